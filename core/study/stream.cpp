#include "core/study/stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/stats/binomial.h"
#include "core/stats/samples.h"
#include "core/study/pose_weights.h"
#include "core/study/target.h"
#include "core/study/trial_batches.h"

namespace trapwright::study {

namespace {

/// Places for the streams of parts within that of their trial (base::StreamKey::trial).
constexpr std::uint32_t kKeysOfStream = 4096;
static_assert(kMostPartsOfStream < static_cast<int>(kKeysOfStream));
constexpr double kMinute = 60.0;
/// A track keeps up as long as no more of what comes than this waits to the end.
constexpr double kWaiting = 0.05;

double durationOf(const StreamSettings& stream) {
    return stream.warmUp + stream.duration;
}

/// When the parts of a stream come. The draws do not hang on the inflow. [s]
std::vector<double> drawArrivals(const StreamSettings& stream, double partsPerMinute, base::Random& random) {
    const double gap = kMinute / partsPerMinute;
    std::vector<double> times;
    double time = gap * random.uniform();  // where in a gap the stream begins
    while (time < durationOf(stream) && static_cast<int>(times.size()) < kMostPartsOfStream) {
        if (time > 0.0) times.push_back(time);
        time += gap * (stream.arrivals == Arrivals::regular ? 1.0 : -std::log1p(-random.uniform()));
    }
    return times;
}

/// Draws how a part comes out of the bowl.
class DrawnStarts {
 public:
    DrawnStarts(const Settings& settings, const part::Part& part)
        : policy_(settings.simulation.start), part_(&part) {
        if (settings.stream.delivery == Delivery::resting) weights_ = poseWeights(part, settings);
    }

    trial::StartPolicy draw(base::Random& random) const {
        trial::StartPolicy policy = policy_;
        if (weights_.empty()) return policy;
        double share = random.uniform();
        std::size_t pose = 0;
        while (pose + 1 < weights_.size() && share >= weights_[pose])
            share -= weights_[pose++];
        policy.nearPose = part_->stablePoses[pose].rotation;
        return policy;
    }

