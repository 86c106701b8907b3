#include "core/study/presets.h"

#include <array>

namespace trapwright::study {

namespace {

constexpr std::array<std::string_view, 2> kPresetNames = {"cuboid", "cone"};

// The paper determined these by experiment and does not print them (section 6). Restitution is the low value
// of parts that land on several corners in turn; with 0.25 to 0.45 an ideal flat landing locks to the phase
// of the default drive (0.8 mm) and crawls at 20-30 mm/s, which rattling parts do not (event-driven solution,
// core/verify).
constexpr std::array<ContactPreset, 2> kContactPresets = {{
    {"abs-on-printed-plastic",
     {0.5, 0.5, 0.2},
     1040.0,
     "friction and restitution assumed; density of injection-moulded ABS, common data sheets"},
    {"brass-on-printed-plastic",
     {0.35, 0.35, 0.2},
     8500.0,
     "friction and restitution assumed; density of CuZn39Pb3 (EN 12164), rounded"},
}};

void useContact(Settings& settings, const ContactPreset& preset) {
    settings.simulation.contact = preset.contact;
    settings.part.density = preset.density;
}

}  // namespace

std::span<const std::string_view> presetNames() {
    return kPresetNames;
}

base::Result<Settings> presetSettings(const std::string& name) {
    if (name != "cuboid" && name != "cone") {
        return base::Error{"There is no preset named \"" + name + "\". Choose \"cuboid\" or \"cone\"."};
    }
    // Table 1; what the columns share.
    Settings settings;
    settings.part.file = name;
    settings.part.units = "mm";
    settings.track.crossSections = 5;
    settings.track.pointsPerSection = 8;
    settings.track.maxSegmentLength = 36e-3;
    settings.track.segmentWidth = 60e-3;
    settings.track.segmentHeight = 30e-3;
    settings.track.shape.bowlRadius = 175e-3;
    settings.evolution.trialsPerEvaluation = 100;
    settings.evolution.populationSize = 100;
    settings.evolution.tournamentSize = 6;

    // Section 6: 50 Hz at 12 degrees. The half-stroke is not printed (design decision 12).
    settings.simulation.drive.frequency = 50.0;
    settings.simulation.drive.angle = 12.0 * base::kDegree;
    settings.simulation.drive.halfStroke = 0.8e-3;

    // Table 1; where the columns differ.
    const bool cuboid = name == "cuboid";
    settings.track.minSegmentLength = cuboid ? 15e-3 : 22e-3;
    settings.evolution.staticMutation = cuboid ? 0.002 : 0.001;
    useContact(settings, kContactPresets[cuboid ? 0 : 1]);
    return settings;
}

Settings paperMode(Settings settings) {
    settings.track.encoding = PointEncoding::free;
    settings.track.shape.type = track::FeederType::bowl;
    settings.track.shape.bowlRadius = 175e-3;
    settings.evolution.orientationDistance = trial::OrientationDistance::plain;
    settings.evolution.smoothingLimit = 1.0;
    settings.evolution.mutationFloor = 0.0;
    settings.evolution.simulateOverlapping = true;
    settings.evolution.racingTrials = 0;
    settings.evolution.commonRandomNumbers = false;
    settings.evolution.learningStuckTime = settings.simulation.termination.stuckTime;
    settings.simulation.engine = "simbody";
    return settings;
}

std::span<const ContactPreset> contactPresets() {
    return kContactPresets;
}

base::Result<ContactPreset> findContactPreset(std::string_view name) {
    std::string names;
    for (const ContactPreset& preset : kContactPresets) {
        if (preset.name == name) return preset;
        names += (names.empty() ? "\"" : ", \"") + std::string(preset.name) + "\"";
    }
    return base::Error{"There is no pair of materials named \"" + std::string(name) + "\". Choose one of " +
                       names + "."};
}

}  // namespace trapwright::study
