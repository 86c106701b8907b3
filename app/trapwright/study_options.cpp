#include "app/trapwright/study_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "app/trapwright/engines.h"
#include "app/trapwright/program.h"
#include "app/trapwright/track_subject.h"
#include "core/base/file.h"
#include "core/base/parallel.h"
#include "core/part/stable_poses.h"
#include "core/study/evaluator.h"
#include "core/study/field_text.h"
#include "core/study/presets.h"
#include "core/study/runner.h"
#include "core/study/track_design.h"
#include "core/track/track_file.h"
#include "core/workflow/learning.h"
#include "core/workflow/proposal.h"
#include "core/workflow/study_design.h"
#include "sim/engines/registry.h"

namespace trapwright::app {

namespace {

struct IdeaFlag {
    const char* name;
    workflow::TrackIdea idea;
    const char* help;
};
constexpr std::array<IdeaFlag, 4> kIdeaFlags = {
    {{"--sorting", workflow::TrackIdea::gaps,
      "A track that throws out what lies wrong, in proportion to the part: for parts that nothing turns into "
      "one way"},
     {"--ledges", workflow::TrackIdea::ledges,
      "A track that lets one way pass, in proportion to the part: gaps that bring parts to it, and ledges "
      "behind them that throw out the others"},
     {"--slots", workflow::TrackIdea::hanging,
      "A track for parts with a head, a collar or one thick end, in proportion to the part: in its slots "
      "they hang by that end, and leave all the same way round"},
     {"--rails", workflow::TrackIdea::rails,
      "The same with one slot that goes on to the track's end: parts leave hanging between its rails, their "
      "thicker end up, and that is what is wanted"}}};

bool isText(const std::string& key) {
    static const std::vector<study::FieldInfo> fields = study::listFields();
    const auto field = std::ranges::find(fields, key, &study::FieldInfo::key);
    return field != fields.end() && field->kind == study::FieldKind::text;
}

/// {"track": {"segmentWidth_mm": 50}} for "track.segmentWidth_mm=50"; a value that is no JSON is taken as a
/// string, and so is one that is no string where a text is set ("target.poses=3").
Attempt<std::string> toJson(const std::string& assignment) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || equals == 0) {
        return Failure{ExitCode::usage,
                       fmt::format("--set {}: write KEY=VALUE, as in --set "
                                   "track.segmentWidth_mm=50; `trapwright settings STUDY` shows the keys.",
                                   assignment)};
    }
    const std::string value = assignment.substr(equals + 1);
    // The number's own text goes on: parsing it here would lose digits.
    std::string key = assignment.substr(0, equals);
    const bool isJson = nlohmann::json::accept(value) && (value.starts_with('"') || !isText(key));
    std::string json = isJson ? value : nlohmann::json(value).dump();
    for (std::size_t dot = key.rfind('.'); dot != std::string::npos; dot = key.rfind('.')) {
        json = fmt::format("{{{}: {}}}", nlohmann::json(key.substr(dot + 1)).dump(), json);
        key.resize(dot);
    }
    return fmt::format("{{{}: {}}}", nlohmann::json(key).dump(), json);
}

/// Seconds of "45s", "10min", "1h" or "1h30min".
Attempt<double> readDuration(const std::string& text) {
    constexpr std::array<std::pair<std::string_view, double>, 3> kUnits = {
        {{"min", 60.0}, {"s", 1.0}, {"h", 3600.0}}};
    const Failure wrong{ExitCode::usage,
                        fmt::format("--time {}: write a time as in 45s, 10min, 1h or 1h30min.", text)};
    double seconds = 0.0;
    std::string_view rest = text;
    while (!rest.empty()) {
        double number = 0.0;
        const auto [end, error] =
            std::from_chars(rest.data(), rest.data() + rest.size(), number, std::chars_format::fixed);
        if (error != std::errc()) return wrong;
        rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
        const auto unit = std::find_if(kUnits.begin(), kUnits.end(), [&](const auto& one) {
            return rest.substr(0, one.first.size()) == one.first;
        });
        if (unit == kUnits.end()) return wrong;
        rest.remove_prefix(unit->first.size());
        seconds += number * unit->second;
    }
    constexpr double kYear = 365.0 * 86400.0;
    if (!(seconds >= 0.0 && seconds <= kYear)) return wrong;
    return seconds;
}

/// Settings for the part and the time on so many threads, told to the user.
Attempt<study::Settings> propose(const study::Settings& settings,
                                 const std::shared_ptr<const part::Part>& part, double seconds,
                                 unsigned threads, std::optional<workflow::TrackIdea> idea,
                                 const Console& console) {
    auto engine = makeEngine(
        engines::registry().nameFor(settings.simulation.engine, trial::EngineUse::learning), {threads, 0.0});
    if (!engine) return engine.error();
    if (threads == 0) threads = base::availableThreads();
    const auto proposal = workflow::proposeSettings({settings, part, *engine, threads}, seconds, {}, idea);
    if (!proposal) return Failure{ExitCode::usage, "--time: " + proposal.error().message};
    for (const std::string& reason : proposal->reasons)
        console.note(reason);
    return proposal->settings;
}

