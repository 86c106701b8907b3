#include "core/bench/bench_scenes.h"

#include "core/part/bundled.h"
#include "core/part/materials.h"
#include "core/part/part_builder.h"
#include "core/study/presets.h"
#include "core/study/trial_batches.h"
#include "core/track/track_file.h"
#include "core/verify/scenes.h"

namespace trapwright::bench {

namespace {

constexpr double kAboveHills = 8e-3;  // of the rough track [m]

base::Result<std::shared_ptr<const part::Part>> makeBundledPart(std::string_view name) {
    const auto bundled = part::findBundledPart(name);
    if (!bundled) return bundled.error();
    part::PartOptions options;
    options.name = name;
    const part::MaterialLibrary library = part::readMaterials();
    if (const auto* material = part::findMaterial(library, bundled->material))
        options.density = material->density.value;
    auto prepared = part::buildPart(part::makeBundledShape(name), options);
    if (!prepared) return prepared.error();
    return std::make_shared<const part::Part>(std::move(prepared->part));
}

}  // namespace

base::Result<std::vector<Scene>> makeScenes() {
    const auto cuboidTrack = track::readTrackFile(study::findResourceTrack("cuboid_track.json"));
    if (!cuboidTrack) return cuboidTrack.error();
    const auto coneTrack = track::readTrackFile(study::findResourceTrack("cone_track.json"));
    if (!coneTrack) return coneTrack.error();
    const auto bowlTrack = track::readTrackFile(study::findResourceTrack("bowl_track.json"));
    if (!bowlTrack) return bowlTrack.error();
    const auto cone = makeBundledPart("cone");
    if (!cone) return cone.error();
    const auto bracket = makeBundledPart("bracket");
    if (!bracket) return bracket.error();

    const auto coneSettings = study::presetSettings("cone");
    if (!coneSettings) return coneSettings.error();

    const study::SimulationSettings plastic;
    const auto cuboid = verify::makePaperCuboid();
    const auto rough = verify::makeRough();
    const auto share = [](const track::TrackFile& file) {
        return std::make_shared<const track::Track>(file.track);
    };
    return std::vector<Scene>{
        {"cuboid flat", verify::makeFlat(), cuboid, std::nullopt, 0.0, plastic},
        {"cuboid rough", rough, cuboid, std::nullopt, kAboveHills, plastic},
        {"cuboid learned", share(*cuboidTrack), cuboid, cuboidTrack->expectedOrientation, 0.0, plastic},
        {"cone learned", share(*coneTrack), *cone, coneTrack->expectedOrientation, 0.0,
         coneSettings->simulation},
        {"bracket rough", rough, *bracket, std::nullopt, kAboveHills, plastic},
        {"bowl", share(*bowlTrack), cuboid, bowlTrack->expectedOrientation, 0.0, plastic}};
}

trial::TrialBatch makeBatch(const Scene& scene, int trials) {
    trial::TrialBatch batch = study::makeTrackBatch(scene.track, scene.part, scene.simulation, 1, trials);
    for (trial::TrialSpec& trial : batch.trials)
        trial.parts[0].pose.position.z() += scene.lift;
    return batch;
}

}  // namespace trapwright::bench
