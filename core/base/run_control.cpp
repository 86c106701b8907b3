#include "core/base/run_control.h"

namespace trapwright::base {

namespace {

constexpr unsigned kCancelled = 1;
constexpr unsigned kPaused = 2;

}  // namespace

RunControl::RunControl() : shared_(std::make_shared<Shared>()) {}

void RunControl::cancel() {
    shared_->state.fetch_or(kCancelled, std::memory_order_relaxed);
    shared_->state.notify_all();
}

bool RunControl::cancelled() const {
    return (shared_->state.load(std::memory_order_relaxed) & kCancelled) != 0;
}

void RunControl::pause() {
    shared_->state.fetch_or(kPaused, std::memory_order_relaxed);
}

void RunControl::resume() {
    shared_->state.fetch_and(~kPaused, std::memory_order_relaxed);
    shared_->state.notify_all();
}

bool RunControl::paused() const {
    return (shared_->state.load(std::memory_order_relaxed) & kPaused) != 0;
}

bool RunControl::mayGoOn() const {
    unsigned state = shared_->state.load(std::memory_order_relaxed);
    while (state == kPaused) {
        shared_->state.wait(state, std::memory_order_relaxed);
        state = shared_->state.load(std::memory_order_relaxed);
    }
    return (state & kCancelled) == 0;
}

void RunControl::advance(std::int64_t count) {
    shared_->done.fetch_add(count, std::memory_order_relaxed);
}

std::int64_t RunControl::done() const {
    return shared_->done.load(std::memory_order_relaxed);
}

}  // namespace trapwright::base
