#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/trial/engine_registry.h"
#include "sim/cluster/channel.h"
#include "sim/cluster/messages.h"
#include "sim/cluster/worker.h"

namespace trapwright::cluster {

/// What the messages of a job came to.
struct Traffic {
    std::int64_t messages = 0;
    std::int64_t bytes = 0;
    std::int64_t tasks = 0;
    double busy = 0.0;  // that rank 0 spent on them: writing, sending, reading [s]
};

// How many trials a rank is given at a time: a share of what is left, by how fast it is, so that shares
// shrink towards the end and all ranks end together (guided self-scheduling: Polychronopoulos and Kuck 1987;
// by measured speeds: Hummel, Schmidt, Uma, Wein 1996).

/// Into how many shares each rank's part of what is left is cut.
inline constexpr double kShares = 2.0;
/// How long a share lasts at least, so that messages and its last trials, which wide instructions make with
/// few lanes, do not matter. [s]
inline constexpr double kLeastTime = 0.15;

/// `left`: trials that nobody has yet; `speed`, `allSpeeds`: of this rank and of all together [trials/s], or
/// threads where no speed is known. Between 1 and `left`, which is not 0.
std::size_t chooseShare(std::size_t left, double speed, double allSpeeds, bool isSpeedKnown);

/// Rank 0's side of a job: hands trials to all ranks, itself among them, as they become idle, and puts the
/// outcomes where they belong. Every outcome depends on its trial alone, so it does not matter who makes it.
/// Safe to call from several threads.
class Coordinator {
 public:
    /// Waits for all ranks, and agrees with them on the best instruction set that all have. An error if one
    /// does not come, is another program, or has other mathematics than rank 0; the others are told, and end.
    static base::Result<std::unique_ptr<Coordinator>> start(std::unique_ptr<Channel> channel,
                                                            const trial::EngineRegistry& engines, Hello self,
                                                            const UseInstructionSet& useInstructionSet,
                                                            const Patience& patience = {});
    Coordinator(const Coordinator&) = delete;
    Coordinator& operator=(const Coordinator&) = delete;
    /// Tells the other ranks that the job is over.
    ~Coordinator();

    /// trial::Engine::run of the engine of that name on all ranks. If a rank is lost the control is
    /// cancelled.
    base::Result<std::vector<std::vector<trial::Outcome>>> run(const std::string& engine,
                                                               const trial::EngineOptions& options,
                                                               std::span<const trial::TrialBatch> batches,
                                                               base::RunControl control);

    [[nodiscard]] const std::vector<Hello>& members() const { return members_; }
    /// Agreed on by all ranks.
    [[nodiscard]] const std::string& instructionSet() const { return instructionSet_; }
    /// Why the job cannot go on; none: it can.
    [[nodiscard]] std::optional<std::string> failure() const;
    [[nodiscard]] Traffic traffic() const;

 private:
    struct Run;
    struct Rank;
    struct Speeds;

    Coordinator(std::unique_ptr<Channel> channel, const trial::EngineRegistry& engines,
                std::vector<Hello> members, std::string instructionSet, const Patience& patience);

    // By the thread that serves; all but serve() with the mutex.
    void serve();
    bool receiveAll();
    void take(int rank, const Message& message);
    void takeAnswer(std::uint64_t task, const std::string& problem, std::vector<trial::Outcome> outcomes,
                    double seconds);
    void takeProgress(const std::vector<Progress>& progress);
    bool takeOwnWork();
    void steerRuns();
    bool grantAll();
    void grant(int rank, Run& run);
    std::vector<Piece> pack(int rank, Run& run, const std::vector<trial::TrialBatch>& batches);
    std::uint64_t idOfPart(Run& run, const std::shared_ptr<const part::Part>& part);
    void lookAfterRanks();
    void send(int rank, const Message& message);
    void tell(Run& run, RunState state);
    void fail(const std::string& why);
    Speeds& speedsOf(const Run& run);
    void noteSpeed(int rank, const Run& run, double speed);

    std::unique_ptr<Channel> channel_;
    std::vector<Hello> members_;
    std::string instructionSet_;
    Patience patience_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    bool over_ = false;
    std::string failure_;
    Traffic traffic_;
    std::uint64_t lastId_ = 0;
    unsigned threads_ = 0;  // of all ranks
    std::vector<Rank> ranks_;
    std::map<std::string, Speeds> speeds_;        // by the kind of run
    std::vector<Run*> runs_;                      // in the order in which they began
    std::map<std::string, std::uint64_t> parts_;  // id by its bytes
    std::unique_ptr<class Workbench> bench_;
    std::thread thread_;
};

/// The same engines, each of which simulates on all ranks. Replays are made by rank 0, and costs are not
/// measured. `coordinator` outlives them.
trial::EngineRegistry spread(const trial::EngineRegistry& engines, Coordinator& coordinator);

}  // namespace trapwright::cluster
