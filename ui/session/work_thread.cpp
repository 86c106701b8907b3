#include "ui/session/work_thread.h"

#include <QObject>
#include <atomic>
#include <cstdint>
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

struct NewestTask::State {
    QObject receiver;                      // lives in the GUI thread
    std::uint64_t newest = 0;              // number of the last request; GUI thread only
    bool busy = false;                     // likewise
    std::atomic<std::uint64_t> wanted{0};  // what the thread need not begin with is older
    std::unique_ptr<WorkThread> thread;    // last: its jobs use all of the above
};

NewestTask::NewestTask() : state_(std::make_unique<State>()) {}

NewestTask::~NewestTask() {
    cancel();
}

void NewestTask::start(Work work) {
    State* const state = state_.get();
    const std::uint64_t number = ++state->newest;
    state->busy = true;
    state->wanted = number;
    if (!state->thread) state->thread = std::make_unique<WorkThread>();
    state->thread->post([state, number, work = std::move(work)] {
        if (state->wanted != number) return;
        Deliver deliver = work();
        QMetaObject::invokeMethod(
            &state->receiver,
            [state, number, deliver = std::move(deliver)] {
                if (state->newest != number || !state->busy) return;
                state->busy = false;
                deliver();
            },
            Qt::QueuedConnection);
    });
}

void NewestTask::cancel() {
    state_->wanted = 0;
    state_->busy = false;
}

bool NewestTask::busy() const {
    return state_->busy;
}

}  // namespace trapwright::session