 private:
    trial::StartPolicy policy_;
    const part::Part* part_;
    std::vector<double> weights_;  // of the stable poses; none: parts come anyhow
};

bool isOfPart(trial::Condition condition) {
    return condition == trial::Condition::part || condition == trial::Condition::startOffset ||
           condition == trial::Condition::startSpeed;
}

/// Which streams are drawn.
struct StreamDraw {
    int streams = 0;
    double partsPerMinute = 0.0;
    bool varied = false;  // each somewhere else in the operating box
    base::Purpose purpose = base::Purpose::stream;
};

trial::TrialBatch drawStreams(const Settings& settings, const Specimens& specimens,
                              const std::shared_ptr<const track::Track>& track,
                              const IndividualId& individual, const StreamDraw& draw) {
    const SimulationSettings& simulation = settings.simulation;
    trial::TrialBatch batch;
    batch.track = track;
    batch.parts = draw.varied ? specimens.varied : std::vector{specimens.drawn};
    batch.drive = simulation.drive;
    batch.contact = simulation.contact;
    batch.partsContact = settings.stream.contact;
    batch.termination = terminationOn(simulation, *track);
    batch.termination.until = durationOf(settings.stream);
    batch.gravity = simulation.gravity;

    base::StreamKey key{settings.evolution.seed, static_cast<std::uint32_t>(individual.generation),
                        static_cast<std::uint32_t>(individual.individual), 0, draw.purpose};
    const BoxPlaces places(
        simulation, settings.box,
        {key.seed, key.generation, static_cast<std::uint32_t>(key.purpose), 0, base::Purpose::conditions});
    const std::vector<trial::BoxPlace> drawn = places.draw(0, draw.streams);
    const DrawnStarts starts(settings, *specimens.drawn);
    for (int i = 0; i < draw.streams; ++i) {
        trial::TrialSpec& spec = batch.trials.emplace_back();
        key.trial = static_cast<std::uint32_t>(i) * kKeysOfStream;
        spec.stream = key;
        base::Random random(key);
        spec.phase = random.uniform(0.0, 2.0 * base::kPi);
        for (const double time : drawArrivals(settings.stream, draw.partsPerMinute, random)) {
            ++key.trial;
            base::Random own({key.seed, key.generation, key.individual, key.trial, base::Purpose::specimen});
            // What is the track's and the drive's is that of the stream, what is the part's its own.
            trial::BoxPlace place = drawn[static_cast<std::size_t>(i)];
            for (std::size_t c = 0; c < place.size(); ++c)
                if (isOfPart(static_cast<trial::Condition>(c))) place[c] = own.uniform();
            const auto count = static_cast<double>(batch.parts.size());
            const auto specimen = std::min(
                static_cast<std::size_t>(place[static_cast<std::size_t>(trial::Condition::part)] * count),
                batch.parts.size() - 1);
            trial::TrialSpec one = trial::drawTrial(*track, *batch.parts[specimen], starts.draw(own), key);
            if (draw.varied) {
                putAt(simulation, settings.box, place, *track, one);
                if (!spec.contact) std::tie(spec.contact, spec.drive) = std::pair(one.contact, one.drive);
            }
            spec.parts.push_back(one.parts.front());
            spec.parts.back().part = specimen;
            spec.parts.back().time = time;
        }
        if (draw.varied) spec.place = drawn[static_cast<std::size_t>(i)];
    }
    return batch;
}

/// Times at which parts pass the finish. Rising. [s]
std::vector<double> listFinishes(const trial::Outcome& outcome) {
    std::vector<double> times;
    for (const trial::PartOutcome& part : outcome.parts)
        if (part.ending == trial::Ending::finished) times.push_back(part.time);
    std::ranges::sort(times);
    return times;
}

/// Counts one stream, and notes the times of its parts.
struct Counting {
    const trial::Goal* goal;
    const part::SymmetryGroup* symmetry;
    double tolerance;
    double warmUp;
    const track::Track* track;
    trial::Returns returns;
    std::vector<double> transits{}, gaps{};

