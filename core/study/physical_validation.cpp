#include "core/study/physical_validation.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

#include "core/base/random.h"

namespace trapwright::study {

namespace {

constexpr std::array<std::pair<FeederKind, const char*>, 4> kFeeders = {{
    {FeederKind::unknown, "unknown"},
    {FeederKind::real, "real"},
    {FeederKind::unconnected, "unconnected"},
    {FeederKind::virtualFeeder, "virtual"},
}};

std::string wereText(int count) {
    return fmt::format("{} trial{}", count, count == 1 ? " was" : "s were");
}

}  // namespace

std::string nameOf(FeederKind kind) {
    for (const auto& [known, name] : kFeeders)
        if (known == kind) return name;
    return {};
}

std::optional<FeederKind> feederKindOf(const std::string& name) {
    for (const auto& [kind, known] : kFeeders)
        if (name == known) return kind;
    return std::nullopt;
}

FeederCount countFeeders(const PhysicalValidation& validation) {
    FeederCount count;
    for (const PhysicalTrial& trial : validation.trials) {
        switch (trial.feeder) {
            case FeederKind::unknown:
                ++count.unknown;
                break;
            case FeederKind::real:
                ++count.real;
                break;
            case FeederKind::unconnected:
                ++count.unconnected;
                break;
            case FeederKind::virtualFeeder:
                ++count.virtualFeeder;
                break;
        }
    }
    return count;
}

std::string feederNotice(const PhysicalValidation& validation) {
    const FeederCount count = countFeeders(validation);
    if (count.virtualFeeder > 0 && !count.mixed())
        return "Made with the virtual feeder, for training: no real part moved, and these numbers say "
               "nothing "
               "about a printed track.";
    const std::string older =
        fmt::format("{} made by an older version, which did not note the feeder.", wereText(count.unknown));
    if (count.virtualFeeder == 0) return count.unknown > 0 ? older : "";
    std::string text = fmt::format(
        "Mixed: {} made with the virtual feeder, for training; these numbers say nothing about a printed "
        "track.",
        wereText(count.virtualFeeder));
    if (count.physical() > 0) text += fmt::format(" {} made on a real feeder.", wereText(count.physical()));
    return count.unknown > 0 ? text + ' ' + older : text;
}

std::vector<int> orderOfTrials(const PhysicalPlan& plan) {
    assert(plan.repetitions >= 0);
    std::vector<int> order;
    order.reserve(plan.poses.size() * static_cast<std::size_t>(plan.repetitions));
    for (const int pose : plan.poses)
        order.insert(order.end(), static_cast<std::size_t>(plan.repetitions), pose);
    if (!plan.shuffled) return order;
    // Fisher and Yates
    base::Random random({.seed = plan.seed, .purpose = base::Purpose::physicalOrder});
    for (std::size_t left = order.size(); left > 1; --left)
        std::swap(order[left - 1], order[random.below(static_cast<std::uint32_t>(left))]);
    return order;
}

std::optional<int> nextPose(const PhysicalValidation& validation) {
    const std::vector<int> order = orderOfTrials(validation.plan);
    if (validation.trials.size() >= order.size()) return std::nullopt;
    return order[validation.trials.size()];
}

}  // namespace trapwright::study
