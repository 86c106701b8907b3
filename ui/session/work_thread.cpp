#include "ui/session/work_thread.h"

#include <utility>

namespace trapwright::session {

WorkThread::WorkThread(std::function<void()> begin)
    : thread_([this, begin = std::move(begin)] {
          if (begin) begin();
          run();
      }) {}

WorkThread::~WorkThread() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void WorkThread::post(std::function<void()> job) {
    {
        const std::lock_guard lock(mutex_);
        jobs_.push_back(std::move(job));
    }
    wake_.notify_one();
}

void WorkThread::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [this] { return over_ || !jobs_.empty(); });
        if (jobs_.empty()) return;
        {
            const std::function<void()> job = std::move(jobs_.front());
            jobs_.pop_front();
            lock.unlock();
            job();
        }
        lock.lock();
    }
}

}  // namespace trapwright::session