    StreamCounts count(const trial::TrialSpec& spec, const trial::Outcome& outcome,
                       const trial::Termination& termination) {
        StreamCounts counts;
        const auto isCounted = [&](double time) { return time >= warmUp; };
        for (std::size_t i = 0; i < outcome.parts.size(); ++i) {
            const trial::PartOutcome& part = outcome.parts[i];
            counts.offered += isCounted(spec.parts[i].time) ? 1 : 0;
            counts.entered += part.entered && isCounted(*part.entered) ? 1 : 0;
            if (part.ending == trial::Ending::timedOut || !isCounted(part.time)) continue;
            switch (trial::judge(part, *goal, *symmetry, tolerance)) {
                case trial::Verdict::success:
                    ++counts.success;
                    break;
                case trial::Verdict::wrongOrientation:
                    ++counts.wrong;
                    break;
                default:
                    ++(trial::comesAgain(part, *track, returns) ? counts.returned : counts.fellOff);
                    continue;
            }
            transits.push_back(part.time - part.entered.value_or(0.0));
        }
        const std::vector<double> finishes = listFinishes(outcome);
        for (std::size_t i = 1; i < finishes.size(); ++i)
            if (isCounted(finishes[i - 1])) gaps.push_back(finishes[i] - finishes[i - 1]);
        for (const Jam& jam : findJams(outcome, termination)) {
            if (jam.to <= warmUp) continue;
            ++counts.jams;
            counts.uncleared += jam.cleared ? 0 : 1;
            counts.jammed += jam.to - std::max(jam.from, warmUp);
        }
        return counts;
    }
};

double quantileOf(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[static_cast<std::size_t>(place)];
}

/// Of how many one stream has, those that arrive as wanted. None: there are none.
template <class Number>
std::optional<stats::MeanEstimate> estimateRatio(std::span<const StreamCounts> streams, Number numberOf) {
    int right = 0;
    int all = 0;
    for (const StreamCounts& one : streams) {
        right += one.success;
        all += numberOf(one);
    }
    if (all == 0) return std::nullopt;
    const double share = static_cast<double>(right) / all;
    const double mean = static_cast<double>(all) / static_cast<double>(streams.size());
    std::vector<double> values;
    values.reserve(streams.size());
    for (const StreamCounts& one : streams)
        values.push_back(share + (one.success - share * numberOf(one)) / mean);
    stats::MeanEstimate estimate = stats::estimateMean(values);
    estimate.mean = share;
    const stats::Interval exact = stats::calcClopperPearson(right, all);
    estimate.interval = {std::max(0.0, std::min(estimate.interval.low, exact.low)),
                         std::min(1.0, std::max(estimate.interval.high, exact.high))};
    return estimate;
}

std::string shareText(const std::optional<stats::MeanEstimate>& share) {
    if (!share) return "none arrives";
    return fmt::format("{:.2f} ({:.2f} ... {:.2f})", 100.0 * share->mean, 100.0 * share->interval.low,
                       100.0 * share->interval.high);
}

std::string rateText(const stats::MeanEstimate& rate) {
    return fmt::format("{:.1f} ({:.1f} ... {:.1f})", rate.mean, std::max(0.0, rate.interval.low),
                       rate.interval.high);
}

}  // namespace

trial::TrialBatch makeStreamBatch(const Settings& settings, const std::shared_ptr<const part::Part>& part,
                                  const std::shared_ptr<const track::Track>& track,
                                  const IndividualId& individual, double partsPerMinute) {
    const bool varied = settings.validation.conditions == TrialConditions::varied;
    return drawStreams(settings, varied ? makeSpecimens(settings, part) : Specimens{part, {}}, track,
                       individual, {settings.stream.streams, partsPerMinute, varied, base::Purpose::stream});
}

trial::TrialBatch makeLearningStreams(const Settings& settings, const Specimens& specimens,
                                      const std::shared_ptr<const track::Track>& track, int generation) {
    const EvolutionSettings& evolution = settings.evolution;
    trial::TrialBatch batch =
        drawStreams(settings, specimens, track, {generation, 0},
                    {evolution.streamsEach, settings.stream.partsPerMinute,
                     evolution.conditions == TrialConditions::varied, base::Purpose::learningStream});
    batch.step = chooseLearningStep(settings);
    return batch;
}

stats::Count countThroughput(const StreamSettings& settings, const trial::Goal& goal,
                             const part::SymmetryGroup& symmetry, double tolerance,
                             const trial::TrialBatch& batch, std::span<const trial::Outcome> outcomes) {
    stats::Count count;
    const double end = durationOf(settings);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        int offered = 0;
        int right = 0;
        for (std::size_t k = 0; k < outcomes[i].parts.size(); ++k) {
            const double time = batch.trials[i].parts[k].time;
            offered += time >= settings.warmUp && time < end ? 1 : 0;
            const trial::PartOutcome& part = outcomes[i].parts[k];
            right += part.time >= settings.warmUp &&
                             trial::judge(part, goal, symmetry, tolerance) == trial::Verdict::success
                         ? 1
                         : 0;
        }
        count.trials += offered;
        // By chance more may leave the track than come.
        count.successes += std::min(right, offered);
    }
    return count;
}

std::vector<Jam> findJams(const trial::Outcome& outcome, const trial::Termination& termination) {
    const std::vector<double> finishes = listFinishes(outcome);
    // Between these nothing changes.
    std::vector<double> times = finishes;
    for (const trial::Stop& stop : outcome.stops)
        times.insert(times.end(), {stop.from, stop.to});
    for (const trial::PartOutcome& part : outcome.parts)
        if (part.entered) times.insert(times.end(), {*part.entered, part.time});
    std::ranges::sort(times);
    const auto stands = [&](double time) {
        const auto standing = std::ranges::count_if(
            outcome.stops, [time](const trial::Stop& stop) { return stop.from <= time && time < stop.to; });
        if (standing != 1) return standing > 1;
        // One that others pass is in nobody's way.
        return std::ranges::count_if(outcome.parts, [time](const trial::PartOutcome& part) {
                   return part.entered && *part.entered <= time && time < part.time;
               }) == 1;
    };
    std::vector<Jam> jams;
    bool jammed = false;
    double from = 0.0;
    const auto close = [&](double to) {
        if (jammed && to - from >= termination.stuckTime) jams.push_back({from, to, to < termination.until});
        jammed = false;
    };
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
        const bool standing = stands(0.5 * (times[i] + times[i + 1]));
        if (!standing || std::ranges::binary_search(finishes, times[i])) close(times[i]);
        if (standing && !jammed) from = times[i];
        jammed = standing;
    }
    if (!times.empty()) close(times.back());
    return jams;
}

