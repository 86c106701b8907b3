#include "core/study/operating_box.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <utility>

#include "core/part/specimen.h"

namespace trapwright::study {

namespace {

using trial::BoxPlace;
using trial::Condition;

struct Range {
    double low = 0.0;
    double high = 0.0;
};

Range about(double middle, double half, double least, double most) {
    return {std::max(least, middle - half), std::min(most, middle + half)};
}

/// Of what conditionAt() tells. Physical whatever the box.
Range rangeOf(const SimulationSettings& simulation, const trial::OperatingBox& box, Condition condition) {
    constexpr double kMost = 1e9;
    const trial::Vibration& drive = simulation.drive;
    switch (condition) {
        case Condition::friction:
            return about(simulation.contact.kineticFriction, box.friction, 0.0, kMost);
        case Condition::restitution:
            return about(simulation.contact.restitution, box.restitution, 0.0, 1.0);
        case Condition::halfStroke:
            return about(drive.halfStroke, box.halfStroke * drive.halfStroke, 0.0, kMost);
        case Condition::frequency:
            return about(drive.frequency, box.frequency * drive.frequency, 0.0, kMost);
        case Condition::angle:
            return about(drive.angle, box.angle, 0.0, 0.5 * base::kPi);
        case Condition::part:
            return {-box.sizeBelow, box.sizeAbove};
        case Condition::startOffset:
            return {-box.startOffset, box.startOffset};
        case Condition::startSpeed:
            return {0.0, box.startSpeed};
        case Condition::roughness:
            return {0.0, box.roughness};
    }
    return {};
}

/// The share of its range at which a condition is that is evenly drawn from [0, 1): itself, or that of a
/// normal distribution cut off at two standard deviations.
double distribute(trial::BoxDistribution distribution, double even) {
    if (distribution == trial::BoxDistribution::uniform) return even;
    constexpr double kCutOff = 2.0;
    const boost::math::normal standard;
    const double below = cdf(standard, -kCutOff);
    const double inside = 1.0 - 2.0 * below;
    return std::clamp(0.5 + quantile(standard, below + inside * even) / (2.0 * kCutOff), 0.0, 1.0);
}

/// Each trial runs over a surface of its own.
std::uint64_t surfaceOf(base::StreamKey stream) {
    stream.purpose = base::Purpose::surface;
    base::Random random(stream);
    const std::uint64_t high = random.bits32();
    return high << 32U | random.bits32();
}

bool hasTolerances(const trial::OperatingBox& box) {
    return box.sizeBelow > 0.0 || box.sizeAbove > 0.0 || box.centre > 0.0;
}

}  // namespace

Specimens makeSpecimens(const Settings& settings, const std::shared_ptr<const part::Part>& part) {
    const trial::OperatingBox& box = settings.box;
    if (!hasTolerances(box)) return {part, {part}};
    Specimens specimens{part, {}};
    for (int k = 0; k < kSpecimens; ++k) {
        const double share = distribute(box.distribution, (k + 0.5) / kSpecimens);
        part::Deviation deviation{conditionAt(settings.simulation, box, Condition::part, share)};
        base::Random random(
            {settings.evolution.seed, 0, 0, static_cast<std::uint32_t>(k), base::Purpose::specimen});
        for (double& off : deviation.centre) {
            const double at = distribute(box.distribution, random.uniform());
            off = box.centre * (2.0 * at - 1.0);
        }
        specimens.varied.push_back(std::make_shared<const part::Part>(part::makeSpecimen(*part, deviation)));
    }
    return specimens;
}

std::shared_ptr<const part::Part> makeSpecimenAt(const trial::OperatingBox& box,
                                                 const std::shared_ptr<const part::Part>& part,
                                                 double share) {
    const part::Deviation deviation{conditionAt({}, box, Condition::part, share)};
    if (deviation.isNone()) return part;
    return std::make_shared<const part::Part>(part::makeSpecimen(*part, deviation));
}

bool varies(const SimulationSettings& simulation, const trial::OperatingBox& box, Condition condition) {
    if (condition == Condition::part) return hasTolerances(box);
    const Range range = rangeOf(simulation, box, condition);
    return range.high > range.low;
}

bool hasRoom(const SimulationSettings& simulation, const trial::OperatingBox& box) {
    return std::ranges::any_of(trial::conditionTexts(), [&](const trial::ConditionText& text) {
        return varies(simulation, box, text.condition);
    });
}

double conditionAt(const SimulationSettings& simulation, const trial::OperatingBox& box, Condition condition,
                   double share) {
    const Range range = rangeOf(simulation, box, condition);
    return range.low + share * (range.high - range.low);
}

void putAt(const SimulationSettings& simulation, const trial::OperatingBox& box, const BoxPlace& place,
           const track::Track& track, trial::TrialSpec& spec) {
    const auto at = [&](Condition condition, double known) {
        return varies(simulation, box, condition)
                   ? conditionAt(simulation, box, condition, place[static_cast<std::size_t>(condition)])
                   : known;
    };
    trial::ContactParameters contact = simulation.contact;
    contact.kineticFriction = at(Condition::friction, contact.kineticFriction);
    // What static friction is more stays.
    contact.staticFriction += contact.kineticFriction - simulation.contact.kineticFriction;
    contact.restitution = at(Condition::restitution, contact.restitution);
    contact.roughness = at(Condition::roughness, 0.0);
    if (contact.roughness > 0.0) contact.surface = surfaceOf(spec.stream);
    trial::Vibration drive = simulation.drive;
    drive.halfStroke = at(Condition::halfStroke, drive.halfStroke);
    drive.frequency = at(Condition::frequency, drive.frequency);
    drive.angle = at(Condition::angle, drive.angle);
    trial::PartStart& start = spec.parts.front();
    const base::Mat3 axes = track.shape.tangentFrame(track.start);
    start.pose.position += at(Condition::startOffset, 0.0) * axes.col(1);
    start.velocity += at(Condition::startSpeed, 0.0) * axes.col(0);
    spec.contact = contact;
    spec.drive = drive;
    spec.place = place;
}

BoxPlaces::BoxPlaces(const SimulationSettings& simulation, const trial::OperatingBox& box,
                     base::StreamKey key, double cornerShare)
    : distribution_(box.distribution), cornerShare_(cornerShare) {
    for (std::size_t c = 0; c < trial::kConditions; ++c)
        varies_[c] = varies(simulation, box, static_cast<Condition>(c));
    key.trial = 0;
    const auto drawShift = [](const base::StreamKey& of, Shift& shift) {
        base::Random random(of);
        for (std::uint64_t& one : shift) {
            const std::uint64_t high = random.bits32();
            one = high << 32U | random.bits32();
        }
    };
    drawShift(key, shift_);
    key.purpose = base::Purpose::corners;
    drawShift(key, cornerShift_);
}

std::vector<BoxPlace> BoxPlaces::draw(int first, int count) const {
    using Sobol = boost::random::sobol_engine<std::uint64_t, 64>;
    // Among the first n trials of all.
    const auto countCorners = [&](int n) { return static_cast<int>(std::floor(cornerShare_ * n)); };
    int corners = countCorners(first);
    Sobol sequence(trial::kConditions);
    sequence.seed(static_cast<Sobol::result_type>(first - corners));
    Sobol cornerSequence(trial::kConditions);
    cornerSequence.seed(static_cast<Sobol::result_type>(corners));
    std::vector<BoxPlace> places(static_cast<std::size_t>(count), trial::kMiddle);
    for (BoxPlace& place : places) {
        const bool isCorner = countCorners(++first) > corners;
        corners += isCorner ? 1 : 0;
        for (std::size_t c = 0; c < trial::kConditions; ++c) {
            constexpr int kFraction = 53;
            const std::uint64_t bits = isCorner ? cornerSequence() ^ cornerShift_[c] : sequence() ^ shift_[c];
            if (!varies_[c]) continue;
            place[c] =
                isCorner ? static_cast<double>(bits >> 63U)
                         : distribute(distribution_,
                                      std::ldexp(static_cast<double>(bits >> (64 - kFraction)), -kFraction));
        }
    }
    return places;
}

}  // namespace trapwright::study
