#pragma once

#include <memory>
#include <string>

#include "core/base/result.h"
#include "sim/cluster/channel.h"

namespace trapwright::cluster {

/// MPI, as long as this lives; one in a process.
class MpiSession {
 public:
    /// Joins the job that this process was started in; alone it is a job of one rank. An error if the MPI at
    /// hand cannot be used from several threads in turn.
    static base::Result<std::unique_ptr<MpiSession>> begin(int& count, char**& arguments);
    MpiSession(const MpiSession&) = delete;
    MpiSession& operator=(const MpiSession&) = delete;
    /// Waits for the other ranks to end, too.
    ~MpiSession();

    [[nodiscard]] int rank() const { return rank_; }
    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] std::string host() const;
    /// How many threads this rank shall work with: the processors that it may use, shared with the ranks that
    /// may use the same ones.
    [[nodiscard]] unsigned chooseThreads() const;

    /// The session outlives it.
    [[nodiscard]] std::unique_ptr<Channel> makeChannel() const;
    /// Ends the whole job, without waiting for anybody.
    [[noreturn]] void abort(int status) const;

 private:
    MpiSession() = default;

    int rank_ = 0;
    int count_ = 1;
};

}  // namespace trapwright::cluster
