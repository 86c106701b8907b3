#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
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

/// Work in the background of which only the newest is wanted. Used by the GUI thread.
class NewestTask {
 public:
    /// Work gives the function that is to be called in the GUI thread with its result.
    using Deliver = std::function<void()>;
    using Work = std::function<Deliver()>;

    NewestTask();
    NewestTask(const NewestTask&) = delete;
    NewestTask& operator=(const NewestTask&) = delete;
    /// Waits for work that has begun.
    ~NewestTask();

    /// Does the work after that which has begun. Nothing that was asked for before is delivered any more.
    void start(Work work);
    void cancel();
    /// Whether something is still to be delivered.
    [[nodiscard]] bool busy() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace trapwright::session
