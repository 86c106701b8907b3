#include "app/trapwright/track_source.h"

#include "core/track/track_file.h"

namespace trapwright::app {

namespace {

study::Settings settingsFor(const TrackRequest& request, const track::Track& track) {
    study::Settings settings;
    settings.simulation.drive.halfStroke = request.halfStroke * base::kMillimetre;
    trial::ContactParameters& contact = settings.simulation.contact;
    contact.staticFriction = request.friction.value_or(contact.staticFriction);
    contact.kineticFriction = request.friction.value_or(contact.kineticFriction);
    contact.restitution = request.restitution.value_or(contact.restitution);
    settings.evolution.seed = request.seed;
    settings.validation.tolerance = request.tolerance * base::kDegree;
    // So that a part that is too large for this track is refused.
    const double leadInEnd = track.sections[static_cast<std::size_t>(track.firstTrapSection)].x;
    settings.track.shape = track.shape;
    settings.track.segmentWidth = track.width;
    settings.track.leadInLength = leadInEnd - track.begin();
    settings.track.startFromLeadInEnd = leadInEnd - track.start;
    return settings;
}

}  // namespace

void addTrackOptions(Command command, TrackRequest& request) {
    command.addOption("--part", request.part.part, "The part: a file, or the name of a bundled one (cuboid)");
    addPartOptions(command, request.part);
    command.addOption("--seed", request.seed, "Of the random starts (1)");
    command.addOption("--half-stroke", request.halfStroke, "Amplitude along the vibration line in mm (0.8)");
    command.addOption("--friction", request.friction, "Static and kinetic (0.5)");
    command.addOption("--restitution", request.restitution, "From 0 to 1 (0.2)");
    command.addOption("--tolerance", request.tolerance, "Of the orientation in degrees (25)");
}

Attempt<LoadedTrack> loadTrack(const TrackRequest& request, const Console& console) {
    const auto file = track::readTrackFile(request.file);
    if (!file) return Failure{ExitCode::badInput, file.error().message};
    auto loaded = loadPart(request.part, console);
    if (!loaded) return loaded.error();
    return LoadedTrack{std::make_shared<const track::Track>(file->track), file->expectedOrientation,
                       loaded->part, settingsFor(request, file->track)};
}

}  // namespace trapwright::app
