#include "core/trial/backed_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/trial/termination_monitor.h"

namespace trapwright::trial {

namespace {

using Outcomes = std::vector<std::vector<Outcome>>;

/// A part that an engine says to have come so far from its track was thrown there by no drive: engines look
/// every few milliseconds. [m]
constexpr double kFarOff = 1.0;

/// Why this is not how a trial ended; none if it is.
std::optional<std::string> findFault(const TrialBatch& batch, const TrialSpec& spec, const Outcome& outcome) {
    if (outcome.parts.size() != spec.parts.size()) return "it has no outcome";
    if (!isFinite(outcome)) return "its pose is not a number";
    const track::Track& track = *batch.track;
    for (const PartOutcome& part : outcome.parts) {
        if (part.throughSurface) return "it fell through the track's surface";
        const base::Vec3& there = part.farthest.position;
        const double off = std::max(
            {there.x() - track.finish, std::abs(there.y()) - track.width, std::abs(there.z()) - track.width});
        if (off > kFarOff) return fmt::format("it was thrown {:.3g} m off the track", off);
    }
    return std::nullopt;
}

Outcome makeStuck(const TrialBatch& batch, const TrialSpec& spec) {
    TerminationMonitor monitor(batch, spec);
    for (std::size_t i = 0; i < spec.parts.size(); ++i)
        monitor.update(i, spec.parts[i].time, spec.parts[i].pose);
    Outcome outcome = monitor.outcome();
    for (std::size_t i = 0; i < spec.parts.size(); ++i) {
        outcome.parts[i].ending = Ending::stuck;
        outcome.parts[i].time = spec.parts[i].time + batch.termination.stuckTime;
    }
    return outcome;
}

/// The batch with this trial alone, in the step that the reference finds right.
TrialBatch makeAgain(const TrialBatch& batch, std::size_t trial) {
    TrialBatch alone = batch;
    alone.trials = {batch.trials[trial]};
    alone.step = 0.0;
    return alone;
}

/// Which trial is meant: its places.
struct Place {
    std::size_t batch = 0;
    std::size_t trial = 0;
};

std::vector<Place> listPlaces(std::span<const TrialBatch> batches) {
    std::vector<Place> places;
    for (std::size_t b = 0; b < batches.size(); ++b)
        for (std::size_t i = 0; i < batches[b].trials.size(); ++i)
            places.push_back({b, i});
    return places;
}

/// Runs these trials by halves until only those fail that fail alone. Their outcomes stay empty, and
/// `reasons` says why. False if cancelled.
class Bisection {
 public:
    Bisection(const Engine& engine, std::span<const TrialBatch> batches, base::RunControl control)
        : engine_(&engine), batches_(batches), control_(std::move(control)) {
        for (const TrialBatch& batch : batches) {
            outcomes.emplace_back(batch.trials.size());
            reasons.emplace_back(batch.trials.size());
        }
    }

    bool run(std::span<const Place> places) {
        std::vector<TrialBatch> chosen;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (i == 0 || places[i].batch != places[i - 1].batch) {
                chosen.push_back(batches_[places[i].batch]);
                chosen.back().trials.clear();
            }
            chosen.back().trials.push_back(batches_[places[i].batch].trials[places[i].trial]);
        }
        const auto made = engine_->run(chosen, control_);
        if (control_.cancelled()) return false;
        if (made) {
            takeOver(*made, chosen, places);
            return true;
        }
        if (places.size() == 1) {
            reasons[places[0].batch][places[0].trial] = made.error().message;
            return true;
        }
        const std::size_t half = places.size() / 2;
        return run(places.first(half)) && run(places.subspan(half));
    }

    Outcomes outcomes;
    std::vector<std::vector<std::string>> reasons;

 private:
    void takeOver(const Outcomes& made, std::span<const TrialBatch> chosen, std::span<const Place> places) {
        std::size_t next = 0;
        for (std::size_t b = 0; b < chosen.size(); ++b) {
            for (std::size_t i = 0; i < chosen[b].trials.size(); ++i, ++next) {
                if (b < made.size() && i < made[b].size())
                    outcomes[places[next].batch][places[next].trial] = made[b][i];
            }
        }
    }

