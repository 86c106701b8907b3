#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "sim/cluster/channel.h"

namespace trapwright::testing {

/// Ranks that are threads of one process.
class MemoryNetwork {
 public:
    explicit MemoryNetwork(int ranks) : boxes_(static_cast<std::size_t>(ranks)) {}

    /// From now on nothing comes from this rank nor gets to it.
    void cutOff(int rank) { cutOff_ = rank; }

    std::unique_ptr<cluster::Channel> makeChannel(int rank) { return std::make_unique<End>(*this, rank); }

 private:
    struct Box {
        std::mutex mutex;
        std::deque<cluster::Received> waiting;
    };

    class End : public cluster::Channel {
     public:
        End(MemoryNetwork& network, int rank) : network_(&network), rank_(rank) {}

        [[nodiscard]] int rank() const override { return rank_; }
        [[nodiscard]] int count() const override { return static_cast<int>(network_->boxes_.size()); }
        void send(int to, std::string bytes) override {
            if (network_->cutOff_ == rank_ || network_->cutOff_ == to) return;
            Box& box = network_->boxes_[static_cast<std::size_t>(to)];
            const std::lock_guard lock(box.mutex);
            box.waiting.push_back({rank_, std::move(bytes)});
        }
        std::optional<cluster::Received> receive() override {
            Box& box = network_->boxes_[static_cast<std::size_t>(rank_)];
            const std::lock_guard lock(box.mutex);
            if (box.waiting.empty()) return std::nullopt;
            cluster::Received received = std::move(box.waiting.front());
            box.waiting.pop_front();
            return received;
        }
        bool flush(double /*seconds*/) override { return true; }

     private:
        MemoryNetwork* network_;
        int rank_;
    };

    std::deque<Box> boxes_;
    std::atomic<int> cutOff_ = -1;
};

}  // namespace trapwright::testing
