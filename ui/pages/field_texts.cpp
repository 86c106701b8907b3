#include "ui/pages/field_texts.h"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <cassert>
#include <map>

#include "core/study/field_text.h"
#include "core/traps/trap_chain.h"
#include "ui/look/text.h"

namespace trapwright::pages {

namespace {

/// Untranslated: translated where it is asked for, so that a change of language is followed.
struct RawText {
    std::string_view key;
    const char* label;
    const char* help;
    std::array<const char*, 4> choices = {};
};

// Marks the texts for translation.
#define TEXT(text) QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", text)

// clang-format off
const RawText kTexts[] = {
    {"part.file", TEXT("Part"), TEXT("The file or the bundled part that is fed.")},
    {"part.units", TEXT("Units"), TEXT("The unit of the part's file.")},
    {"part.density_kg_m3", TEXT("Density"), TEXT("Mass of the part for its volume; sets how hard it hits.")},
    {"part.material", TEXT("Material"), TEXT("What the part is made of, as the library of materials names it.")},
    {"part.symmetry", TEXT("Symmetry counts"), TEXT("A part that is marked or coloured looks symmetric to its mesh only: let it have no symmetry then."), {TEXT("As found"), TEXT("Not at all")}},
    {"part.poseWeights", TEXT("Poses count by"), TEXT("How likely parts lie in each stable pose where totals are weighted: by the quasi-static estimate from the shape, or as they came to rest in the drop test."), {TEXT("Estimate"), TEXT("Drop test")}},
    {"part.droppedCounts", TEXT("Dropped"), TEXT("How many drops of the chosen drop test came to rest in each stable pose.")},
    {"part.symmetryTolerance", TEXT("Symmetry tolerance"), TEXT("How far the turned part may be from itself, as a share of its size, to count as alike.")},

    {"track.feeder", TEXT("Feeder"), TEXT("A straight track that shakes along a line, or one around a bowl that turns back and forth."), {TEXT("Linear"), TEXT("Bowl")}},
    {"track.bowlRadius_mm", TEXT("Bowl radius"), TEXT("From the bowl's axis to the middle of the track.")},
    {"track.conveying", TEXT("Parts move"), TEXT("The way around the bowl, seen from above."), {TEXT("Clockwise"), TEXT("Anticlockwise")}},
    {"track.slope_deg", TEXT("Slope"), TEXT("How steeply the track climbs; below 0 it falls. A linear feeder is tilted as a whole, and the vibration with it; a bowl's track climbs around an upright bowl.")},
    {"track.innerWall_mm", TEXT("Inner wall"), TEXT("How far a wall at the inner side rises above what is highest of the surface beside it, to keep parts on the track; 0: an edge. It closes cut-outs and gaps at its side; where both sides are cut back, as beside narrow rails, there is none.")},
    {"track.outerWall_mm", TEXT("Outer wall"), TEXT("The same at the outer side, where a bowl has its wall.")},
    {"track.spiralWidth_mm", TEXT("Spiral"), TEXT("Width of the ledge that parts come up the bowl on, beside a wall at its outer side; it takes the place of the level lead-in. 0: level over the whole width.")},
    {"track.spiralWall_mm", TEXT("Wall of ledges"), TEXT("How far it rises above the ledge, that of the spiral and those among the traps.")},
    {"track.spiralInclination_deg", TEXT("Ledges lean out"), TEXT("How steeply a ledge falls toward its wall, so that parts come along the wall: that of the spiral and those among the traps.")},
    {"track.chuteLength_mm", TEXT("Chute"), TEXT("How long a chute behind the lead-out is, along the track: the last cross-section, falling. The finish line is then in its middle, and parts count as they lie on it. 0: none.")},
    {"track.chuteAngle_deg", TEXT("Chute falls by"), TEXT("How steeply. Parts slide by themselves where its tangent is more than the friction; vibration helps them.")},
    {"track.traps", TEXT("Traps"), TEXT("What turns the parts: a free-form surface of hills and valleys, a level step, a groove, drops from one groove into the next, cut-outs, gaps, slots, rails, narrow rails, ledges, narrowed and notched tracks that throw out what lies wrong, or several one after the other.")},
    {"track.given", TEXT("Given trap"), TEXT("Cross-sections that the traps follow: those of a track that was learned before and stays as it is. Change in a new study, Add a rejecting trap, sets them.")},
    {"track.returns", TEXT("What falls off"), TEXT("Where parts that fall off the track come again because they fall back into the bowl or a tray: nowhere, at one side, anywhere. What falls elsewhere is lost."), {TEXT("Is lost"), TEXT("Returns inside"), TEXT("Returns outside"), TEXT("Returns")}},
    {"track.crossSections", TEXT("Cross-sections"), TEXT("How many shape a free-form trap; more of them allow more turns of the part and take longer to learn.")},
    {"track.pointsPerSection", TEXT("Points per section"), TEXT("How many points shape each cross-section, from the inner to the outer edge.")},
    {"track.minSegmentLength_mm", TEXT("Shortest segment"), TEXT("Least distance between two cross-sections.")},
    {"track.maxSegmentLength_mm", TEXT("Longest segment"), TEXT("Largest distance between two cross-sections, and the length of each segment after the trap.")},
    {"track.segmentWidth_mm", TEXT("Width"), TEXT("Of the track, from the inner to the outer edge.")},
    {"track.segmentHeight_mm", TEXT("Height"), TEXT("Of the hills above the deepest valleys; the lead-in lies in the middle.")},
    {"track.leadInLength_mm", TEXT("Lead-in"), TEXT("Length of the track before the trap, level or the spiral.")},
    {"track.startFromLeadInEnd_mm", TEXT("Start before trap"), TEXT("Where parts are put, measured back from the trap; leave 60 mm of lead-in behind it.")},
    {"track.leadOutSegments", TEXT("Lead-out segments"), TEXT("How often the last cross-section is repeated; the finish line is in the last one, or in the chute.")},
    {"track.baseThickness_mm", TEXT("Base thickness"), TEXT("Of the solid below the deepest point.")},
    {"track.encoding", TEXT("Points may lie"), TEXT("In strips a surface never crosses itself; anywhere is the paper's way, and allows overhangs."), {TEXT("In strips"), TEXT("Anywhere")}},

    {"evolution.search", TEXT("Search"), TEXT("How tracks are looked for: bred from the best ones, as in the paper; drawn at random, which shows what breeding is worth; or by exchanging single traps or cross-sections of the best one, for chains of traps."), {TEXT("Genetic"), TEXT("Random"), TEXT("Exchange")}},
    {"evolution.objectives", TEXT("Objective"), TEXT("What the search maximises, the sum of: F_C, tracks that do not cross themselves; F_D, parts that come to the end; F_O, parts that end more alike than they start (these three are the paper's); F_W, the share of parts that end as wanted, where something is wanted; success, the share of parts that finish as wanted or else in the most frequent orientation; disorder, in how many ways parts end, in bits; sorting, how far the parts that stay on the track are from all lying right, for tracks that throw back what lies wrong; correct, the share of finished parts in the most frequent orientation; purity, how few of the parts that do not come again are wrong, in nines, for tracks behind whose end nothing may be wrong; yield, how many right parts there are of all that are fed, in decades (twice as many count as much as half of the wrong ones do in purity); throughput, the share of parts that leave the track as wanted in streams of parts, which are then sent over the best tracks; worst_half, the success in the half of the operating box where it is least; corners, the success in its corners, where a share of the parts is; conveying_speed, in m/s; F_P, minus the area in mm² that a printer cannot make because walls are thinner than 1.2 mm or overhangs steeper than 45 degrees.")},
    {"evolution.populationSize", TEXT("Population"), TEXT("Individuals in each generation.")},
    {"evolution.trialsPerEvaluation", TEXT("Trials each"), TEXT("Parts that are simulated to judge one individual.")},
    {"evolution.tournamentSize", TEXT("Tournament"), TEXT("Individuals that compete to become a parent; more of them press harder.")},
    {"evolution.staticMutation", TEXT("Static mutation"), TEXT("Chance of each bit of all genes to be drawn anew, beside the chance that adapts itself.")},
    {"evolution.strategyScope", TEXT("Rates adapt"), TEXT("What has crossover and mutation rates of its own, that adapt themselves: each individual, as in the paper, or each of its genes (points, single numbers, strategy values)."), {TEXT("Individual"), TEXT("Gene by gene")}},
    {"evolution.smoothingLimit", TEXT("Most smoothing"), TEXT("The share of points that may be smoothed away at most; 1 in the paper.")},
    {"evolution.mutationFloor", TEXT("Least mutation"), TEXT("The least that the chance which adapts itself can be; 0 in the paper.")},
    {"evolution.firstGeneration", TEXT("First generation"), TEXT("From nearly level tracks to rough ones, so that parts come through from the start; or all at random, as in the paper; or planned: drops, cut-outs, gaps and slots are tried by themselves first, and learning begins with the best chains of them; or half of it tracks of another study, as Change in a new study on this page takes them along."), {TEXT("Level to rough"), TEXT("At random"), TEXT("Planned"), TEXT("Known tracks")}},
    {"evolution.plannedTraps", TEXT("Planned traps"), TEXT("How many drops, cut-outs, gaps and slots are tried by themselves before a planned first generation. It takes most of the time; more find better chains.")},
    {"evolution.conditions", TEXT("Learn under"), TEXT("Whether every part meets what is set here, or each another friction, restitution, stroke and size out of the operating box. Tracks learned so hold where the real feeder is not quite what was set."), {TEXT("As set"), TEXT("Varied")}},
    {"evolution.cornerShare", TEXT("Share in corners"), TEXT("How many of the parts that meet varied conditions meet corners of the operating box, where every condition is at an end of its range: least friction with least stroke, say. 0: none. Best from late generations on, when good tracks have all other trials right; the objective corners has to count then.")},
    {"evolution.cornersFrom", TEXT("Corners from"), TEXT("The generation from which the share in corners applies; 0: from the first. Learn in corners, after some generations, sets it.")},
    {"evolution.orientationDistance", TEXT("Alike orientations"), TEXT("Whether orientations that look alike count as the same; the paper does not count them so."), {TEXT("Count as one"), TEXT("Stay apart")}},
    {"evolution.simulateOverlapping", TEXT("Overlapping tracks"), TEXT("Whether tracks that cross themselves are simulated, as in the paper, or scored worst at once."), {TEXT("Score worst"), TEXT("Simulate")}},
    {"evolution.racingTrials", TEXT("Racing trials"), TEXT("Trials for every individual before only the best get all; 0 gives all to everybody.")},
    {"evolution.racingShare", TEXT("Racing share"), TEXT("Share of the population that gets all trials in a race; 0.3 at least unless the search is by exchanges.")},
    {"evolution.commonRandomNumbers", TEXT("Starts of parts"), TEXT("Whether all individuals of a generation meet the same random starts."), {TEXT("Differ"), TEXT("Same for all")}},
    {"evolution.tradeOff", TEXT("Trade-off"), TEXT("Two of the objectives that pull against each other, such as purity and success. Instead of by their sum tracks are ranked by Pareto fronts (NSGA-II), so that the population spreads over all that there is to choose from.")},
    {"evolution.streamShare", TEXT("Share with streams"), TEXT("Where throughput is an objective: the share of the population, the best by single parts, that streams of parts are sent over in each generation.")},
    {"evolution.streamsEach", TEXT("Streams each"), TEXT("How many streams are sent over each of these tracks, as Stream of parts says.")},
    {"evolution.learningStuckTime_s", TEXT("Stuck while learning"), TEXT("A part that makes no progress for this long counts as stuck while learning; it saves time.")},
    {"evolution.learningStep_ms", TEXT("Step while learning"), TEXT("Of simulated time. 0 takes the largest with which parts end as they do at finer steps: 0.3 ms up to 50 Hz, a 66th of a period above. Winners are checked, selected and validated at 0.2 ms, or a hundredth of a period if that is less.")},
    {"evolution.generations", TEXT("Generations"), TEXT("When learning ends; it can be raised later.")},
    {"evolution.seed", TEXT("Seed"), TEXT("Of all random numbers: the same seed and settings give the same tracks.")},

    {"simulation.drive.frequency_Hz", TEXT("Frequency"), TEXT("Of the vibration: mechanical, so twice the mains for most magnets without permanent field.")},
    {"simulation.drive.halfStroke_mm", TEXT("Half-stroke"), TEXT("From the middle of the vibration to its end, along its line; half of what a wedge on the feeder shows.")},
    {"simulation.drive.angle_deg", TEXT("Vibration angle"), TEXT("Between the line of vibration and the track of a linear feeder, or the level of a bowl.")},
    {"simulation.contact.staticFriction", TEXT("Static friction"), TEXT("Friction that holds a part at rest, over its normal force.")},
    {"simulation.contact.kineticFriction", TEXT("Kinetic friction"), TEXT("Friction of a part that slides, over its normal force.")},
    {"simulation.contact.restitution", TEXT("Restitution"), TEXT("Speed after an impact over the speed before it.")},
    {"simulation.contact.surface", TEXT("Surface"), TEXT("What the track's surface is made of, as the library of materials names it.")},
    {"simulation.termination.timeLimit_s", TEXT("Time limit"), TEXT("A part that is not at the finish by then counts as stuck. 0: as long as a part takes at 20 mm/s, and 10 s at least; longer where the feeder climbs.")},
    {"simulation.termination.stuckTime_s", TEXT("Stuck after"), TEXT("A part that makes no progress for this long is stuck in selection and validation.")},
    {"simulation.termination.stuckProgress_mm", TEXT("Progress"), TEXT("What counts as progress along the track.")},
    {"simulation.start.nearPose", TEXT("Start pose"), TEXT("The orientation near which parts start; any, if it is not set.")},
    {"simulation.start.tilt_deg", TEXT("Start tilt"), TEXT("How far parts are tilted at the start when one pose is set; the standard deviation.")},
    {"simulation.start.lateral_mm", TEXT("Start offset"), TEXT("Parts start up to this far beside the middle.")},
    {"simulation.gravity_m_s2", TEXT("Gravity"), TEXT("9.81 on Earth.")},
    {"simulation.engine", TEXT("Engine"), TEXT("Hybrid learns with the quick engine and has each winner checked by the reference engine.")},

    {"box.friction", TEXT("Friction ±"), TEXT("How far both coefficients of friction may be off; nobody knows that of a print to better than 0.15. A pair of materials sets it to what the library says; measurements on the feeder narrow it.")},
    {"box.restitution", TEXT("Restitution ±"), TEXT("How far the restitution may be off; never below 0 nor above 1. A pair of materials and measurements set it, as that of friction.")},
    {"box.halfStroke_percent", TEXT("Half-stroke ±"), TEXT("How far the drive's half-stroke may be off.")},
    {"box.frequency_percent", TEXT("Frequency ±"), TEXT("How far the drive's frequency may be off.")},
    {"box.angle_deg", TEXT("Angle ±"), TEXT("How far the vibration angle may be off.")},
    {"box.sizeBelow_mm", TEXT("Part smaller by"), TEXT("How much less each extent of a part may be than drawn.")},
    {"box.sizeAbove_mm", TEXT("Part larger by"), TEXT("How much more each extent of a part may be than drawn.")},
    {"box.centre_mm", TEXT("Centre of mass ±"), TEXT("How far a part's centre of mass may be off in each direction.")},
    {"box.startOffset_mm", TEXT("Start offset ±"), TEXT("How far to the sides the middle of where parts start may be off the track's, beside what Start offset says of each part.")},
    {"box.startSpeed_mm_s", TEXT("Start speed to"), TEXT("How fast along the track parts may come onto it; they start at rest else.")},
    {"box.roughness_deg", TEXT("Roughness to"), TEXT("How far the surface may lean from what is drawn, in grains of 0.4 mm, as the lines of a print do: each presses in a direction of its own. 0: smooth.")},
    {"box.distribution", TEXT("Spread"), TEXT("How conditions are drawn: all of the range alike, or most in its middle, with twice the standard deviation at its ends."), {TEXT("Even"), TEXT("Normal, cut off")}},

    {"target.poses", TEXT("Wanted poses"), TEXT("The stable poses in which parts shall leave the track, by their numbers on the Part page, as in 3, 5-6; each is as good as the others, alike ones are one. Empty: any one way will do, as in the paper.")},
    {"target.heading_deg", TEXT("Wanted heading"), TEXT("How far parts shall be turned about the vertical in a wanted pose, anticlockwise seen from above, from how the pose is listed: an angle, or any.")},
    {"target.orientation", TEXT("Wanted orientation"), TEXT("An orientation in which parts shall leave the track instead of wanted poses: a rotation w x y z from the part's frame to the track's, whose x is the conveying direction and z up.")},
    {"target.orientationTurns", TEXT("Its heading"), TEXT("Whether the heading of the wanted orientation counts, or only which side is up: for parts that leave hanging or standing as they cannot rest."), {TEXT("Counts"), TEXT("Any")}},

    {"validation.selectionWinners", TEXT("Winners"), TEXT("How many of the best are simulated again to choose the final one.")},
    {"validation.selectionTrials", TEXT("Trials of each"), TEXT("Parts that are simulated for each of these winners.")},
    {"validation.selectionCornerTrials", TEXT("Trials in corners"), TEXT("Parts that are simulated for each of these winners in corners of the operating box, besides. The better a track is over the box and in its corners, on average of both, the higher it ranks. 0: none; none either where conditions do not vary.")},
    {"validation.trialsPerPose", TEXT("Trials per pose"), TEXT("Parts that are simulated from each stable pose in a validation.")},
    {"validation.tolerance_deg", TEXT("Tolerance"), TEXT("How far from the expected orientation still counts as success.")},
    {"validation.conditions", TEXT("Judge under"), TEXT("Whether parts of selection and validation meet what is set here, or each other conditions out of the operating box."), {TEXT("As set"), TEXT("Varied")}},

    {"stream.partsPerMinute", TEXT("Inflow"), TEXT("How many parts a minute the bowl delivers onto the track of a stream.")},
    {"stream.arrivals", TEXT("Arrivals"), TEXT("Whether parts come after gaps that are drawn at random, as out of a bowl, or all alike."), {TEXT("At random"), TEXT("Regular")}},
    {"stream.delivery", TEXT("Delivered"), TEXT("How parts come onto the track: at rest in their stable poses, as often as they land so, or anyhow, as while learning."), {TEXT("In stable poses"), TEXT("Anyhow")}},
    {"stream.warmUp_s", TEXT("Warm-up"), TEXT("The first part of each stream, which does not count: until the track is as full as it will be.")},
    {"stream.duration_s", TEXT("Duration"), TEXT("How long each stream counts after that.")},
    {"stream.streams", TEXT("Streams"), TEXT("How many are simulated, each for itself; how much they differ tells how sure their means are.")},
    {"stream.contact.staticFriction", TEXT("Parts' static friction"), TEXT("Coefficient of friction of two parts that touch each other and do not slide. Assumed, until you measure it.")},
    {"stream.contact.kineticFriction", TEXT("Parts' kinetic friction"), TEXT("The same of parts that slide along each other.")},
    {"stream.contact.restitution", TEXT("Parts' restitution"), TEXT("Speed after an impact of two parts over the one before it.")},

    {"feeder.highestSetPoint", TEXT("Highest set-point"), TEXT("The highest set-point that the drive of the real feeder is given, as a share of full.")},
    {"feeder.rampPerSecond", TEXT("Ramp"), TEXT("How quickly its set-point rises and falls, as a share of full per second; a stop is at once.")},
};
// clang-format on
#undef TEXT

QString translated(const char* text) {
    return QCoreApplication::translate("trapwright::pages::FieldTexts", text);
}

/// What may be typed there, and what stands there at first.
QString valuesOf(const study::FieldInfo& field, const FieldText& text) {
    const bool hasUnit = field.kind != study::FieldKind::text && !unitOf(field.key).isEmpty();
    const QString unit = hasUnit ? ' ' + unitOf(field.key) : QString();
    QString first = QString::fromStdString(study::fieldText(study::Settings(), field.key));
    QStringList lines;
    if (!text.choices.empty() && text.choices.size() == field.choices.size()) {
        QStringList names;
        for (std::size_t i = 0; i < text.choices.size(); ++i)
            names << QString("*%1* (`%2`)").arg(text.choices[i], QString::fromStdString(field.choices[i]));
        lines << translated("One of: %1.").arg(names.join(", "));
    } else if (field.kind == study::FieldKind::number || field.kind == study::FieldKind::count) {
        lines << translated("%1 to %2%3.")
                     .arg(QString::number(field.low), QString::number(field.high, 'g', 10), unit);
    }
    if (!first.isEmpty()) lines << translated("At first: %1%2.").arg(first, unit);
    return lines.join(' ');
}

QString describe(const study::FieldInfo& field) {
    const FieldText text = findFieldText(field.key);
    return QString("### %1\n\n%2\n\n")
        .arg(settingHeading(field.key), (text.help + ' ' + valuesOf(field, text)).trimmed());
}

}  // namespace

FieldText findFieldText(std::string_view key) {
    const auto* found = std::find_if(std::begin(kTexts), std::end(kTexts),
                                     [&](const RawText& text) { return text.key == key; });
    assert(found != std::end(kTexts));
    FieldText text{found->key, translated(found->label), translated(found->help)};
    for (const char* choice : found->choices)
        if (choice != nullptr) text.choices.push_back(translated(choice));
    return text;
}

std::vector<Choice> trapChoices() {
    std::vector<Choice> choices;
    const auto add = [&](const std::string& value) {
        if (const auto chain = traps::readTraps(value))
            choices.push_back({value, QString::fromStdString(traps::describe(*chain))});
    };
    for (const traps::TrapKind& kind : traps::trapKinds())
        add(std::string(kind.key));
    for (const char* chain :
         {"free-form, step", "step, free-form", "groove, drop", "groove, 3 x drop", "groove, 6 x drop",
          "groove, 10 x drop", "groove, groove, 8 x gap", "groove, groove, 3 x slot", "groove, groove, rails",
          "drop, groove, narrow rails", "groove, groove, 8 x cut-out", "2 x narrowed", "narrowed, notched",
          "free-form, narrowed", "10 x ledge"})
        add(chain);
    return choices;
}

std::vector<Choice> objectiveChoices() {
    const auto tr = [](const char* text) { return translated(text); };
    return {
        {std::string(objectives::kPaperObjectives),
         tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Paper"))},
        {"F_C, F_D, success", tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Success"))},
        {"F_C, F_D, F_O, success", tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Paper, success"))},
        {"F_C, F_D, F_O, worst_half",
         tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Paper, worst half"))},
        {"F_C, F_D, F_O, F_P", tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Paper, printability"))},
        {"F_C, F_D, disorder", tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Disorder"))},
        {"sorting", tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Sorting"))},
        {"F_C, purity, success", tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "None wrong"))},
        {"F_C, purity, yield", tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "None wrong, many"))},
        {"F_C, F_D, F_O, throughput",
         tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Paper, streams"))},
        {"F_C, F_D, success, conveying_speed",
         tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Success, speed"))}};
}

std::vector<Choice> tradeOffChoices() {
    const auto tr = [](const char* text) { return translated(text); };
    return {{"", tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "None"))},
            {"purity, success", tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Purity, success"))},
            {"success, conveying_speed",
             tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Success, speed"))},
            {"success, throughput",
             tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Success, throughput"))}};
}

std::vector<Choice> engineChoices(const trial::EngineRegistry& engines) {
    std::vector<Choice> choices;
    for (const std::string& setting : engines.settings()) {
        const trial::EngineKind* kind = engines.find(setting);
        choices.push_back({setting, kind != nullptr ? QString::fromStdString(kind->title)
                                                    : translated(QT_TRANSLATE_NOOP(
                                                          "trapwright::pages::FieldTexts", "Hybrid"))});
    }
    return choices;
}

QString unitOf(std::string_view key) {
    static const std::pair<std::string_view, const char*> kUnits[] = {
        {"_kg_m3", "kg/m³"}, {"_m_s2", "m/s²"}, {"_mm_s", "mm/s"}, {"_mm", "mm"},    {"_deg", "°"},
        {"_Hz", "Hz"},       {"_ms", "ms"},     {"_s", "s"},       {"_percent", "%"}};
    for (const auto& [ending, unit] : kUnits)
        if (key.ends_with(ending)) return QString::fromUtf8(unit);
    return {};
}

std::vector<FieldGroup> trackGroups() {
    const auto tr = [](const char* text) { return translated(text); };
    return {
        {"feeder",
         tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Feeder")),
         {"track.feeder", "track.bowlRadius_mm", "track.conveying", "track.slope_deg", "track.innerWall_mm",
          "track.outerWall_mm"}},
        {"drive",
         tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Drive")),
         {"simulation.drive.frequency_Hz", "simulation.drive.halfStroke_mm", "simulation.drive.angle_deg"}},
        {"trap",
         tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Trap")),
         {"track.traps", "track.returns", "track.crossSections", "track.pointsPerSection",
          "track.minSegmentLength_mm", "track.maxSegmentLength_mm", "track.segmentWidth_mm",
          "track.segmentHeight_mm", "track.encoding"}},
        {"ends",
         tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Lead-in and lead-out")),
         {"track.leadInLength_mm", "track.startFromLeadInEnd_mm", "track.spiralWidth_mm",
          "track.spiralWall_mm", "track.spiralInclination_deg", "track.leadOutSegments",
          "track.chuteLength_mm", "track.chuteAngle_deg", "track.baseThickness_mm"}},
        {"contact",
         tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Contact")),
         {"simulation.contact.staticFriction", "simulation.contact.kineticFriction",
          "simulation.contact.restitution"}},
        {"box",
         tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Operating box")),
         {"evolution.conditions", "evolution.cornerShare", "evolution.cornersFrom", "validation.conditions",
          "box.friction", "box.restitution", "box.halfStroke_percent", "box.frequency_percent",
          "box.angle_deg", "box.sizeBelow_mm", "box.sizeAbove_mm", "box.centre_mm", "box.startOffset_mm",
          "box.startSpeed_mm_s", "box.roughness_deg", "box.distribution"}},
        {"learning",
         tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Learning")),
         {"evolution.search", "evolution.objectives", "evolution.tradeOff", "evolution.generations",
          "evolution.populationSize", "evolution.trialsPerEvaluation", "simulation.engine",
          "evolution.seed"}},
        {"operators",
         tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Genetic operators")),
         {"evolution.tournamentSize", "evolution.staticMutation", "evolution.mutationFloor",
          "evolution.strategyScope", "evolution.smoothingLimit", "evolution.firstGeneration",
          "evolution.plannedTraps", "evolution.orientationDistance", "evolution.simulateOverlapping",
          "evolution.racingTrials", "evolution.racingShare", "evolution.commonRandomNumbers",
          "evolution.streamShare", "evolution.streamsEach"},
         true},
        {"trial",
         tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Trial")),
         {"simulation.termination.timeLimit_s", "evolution.learningStuckTime_s",
          "simulation.termination.stuckTime_s", "simulation.termination.stuckProgress_mm",
          "evolution.learningStep_ms", "simulation.start.lateral_mm", "simulation.gravity_m_s2"},
         true},
        {"validation",
         tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Selection and validation")),
         {"validation.selectionWinners", "validation.selectionTrials", "validation.selectionCornerTrials",
          "validation.trialsPerPose", "validation.tolerance_deg"},
         true},
        {"stream",
         tr(QT_TRANSLATE_NOOP("trapwright::pages::FieldTexts", "Stream of parts")),
         {"stream.partsPerMinute", "stream.arrivals", "stream.delivery", "stream.warmUp_s",
          "stream.duration_s", "stream.streams", "stream.contact.staticFriction",
          "stream.contact.kineticFriction", "stream.contact.restitution"},
         true},
    };
}

QString settingHeading(std::string_view key) {
    return QString("%1 (`%2`)").arg(findFieldText(key).label, look::fromUtf8(key));
}

QString settingsReference() {
    std::map<std::string_view, study::FieldInfo> fields;
    const std::vector<study::FieldInfo> all = study::listFields();
    for (const study::FieldInfo& field : all)
        fields.emplace(field.key, field);
    QString page = translated(
        "# Settings\n\nEvery setting of a study, in the order of the [Track](track.md) page. In brackets its "
        "name in "
        "files and for `--set` on the [command line](command-line.md).\n\n");
    for (const FieldGroup& group : trackGroups()) {
        page += QString("## %1\n\n").arg(group.title);
        for (const std::string_view key : group.keys) {
            page += describe(fields.at(key));
            fields.erase(key);
        }
    }
    page += translated("## On other pages\n\n");
    for (const study::FieldInfo& field : all)
        if (fields.count(field.key) > 0) page += describe(field);
    return page.trimmed() + '\n';
}

}  // namespace trapwright::pages