Attempt<study::Settings> startingSettings(const CreationOptions& creation) {
    study::Settings settings;
    if (creation.preset) {
        auto preset = study::presetSettings(*creation.preset);
        if (!preset) return Failure{ExitCode::usage, preset.error().message};
        settings = std::move(*preset);
    }
    if (creation.contact) {
        const auto pair = part::requirePair(part::readMaterials(findOwnMaterials()), *creation.contact);
        if (!pair) return Failure{ExitCode::usage, pair.error().message};
        study::usePair(settings, *pair);
    }
    if (creation.paper) settings = study::paperMode(settings);
    if (creation.settingsFile) {
        const auto text = base::readFile(*creation.settingsFile);
        if (!text) return Failure{ExitCode::badInput, text.error().message};
        auto read = study::settingsFromJson(*text, settings);
        if (!read) return Failure{ExitCode::badInput, *creation.settingsFile + ": " + read.error().message};
        settings = std::move(*read);
    }
    return settings;
}

std::optional<workflow::TrackIdea> askedIdea(const CreationOptions& creation) {
    for (std::size_t i = 0; i < kIdeaFlags.size(); ++i)
        if (creation.ideas[i]) return kIdeaFlags[i].idea;
    return std::nullopt;
}

/// Without another word of the user the part is what the settings say it is.
PartRequest completeRequest(PartRequest request, const study::Settings& settings,
                            const CreationOptions& creation) {
    const study::PartSettings& known = settings.part;
    const auto takeDensity = [&] {
        if (request.density || request.material) return;
        request.density = known.density;
        request.materialName = known.material;
    };
    if (request.part.empty()) {
        request.part = known.file;
        if (!request.units && !known.units.empty()) request.units = known.units;
        takeDensity();
    } else if (creation.contact) {
        takeDensity();
    }
    if (!request.tolerance) request.tolerance = known.symmetryTolerance;
    request.symmetry = known.symmetry;
    return request;
}

}  // namespace

bool CreationOptions::given() const {
    return preset || !part.part.empty() || part.units || part.density || part.material || part.tolerance ||
           contact || surface || settingsFile || paper || std::ranges::find(ideas, true) != ideas.end() ||
           time || beginWith || behind;
}

bool SettingOptions::given() const {
    return !assignments.empty() || generations || population || trials || seed || engine;
}

void addCreationOptions(Command command, CreationOptions& options) {
    const Option preset =
        command.addOption("--preset", options.preset, "Start from the paper's Table 1: cuboid or cone");
    const Option part =
        command.addOption("--part", options.part.part, "The part: a file, or the name of a bundled one");
    addPartOptions(command, options.part);
    const Option contact = command.addOption("--contact", options.contact,
                                             "Friction and restitution, how far they may be off, and density "
                                             "by pair: abs-on-printed-plastic, steel-on-steel-sheet ... "
                                             "`trapwright materials` lists them");
    const Option surface =
        command
            .addOption("--surface", options.surface,
                       "What the track's surface is made of, for friction and restitution with the part's "
                       "material, and how far "
                       "they may be off: "
                       "printed-pla, steel-sheet ...")
            .excludes(contact);
    const Option settings = command.addOption("--settings", options.settingsFile,
                                              "Settings in JSON, as `trapwright settings` prints them");
    const Option paper =
        command.addFlag("--paper", options.paper, "The paper's own choices where the defaults go past it");
    std::vector<Option> ideas{paper};  // what there is instead of the defaults, each without the others
    for (std::size_t i = 0; i < kIdeaFlags.size(); ++i) {
        Option flag = command.addFlag(kIdeaFlags[i].name, options.ideas[i], kIdeaFlags[i].help);
        for (const Option& other : ideas)
            flag.excludes(other);
        ideas.push_back(flag);
    }
    const Option time =
        command
            .addOption(
                "--time", options.time,
                "The time that you have, as in 10min or 1h30min: how the track is learned is chosen for the "
                "part (unless --sorting, --ledges, --slots or --rails says it), and how much of it for this "
                "time on this machine")
            .type("DURATION")
            .excludes(paper);
    Option beginWith =
        command
            .addOption(
                "--begin-with", options.beginWith,
                "Begin with the tracks of another study, its part and its settings, changed by --set and "
                "what follows: so that what is learned need not be learned again where friction, drive or "
                "what is wanted is another")
            .type("STUDY");
    for (const Option& other : {preset, part, contact, surface, settings, time})
        beginWith.excludes(other);
    for (const Option& other : ideas)
        beginWith.excludes(other);
    Option behind =
        command
            .addOption("--behind", options.behind,
                       "Learn traps that throw out what still lies wrong behind a track that is there: of a "
                       "study, with its part and its settings (its chosen track, or else its best), or of a "
                       "track's file, with --part or --preset")
            .type("STUDY|TRACK");
    for (const Option& other : {time, beginWith})
        behind.excludes(other);
    for (const Option& other : ideas)
        behind.excludes(other);
}

