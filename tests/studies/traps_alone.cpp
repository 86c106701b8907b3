// What single traps do: COUNT of a study's first planned kind, drawn at random, each tried by itself with
// EACH parts from every way in which they come to it. One line a trap, best first: the share of parts that it
// leaves in one way, that gets stuck, that falls, and its numbers.
//
//     traps_alone STUDY COUNT EACH SEED

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/random.h"
#include "core/store/study_file.h"
#include "core/study/trap_trials.h"
#include "core/traps/trap_chain.h"
#include "core/workflow/study_design.h"
#include "sim/engines/registry.h"

using namespace trapwright;

namespace {

constexpr double kPercent = 100.0;

template <class T>
T readNumber(std::string_view text) {
    T number{};
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

struct Tried {
    double most = 0.0;
    double stuck = 0.0;
    double fallen = 0.0;
    std::vector<double> numbers;
};

base::Result<std::vector<Tried>> tryTraps(const study::StudyInputs& inputs, int count, int each,
                                          std::uint64_t seed) {
    const auto chain = traps::readTraps(inputs.settings.track.traps);
    if (!chain) return chain.error();
    study::TrapTrials trials(inputs, study::makeFrame(*chain, {}, 0.0, inputs.settings.track), {});
    study::ChainProblem problem;
    if (const auto found = trials.findWays(study::kTrialsOfWays, problem); !found) return found.error();
    const auto ways = static_cast<std::ptrdiff_t>(problem.ways);
    const auto dimensions = trials.frame().kinds.front()->dimensions(inputs.settings.track);
    fmt::print("{} ways, {:.1f} % in the most frequent one. Numbers:", problem.ways,
               kPercent * *std::max_element(problem.arriving.begin(), problem.arriving.begin() + ways));
    for (const search::Dimension& dimension : dimensions)
        fmt::print(" {} [{}],", dimension.key, dimension.unit);
    fmt::print("\n");
    base::Random random({seed, 0, 0, 0, base::Purpose::planning});
    std::vector<study::KnownTrap> traps;
    for (int i = 0; i < count; ++i) {
        study::WayMatrix counts(trials.rows(), study::WayShares(problem.columns(), 0.0));
        std::vector<double> numbers;
        numbers.reserve(dimensions.size());
        for (const search::Dimension& dimension : dimensions)
            numbers.push_back(search::drawNumber(dimension, random));
        traps.push_back({0, std::move(numbers), std::move(counts), {}, 0.0});
    }
    std::vector<study::Work> works;
    works.reserve(traps.size());
    for (study::KnownTrap& trap : traps)
        works.push_back({&trap, std::vector<int>(trials.rows(), each)});
    if (const auto measured = trials.measure(works); !measured) return measured.error();
    std::vector<Tried> tried;
    for (const study::KnownTrap& trap : traps) {
        const study::WayShares parts = study::pass(problem.arriving, trap.chances);
        Tried& one = tried.emplace_back(Tried{*std::max_element(parts.begin(), parts.begin() + ways),
                                              parts[problem.stuck()],
                                              parts[problem.fallen()],
                                              {}});
        for (std::size_t i = 0; i < dimensions.size(); ++i)
            one.numbers.push_back(dimensions[i].low +
                                  (dimensions[i].high - dimensions[i].low) * trap.numbers[i]);
    }
    std::ranges::stable_sort(tried, std::ranges::greater(), &Tried::most);
    return tried;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 5 || readNumber<int>(arguments[2]) < 1 || readNumber<int>(arguments[3]) < 1) {
        fmt::print(stderr, "traps_alone STUDY COUNT EACH SEED\n");
        return 2;
    }
    const auto file = store::StudyFile::openReadOnly(arguments[1]);
    if (!file) {
        fmt::print(stderr, "{}\n", file.error().message);
        return 1;
    }
    const auto design = workflow::loadDesign(*file);
    if (!design) {
        fmt::print(stderr, "{}\n", design.error().message);
        return 1;
    }
    study::StudyInputs inputs;
    inputs.settings = design->settings;
    inputs.part = design->part;
    const std::shared_ptr<const trial::Engine> engine =
        engines::registry().find("native")->make({.threads = 1});
    inputs.engine = engine;
    const auto tried = tryTraps(inputs, readNumber<int>(arguments[2]), readNumber<int>(arguments[3]),
                                readNumber<std::uint64_t>(arguments[4]));
    if (!tried) {
        fmt::print(stderr, "{}\n", tried.error().message);
        return 1;
    }
    for (const Tried& one : *tried) {
        fmt::print("{:5.1f} % one way {:5.1f} stuck {:5.1f} fallen ", kPercent * one.most,
                   kPercent * one.stuck, kPercent * one.fallen);
        for (const double number : one.numbers)
            fmt::print(" {:7.3f}", number);
        fmt::print("\n");
    }
    return 0;
}
