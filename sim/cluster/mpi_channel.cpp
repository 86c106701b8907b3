#include "sim/cluster/mpi_channel.h"

#include <mpi.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <thread>
#include <utility>
#include <vector>

namespace trapwright::cluster {

namespace {

constexpr int kTag = 1;

class MpiChannel : public Channel {
 public:
    MpiChannel(int rank, int count) : rank_(rank), count_(count) {}

    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int count() const override { return count_; }

    void send(int to, std::string bytes) override {
        tidy();
        // A deque moves nothing that is being sent.
        Sent& sent = sent_.emplace_back(Sent{std::move(bytes), MPI_REQUEST_NULL});
        MPI_Isend(sent.bytes.data(), static_cast<int>(sent.bytes.size()), MPI_BYTE, to, kTag, MPI_COMM_WORLD,
                  &sent.request);
    }

    std::optional<Received> receive() override {
        tidy();
        int isThere = 0;
        MPI_Status status;
        MPI_Iprobe(MPI_ANY_SOURCE, kTag, MPI_COMM_WORLD, &isThere, &status);
        if (isThere == 0) return std::nullopt;
        int size = 0;
        MPI_Get_count(&status, MPI_BYTE, &size);
        Received received{status.MPI_SOURCE, std::string(static_cast<std::size_t>(size), '\0')};
        MPI_Recv(received.bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, kTag, MPI_COMM_WORLD,
                 MPI_STATUS_IGNORE);
        return received;
    }

    bool flush(double seconds) override {
        constexpr auto kNap = std::chrono::milliseconds(1);
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (!tidy()) {
            if (std::chrono::steady_clock::now() > end) return false;
            std::this_thread::sleep_for(kNap);
        }
        return true;
    }

 private:
    struct Sent {
        std::string bytes;
        MPI_Request request;
    };

    /// Lets go of what has left. Whether nothing is on its way any more.
    bool tidy() {
        for (Sent& one : sent_) {
            if (one.request == MPI_REQUEST_NULL) continue;
            int isDone = 0;
            MPI_Test(&one.request, &isDone, MPI_STATUS_IGNORE);
            if (isDone != 0) one.bytes = {};
        }
        while (!sent_.empty() && sent_.front().request == MPI_REQUEST_NULL)
            sent_.pop_front();
        return sent_.empty();
    }

    int rank_;
    int count_;
    std::deque<Sent> sent_;
};

using Processors = std::array<std::uint64_t, CPU_SETSIZE / 64>;

/// Those that this process may use; a bit each.
Processors usableProcessors() {
    cpu_set_t set;
    CPU_ZERO(&set);
    ::sched_getaffinity(0, sizeof set, &set);
    Processors processors{};
    for (std::size_t i = 0; i < CPU_SETSIZE; ++i)
        if (CPU_ISSET(i, &set)) processors[i / 64] |= std::uint64_t{1} << (i % 64);
    return processors;
}

}  // namespace

base::Result<std::unique_ptr<MpiSession>> MpiSession::begin(int& count, char**& arguments) {
    int provided = MPI_THREAD_SINGLE;
    if (MPI_Init_thread(&count, &arguments, MPI_THREAD_SERIALIZED, &provided) != MPI_SUCCESS)
        return base::Error{"MPI could not be started."};
    std::unique_ptr<MpiSession> session(new MpiSession);
    if (provided < MPI_THREAD_SERIALIZED)
        return base::Error{"This MPI cannot be used by several threads; Trapwright needs that."};
    MPI_Comm_rank(MPI_COMM_WORLD, &session->rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &session->count_);
    return session;
}

MpiSession::~MpiSession() {
    MPI_Finalize();
}

std::string MpiSession::host() const {
    std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
    int size = 0;
    MPI_Get_processor_name(name.data(), &size);
    return {name.data(), static_cast<std::size_t>(size)};
}

unsigned MpiSession::chooseThreads() const {
    MPI_Comm here = MPI_COMM_NULL;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &here);
    int ranksHere = 1;
    MPI_Comm_size(here, &ranksHere);
    const Processors own = usableProcessors();
    std::vector<Processors> all(static_cast<std::size_t>(ranksHere));
    MPI_Allgather(own.data(), static_cast<int>(own.size()), MPI_UINT64_T, all.data(),
                  static_cast<int>(own.size()), MPI_UINT64_T, here);
    MPI_Comm_free(&here);
    int processors = 0;
    for (const std::uint64_t word : own)
        processors += std::popcount(word);
    const auto sharers = std::max<int>(static_cast<int>(std::ranges::count(all, own)), 1);
    return static_cast<unsigned>(std::max(processors / sharers, 1));
}

std::unique_ptr<Channel> MpiSession::makeChannel() const {
    return std::make_unique<MpiChannel>(rank_, count_);
}

void MpiSession::abort(int status) const {
    MPI_Abort(MPI_COMM_WORLD, status);
    std::abort();
}

}  // namespace trapwright::cluster
