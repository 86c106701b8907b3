#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/objectives/objectives.h"
#include "core/part/part.h"
#include "core/part/symmetry.h"
#include "core/search/methods.h"
#include "core/traps/trap_kind.h"
#include "core/trial/batch.h"
#include "core/trial/returns.h"
#include "core/trial/start.h"

namespace trapwright::study {

using PointEncoding = traps::PointEncoding;

/// The track's form.
struct TrackSettings : traps::TrapParameters {
    std::string traps = "free-form";  // kinds of trap, one after the other (traps::readTraps)
    /// Cross-sections of a trap that is there already, before those (describeSections); empty: none.
    std::string given{};
    trial::Returns returns = trial::Returns::nowhere;  // where parts that fall off come again

    friend bool operator==(const TrackSettings& a, const TrackSettings& b);
};

/// Under which conditions trials run: as the settings say, or each somewhere in the operating box.
enum class TrialConditions { nominal, varied };

/// How designs are searched for and judged (paper, Table 1; decisions.md#smoothing and what follows).
struct EvolutionSettings {
    search::Method search = search::Method::genetic;
    int populationSize = 100;       // P
    int trialsPerEvaluation = 100;  // N
    int tournamentSize = 6;         // s
    double staticMutation = 0.002;  // p_sm
    double smoothingLimit = 0.3;    // what p_s = 1 stands for; 1 in the paper
    double mutationFloor = 0.0005;  // floor of p_dm; 0 in the paper
    search::ga::StrategyScope strategyScope = search::ga::StrategyScope::individual;    // of p_x and p_dm
    search::ga::FirstGeneration firstGeneration = search::ga::FirstGeneration::graded;  // random in the paper
    int plannedTraps = 1500;  // that are tried by themselves for a first generation that is planned
    // Whose sum a search maximises (objectives::readObjectives).
    std::string objectives{objectives::kPaperObjectives};
    // Two of them, a comma between, that are not added up but traded: tracks are ranked by Pareto fronts
    // (tradedObjectives); empty: by the sum.
    std::string tradeOff{};
    TrialConditions conditions = TrialConditions::varied;  // nominal in the paper
    // Of trials that vary: those in corners of the operating box, from that generation on.
    double cornerShare = 0.0;
    int cornersFrom = 0;
    trial::OrientationDistance orientationDistance = trial::OrientationDistance::symmetric;
    bool simulateOverlapping = false;  // tracks with F_C < 0
    int racingTrials = 0;              // of everybody before the best go on to N; 0: N for everybody
    double racingShare = 0.3;          // of the population that gets all N in a race
    bool commonRandomNumbers = false;  // trial i is the same for all individuals of a generation
    // Of the population, the best by single parts, that streams of parts are sent over where the objective
    // throughput counts; and how many over each.
    double streamShare = 0.1;
    int streamsEach = 2;
    // A part without progress for so long counts as stuck while learning, if that is less than
    // Termination::stuckTime, which counts in selection and validation. [s]
    double learningStuckTime = 0.6;
    // Of simulated time in learning trials; 0: chosen by evidence (chooseLearningStep). Selection and
    // validation go by the engine's own (TrialBatch::stepOf). [s]
    double learningStep = 0.0;
    int generations = 200;
    std::uint64_t seed = 1;

    friend bool operator==(const EvolutionSettings&, const EvolutionSettings&) = default;
};

/// What is simulated and how it ends.
struct SimulationSettings {
    trial::Vibration drive;
    trial::ContactParameters contact;
    std::string surface{};  // that the contact numbers are of, as the library of materials names it; or empty
    trial::Termination termination{.timeLimit = 0.0};  // 0: each track its own (terminationOn)
    trial::StartPolicy start;                          // of learning trials
    double gravity = base::kStandardGravity;
    std::string engine = "hybrid";  // a text of the study; what it means is trial::EngineRegistry's

    friend bool operator==(const SimulationSettings& a, const SimulationSettings& b);
};

/// After learning (paper, sections 6.1.1 and 6.2; decisions.md#selection-and-success).
struct ValidationSettings {
    int selectionWinners = 10;  // how many of the highest winners are re-simulated
    int selectionTrials = 1000;
    int selectionCornerTrials = 480;  // besides, in corners of the operating box
    int trialsPerPose = 1000;
    double tolerance = 25.0 * base::kDegree;               // of the expected orientation [rad]
    TrialConditions conditions = TrialConditions::varied;  // nominal in the paper

    friend bool operator==(const ValidationSettings&, const ValidationSettings&) = default;
};

/// When parts come out of the bowl in a stream: after gaps that say nothing of each other, or all alike.
enum class Arrivals { random, regular };
/// How: in their stable poses, as often as they land so, with any heading, as a bowl's track delivers them;
/// or anyhow, as while learning.
enum class Delivery { resting, anyhow };

/// Streams of parts that follow each other (decisions.md#streams).
struct StreamSettings {
    double partsPerMinute = 60.0;  // that the bowl delivers
    Arrivals arrivals = Arrivals::random;
    Delivery delivery = Delivery::resting;
    double warmUp = 15.0;    // of each stream, before anything counts [s]
    double duration = 60.0;  // that counts [s]
    int streams = 8;         // each for itself, so that their differences tell how sure the means are
    // Of parts with each other; roughness is none. Assumed: plastic on plastic.
    trial::ContactParameters contact{.staticFriction = 0.4, .kineticFriction = 0.4, .restitution = 0.2};

