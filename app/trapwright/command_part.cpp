#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/trapwright/command.h"
#include "app/trapwright/engines.h"
#include "app/trapwright/json_records.h"
#include "app/trapwright/part_source.h"
#include "app/trapwright/work_display.h"
#include "core/base/parallel.h"
#include "core/geometry/mass_properties.h"
#include "core/objectives/paper_scores.h"
#include "core/part/bundled.h"
#include "core/part/stable_poses.h"
#include "core/study/pose_drops.h"
#include "core/study/presets.h"
#include "core/study/settings.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

namespace {

struct Options {
    PartRequest part;
    int drops = 0;
    bool everyPose = false;
    double height = 30.0;  // [mm]
    std::optional<std::string> surface;
    std::optional<double> staticFriction;
    std::optional<double> friction;  // kinetic, and static unless that is given
    std::optional<double> restitution;
    std::uint64_t seed = 1;
    std::string engine = engines::registry().reference().name;
};

constexpr double kPerMm3 = 1e9;
constexpr double kPerGram = 1e3;
constexpr double kPerGramMm2 = 1e9;

/// The way down in the part's axes: which side lies below in that pose.
base::Vec3 downDirection(const part::StablePose& pose) {
    return pose.rotation.conjugate() * base::Vec3(0.0, 0.0, -1.0);
}

/// The centre of mass in the file's coordinates, from where the part was moved to its own origin.
base::Vec3 findCentre(const LoadedPart& loaded) {
    return geometry::calcBoundingBox(loaded.stored.mesh).low -
           geometry::calcBoundingBox(loaded.part->mesh).low;
}

std::string describePart(const LoadedPart& loaded, bool everyPose) {
    const part::Part& part = *loaded.part;
    const base::Vec3 size = geometry::calcBoundingBox(part.mesh).size() * 1e3;
    const base::Vec3 centre = findCentre(loaded) * 1e3;
    const base::Mat3 inertia = part.massProperties.inertia * kPerGramMm2;
    std::string text = fmt::format(
        "Part          {} ({}), read in {}\n"
        "Triangles     {}\n"
        "Size          {:.6g} x {:.6g} x {:.6g} mm\n"
        "Volume        {:.6g} mm^3\n"
        "Density       {:.6g} kg/m^3\n"
        "Mass          {:.6g} g\n"
        "Centre        ({:.6g}, {:.6g}, {:.6g}) mm in the file's coordinates\n"
        "Inertia       xx {:.6g}, yy {:.6g}, zz {:.6g}, xy {:.3g}, xz {:.3g}, yz {:.3g} g mm^2 about the "
        "centre\n"
        "Shape         {}\n"
        "Symmetry      {}{}\n",
        part.name, part.source, loaded.settings.units, part.mesh.triangles.size(), size.x(), size.y(),
        size.z(), part.massProperties.volume * kPerMm3, part.density, part.massProperties.mass * kPerGram,
        centre.x(), centre.y(), centre.z(), inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(0, 1),
        inertia(0, 2), inertia(1, 2),
        part.pieces.size() == 1 ? "convex" : fmt::format("{} convex pieces", part.pieces.size()),
        part.symmetry.name,
        part.symmetry.continuous ? fmt::format(" about ({:.4f}, {:.4f}, {:.4f})", part.symmetry.axis.x(),
                                               part.symmetry.axis.y(), part.symmetry.axis.z())
                                 : fmt::format(", {} rotations", part.symmetry.rotations.size()));
    text += fmt::format(
        "Best score    F_O {:.3f} for a perfect feeder\n",
        objectives::calcBestOrientationScore(part.symmetry, trial::OrientationDistance::symmetric));
    text +=
        "\nStable pose   Alike   Probability   Height of centre   Side below (direction in the part's "
        "axes)\n";
    const auto addPose = [&](const std::string& name, const std::string& alike, double probability,
                             int index) {
        const part::StablePose& pose = part.stablePoses[static_cast<std::size_t>(index)];
        const base::Vec3 down = downDirection(pose);
        text += fmt::format("{:>11} {:>7} {:>11.1f} % {:>15.3f} mm   ({:+.3f}, {:+.3f}, {:+.3f})\n", name,
                            alike, probability * 100.0, pose.height * 1e3, down.x(), down.y(), down.z());
    };
    for (const part::PoseGroup& group : part::findPoseGroups(part)) {
        addPose(part::namePoses(group.poses), std::to_string(group.poses.size()), group.probability,
                group.poses.front());
        if (!everyPose || group.poses.size() < 2) continue;
        for (const int pose : group.poses)
            addPose(std::to_string(pose + 1), "",
                    part.stablePoses[static_cast<std::size_t>(pose)].probability, pose);
    }
    text += "\nFound and mended:\n";
    for (const std::string& note : loaded.notes)
        text += "  " + note + "\n";
    return text;
}

nlohmann::ordered_json partToJson(const LoadedPart& loaded) {
    const part::Part& part = *loaded.part;
    const base::Mat3 inertia = part.massProperties.inertia * kPerGramMm2;
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (int row = 0; row < 3; ++row)
        rows.push_back(toJson(inertia.row(row).transpose(), 1.0));
    nlohmann::ordered_json poses = nlohmann::ordered_json::array();
    for (const part::StablePose& pose : part.stablePoses) {
        poses.push_back({{"probability", pose.probability},
                         {"height_mm", pose.height * 1e3},
                         {"rotation", toJson(pose.rotation)},
                         {"down", toJson(downDirection(pose), 1.0)}});
    }
    nlohmann::ordered_json groups = nlohmann::ordered_json::array();
    for (const part::PoseGroup& group : part::findPoseGroups(part))
        groups.push_back({{"poses", numbersToJson(group.poses)}, {"probability", group.probability}});
    nlohmann::ordered_json symmetry = {{"name", part.symmetry.name},
                                       {"continuous", part.symmetry.continuous},
                                       {"rotations", part.symmetry.rotations.size()}};
    if (part.symmetry.continuous) symmetry["axis"] = toJson(part.symmetry.axis, 1.0);
    return {{"name", part.name},
            {"source", part.source},
            {"units", loaded.settings.units},
            {"notes", loaded.notes},
            {"triangles", part.mesh.triangles.size()},
            {"size_mm", toJson(geometry::calcBoundingBox(part.mesh).size(), 1e3)},
            {"volume_mm3", part.massProperties.volume * kPerMm3},
            {"density_kg_m3", part.density},
            {"mass_g", part.massProperties.mass * kPerGram},
            {"centre_mm", toJson(findCentre(loaded), 1e3)},
            {"inertia_g_mm2", rows},
            {"convex_pieces", part.pieces.size()},
            {"symmetry", symmetry},
            {"stable_poses", poses},
            {"pose_groups", groups}};
}

/// How the user wants the part dropped; what he does not say is that of the surface, else the default.
Attempt<study::DropSettings> dropSettings(const Options& options, const LoadedPart& loaded) {
    study::DropSettings settings;
    settings.drops = options.drops;
    settings.height = options.height * 1e-3;
    settings.seed = options.seed;
    if (options.surface) {
        auto pair = findPair(*options.surface, loaded);
        if (!pair) return pair.error();
        settings.contact = study::contactOf(*pair);
    }
    trial::ContactParameters& contact = settings.contact;
    if (options.friction) contact.staticFriction = contact.kineticFriction = *options.friction;
    contact.staticFriction = options.staticFriction.value_or(contact.staticFriction);
    if (contact.staticFriction < contact.kineticFriction) {
        return Failure{
            ExitCode::usage,
            fmt::format("--static-friction {} is below the kinetic friction {}; give --friction as well.",
                        contact.staticFriction, contact.kineticFriction)};
    }
    contact.restitution = options.restitution.value_or(contact.restitution);
    if (const auto problems = study::findProblems(settings); !problems.empty())
        return Failure{ExitCode::usage, problems.front()};
    return settings;
}

/// Drops the part, telling how far it is.
Attempt<study::DropRecord> dropPart(const LoadedPart& loaded, const study::DropSettings& settings,
                                    const std::string& name, const Console& console) {
    const unsigned threads = base::availableThreads();
    auto engine = makeEngine(name, {1, 0.0});
    if (!engine) return engine.error();
    base::RunControl control;
    WorkWatch watch;
    watch.progress = [&] { return fmt::format("Dropping, {} of {} parts", control.done(), settings.drops); };
    watch.interrupted = [control](int) mutable { control.cancel(); };
    const WorkDisplay display(console, watch);
    auto result = study::simulateDrops(**engine, loaded.part, settings, threads, control);
    if (control.cancelled()) return Failure{ExitCode::interrupted, "Interrupted; no drops are reported."};
    if (!result) return Failure{ExitCode::fault, result.error().message};
    return study::makeDropRecord(*loaded.part, settings, (*engine)->name(), *std::move(result));
}

std::string describeDrops(const part::Part& part, const study::DropRecord& record, bool everyPose) {
    const study::DropSettings& settings = record.settings;
    const int drops = record.result.drops();
    std::string text = fmt::format(
        "\nDropped {} times from {:g} mm onto a level plane (friction {:g} static, {:g} kinetic, restitution "
        "{:g},"
        " seed {}, {}):\n"
        "Stable pose      Came to rest   95 % Clopper-Pearson   Quasi-static\n",
        drops, settings.height * 1e3, settings.contact.staticFriction, settings.contact.kineticFriction,
        settings.contact.restitution, settings.seed, record.engine);
    const auto addRow = [&](const std::vector<int>& poses, double estimate) {
        int count = 0;
        for (const int pose : poses)
            count += record.result.counts[static_cast<std::size_t>(pose)];
        const stats::Interval bounds = stats::calcClopperPearson(count, drops);
        text +=
            fmt::format("{:>11} {:>15.1f} % {:>11.1f} to {:>5.1f} % {:>12.1f} %\n", part::namePoses(poses),
                        100.0 * count / drops, 100.0 * bounds.low, 100.0 * bounds.high, 100.0 * estimate);
    };
    for (const part::PoseGroup& group : part::findPoseGroups(part)) {
        addRow(group.poses, group.probability);
        if (!everyPose || group.poses.size() < 2) continue;
        for (const int pose : group.poses)
            addRow({pose}, part.stablePoses[static_cast<std::size_t>(pose)].probability);
    }
    return text + fmt::format("  none of them {:>12.1f} %\n", 100.0 * record.result.unsettled / drops);
}

nlohmann::ordered_json dropsToJson(const study::DropRecord& record) {
    const study::DropSettings& settings = record.settings;
    nlohmann::ordered_json poses = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < record.result.counts.size(); ++i) {
        const stats::Interval bounds = record.bounds(i);
        poses.push_back({{"share", record.share(i)}, {"low", bounds.low}, {"high", bounds.high}});
    }
    return {{"drops", record.result.drops()},
            {"height_mm", settings.height * 1e3},
            {"staticFriction", settings.contact.staticFriction},
            {"kineticFriction", settings.contact.kineticFriction},
            {"restitution", settings.contact.restitution},
            {"seed", settings.seed},
            {"engine", record.engine},
            {"interval", "95 % Clopper-Pearson"},
            {"came_to_rest", record.result.counts},
            {"in_no_pose", record.result.unsettled},
            {"poses", poses}};
}