    const Engine* engine_;
    std::span<const TrialBatch> batches_;
    base::RunControl control_;
};

bool canBeSimulated(std::span<const TrialBatch> batches) {
    return std::ranges::none_of(batches,
                                [](const TrialBatch& batch) { return findProblem(batch).has_value(); });
}

}  // namespace

BackedEngine::BackedEngine(std::shared_ptr<const Engine> engine, EngineKind reference, EngineOptions options)
    : engine_(std::move(engine)), reference_(std::move(reference)), options_(std::move(options)) {}

base::Result<Outcomes> BackedEngine::run(std::span<const TrialBatch> batches,
                                         base::RunControl control) const {
    const std::int64_t doneBefore = control.done();
    auto made = engine_->run(batches, control);
    if (control.cancelled()) return made;
    const std::vector<Place> places = listPlaces(batches);
    Outcomes outcomes;
    std::vector<std::vector<std::string>> reasons;
    if (made) {
        outcomes = std::move(*made);
        outcomes.resize(batches.size());
        for (std::size_t b = 0; b < batches.size(); ++b)
            outcomes[b].resize(batches[b].trials.size());
    } else {
        // What is wrong with the batches is no matter of a trial.
        if (!canBeSimulated(batches)) return made;
        Bisection bisection(*engine_, batches, control);
        if (!bisection.run(places)) return base::Error{"The simulation was cancelled."};
        outcomes = std::move(bisection.outcomes);
        reasons = std::move(bisection.reasons);
    }

    std::unique_ptr<Engine> reference;
    std::vector<RemadeTrial> remade;
    for (const Place& place : places) {
        const TrialBatch& batch = batches[place.batch];
        const TrialSpec& spec = batch.trials[place.trial];
        Outcome& outcome = outcomes[place.batch][place.trial];
        std::string reason = reasons.empty() ? "" : reasons[place.batch][place.trial];
        if (reason.empty()) {
            const auto fault = findFault(batch, spec, outcome);
            if (!fault) continue;
            reason = *fault;
        }
        if (!reference) reference = reference_.make({options_.threads, 0.0});
        const TrialBatch again = makeAgain(batch, place.trial);
        auto second = reference->run({&again, 1}, control);
        if (control.cancelled()) return base::Error{"The simulation was cancelled."};
        const bool isMade = second && second->size() == 1 && second->front().size() == 1 &&
                            !findFault(again, spec, second->front().front());
        outcome = isMade ? std::move(second->front().front()) : makeStuck(batch, spec);
        remade.push_back({spec.stream, name(), std::move(reason), !isMade});
    }
    if (remade.size() > 1 && remade.size() == places.size() &&
        std::ranges::all_of(remade, &RemadeTrial::isStuck))
        return base::Error{fmt::format("Neither {} nor {} could finish any of {} trials: {}", name(),
                                       reference_.name, remade.size(), remade.front().reason)};
    if (options_.remade)
        for (RemadeTrial& trial : remade)
            options_.remade->add(std::move(trial));
    // Each trial counts once, however often it was made.
    if (!made || !remade.empty())
        control.advance(doneBefore + static_cast<std::int64_t>(places.size()) - control.done());
    return outcomes;
}

base::Result<Trajectory> BackedEngine::replay(const TrialBatch& batch, std::size_t index, double interval,
                                              base::RunControl control) const {
    auto own = engine_->replay(batch, index, interval, control);
    if (control.cancelled() || index >= batch.trials.size()) return own;
    if (own && !findFault(batch, batch.trials[index], own->outcome)) return own;
    if (!own && !canBeSimulated({&batch, 1})) return own;
    const auto reference = reference_.make({options_.threads, 0.0});
    return reference->replay(makeAgain(batch, index), 0, interval, std::move(control));
}

}  // namespace trapwright::trial
