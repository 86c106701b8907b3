#include "core/verify/agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "core/part/bundled.h"
#include "core/part/materials.h"
#include "core/part/part_builder.h"
#include "core/stats/binomial.h"
#include "core/stats/rates.h"
#include "core/study/evaluator.h"
#include "core/study/trial_batches.h"
#include "core/trial/goal.h"
#include "core/trial/orientations.h"
#include "core/verify/scenes.h"

namespace trapwright::verify {

namespace {

using Outcomes = std::vector<trial::Outcome>;

// The hills on which about half of the part's trials fail, found by trying.
struct PartAndHills {
    std::string_view part;
    double amplitude;  // [m]
};
constexpr std::array<PartAndHills, 3> kParts = {
    {{"cuboid", 0.57e-3}, {"cone", 0.85e-3}, {"bracket", 0.75e-3}}};

constexpr double kTolerance = 25.0 * base::kDegree;
constexpr std::uint64_t kSeed = 1;

base::Result<std::shared_ptr<const part::Part>> buildBundled(std::string_view name) {
    const auto bundled = part::findBundledPart(name);
    if (!bundled) return bundled.error();
    part::PartOptions options;
    options.name = name;
    const part::MaterialLibrary library = part::readMaterials();
    const part::Material* material = part::findMaterial(library, bundled->material);
    if (material == nullptr) {
        return base::Error{
            fmt::format("The material {} of the part {} is not in the library of materials; "
                        "install the program's resources again.",
                        bundled->material, name)};
    }
    options.density = material->density.value;
    auto built = part::buildPart(part::makeBundledShape(name), options);
    if (!built) return built.error();
    return std::make_shared<const part::Part>(std::move(built->part));
}

std::vector<double> transitTimes(const Outcomes& outcomes) {
    std::vector<double> times;
    for (const trial::Outcome& outcome : outcomes) {
        const trial::PartOutcome& part = outcome.parts.front();
        if (part.ending == trial::Ending::finished) times.push_back(part.time);
    }
    return times;
}

// Trials in which one side alone succeeded.
struct Discordance {
    int first = 0;
    int second = 0;

