#include "sim/cluster/coordinator.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "core/base/parallel.h"
#include "core/trial/batch_codec.h"
#include "sim/cluster/workbench.h"

namespace trapwright::cluster {

namespace {

using Clock = std::chrono::steady_clock;
using Outcomes = std::vector<std::vector<trial::Outcome>>;

/// How long the serving thread sleeps when nothing happens.
constexpr auto kNap = std::chrono::milliseconds(1);
/// How often a run looks whether it is cancelled.
constexpr auto kLook = std::chrono::milliseconds(20);
/// The weight of a new speed beside what was measured before.
constexpr double kNewWeight = 0.5;

double secondsSince(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::string describeRank(int rank, const Hello& member) {
    return fmt::format("Rank {} on {}", rank, member.host);
}

/// The best instruction set that all have; none if there is none.
std::optional<std::string> agreeOn(const std::vector<Hello>& members) {
    for (const std::string& set : members.front().instructionSets) {
        const bool haveAll = std::ranges::all_of(members, [&](const Hello& member) {
            return std::ranges::find(member.instructionSets, set) != member.instructionSets.end();
        });
        if (haveAll) return set;
    }
    return std::nullopt;
}

/// Why these cannot work together; empty: they can.
std::string findMismatch(const std::vector<Hello>& members) {
    for (std::size_t rank = 1; rank < members.size(); ++rank) {
        const Hello& one = members[rank];
        const std::string who = describeRank(static_cast<int>(rank), one);
        if (one.program != members[0].program)
            return fmt::format(
                "{} runs another build of Trapwright than rank 0 on {}, and would give other bits. Install "
                "the "
                "same one on all machines.",
                who, members[0].host);
        if (one.mathInstructions != members[0].mathInstructions)
            return fmt::format(
                "The mathematics of {}'s C library takes {}, that of rank 0 on {} {}: results would hang on "
                "who makes them. Leave that machine out.",
                who, one.mathInstructions, members[0].host, members[0].mathInstructions);
    }
    return {};
}

/// Which trial is meant.
struct Place {
    std::size_t batch = 0;
    std::size_t trial = 0;
};

/// Trials of like parts together, as engines like them.
std::vector<Place> orderTrials(std::span<const trial::TrialBatch> batches) {
    std::vector<std::pair<std::size_t, Place>> places;
    for (std::size_t b = 0; b < batches.size(); ++b) {
        for (std::size_t i = 0; i < batches[b].trials.size(); ++i) {
            const auto& parts = batches[b].trials[i].parts;
            places.push_back({parts.empty() ? 0 : parts.front().part, {b, i}});
        }
    }
    std::ranges::stable_sort(places, {}, &std::pair<std::size_t, Place>::first);
    std::vector<Place> ordered;
    ordered.reserve(places.size());
    for (const auto& [part, place] : places)
        ordered.push_back(place);
    return ordered;
}

/// All of a batch but its trials.
trial::TrialBatch withoutTrials(const trial::TrialBatch& batch) {
    return {batch.track,   batch.parts, batch.drive, batch.contact, batch.partsContact, batch.termination,
            batch.gravity, batch.step,  {}};
}

}  // namespace

std::size_t chooseShare(std::size_t left, double speed, double allSpeeds, bool isSpeedKnown) {
    const double even = static_cast<double>(left) * speed / allSpeeds / kShares;
    const double least = isSpeedKnown ? kLeastTime * speed : 1.0;
    const double share = std::ceil(std::max(even, least));
    return static_cast<std::size_t>(std::clamp(share, 1.0, static_cast<double>(left)));
}

struct Coordinator::Run {
    struct GivenTask {
        int rank = 0;
        std::size_t first = 0;  // in the order of trials
        std::size_t count = 0;
        std::int64_t counted = 0;  // trials of it that the control knows of
    };

