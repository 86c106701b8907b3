#include "core/study/trap_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

#include "core/base/parallel.h"
#include "core/study/orientation_shares.h"
#include "core/study/presets.h"
#include "core/study/selection.h"
#include "core/study/target.h"
#include "core/study/track_design.h"
#include "core/study/trial_batches.h"
#include "core/track/track_builder.h"
#include "core/traps/groove.h"
#include "core/trial/orientations.h"

namespace trapwright::study {

namespace {

constexpr int kLeastOfWay = 40;                    // of kTrialsOfWays, that end so
constexpr std::size_t kMostWays = 14;              // others are one together
constexpr double kNearWay = 35.0 * base::kDegree;  // what is farther from all ways is none of them
constexpr int kWaysThen = 15;  // ways: of what follows, all take as many trials as tell these
constexpr double kShareOfMet = 0.5;
constexpr std::size_t kFewOfWay = 3;  // that come through a trap

/// All numbers in the middle: a ledge that is not cut.
FixedTraps makePlain(traps::TrapChain traps, const TrackSettings& settings) {
    FixedTraps plain;
    if (traps.empty()) return plain;
    for (const search::Dimension& dimension : traps::designSpace(traps, settings).dimensions)
        plain.numbers.push_back(search::roundToBits(0.5, dimension.bits));
    plain.traps = std::move(traps);
    return plain;
}

double lowestAt(const track::Track& track, double x) {
    for (std::size_t i = 1; i < track.sections.size(); ++i) {
        const track::CrossSection& from = track.sections[i - 1];
        const track::CrossSection& to = track.sections[i];
        if (x > to.x && i + 1 < track.sections.size()) continue;
        const double share = std::clamp((x - from.x) / (to.x - from.x), 0.0, 1.0);
        return std::lerp(traps::findLowest(from), traps::findLowest(to), share);
    }
    return traps::findLowest(track.sections.back());
}

double lowestAtFinish(const track::Track& track) {
    return lowestAt(track, track.finish);
}

}  // namespace

ChainFrame makeFrame(const traps::TrapChain& chain, const traps::TrapChain& then, double room,
                     const TrackSettings& settings) {
    const bool isOfLedges = chain.front()->isLedge;
    const auto before = static_cast<std::ptrdiff_t>(isOfLedges ? kLedgesBefore : kGroovesBefore);
    ChainFrame frame;
    frame.room = room;
    frame.then = makePlain(then, settings);
    const traps::TrapChain first(chain.begin(), chain.begin() + before);
    if (isOfLedges) {
        frame.before = makePlain(first, settings);
    } else {
        frame.before.traps = first;
        for (std::ptrdiff_t i = 0; i < before; ++i)
            std::ranges::copy(traps::restingGroove(settings), std::back_inserter(frame.before.numbers));
    }
    for (const traps::TrapKind* kind : std::span(chain).subspan(first.size())) {
        auto found = std::ranges::find(frame.kinds, kind);
        if (found == frame.kinds.end()) found = frame.kinds.insert(frame.kinds.end(), kind);
        frame.places.push_back(static_cast<std::size_t>(found - frame.kinds.begin()));
    }
    return frame;
}

TrapTrials::TrapTrials(const StudyInputs& inputs, ChainFrame frame, base::RunControl run)
    : inputs_(&inputs),
      frame_(std::move(frame)),
      run_(std::move(run)),
      specimens_(makeSpecimens(inputs.settings, inputs.part)) {}

base::Status TrapTrials::findWays(int trials, ChainProblem& problem) {
    const auto track = build(frame_.before, settings().track);
    if (!track) return track.error();
    const trial::TrialBatch batch = makeBatch(*track, trials);
    const auto outcomes = runTrials(*inputs_->engine, {&batch, 1}, run_);
    if (!outcomes) return outcomes.error();
    for (const EndMode& mode :
         findEndModes(*inputs_->part, outcomes->front(), settings().validation.tolerance, kMostWays)) {
        if (mode.count * kTrialsOfWays >= kLeastOfWay * trials) ways_.push_back(mode.orientation);
    }
    problem.ways = ways_.size();
    problem.places = frame_.places;
    problem.arriving.assign(problem.columns(), 0.0);
    problem_ = problem;  // findColumn() asks it
    starts_.resize(ways_.size() + 1);
    const double bottom = lowestAtFinish(**track);
    fallBefore_ = settings().track.segmentHeight - bottom;
    problem.mostFall = bottom - frame_.room;
    for (const trial::Outcome& outcome : outcomes->front()) {
        const std::size_t column = findColumn(outcome, ways_);
        problem.arriving[column] += 1.0 / trials;
        if (column >= starts_.size()) continue;
        base::Pose start = outcome.parts.front().farthest;
        start.position.z() -= bottom;
        starts_[column].push_back(start);
    }
    // Too few to be tried from count as the most frequent way.
    if (static_cast<int>(starts_.back().size()) * kTrialsOfWays < kLeastOfWay * trials) starts_.pop_back();
    problem.rows = starts_.size();
    problem_ = problem;
    if (ways_.empty()) return base::success();
    ends_ = ways_;
    if (!frame_.then.traps.empty()) {
        if (const auto found = findWaysThen(problem, trials / kWaysThen); !found) return found.error();
    }
    problem.wanted = listWanted();
    problem_ = problem;
    return base::success();
}

/// How parts lie behind what follows the chain, from each way before it, by so many trials of each.
base::Status TrapTrials::findWaysThen(ChainProblem& problem, int each) {
    FixedTraps both = frame_.before;
    both.traps.insert(both.traps.end(), frame_.then.traps.begin(), frame_.then.traps.end());
    both.numbers.insert(both.numbers.end(), frame_.then.numbers.begin(), frame_.then.numbers.end());
    const auto track = build(both, withoutGiven());
    if (!track) return track.error();
    std::vector<std::size_t> from;
    for (std::size_t way = 0; way < rows(); ++way)
        from.insert(from.end(), static_cast<std::size_t>(each), way);
    trial::TrialBatch batch = makeBatch(*track, static_cast<int>(from.size()));
    placeParts(batch, from, 0.0);
    const auto outcomes = runTrials(*inputs_->engine, {&batch, 1}, run_);
    if (!outcomes) return outcomes.error();
    ends_.clear();
    for (const EndMode& mode :
         findEndModes(*inputs_->part, outcomes->front(), settings().validation.tolerance, ways_.size()))
        ends_.push_back(mode.orientation);
    WayMatrix counts(rows(), WayShares(problem.columns(), 0.0));
    for (std::size_t i = 0; i < from.size(); ++i)
        counts[from[i]][findColumn(outcomes->front()[i], ends_)] += 1.0;
    problem.then = calcChances(problem, counts);
    return base::success();
}

base::Status TrapTrials::measure(std::span<const Work> works) {
    std::vector<trial::TrialBatch> batches;
    std::vector<std::vector<std::size_t>> from;
    batches.reserve(works.size());
    for (const Work& work : works) {
        const auto track = build({&work.trap, 1});
        if (!track) return track.error();
        work.trap->fall = settings().track.segmentHeight - lowestAtFinish(**track) - fallBefore_;
        std::vector<std::size_t>& ways = from.emplace_back();
        for (std::size_t way = 0; way < rows(); ++way)
            ways.insert(ways.end(), static_cast<std::size_t>(work.trials[way]), way);
        batches.push_back(makeBatch(*track, static_cast<int>(ways.size())));
    }
    base::parallelFor(batches.size(), inputs_->threads, [&](std::size_t i, unsigned /*worker*/) {
        placeParts(batches[i], from[i], kShareOfMet);
    });
    const auto outcomes = runTrials(*inputs_->engine, batches, run_);
    if (!outcomes) return outcomes.error();
    for (std::size_t i = 0; i < works.size(); ++i) {
        KnownTrap& trap = *works[i].trap;
        for (std::size_t k = 0; k < from[i].size(); ++k)
            trap.counts[from[i][k]][findColumn((*outcomes)[i][k], ways_)] += 1.0;
        trap.chances = calcChances(problem_, trap.counts);
    }
    return base::success();
}

base::Result<std::vector<WayShares>> TrapTrials::findShares(std::span<const TrapRow> beginnings, int trials) {
    std::vector<trial::TrialBatch> batches;
    const int individual = batches_;
    for (const TrapRow& traps : beginnings) {
        const auto track = build(traps);
        if (!track) return track.error();
        batches_ = individual;
        batches.push_back(makeBatch(*track, trials));
        if (!settings().track.given.empty()) placeParts(batches.back(), shareWays(trials), 0.0);
    }
    const auto outcomes = runTrials(*inputs_->engine, batches, run_);
    if (!outcomes) return outcomes.error();
    std::vector<WayShares> shares;
    for (const std::vector<trial::Outcome>& behind : *outcomes) {
        WayShares& parts = shares.emplace_back(problem_.columns(), 0.0);
        for (const trial::Outcome& outcome : behind)
            parts[findColumn(outcome, ways_)] += 1.0 / static_cast<double>(behind.size());
    }
    return shares;
}

base::Status TrapTrials::followParts(std::span<const TrapRow> chains, int trials, bool keepsLast) {
    std::vector<trial::TrialBatch> batches;
    std::vector<double> bottoms;
    for (const TrapRow& chain : chains) {
        for (std::size_t place = 1; place < chain.size(); ++place) {
            const auto track = build(std::span(chain).first(place));
            if (!track) return track.error();
            bottoms.push_back(lowestAtFinish(**track));
            batches.push_back(makeBatch(*track, trials));
            if (!settings().track.given.empty()) placeParts(batches.back(), shareWays(trials), 0.0);
        }
    }
    const auto outcomes = runTrials(*inputs_->engine, batches, run_);
    if (!outcomes) return outcomes.error();
    met_.assign(rows(), {});
    std::vector<std::vector<base::Pose>> farthest;  // of each way, along one chain
    for (std::size_t i = 0; i < batches.size(); ++i) {
        std::vector<std::vector<base::Pose>> here(rows());
        for (const trial::Outcome& outcome : (*outcomes)[i]) {
            const std::size_t column = findColumn(outcome, ways_);
            if (column >= rows()) continue;
            here[column].push_back(outcome.parts.front().farthest);
            here[column].back().position.z() -= bottoms[i];
        }
        // Parts that lie one way, or in none that has a name, are of many kinds: where the last wrong one
        // counts, those that come through are what is to be thrown out.
        if (keepsLast) {
            const std::size_t traps = frame_.places.size() - 1;  // that parts are followed behind
            if (i % traps == 0) farthest.assign(rows(), {});
            for (std::size_t row = 0; row < rows(); ++row) {
                if (here[row].size() >= kFewOfWay) farthest[row] = std::move(here[row]);
                here[row].clear();
            }
            if (i % traps == traps - 1) here.swap(farthest);
        }
        for (std::size_t row = 0; row < rows(); ++row)
            std::ranges::move(here[row], std::back_inserter(met_[row]));
    }
    return base::success();
}

/// Which are wanted; none where nothing is.
std::vector<std::size_t> TrapTrials::listWanted() const {
    std::vector<std::size_t> wanted;
    const auto goal = findWanted(settings(), *inputs_->part);
    for (std::size_t way = 0; goal && way < ends_.size(); ++way) {
        const double angle = trial::calcAngleToGoal(ends_[way], *goal, inputs_->part->symmetry);
        if (angle <= settings().validation.tolerance) wanted.push_back(way);
    }
    return wanted;
}

base::Status TrapTrials::checkWays() const {
    if (ways_.empty()) return tellNoWays();
    if (!settings().target.isSet() || !problem_.wanted.empty()) return base::success();
    return base::Error{
        fmt::format(
            "Parts shall end {}, and none comes to the traps so, within {:g}°. Traps take them from "
            "one of the ways in which they come to another, or throw them out; these are:{}\n"
            "Want one of them (target.poses, target.heading_deg), or a larger angle "
            "(validation.tolerance_deg); or learn without a plan (evolution.firstGeneration "
            "graded).{}",
            describeTarget(settings(), *inputs_->part), settings().validation.tolerance / base::kDegree,
            describeEnds(),
            wantsHanging(settings(), *inputs_->part)
                ? fmt::format("\nAs it is wanted this part hangs by its thicker end: rails may bring it "
                              "so (\"{}\").",
                              kRailsTraps)
                : ""),
        base::ErrorKind::unattainable};
}

/// What became of the parts of which none, or hardly two in the same way, came to the first trap.
base::Error TrapTrials::tellNoWays() const {
    constexpr double kPercent = 100.0;
    const double fallen = kPercent * problem_.arriving[problem_.fallen()];
    const double stuck = kPercent * problem_.arriving[problem_.stuck()];
    return {
        fmt::format(
            "Traps are planned from the ways in which parts come to the first of them, and in no way do as "
            "many as {:.1f} % of them: {:.1f} % fall off before it, {:.1f} % get stuck, {:.1f} % come, each "
            "in a way of its own.\n"
            "Give the track walls or more width (track.innerWall_mm, track.outerWall_mm, "
            "track.segmentWidth_mm), or check the drive (simulation.drive); or learn without a plan "
            "(evolution.firstGeneration graded).",
            kPercent * kLeastOfWay / kTrialsOfWays, fallen, stuck, kPercent - fallen - stuck),
        base::ErrorKind::unattainable};
}

/// What can be wanted instead, a line each, the most frequent first: with what else counts as that.
std::string TrapTrials::describeEnds() const {
    constexpr double kPercent = 100.0;
    const WayShares shares = calcUnturned(problem_);
    std::vector<std::size_t> left(ends_.size());
    std::iota(left.begin(), left.end(), std::size_t{0});
    std::vector<std::pair<double, std::string>> lines;
    while (!left.empty()) {
        const std::size_t most =
            *std::ranges::max_element(left, {}, [&](std::size_t way) { return shares[way]; });
        Settings instead = settings();
        instead.target = findNearestTarget(settings(), *inputs_->part, ends_[most]);
        const trial::Goal goal = findWanted(instead, *inputs_->part).value_or(trial::makeGoal(ends_[most]));
        double share = 0.0;
        std::erase_if(left, [&](std::size_t way) {
            const double angle = trial::calcAngleToGoal(ends_[way], goal, inputs_->part->symmetry);
            if (way != most && angle > settings().validation.tolerance) return false;
            share += shares[way];
            return true;
        });
        const std::string& heading = instead.target.heading;
        lines.emplace_back(
            share, fmt::format("pose {}, {}", instead.target.poses,
                               heading == "any" ? "any heading" : fmt::format("turned to {}°", heading)));
    }
    std::ranges::stable_sort(lines, std::greater{}, &std::pair<double, std::string>::first);
    std::string all;
    for (const auto& [share, text] : lines)
        all += fmt::format("\n  {:4.1f} % in {}", kPercent * share, text);
    return all;
}

base::Result<std::shared_ptr<const track::Track>> TrapTrials::build(const FixedTraps& traps,
                                                                    TrackSettings shortened) const {
    // Parts must be seen as they go on: they creep along a level lead-out, and lie better behind it.
    shortened.leadOutSegments = 1;
    // What a trap does with a part that lies in the groove before it depends on neither; but on a ledge
    // parts lie as they come up the spiral.
    if (!traps.traps.front()->isLedge) shortened.spiral = {};
    shortened.chute = {};
    shortened.maxSegmentLength = 2.0 * inputs_->part->boundingRadius;
    auto track = decodeChain(settings().track, traps.traps, traps.numbers, shortened);
    if (!track) return track.error();
    return std::make_shared<const track::Track>(std::move(track).value());
}

base::Result<std::shared_ptr<const track::Track>> TrapTrials::build(
    std::span<const KnownTrap* const> traps) const {
    FixedTraps all = frame_.before;
    for (const KnownTrap* trap : traps) {
        all.traps.push_back(frame_.kinds[trap->kind]);
        all.numbers.insert(all.numbers.end(), trap->numbers.begin(), trap->numbers.end());
    }
    return build(all, withoutGiven());
}

/// Parts are put behind what is given.
TrackSettings TrapTrials::withoutGiven() const {
    TrackSettings shortened = settings().track;
    shortened.given.clear();
    return shortened;
}

trial::TrialBatch TrapTrials::makeBatch(std::shared_ptr<const track::Track> track, int trials) {
    // Behind those of all individuals of generation 0.
    const int individual = settings().evolution.populationSize + batches_++;
    return makeLearningBatch(makeScene(settings(), specimens_, std::move(track)), {0, individual}, trials);
}

/// Trials, each from its way, at the beginning of the second groove or of the first ledge: what is put there
/// at rest conveys as quickly as any other when it comes to the trap.
void TrapTrials::placeParts(trial::TrialBatch& batch, const std::vector<std::size_t>& ways,
                            double shareOfMet) const {
    const track::Track& track = *batch.track;
    // Without the track that is given the lead-in goes down to where that ends: off this slope.
    const double behind = settings().track.given.empty() ? 0.1 : 1.1;
    const double x = track.sections[2].x + behind * inputs_->part->boundingRadius;
    const double bottom = lowestAt(track, x);
    const double slope = frame_.before.traps.front()->isLedge ? 0.0 : traps::kRestingFall;
    const base::Quaternion fall(Eigen::AngleAxisd(slope, base::Vec3::UnitY()));
    constexpr double kAbove = 0.3e-3;  // so that it touches nothing when it is turned [m]
    for (std::size_t i = 0; i < batch.trials.size(); ++i) {
        trial::TrialSpec& spec = batch.trials[i];
        base::Random random(
            {spec.stream.seed, 0, spec.stream.individual, spec.stream.trial, base::Purpose::planning});
        const base::Pose& start = chooseStart(ways[i], shareOfMet, random);
        base::Pose& pose = spec.parts.front().pose;
        pose.position = track.shape.toRoom({x, start.position.y(), bottom + start.position.z() + kAbove});
        pose.rotation = base::Quaternion(track.shape.tangentFrame(x)) * fall * start.rotation;
    }
}

/// `shareOfMet`: of those from behind other traps.
const base::Pose& TrapTrials::chooseStart(std::size_t way, double shareOfMet, base::Random& random) const {
    const bool isMet = random.uniform() < shareOfMet && way < met_.size() && !met_[way].empty();
    const std::vector<base::Pose>& own = isMet ? met_[way] : starts_[way];
    // All of a way may be nearer to another one.
    const std::vector<base::Pose>& from = own.empty() ? starts_.front() : own;
    return from[random.below(static_cast<std::uint32_t>(from.size()))];
}

/// Of so many parts the ways in which they come to the first trap.
std::vector<std::size_t> TrapTrials::shareWays(int trials) const {
    const auto arriving = std::span(problem_.arriving).first(rows());
    const double all = std::accumulate(arriving.begin(), arriving.end(), 0.0);
    std::vector<std::size_t> ways;
    double sum = 0.0;
    for (std::size_t way = 0; way < arriving.size(); ++way) {
        sum += arriving[way];
        ways.resize(static_cast<std::size_t>(std::lround(trials * sum / all)), way);
    }
    return ways;
}

std::size_t TrapTrials::findColumn(const trial::Outcome& outcome,
                                   std::span<const base::Quaternion> ways) const {
    const trial::PartOutcome& part = outcome.parts.front();
    if (part.ending == trial::Ending::fellOff) return problem_.fallen();
    if (part.ending != trial::Ending::finished) return problem_.stuck();
    std::size_t nearest = problem_.ways;
    double least = kNearWay;
    for (std::size_t way = 0; way < ways.size(); ++way) {
        const double angle =
            trial::calcOrientationAngle(part.farthest.rotation, ways[way], inputs_->part->symmetry,
                                        trial::OrientationDistance::symmetric);
        if (angle < least) {
            least = angle;
            nearest = way;
        }
    }
    return nearest;
}

}  // namespace trapwright::study