StreamCounts StreamResult::sum() const {
    StreamCounts sum;
    for (const StreamCounts& one : streams) {
        for (int StreamCounts::*count :
             {&StreamCounts::offered, &StreamCounts::entered, &StreamCounts::success, &StreamCounts::wrong,
              &StreamCounts::returned, &StreamCounts::fellOff, &StreamCounts::jams, &StreamCounts::uncleared})
            sum.*count += one.*count;
        sum.jammed += one.jammed;
    }
    return sum;
}

stats::MeanEstimate StreamResult::rate(int StreamCounts::*count) const {
    std::vector<double> rates;
    for (const StreamCounts& one : streams)
        rates.push_back(one.*count * kMinute / duration);
    return stats::estimateMean(rates);
}

stats::MeanEstimate StreamResult::arrivals() const {
    std::vector<double> rates;
    for (const StreamCounts& one : streams)
        rates.push_back(one.arrived() * kMinute / duration);
    return stats::estimateMean(rates);
}

std::optional<stats::MeanEstimate> StreamResult::successShare() const {
    return estimateRatio(streams, [](const StreamCounts& one) { return one.arrived(); });
}

std::optional<stats::MeanEstimate> StreamResult::efficiency() const {
    return estimateRatio(streams, [](const StreamCounts& one) { return one.left(); });
}

double StreamResult::jammedShare() const {
    return sum().jammed / (duration * static_cast<double>(streams.size()));
}

int StreamResult::countFull() const {
    return static_cast<int>(std::ranges::count_if(
        streams, [](const StreamCounts& one) { return one.entered + 1 < (1.0 - kWaiting) * one.offered; }));
}

const StreamResult* Streams::findBest() const {
    const auto best = std::ranges::max_element(
        results, {}, [](const StreamResult& result) { return result.rate(&StreamCounts::success).mean; });
    return best == results.end() ? nullptr : &*best;
}

std::span<const double> defaultInflows() {
    static constexpr std::array<double, 6> kInflows = {10.0, 30.0, 60.0, 100.0, 180.0, 300.0};
    return kInflows;
}

std::vector<std::string> findStreamProblems(const Settings& settings, double partsPerMinute) {
    std::vector<std::string> problems;
    if (!(partsPerMinute >= 0.1 && partsPerMinute <= 10000.0))
        problems.push_back(
            fmt::format("The inflow is {} parts a minute; 0.1 to 10000 is allowed.", partsPerMinute));
    const double parts = partsPerMinute * durationOf(settings.stream) / kMinute;
    // Random arrivals are more than their mean now and then.
    if (parts > 0.9 * kMostPartsOfStream)
        problems.push_back(fmt::format(
            "At {} parts a minute {:.0f} parts come in a stream of {} s, and no more than {} can; make "
            "stream.duration_s or the inflow less.",
            partsPerMinute, parts, durationOf(settings.stream), 0.9 * kMostPartsOfStream));
    return problems;
}