    void count(bool inFirst, bool inSecond) {
        first += inFirst && !inSecond ? 1 : 0;
        second += inSecond && !inFirst ? 1 : 0;
    }
};

bool lieInEachOthersIntervals(int a, int b, int trials) {
    const auto holds = [trials](const stats::Interval& interval, int count) {
        const double share = static_cast<double>(count) / trials;
        return interval.low <= share && share <= interval.high;
    };
    return holds(stats::calcClopperPearson(a, trials), b) && holds(stats::calcClopperPearson(b, trials), a);
}

Agreement compare(const AgreementScene& scene, const Outcomes& own, const Outcomes& judged) {
    const part::SymmetryGroup& symmetry = scene.batch.parts.front()->symmetry;
    // Of both together: the mode of one side would favour that side.
    std::vector<base::Quaternion> ends = trial::finalOrientations(own);
    const std::vector<base::Quaternion> judgedEnds = trial::finalOrientations(judged);
    ends.insert(ends.end(), judgedEnds.begin(), judgedEnds.end());
    const trial::Goal expected = trial::makeGoal(trial::findModalOrientation(ends, symmetry, kTolerance));
    Agreement result;
    result.part = scene.part;
    result.track = scene.track;
    result.trials = static_cast<int>(own.size());
    Discordance finished;
    Discordance oriented;
    for (std::size_t i = 0; i < own.size(); ++i) {
        const trial::PartOutcome& ownPart = own[i].parts.front();
        const trial::PartOutcome& judgedPart = judged[i].parts.front();
        const bool ownFinished = ownPart.ending == trial::Ending::finished;
        const bool judgedFinished = judgedPart.ending == trial::Ending::finished;
        const bool ownOriented =
            trial::judge(ownPart, expected, symmetry, kTolerance) == trial::Verdict::success;
        const bool judgedOriented =
            trial::judge(judgedPart, expected, symmetry, kTolerance) == trial::Verdict::success;
        finished.count(ownFinished, judgedFinished);
        oriented.count(ownOriented, judgedOriented);
        result.engine.finished += ownFinished ? 1 : 0;
        result.engine.oriented += ownOriented ? 1 : 0;
        result.reference.finished += judgedFinished ? 1 : 0;
        result.reference.oriented += judgedOriented ? 1 : 0;
    }
    result.finishedInOne = finished.first + finished.second;
    result.finishedP = stats::testMcNemar(finished.first, finished.second);
    result.orientedP = stats::testMcNemar(oriented.first, oriented.second);

    const std::vector<double> ownTimes = transitTimes(own);
    const std::vector<double> judgedTimes = transitTimes(judged);
    if (!ownTimes.empty()) result.engine.medianTime = stats::medianOf(ownTimes);
    if (!judgedTimes.empty()) result.reference.medianTime = stats::medianOf(judgedTimes);
    if (!ownTimes.empty() && !judgedTimes.empty())
        result.times = stats::testKolmogorovSmirnov(ownTimes, judgedTimes);
    result.alikeAlone =
        lieInEachOthersIntervals(result.engine.finished, result.reference.finished, result.trials) &&
        lieInEachOthersIntervals(result.engine.oriented, result.reference.oriented, result.trials) &&
        result.times.p > 0.01;
    return result;
}

void adjustForTheFamily(std::vector<Agreement>& table) {
    std::vector<double> all;
    for (const Agreement& row : table)
        all.insert(all.end(), {row.finishedP, row.orientedP, row.times.p});
    const std::vector<double> adjusted = stats::adjustHolm(all);
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i].familyP = std::min({adjusted[3 * i], adjusted[3 * i + 1], adjusted[3 * i + 2]});
}

/// Looks at the rows that fail again.
base::Status confirmFailures(const trial::Engine& engine, const trial::Engine& reference,
                             const std::vector<AgreementScene>& scenes, const base::RunControl& control,
                             std::vector<Agreement>& table) {
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (table[i].passed()) continue;
        const auto own = study::runTrials(engine, {&scenes[i].fresh, 1}, control);
        if (!own) return own.error();
        const auto judged = study::runTrials(reference, {&scenes[i].fresh, 1}, control);
        if (!judged) return judged.error();
        std::vector<Agreement> fresh{compare(scenes[i], own->front(), judged->front())};
        adjustForTheFamily(fresh);
        table[i].freshP = fresh.front().familyP;
    }
    return base::success();
}

}  // namespace

base::Result<std::vector<AgreementScene>> makeAgreementScenes(
    const std::shared_ptr<const track::Track>& learned, int trials) {
    const study::SimulationSettings simulation;
    const auto flat = makeFlat();
    std::vector<AgreementScene> scenes;
    for (const PartAndHills& one : kParts) {
        auto part = buildBundled(one.part);
        if (!part) return part.error();
        const auto add = [&](const char* name, const std::shared_ptr<const track::Track>& track) {
            const study::TrialScene scene{&simulation, part.value(), track, kSeed};
            scenes.push_back({std::string(one.part), name, study::makeLearningBatch(scene, {0, 0}, trials),
                              study::makeLearningBatch(scene, {0, 1}, trials)});
        };
        add("flat", flat);
        add("hills", makeHills(one.amplitude));
        add("learned", learned);
    }
    return scenes;
}

base::Result<std::vector<Agreement>> compareEngines(const trial::Engine& engine,
                                                    const trial::Engine& reference,
                                                    const std::vector<AgreementScene>& scenes,
                                                    const base::RunControl& control) {
    std::vector<trial::TrialBatch> batches;
    batches.reserve(scenes.size());
    for (const AgreementScene& scene : scenes)
        batches.push_back(scene.batch);
    const auto own = study::runTrials(engine, batches, control);
    if (!own) return own.error();
    const auto judged = study::runTrials(reference, batches, control);
    if (!judged) return judged.error();
    std::vector<Agreement> table;
    table.reserve(scenes.size());
    for (std::size_t i = 0; i < scenes.size(); ++i)
        table.push_back(compare(scenes[i], (*own)[i], (*judged)[i]));
    adjustForTheFamily(table);
    if (const auto confirmed = confirmFailures(engine, reference, scenes, control, table); !confirmed)
        return confirmed.error();
    return table;
}

}  // namespace trapwright::verify