    std::uint64_t id = 0;
    std::string engine;
    unsigned threads = 0;
    double step = 0.0;
    bool isAside = false;
    std::span<const trial::TrialBatch> batches;
    base::RunControl control;
    std::vector<Place> order;
    std::size_t next = 0;  // the first trial that nobody has
    std::size_t left = 0;  // trials without outcome
    Outcomes outcomes;
    std::string problem;
    RunState told = RunState::running;
    std::set<int> toldRanks;  // that know of the run
    std::map<std::uint64_t, GivenTask> tasks;
    std::map<const track::Track*, std::uint64_t> trackIds;
    std::map<const track::Track*, std::string> trackBytes;
    std::map<const part::Part*, std::uint64_t> partIds;

    /// By which speeds are known.
    [[nodiscard]] std::string kind() const { return engine + (isAside ? " aside" : ""); }
};

struct Coordinator::Rank {
    std::map<std::uint64_t, bool> tasks;  // that it has, and whether aside
    std::set<std::uint64_t> parts;        // that it knows
    std::set<std::uint64_t> tracks;
    Clock::time_point heard;
};

/// How fast the ranks make trials of one kind of run, as far as that is measured.
struct Coordinator::Speeds {
    std::vector<double> ofRank;  // 0: not known yet [trials/s]
    double sum = 0.0;            // of those that are known
    unsigned threads = 0;        // that those have
};

base::Result<std::unique_ptr<Coordinator>> Coordinator::start(std::unique_ptr<Channel> channel,
                                                              const trial::EngineRegistry& engines,
                                                              Hello self,
                                                              const UseInstructionSet& useInstructionSet,
                                                              const Patience& patience) {
    const auto count = static_cast<std::size_t>(channel->count());
    std::vector<std::optional<Hello>> heard(count);
    heard[0] = std::move(self);
    const auto refuse = [&](const std::string& why) {
        for (int rank = 1; rank < channel->count(); ++rank)
            channel->send(rank, encode(Over{why}));
        channel->flush(1.0);
        return base::Error{why};
    };
    const Clock::time_point begin = Clock::now();
    while (!std::ranges::all_of(heard, [](const auto& one) { return one.has_value(); })) {
        while (const auto received = channel->receive()) {
            auto message = decode(received->bytes);
            if (!message) return refuse(message.error().message);
            if (auto* hello = std::get_if<Hello>(&*message)) heard[received->from] = std::move(*hello);
        }
        if (secondsSince(begin) > patience.meeting) {
            const auto missing = std::ranges::find(heard, false, &std::optional<Hello>::has_value);
            return refuse(fmt::format("Rank {} did not report within {:.0f} s of the job's start.",
                                      missing - heard.begin(), patience.meeting));
        }
        std::this_thread::sleep_for(kNap);
    }
    std::vector<Hello> members;
    members.reserve(count);
    for (std::optional<Hello>& one : heard)
        members.push_back(std::move(*one));
    if (const std::string mismatch = findMismatch(members); !mismatch.empty()) return refuse(mismatch);
    const auto agreed = agreeOn(members);
    if (!agreed) return refuse("There is no instruction set that all machines of this job have.");
    if (const base::Status used = useInstructionSet(*agreed); !used) return refuse(used.error().message);
    return std::unique_ptr<Coordinator>(
        new Coordinator(std::move(channel), engines, std::move(members), *agreed, patience));
}

Coordinator::Coordinator(std::unique_ptr<Channel> channel, const trial::EngineRegistry& engines,
                         std::vector<Hello> members, std::string instructionSet, const Patience& patience)
    : channel_(std::move(channel)),
      members_(std::move(members)),
      instructionSet_(std::move(instructionSet)),
      patience_(patience),
      ranks_(members_.size()),
      bench_(std::make_unique<Workbench>(engines, members_.front().threads)) {
    for (Rank& rank : ranks_)
        rank.heard = Clock::now();
    for (const Hello& member : members_)
        threads_ += member.threads;
    for (int rank = 1; rank < channel_->count(); ++rank)
        send(rank, Welcome{instructionSet_});
    thread_ = std::thread([this] { serve(); });
}

Coordinator::~Coordinator() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    wake_.notify_all();
    thread_.join();
    for (int rank = 1; rank < channel_->count(); ++rank)
        send(rank, Over{failure_});
    constexpr double kFarewell = 2.0;  // [s]
    channel_->flush(kFarewell);
}

base::Result<Outcomes> Coordinator::run(const std::string& engine, const trial::EngineOptions& options,
                                        std::span<const trial::TrialBatch> batches,
                                        base::RunControl control) {
    for (const trial::TrialBatch& batch : batches)
        if (const auto problem = findProblem(batch)) return *problem;
    Run run;
    run.engine = engine;
    run.threads = options.threads;
    run.step = options.step;
    run.isAside = base::hasLowestPriority();
    run.batches = batches;
    run.control = control;
    run.order = orderTrials(batches);
    run.left = run.order.size();
    for (const trial::TrialBatch& batch : batches)
        run.outcomes.emplace_back(batch.trials.size());

    std::unique_lock lock(mutex_);
    run.id = ++lastId_;
    runs_.push_back(&run);
    wake_.notify_all();
    while (failure_.empty() && run.left > 0 && run.problem.empty() && !control.cancelled())
        wake_.wait_for(lock, kLook);
    std::erase(runs_, &run);
    tell(run, RunState::over);
    for (Rank& rank : ranks_)
        for (const auto& [track, id] : run.trackIds)
            rank.tracks.erase(id);
    if (!failure_.empty()) {
        // What was made is of no use, and nothing is to be made again.
        control.cancel();
        return base::Error{failure_};
    }
    if (!run.problem.empty()) return base::Error{run.problem};
    if (run.left > 0) return base::Error{"The simulation was cancelled."};
    return std::move(run.outcomes);
}

std::optional<std::string> Coordinator::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_.empty() ? std::nullopt : std::optional(failure_);
}

