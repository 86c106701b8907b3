#pragma once

#include <optional>
#include <string>

namespace trapwright::cluster {

/// What came from another rank.
struct Received {
    int from = 0;
    std::string bytes;
};

/// Carries messages between the ranks of a job: processes on one or many machines, numbered from 0 on. What
/// one rank sends to another comes in that order, once. Used by one thread at a time.
class Channel {
 public:
    Channel() = default;
    Channel(const Channel&) = delete;
    Channel& operator=(const Channel&) = delete;
    virtual ~Channel() = default;

    [[nodiscard]] virtual int rank() const = 0;
    [[nodiscard]] virtual int count() const = 0;

    /// Never waits for the other, who may hang. `bytes` has less than 2 GiB.
    virtual void send(int to, std::string bytes) = 0;
    /// The next message of any rank; none if none is there. Never waits.
    virtual std::optional<Received> receive() = 0;
    /// Waits until all that was sent has left, at most so many seconds. False if it has not.
    virtual bool flush(double seconds) = 0;
};

}  // namespace trapwright::cluster