void addSettingOptions(Command command, SettingOptions& options) {
    command.addOption("--set", options.assignments, "Set one setting, as in --set track.segmentWidth_mm=50")
        .type("KEY=VALUE")
        .repeatable();
    command.addOption("--generations", options.generations, "Generations in all");
    command.addOption("--population", options.population, "Individuals of a generation");
    command.addOption("--trials", options.trials, "Simulated trials of every individual");
    command.addOption("--seed", options.seed, "Of all random numbers");
    command.addOption(
        "--engine", options.engine,
        fmt::format("What simulates: {0}, {1}, or {2} ({0}, each generation's winner checked by {1})",
                    engines::registry().quick().name, engines::registry().reference().name, trial::kHybrid));
}

Attempt<study::Settings> applySettings(study::Settings settings, const SettingOptions& options) {
    for (const std::string& assignment : options.assignments) {
        auto json = toJson(assignment);
        if (!json) return json.error();
        auto changed = study::settingsFromJson(*json, settings);
        if (!changed) return Failure{ExitCode::usage, "--set " + assignment + ": " + changed.error().message};
        settings = std::move(*changed);
    }
    study::EvolutionSettings& evolution = settings.evolution;
    evolution.generations = options.generations.value_or(evolution.generations);
    evolution.populationSize = options.population.value_or(evolution.populationSize);
    evolution.trialsPerEvaluation = options.trials.value_or(evolution.trialsPerEvaluation);
    evolution.seed = options.seed.value_or(evolution.seed);
    settings.simulation.engine = options.engine.value_or(settings.simulation.engine);
    if (auto engine =
            findEngine(engines::registry().nameFor(settings.simulation.engine, trial::EngineUse::learning));
        !engine)
        return Failure{engine.error().code,
                       engine.error().message + fmt::format(" A study also takes {}.", trial::kHybrid)};
    return settings;
}

Attempt<bool> changeSettings(OpenStudy& study, const SettingOptions& options) {
    auto settings = applySettings(study.settings, options);
    if (!settings) return settings.error();
    if (*settings == study.settings) return false;
    if (const auto checked = study::checkInputs({*settings, study.part, nullptr}); !checked)
        return Failure{ExitCode::usage, checked.error().message};
    if (const auto changed = study.file.changeSettings(*settings); !changed)
        return describeStudyFailure(changed.error(), ExitCode::usage);
    study.settings = std::move(*settings);
    return true;
}

namespace {

/// The study, as far as it is of what was read of another one.
Attempt<store::StudyFile> createOf(const std::string& path, const workflow::StudyDesign& design,
                                   const study::KnownTracks& known, const SettingOptions& options,
                                   const Console& console) {
    const auto settings = applySettings(design.settings, options);
    if (!settings) return settings.error();
    if (const auto checked = study::checkInputs({*settings, design.part, nullptr}); !checked)
        return Failure{ExitCode::usage, checked.error().message};
    if (const std::string problem = study::findKnownProblem(*settings, known); !problem.empty())
        return Failure{ExitCode::usage, problem};
    for (const std::string& recommendation : study::findRecommendations(*settings))
        console.note(recommendation);
    auto file = store::StudyFile::create(path, *settings, design.stored, kProgram);
    if (!file) return describeCreateFailure(path, file.error());
    if (!known.tracks.empty()) {
        if (const auto saved = file->saveKnownTracks(known, *settings); !saved)
            return describeStudyFailure(saved.error(), ExitCode::badInput);
    }
    return std::move(*file);
}

/// A study with part, settings and tracks of another one.
Attempt<store::StudyFile> createFrom(const std::string& path, const std::string& other,
                                     const SettingOptions& options, const Console& console) {
    const auto from = store::StudyFile::openReadOnly(other);
    if (!from) return describeStudyFailure(from.error(), ExitCode::badInput);
    auto design = workflow::loadDesign(*from);
    if (!design) return Failure{ExitCode::badInput, design.error().message};
    const auto known = workflow::collectTracks(*from);
    if (!known) return Failure{ExitCode::badInput, known.error().message};
    design->settings.evolution.firstGeneration = search::ga::FirstGeneration::known;
    return createOf(path, *design, *known, options, console);
}

/// A study with part and settings of another one, and its track before traps of its own.
Attempt<store::StudyFile> createBehind(const std::string& path, const std::string& other,
                                       const CreationOptions& creation, const SettingOptions& options,
                                       const Console& console) {
    const auto from = store::StudyFile::openReadOnly(other);
    if (!from) return describeStudyFailure(from.error(), ExitCode::badInput);
    if (creation.preset || !creation.part.part.empty() || creation.contact || creation.surface ||
        creation.settingsFile)
        return Failure{ExitCode::usage,
                       fmt::format("--behind {}: part and settings are those of the study; give none, or a "
                                   "track's file.",
                                   other)};
    auto design = workflow::loadDesign(*from);
    if (!design) return Failure{ExitCode::badInput, design.error().message};
    const auto individual = findIndividual(*from, {});
    if (!individual) return individual.error();
    const auto track = study::decodeTrack(design->settings.track, individual->record.design);
    if (!track) return Failure{ExitCode::badInput, track.error().message};
    auto rejecting = study::rejectingMode(design->settings, *track);
    if (!rejecting) return Failure{ExitCode::usage, "--behind " + other + ": " + rejecting.error().message};
    design->settings = std::move(*rejecting);
    return createOf(path, *design, {}, options, console);
}

}  // namespace