Traffic Coordinator::traffic() const {
    const std::lock_guard lock(mutex_);
    return traffic_;
}

void Coordinator::serve() {
    Clock::time_point looked = Clock::now();
    Clock::time_point signGiven = looked;
    std::unique_lock lock(mutex_);
    while (!over_) {
        const Clock::time_point begin = Clock::now();
        // Who was stopped itself heard nobody.
        if (secondsSince(looked) > patience_.pulse)
            for (Rank& rank : ranks_)
                rank.heard = begin;
        looked = begin;
        bool isBusy = receiveAll();
        isBusy = takeOwnWork() || isBusy;
        if (failure_.empty()) {
            steerRuns();
            isBusy = grantAll() || isBusy;
            if (secondsSince(signGiven) > patience_.pulse) {
                signGiven = begin;
                lookAfterRanks();
            }
        }
        if (isBusy) {
            traffic_.busy += secondsSince(begin);
            continue;
        }
        wake_.wait_for(lock, kNap);
    }
}

bool Coordinator::receiveAll() {
    bool any = false;
    while (const auto received = channel_->receive()) {
        any = true;
        traffic_.messages += 1;
        traffic_.bytes += static_cast<std::int64_t>(received->bytes.size());
        ranks_[received->from].heard = Clock::now();
        const auto message = decode(received->bytes);
        if (!message) {
            fail(message.error().message);
            return true;
        }
        take(received->from, *message);
    }
    return any;
}

void Coordinator::take(int rank, const Message& message) {
    if (const auto* answer = std::get_if<Answer>(&message)) {
        auto outcomes = trial::decodeOutcomes(answer->outcomes);
        if (!outcomes) return fail(outcomes.error().message);
        takeAnswer(answer->task, answer->problem, std::move(*outcomes), answer->seconds);
    } else if (const auto* pulse = std::get_if<Pulse>(&message)) {
        takeProgress(pulse->progress);
    } else if (const auto* over = std::get_if<Over>(&message)) {
        fail(describeRank(rank, members_[rank]) + " gave up: " + over->reason);
    }
}

