#include "core/base/run_control.h"

namespace trapwright::base {

RunControl::RunControl() : shared_(std::make_shared<Shared>()) {}

void RunControl::cancel() {
    shared_->cancelled.store(true, std::memory_order_relaxed);
}

bool RunControl::cancelled() const {
    return shared_->cancelled.load(std::memory_order_relaxed);
}

void RunControl::advance(std::int64_t count) {
    shared_->done.fetch_add(count, std::memory_order_relaxed);
}

std::int64_t RunControl::done() const {
    return shared_->done.load(std::memory_order_relaxed);
}

}  // namespace trapwright::base
