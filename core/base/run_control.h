#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

namespace trapwright::base {

/// A copyable handle on a piece of long work: any copy may cancel it and read its progress, from any thread.
class RunControl {
 public:
    RunControl();

    /// Asks the work to end as soon as it can; its result is then incomplete and must be dropped.
    void cancel();
    [[nodiscard]] bool cancelled() const;

    /// Adds to the number of finished trials (or whatever unit the work counts in).
    void advance(std::int64_t count);
    [[nodiscard]] std::int64_t done() const;

 private:
    struct Shared {
        std::atomic<bool> cancelled{false};
        std::atomic<std::int64_t> done{0};
    };
    std::shared_ptr<Shared> shared_;
};

}  // namespace trapwright::base