void Coordinator::takeAnswer(std::uint64_t task, const std::string& problem,
                             std::vector<trial::Outcome> outcomes, double seconds) {
    for (Rank& rank : ranks_)
        rank.tasks.erase(task);
    for (Run* run : runs_) {
        const auto found = run->tasks.find(task);
        if (found == run->tasks.end()) continue;
        const Run::GivenTask given = found->second;
        run->tasks.erase(found);
        if (!problem.empty() || outcomes.size() != given.count) {
            // A task that was cancelled has a problem, too, but then nobody waits for it.
            run->problem = problem.empty() ? "A rank left out trials." : problem;
            wake_.notify_all();
            return;
        }
        for (std::size_t i = 0; i < given.count; ++i) {
            const Place& place = run->order[given.first + i];
            run->outcomes[place.batch][place.trial] = std::move(outcomes[i]);
        }
        run->left -= given.count;
        run->control.advance(static_cast<std::int64_t>(given.count) - given.counted);
        if (seconds > 0.0) noteSpeed(given.rank, *run, static_cast<double>(given.count) / seconds);
        if (run->left == 0) wake_.notify_all();
        return;
    }
}

void Coordinator::takeProgress(const std::vector<Progress>& progress) {
    for (const auto& [task, done] : progress) {
        for (Run* run : runs_) {
            const auto found = run->tasks.find(task);
            if (found == run->tasks.end() || done <= found->second.counted) continue;
            run->control.advance(done - found->second.counted);
            found->second.counted = done;
        }
    }
}

bool Coordinator::takeOwnWork() {
    std::vector<FinishedJob> finished = bench_->takeFinished();
    for (FinishedJob& job : finished)
        takeAnswer(job.task, job.problem, std::move(job.outcomes), job.seconds);
    return !finished.empty();
}

void Coordinator::steerRuns() {
    for (Run* run : runs_) {
        const RunState state = run->control.paused() ? RunState::paused : RunState::running;
        if (state != run->told) tell(*run, state);
        run->told = state;
    }
}

void Coordinator::tell(Run& run, RunState state) {
    for (const int rank : run.toldRanks) {
        if (rank == 0) {
            bench_->steer(run.id, state);
        } else {
            send(rank, Steer{run.id, state});
        }
    }
}

bool Coordinator::grantAll() {
    bool any = false;
    for (int rank = 0; rank < channel_->count(); ++rank) {
        for (const bool isAside : {false, true}) {
            // A second task that waits would spare a millisecond between tasks of a hundred, and be late at
            // the end of a run.
            const auto& tasks = ranks_[rank].tasks;
            if (std::ranges::find(tasks, isAside, &std::pair<const std::uint64_t, bool>::second) !=
                tasks.end())
                continue;
            const auto run = std::ranges::find_if(runs_, [&](const Run* one) {
                return one->isAside == isAside && one->next < one->order.size() && one->problem.empty() &&
                       one->told == RunState::running && !one->control.cancelled();
            });
            if (run == runs_.end()) continue;
            grant(rank, **run);
            any = true;
        }
    }
    return any;
}

Coordinator::Speeds& Coordinator::speedsOf(const Run& run) {
    Speeds& speeds = speeds_[run.kind()];
    speeds.ofRank.resize(members_.size(), 0.0);
    return speeds;
}

void Coordinator::noteSpeed(int rank, const Run& run, double speed) {
    Speeds& speeds = speedsOf(run);
    double& known = speeds.ofRank[rank];
    if (known == 0.0) speeds.threads += members_[rank].threads;
    const double now = known == 0.0 ? speed : known + kNewWeight * (speed - known);
    speeds.sum += now - known;
    known = now;
}