    friend bool operator==(const StreamSettings& a, const StreamSettings& b);
};

/// How parts shall end (decisions.md#wanted-orientation). Nothing is wanted, as in the paper, unless `poses`
/// or `orientation` is set; then any orientation is as good as another, so long as most parts end in it.
struct TargetSettings {
    std::string poses{};  // stable poses, each as good as the others, by their numbers: "3, 5-6"
    // In which they are turned about the vertical, from how the part has them: "any", or an angle in degrees.
    std::string heading = "any";
    std::optional<base::Quaternion> orientation{};  // part frame to track frame; instead of poses
    bool orientationTurns = false;  // that orientation counts however it is turned about the vertical

    [[nodiscard]] bool isSet() const { return !poses.empty() || orientation.has_value(); }

    friend bool operator==(const TargetSettings& a, const TargetSettings& b);
};

/// What the drive of the real feeder may be told, whoever operates it. Shares of its full set-point.
struct FeederSettings {
    double highestSetPoint = 0.8;
    double rampPerSecond = 0.5;  // up and down; a stop knows no ramp

    friend bool operator==(const FeederSettings&, const FeederSettings&) = default;
};

/// Which probabilities of the stable poses weight totals: those of core/part's quasi-static estimate, or the
/// shares of a drop test (core/study/pose_drops).
enum class PoseWeights { quasiStatic, dropped };

/// The part as given by the user; the mesh itself is kept beside it in the study.
struct PartSettings {
    std::string file;                 // absolute path or bundled name ("cuboid")
    std::string units;                // "mm", "m", "inch", ... as used on import
    double density = 1040.0;          // [kg/m^3]
    double symmetryTolerance = 0.01;  // relative to the part's size
    part::SymmetryUse symmetry = part::SymmetryUse::found;
    std::string material{};  // as the library of materials names it; empty: not told
    // A matter of totals alone: no trial depends on these two (core/study/pose_weights).
    PoseWeights poseWeights = PoseWeights::quasiStatic;
    std::string droppedCounts{};  // of the drop test that was chosen, one for each stable pose: "129, 48, 23"

    friend bool operator==(const PartSettings&, const PartSettings&) = default;
};

/// Everything that a study is made with. The same settings, seed and program give the same bits.
struct Settings {
    PartSettings part;
    TrackSettings track;
    EvolutionSettings evolution;
    SimulationSettings simulation;
    trial::OperatingBox box;
    TargetSettings target;
    ValidationSettings validation;
    StreamSettings stream;
    FeederSettings feeder;

    friend bool operator==(const Settings&, const Settings&) = default;
};

/// Takes from `other` how the stable poses count.
void takePoseWeights(PartSettings& part, const PartSettings& other);

/// Whether scores of the first so many generations that were made with `before` still hold with `after`: only
/// the number of generations, the weights of the stable poses and what concerns selection, validation,
/// streams unless throughput counts, the real feeder and corners of the operating box in generations to come
/// differ.
bool keepsScores(const Settings& before, const Settings& after, int generations);

/// The share of the trials of a generation that are in corners of the operating box.
double cornerShareIn(const EvolutionSettings& settings, int generation);
/// From this generation on corners of the operating box are learned, too: three of five trials are there, and
/// their success counts. Learning ends twenty generations later at the soonest. (By then good tracks have all
/// trials right all over the box: decisions.md#operating-box.)
Settings learnInCorners(const Settings& settings, int generation);
/// Whether that changes something: trials vary over a box that has corners, and none is there in that
/// generation yet.
bool canLearnInCorners(const Settings& settings, int generation);

/// The box that trials of selection and validation vary over; none where they are nominal.
std::optional<trial::OperatingBox> boxOfJudging(const Settings& settings);

/// The box alone, as toJson writes it in settings, and back.
std::string boxToJson(const trial::OperatingBox& box);
base::Result<trial::OperatingBox> boxFromJson(const std::string& text);

/// The step of learning trials: the one that is set, or the largest with which the rows of `verify` that
/// matter for the drive and the rates of trials agree with those of engines' own steps
/// (decisions.md#steps-while-learning); 0 where that is no larger than theirs. [s]
double chooseLearningStep(const Settings& settings);

/// Every violated range, as sentences that name the parameter as its JSON key, its value and what is allowed.
/// Empty if all is well.
std::vector<std::string> findProblems(const Settings& settings);
/// Why this part cannot be fed on tracks of these settings (it is larger than the track, would start in the
/// trap ...).
std::vector<std::string> findPartProblems(const Settings& settings, const part::Part& part);
/// What is allowed but unwise, in the same form: less than 60 mm of lead-in behind the start point.
std::vector<std::string> findRecommendations(const Settings& settings);

/// JSON in people's units (mm, degrees), one key per field, unit in the key: "segmentWidth_mm".
/// settingsFromJson gives equal settings back, to the last bit; an angle so if it is a multiple of
/// base::kDegree by some double, as every angle is that was entered in degrees.
std::string toJson(const Settings& settings);
/// Reads what toJson writes. Keys that are left out keep the values of `base`; an unknown key or a wrong type
/// is an error that names it. Ranges are not looked at: findProblems does that.
base::Result<Settings> settingsFromJson(const std::string& text, const Settings& base);

/// A setting's key ("track.encoding") and the values that it can have, where they are a list of names; empty
/// for numbers, texts and rotations.
struct SettingKey {
    std::string key;
    std::vector<std::string> values;
};

/// The keys of all settings, in the order of the file (settings_json.cpp).
std::vector<SettingKey> listSettingKeys();

}  // namespace trapwright::study