Attempt<store::StudyFile> createStudy(const std::string& path, const CreationOptions& creation,
                                      const SettingOptions& options, const Console& console) {
    if (creation.beginWith) return createFrom(path, *creation.beginWith, options, console);
    if (creation.behind && !isTrackFile(*creation.behind))
        return createBehind(path, *creation.behind, creation, options, console);
    auto settings = startingSettings(creation);
    if (!settings) return settings.error();
    PartRequest request = completeRequest(creation.part, *settings, creation);
    if (request.part.empty()) {
        return Failure{ExitCode::usage, "A new study needs a part: give --preset cuboid or --part FILE."};
    }
    std::optional<double> seconds;
    if (creation.time) {
        const auto read = readDuration(*creation.time);
        if (!read) return read.error();
        seconds = *read;
    }
    // What is set one by one goes before the surface, which the part's material must be known for.
    auto applied = applySettings(*settings, options);
    if (!applied) return applied.error();
    request.defaultDensity = applied->part.density;
    auto loaded = loadPart(request, console);
    if (!loaded) return loaded.error();
    if (creation.surface) {
        auto pair = findPair(*creation.surface, *loaded);
        if (!pair) return pair.error();
        study::useContact(*settings, *pair);
        applied = applySettings(*settings, options);
        if (!applied) return applied.error();
    }
    if (creation.behind) {
        const auto file = track::readTrackFile(*creation.behind);
        if (!file) return Failure{ExitCode::badInput, file.error().message};
        auto rejecting = study::rejectingMode(*settings, file->track);
        if (!rejecting)
            return Failure{ExitCode::usage,
                           "--behind " + *creation.behind + ": " + rejecting.error().message};
        settings = std::move(*rejecting);
        applied = applySettings(*settings, options);
        if (!applied) return applied.error();
    }
    const std::optional<workflow::TrackIdea> idea = askedIdea(creation);
    if (seconds) {
        auto proposed = propose(*applied, loaded->part, *seconds, creation.threads, idea, console);
        if (!proposed) return proposed.error();
        applied = applySettings(*proposed, options);
        if (!applied) return applied.error();
    } else if (idea) {
        *settings = workflow::applyIdea(*idea, std::move(*settings), *loaded->part);
        if (*idea == workflow::TrackIdea::rails && !part::findHanging(*loaded->part))
            console.note(
                fmt::format("--rails: {} is not wider above its centre of mass than below it, and may "
                            "tip over. Say with --set target.poses=N how it shall leave.",
                            loaded->stored.options.name));
        applied = applySettings(*settings, options);
        if (!applied) return applied.error();
    }
    applied->part = loaded->settings;

    if (const auto checked = study::checkInputs({*applied, loaded->part, nullptr}); !checked)
        return Failure{ExitCode::usage, checked.error().message};
    if (const std::string problem = study::findKnownProblem(*applied, {}); !problem.empty())
        return Failure{ExitCode::usage, problem};
    // What had to be done to a bundled part concerns nobody.
    if (!loaded->bundled)
        for (const std::string& note : loaded->notes)
            console.note(loaded->stored.options.name + ": " + note);
    for (const std::string& recommendation : study::findRecommendations(*applied))
        console.note(recommendation);

    auto file = store::StudyFile::create(path, *applied, loaded->stored, kProgram);
    if (!file) return describeCreateFailure(path, file.error());
    return std::move(*file);
}

}  // namespace trapwright::app