base::Result<Streams> measureStreams(const StudyInputs& inputs,
                                     const std::shared_ptr<const track::Track>& track,
                                     const IndividualId& individual, const std::optional<trial::Goal>& given,
                                     std::vector<double> inflows, const base::RunControl& control) {
    if (const auto checked = checkInputs(inputs); !checked) return checked.error();
    std::ranges::sort(inflows);
    inflows.erase(std::unique(inflows.begin(), inflows.end()), inflows.end());
    if (inflows.empty()) return base::Error{"Name at least one inflow, in parts a minute."};
    std::string problems;
    for (const double inflow : inflows)
        for (const std::string& problem : findStreamProblems(inputs.settings, inflow))
            problems += (problems.empty() ? "" : " ") + problem;
    if (!problems.empty()) return base::Error{problems};

    std::optional<trial::Goal> goal = given;
    if (!goal) goal = findWanted(inputs.settings, *inputs.part);
    const double tolerance = inputs.settings.validation.tolerance;
    Streams streams;
    streams.settings = inputs.settings.stream;
    for (const double inflow : inflows) {
        const trial::TrialBatch batch =
            makeStreamBatch(inputs.settings, inputs.part, track, individual, inflow);
        const auto outcomes = runTrials(*inputs.engine, {&batch, 1}, control);
        if (!outcomes) return outcomes.error();
        const std::vector<trial::Outcome>& own = outcomes->front();
        if (!goal) goal = trial::findGoal(std::nullopt, own, inputs.part->symmetry, tolerance);
        Counting counting{&*goal,      &inputs.part->symmetry,       tolerance, inputs.settings.stream.warmUp,
                          track.get(), inputs.settings.track.returns};
        StreamResult& result = streams.results.emplace_back();
        result.partsPerMinute = inflow;
        result.duration = inputs.settings.stream.duration;
        for (std::size_t i = 0; i < own.size(); ++i)
            result.streams.push_back(counting.count(batch.trials[i], own[i], batch.termination));
        result.transit = quantileOf(counting.transits, 0.5);
        result.spacing = quantileOf(counting.gaps, 0.5);
        result.closest = quantileOf(counting.gaps, 0.1);
    }
    streams.goal = *goal;
    return streams;
}

std::string formatStreams(const Streams& streams) {
    constexpr const char* kColumns = "{:>8} {:<24} {:<22} {:>7} {:>7} {:>7} {:>8} {:>9} {:>11} {}\n";
    std::string text = fmt::format(kColumns, "Inflow", "  as wanted", "  share as wanted", "of all", "back",
                                   "lost", "transit", "spacing", "jammed", "");
    text += fmt::format(kColumns, "[1/min]", "  [1/min]", "  [%]", "[%]", "[1/min]", "[1/min]", "[s]", "[s]",
                        "[%] (times)", "");
    for (const StreamResult& result : streams.results) {
        const StreamCounts sum = result.sum();
        const auto efficiency = result.efficiency();
        std::string note;
        const auto add = [&](int count, const char* what) {
            if (count == 0) return;
            note += fmt::format("{}{} of {} streams {}", note.empty() ? "" : "; ", count,
                                result.streams.size(), what);
        };
        add(result.countFull(), "are full");
        add(sum.uncleared, "end jammed");
        const auto perMinute = [&](int StreamCounts::*count) {
            return fmt::format("{:.1f}", result.rate(count).mean);
        };
        text += fmt::format(kColumns, fmt::format("{:g}", result.partsPerMinute),
                            "  " + rateText(result.rate(&StreamCounts::success)),
                            "  " + shareText(result.successShare()),
                            efficiency ? fmt::format("{:.1f}", 100.0 * efficiency->mean) : "-",
                            perMinute(&StreamCounts::returned), perMinute(&StreamCounts::fellOff),
                            fmt::format("{:.2f}", result.transit), fmt::format("{:.2f}", result.spacing),
                            fmt::format("{:.1f} ({})", 100.0 * result.jammedShare(), sum.jams), note);
    }
    text += fmt::format(
        "In brackets: 95 %, over {} streams of {:g} s each after {:g} s of warm-up. Share as wanted: of "
        "those that arrive; of all: of those that leave the track in any way, with what comes again. Jammed: "
        "nobody arrives, and all on the track or two of them stand still. Full: more comes than gets on.\n",
        streams.settings.streams, streams.settings.duration, streams.settings.warmUp);
    return text;
}

}  // namespace trapwright::study