Attempt<ExitCode> run(const Options& options, const Console& console) {
    auto loaded = loadPart(options.part, console);
    if (!loaded) return loaded.error();
    nlohmann::ordered_json json = partToJson(*loaded);
    console.print(describePart(*loaded, options.everyPose));
    if (options.drops > 0) {
        auto settings = dropSettings(options, *loaded);
        if (!settings) return settings.error();
        auto dropped = dropPart(*loaded, *settings, options.engine, console);
        if (!dropped) return dropped.error();
        console.print(describeDrops(*loaded->part, *dropped, options.everyPose));
        json["drops"] = dropsToJson(*dropped);
    }
    console.emit(json);
    return ExitCode::ok;
}

}  // namespace

void addPartCommand(CLI::App& program, Invocation& invocation) {
    const auto options = std::make_shared<Options>();
    Command command =
        addCommand(program, invocation, "part",
                   "Imports a part and tells what was found and mended, its mass, symmetry and stable poses.",
                   "trapwright part clip.stl --units mm --material POM\n  "
                   "trapwright part cuboid --drop 1000 --drop-height 50 --surface steel-sheet",
                   [options](const Console& console) { return run(*options, console); });
    command
        .addOption("FILE", options->part.part,
                   "STL, OBJ, PLY, OFF, 3MF, glTF, STEP or IGES file, or a bundled part: " +
                       part::nameBundledParts())
        .required();
    addPartOptions(command, options->part);
    command.addFlag("--poses", options->everyPose, "Also a row for each of the poses that look the same");
    const Option drop =
        command
            .addOption("--drop", options->drops,
                       "Also drop the part this often, simulated, and count the poses in which it "
                       "comes to rest")
            .range(1, study::kMostDrops);
    constexpr double kGreatestFriction = 2.0;
    command
        .addOption("--drop-height", options->height, "Of the part's lowest point above the plane in mm (30)")
        .range(0.0, study::kGreatestDropHeight * 1e3)
        .needs(drop);
    command
        .addOption(
            "--surface", options->surface,
            "What the plane is made of, for its friction and restitution: printed-pla, steel-sheet ...")
        .needs(drop);
    command.addOption("--friction", options->friction, "Kinetic, and static unless that is given (0.5)")
        .range(0.0, kGreatestFriction)
        .needs(drop);
    command.addOption("--static-friction", options->staticFriction, "Not below --friction (the same)")
        .range(0.0, kGreatestFriction)
        .needs(drop);
    command.addOption("--restitution", options->restitution, "(0.2)").range(0.0, 1.0).needs(drop);
    command.addOption("--seed", options->seed, "Of the drops (1)").needs(drop);
    command
        .addOption("--engine", options->engine,
                   fmt::format("What simulates the drops: {0} or {1} ({0})", options->engine,
                               engines::registry().quick().name))
        .needs(drop);
}

}  // namespace trapwright::app