void Coordinator::grant(int rank, Run& run) {
    const Speeds& speeds = speedsOf(run);
    const bool isKnown = speeds.threads > 0;
    // Who is not known yet is as fast by thread as those that are.
    const double perThread = isKnown ? speeds.sum / speeds.threads : 1.0;
    const double own = speeds.ofRank[rank];
    const double speed = own > 0.0 ? own : perThread * members_[rank].threads;
    const double all = speeds.sum + perThread * (threads_ - speeds.threads);
    const std::size_t count = chooseShare(run.order.size() - run.next, speed, all, isKnown);

    std::vector<trial::TrialBatch> batches;
    std::size_t last = run.batches.size();
    for (std::size_t i = run.next; i < run.next + count; ++i) {
        const Place& place = run.order[i];
        const trial::TrialBatch& batch = run.batches[place.batch];
        if (place.batch != last) batches.push_back(withoutTrials(batch));
        last = place.batch;
        batches.back().trials.push_back(batch.trials[place.trial]);
    }
    const std::uint64_t task = ++lastId_;
    run.tasks[task] = {rank, run.next, count, 0};
    run.next += count;
    run.toldRanks.insert(rank);
    ranks_[rank].tasks[task] = run.isAside;
    traffic_.tasks += 1;
    if (rank == 0) {
        bench_->add({task, run.id, run.engine, run.threads, run.step, run.isAside, std::move(batches)});
    } else {
        Task sent{task, run.id, run.engine, run.threads, run.step, run.isAside, {}};
        sent.pieces = pack(rank, run, batches);
        send(rank, sent);
    }
}

std::vector<Piece> Coordinator::pack(int rank, Run& run, const std::vector<trial::TrialBatch>& batches) {
    std::vector<Piece> pieces;
    for (const trial::TrialBatch& batch : batches) {
        Piece piece;
        const auto [track, isNew] = run.trackIds.try_emplace(batch.track.get(), 0);
        if (isNew) {
            track->second = ++lastId_;
            run.trackBytes[batch.track.get()] = trial::encode(*batch.track);
        }
        piece.track = track->second;
        if (ranks_[rank].tracks.insert(piece.track).second)
            send(rank, SentTrack{run.id, piece.track, run.trackBytes[batch.track.get()]});
        for (const auto& part : batch.parts) {
            const std::uint64_t id = idOfPart(run, part);
            piece.parts.push_back(id);
            if (!ranks_[rank].parts.insert(id).second) continue;
            send(rank, SentPart{id, trial::encode(*part)});
        }
        piece.batch = trial::encode(batch);
        pieces.push_back(std::move(piece));
    }
    return pieces;
}

std::uint64_t Coordinator::idOfPart(Run& run, const std::shared_ptr<const part::Part>& part) {
    const auto [known, isNew] = run.partIds.try_emplace(part.get(), 0);
    if (isNew) {
        // A generation makes its specimens anew, with the same bits.
        const auto [same, isFirst] = parts_.try_emplace(trial::encode(*part), lastId_ + 1);
        if (isFirst) ++lastId_;
        known->second = same->second;
    }
    return known->second;
}

void Coordinator::lookAfterRanks() {
    takeProgress(bench_->progress());
    for (int rank = 1; rank < channel_->count(); ++rank) {
        send(rank, Pulse{});
        if (secondsSince(ranks_[rank].heard) > patience_.silence)
            return fail(fmt::format(
                "{} has not answered for {:.0f} s: it died, hangs, or the network is cut. The generation in "
                "progress is dropped; what was saved before is safe.",
                describeRank(rank, members_[rank]), patience_.silence));
    }
}

void Coordinator::send(int rank, const Message& message) {
    std::string bytes = encode(message);
    traffic_.messages += 1;
    traffic_.bytes += static_cast<std::int64_t>(bytes.size());
    channel_->send(rank, std::move(bytes));
}

void Coordinator::fail(const std::string& why) {
    if (failure_.empty()) failure_ = why;
    wake_.notify_all();
}

}  // namespace trapwright::cluster
