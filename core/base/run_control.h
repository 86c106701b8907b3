#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

namespace trapwright::base {

/// A copyable handle on a piece of long work: any copy may cancel it, have it wait and read its progress,
/// from any thread.
class RunControl {
 public:
    RunControl();

    /// Asks the work to end as soon as it can, also while it waits; its result is then incomplete and must be
    /// dropped.
    void cancel();
    [[nodiscard]] bool cancelled() const;

    /// Has the work stand still as soon as it can, until resume() or cancel(). Nothing is lost by that.
    void pause();
    void resume();
    [[nodiscard]] bool paused() const;

    /// For the work itself, wherever it can stand still: waits while paused. False if it is to end.
    [[nodiscard]] bool mayGoOn() const;

    /// Adds to the number of finished trials (or whatever unit the work counts in).
    void advance(std::int64_t count);
    [[nodiscard]] std::int64_t done() const;

 private:
    struct Shared {
        std::atomic<unsigned> state{0};
        std::atomic<std::int64_t> done{0};
    };
    std::shared_ptr<Shared> shared_;
};

}  // namespace trapwright::base
