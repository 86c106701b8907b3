#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace trapwright::session {

/// One thread that does one job after the other.
class WorkThread {
 public:
    /// `begin` is called on the thread before all else. May be empty.
    explicit WorkThread(std::function<void()> begin = {});
    WorkThread(const WorkThread&) = delete;
    WorkThread& operator=(const WorkThread&) = delete;
    /// Waits until every job is done: who is in a hurry cancels them before.
    ~WorkThread();

    void post(std::function<void()> job);

 private:
    void run();

    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<std::function<void()>> jobs_;
    bool over_ = false;
    std::thread thread_;  // last: it uses all of the above
};

}  // namespace trapwright::session
