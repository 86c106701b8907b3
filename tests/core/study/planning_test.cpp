// Chains of traps are put together from what each does, told by a law that is known.

#include "core/study/planning.h"

#include <QtTest>
#include <cmath>

#include "core/part/stable_poses.h"
#include "core/study/runner.h"
#include "core/study/track_design.h"
#include "core/traps/ledge.h"
#include "tests/core/study/fake_engine.h"

using namespace trapwright;

namespace {

constexpr double kCut = 20e-3;      // of the width: less throws nothing out [m]
constexpr double kDeepCut = 30e-3;  // throws all out

/// The heading of what starts so, in quarters of a turn.
int findWay(const base::Quaternion& rotation) {
    const base::Vec3 axis = rotation * base::Vec3::UnitX();
    return (static_cast<int>(std::lround(std::atan2(axis.y(), axis.x()) / (0.5 * base::kPi))) + 4) % 4;
}

/// It ends as it starts, or falls.
trial::PartOutcome endOf(const track::Track& track, const trial::TrialSpec& spec, bool falls) {
    trial::PartOutcome outcome;
    outcome.initial = {spec.parts.front().pose.rotation, {track.start, 0.0, 0.0}};
    outcome.farthest.position = {track.finish, 0.0, 0.0};
    outcome.farthest.rotation =
        Eigen::AngleAxisd(findWay(spec.parts.front().pose.rotation) * 0.5 * base::kPi, base::Vec3::UnitZ());
    outcome.ending = falls ? trial::Ending::fellOff : trial::Ending::finished;
    outcome.time = 1.0;
    return outcome;
}

/// Parts lie down with one of four headings. What cuts in from the inner edge throws out 1 and 3, from the
/// outer edge 2 and 3; nothing turns.
trial::PartOutcome sieveLaw(const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
    const track::Track& track = *batch.track;
    const int way = findWay(spec.parts.front().pose.rotation);
    bool falls = false;
    for (const track::CrossSection& section : track.sections) {
        const double half = 0.5 * track.width;
        if (section.points.front().x() > -half + kCut) falls = falls || way == 1 || way == 3;
        if (section.points.back().x() < half - kCut) falls = falls || way == 2 || way == 3;
    }
    return endOf(track, spec, falls);
}

/// The same with a property that a part keeps, as its friction: for half of them only deep cuts do. These
/// throw out right ones, too, but the same ones every time.
trial::PartOutcome deepSieveLaw(const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
    const track::Track& track = *batch.track;
    const int way = findWay(spec.parts.front().pose.rotation);
    const double needed = spec.stream.trial % 2 == 0 ? kCut : kDeepCut;
    const double half = 0.5 * track.width;
    bool falls = false;
    for (const track::CrossSection& section : track.sections) {
        const double inner = section.points.front().x() + half;
        const double outer = half - section.points.back().x();
        falls = falls || (inner > needed && way % 2 == 1) || (outer > needed && way >= 2);
        falls = falls || (std::max(inner, outer) > kDeepCut && spec.stream.trial % 5 < 2);
    }
    return endOf(track, spec, falls);
}

/// How high the surface is between two places at its lowest across, each stretch as high as its higher end.
/// [m]
double highestBottom(const track::Track& track, double from, double to) {
    double highest = 0.0;
    for (std::size_t i = 1; i < track.sections.size(); ++i) {
        if (track.sections[i].x <= from || track.sections[i - 1].x >= to) continue;
        for (const std::size_t k : {i - 1, i}) {
            double lowest = track.height;
            for (const base::Vec2& point : track.sections[k].points)
                lowest = std::min(lowest, point.y());
            highest = std::max(highest, lowest);
        }
    }
    return highest;
}

/// The same on a ledge: what narrows it throws out 1 and 3, what takes its wall away 2 and 3. What is put
/// into the surface falls, too.
trial::PartOutcome ledgeLaw(const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
    constexpr double kNarrow = 5e-3;
    const track::Track& track = *batch.track;
    const int way = findWay(spec.parts.front().pose.rotation);
    bool isNarrow = false;
    bool hasGap = false;
    for (const track::CrossSection& section : track.sections) {
        const double last = section.points.back().x();
        const double width = last - section.points.front().x();
        const bool hasWall = section.points.back().y() > section.points.front().y() + 5e-3;
        isNarrow = isNarrow || (hasWall && width < kNarrow);
        hasGap = hasGap || !hasWall;
    }
    constexpr double kHalfPart = 5e-3;
    const base::Vec3 at = spec.parts.front().pose.position;
    const bool isInside = at.x() > track.start + 1e-3 &&
                          highestBottom(track, at.x() - kHalfPart, at.x() + kHalfPart) > at.z() + 1e-3;
    const bool falls = isInside || (isNarrow && way % 2 == 1) || (hasGap && way >= 2);
    trial::PartOutcome outcome = endOf(track, spec, falls);
    outcome.farthest.position.z() = highestBottom(track, track.finish - 1e-3, track.finish);
    return outcome;
}

bool hasUprightWall(const track::CrossSection& section) {
    const auto rises = [](const base::Vec2& from, const base::Vec2& to) {
        return to.y() - from.y() > 10.0 * (to.x() - from.x());
    };
    return std::ranges::adjacent_find(section.points, rises) != section.points.end();
}

/// A cut from the inner edge turns 1 into 2, from the outer edge two times in five into 3. Which a ledge
/// turns into 0.
trial::PartOutcome turningLaw(const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
    const track::Track& track = *batch.track;
    const double half = 0.5 * track.width;
    int way = findWay(spec.parts.front().pose.rotation);
    for (const track::CrossSection& section : track.sections) {
        const bool isLedge = hasUprightWall(section);
        if (isLedge && way == 3) way = 0;
        if (isLedge) break;
        if (section.points.front().x() > -half + kCut && way == 1) way = 2;
        if (section.points.back().x() < half - kCut && way == 1 && spec.stream.trial % 5 < 2) way = 3;
    }
    trial::PartOutcome outcome = endOf(track, spec, false);
    outcome.farthest.rotation = Eigen::AngleAxisd(way * 0.5 * base::kPi, base::Vec3::UnitZ());
    outcome.farthest.position.z() = highestBottom(track, track.finish - 1e-3, track.finish);
    return outcome;
}

study::StudyInputs sieveInputs(const char* objectives, unsigned threads = 1) {
    study::StudyInputs inputs = fake::waveInputs(threads);
    part::Part part = *inputs.part;
    part.symmetry = {};
    inputs.part = std::make_shared<const part::Part>(std::move(part));
    inputs.settings.track.traps = "groove, groove, 3 x cut-out";
    inputs.settings.track.shape.type = track::FeederType::linear;
    inputs.settings.track.segmentHeight = 200e-3;
    inputs.settings.evolution.populationSize = 6;
    inputs.settings.evolution.firstGeneration = search::ga::FirstGeneration::planned;
    inputs.settings.evolution.objectives = objectives;
    inputs.engine = std::make_shared<fake::FakeEngine>(sieveLaw, threads);
    return inputs;
}

/// How far the track of a design is cut, from either edge. [m]
std::pair<double, double> findCuts(const study::Settings& settings, const search::Design& design) {
    const auto track = study::decodeTrack(settings.track, design);
    std::pair<double, double> cuts{0.0, 0.0};
    if (!track) return {1.0, 1.0};
    for (const track::CrossSection& section : track->sections) {
        const double half = 0.5 * track->width;
        cuts.first = std::max(cuts.first, half + section.points.front().x());
        cuts.second = std::max(cuts.second, half - section.points.back().x());
    }
    return cuts;
}

}  // namespace

class PlanningTest : public QObject {
    Q_OBJECT

 private slots:
    // Neither cut alone leaves one way; both do, and only if what falls comes again.
    void findsTheCutsThatLeaveOneWay_data() {
        QTest::addColumn<int>("individuals");
        QTest::addColumn<QString>("traps");
        QTest::newRow("one plan") << 6 << "groove, groove, 3 x cut-out";
        QTest::newRow("one plan, gaps") << 6 << "groove, groove, 3 x gap";
        QTest::newRow("three plans that are joined") << 75 << "groove, groove, 3 x cut-out";
    }
    void findsTheCutsThatLeaveOneWay() {
        QFETCH(int, individuals);
        QFETCH(QString, traps);
        study::StudyInputs inputs = sieveInputs("sorting", 2);
        inputs.settings.evolution.populationSize = individuals;
        inputs.settings.track.traps = traps.toStdString();
        const auto designs = study::planDesigns(inputs, 3, {}, {});
        VERIFY_OK(designs);
        QVERIFY(!designs->empty() && designs->size() <= 3);
        const auto [inner, outer] = findCuts(inputs.settings, designs->front());
        QVERIFY2(inner > kCut && outer > kCut,
                 qPrintable(QString("%1 and %2 mm").arg(1e3 * inner).arg(1e3 * outer)));
        for (const search::Design& design : *designs)
            QVERIFY(study::designSpace(inputs.settings.track).check(design).ok());
    }

    void findsTheLedgesThatLeaveOneWay_data() {
        constexpr double kNone = -1.0;
        QTest::addColumn<double>("given");  // how far it falls [m]
        QTest::addColumn<QByteArray>("traps");
        QTest::addColumn<bool>("isPlannedTwice");
        QTest::newRow("behind the lead-in") << kNone << QByteArray("4 x ledge") << false;
        QTest::newRow("behind a track that is given") << 0.0 << QByteArray("4 x ledge") << false;
        QTest::newRow("behind one that falls") << 30e-3 << QByteArray("4 x ledge") << false;
        QTest::newRow("a long chain, its last one three times") << kNone << QByteArray("8 x ledge") << false;
        QTest::newRow("two plans") << kNone << QByteArray("4 x ledge") << true;
        QTest::newRow("behind gaps that are planned")
            << kNone << QByteArray("2 x groove, gap, 4 x ledge") << false;
    }
    void findsTheLedgesThatLeaveOneWay() {
        QFETCH(double, given);
        QFETCH(QByteArray, traps);
        QFETCH(bool, isPlannedTwice);
        study::StudyInputs inputs = sieveInputs("purity", 2);
        if (isPlannedTwice) {
            study::EvolutionSettings& evolution = inputs.settings.evolution;
            evolution.objectives = "purity, yield";
            evolution.plannedTraps = 999;
            const std::int64_t once = study::estimatePlanningTrials(evolution, 4);
            evolution.plannedTraps = 1000;
            QVERIFY(study::estimatePlanningTrials(evolution, 4) > once + 37000);
        }
        inputs.engine = std::make_shared<fake::FakeEngine>(ledgeLaw, 2);
        study::TrackSettings& track = inputs.settings.track;
        track.traps = traps.toStdString();
        track.spiral = {20e-3, 10e-3, 10.0 * base::kDegree};
        if (given >= 0.0) {
            track::CrossSection section = track::makeLeadIn(track, 20e-3, 8);
            for (base::Vec2& point : section.points)
                point.y() -= given;
            track.given = study::describeSections({&section, 1});
        }
        const auto designs = study::planDesigns(inputs, 3, {}, {});
        VERIFY_OK(designs);
        QVERIFY(!designs->empty() && designs->size() <= 3);
        const auto built = study::decodeTrack(track, designs->front());
        VERIFY_OK(built);
        for (int quarter = 0; quarter < 4; ++quarter) {
            trial::TrialBatch batch;
            batch.track = std::make_shared<const track::Track>(*built);
            trial::TrialSpec spec;
            spec.parts.resize(1);
            spec.parts.front().pose.rotation =
                Eigen::AngleAxisd(quarter * 0.5 * base::kPi, base::Vec3::UnitZ());
            QCOMPARE(ledgeLaw(batch, spec).ending == trial::Ending::finished, quarter == 0);
        }
        for (const search::Design& design : *designs)
            QVERIFY(study::designSpace(track).check(design).ok());
        const std::ptrdiff_t each = std::ssize(traps::ledge().dimensions(track));
        const auto end = designs->front().end();
        QCOMPARE(std::equal(end - each, end, end - 2 * each) && std::equal(end - each, end, end - 3 * each),
                 traps == "8 x ledge");
    }

    // What a shallow cut leaves the next one leaves as well, which no trap by itself tells.
    void partsKeepWhatTheyAre() {
        study::StudyInputs inputs = sieveInputs("sorting", 2);
        inputs.settings.track.traps = "groove, groove, 6 x cut-out";
        inputs.settings.track.returns = trial::Returns::anywhere;
        inputs.engine = std::make_shared<fake::FakeEngine>(deepSieveLaw, 2);
        const auto designs = study::planDesigns(inputs, 1, {}, {});
        VERIFY_OK(designs);
        QCOMPARE(designs->size(), std::size_t{1});
        const auto [inner, outer] = findCuts(inputs.settings, designs->front());
        QVERIFY2(inner > kDeepCut && outer > kDeepCut,
                 qPrintable(QString("%1 and %2 mm").arg(1e3 * inner).arg(1e3 * outer)));
    }

    // In the groove alone what always turns a way into another would be best.
    void whatIsOneWayOnALedgeCounts() {
        study::StudyInputs inputs = sieveInputs("purity", 2);
        inputs.engine = std::make_shared<fake::FakeEngine>(turningLaw, 2);
        study::TrackSettings& track = inputs.settings.track;
        track.traps = "2 x groove, 2 x gap, 2 x ledge";
        track.spiral = {0.0, 10e-3, 10.0 * base::kDegree};
        const auto designs = study::planDesigns(inputs, 1, {}, {});
        VERIFY_OK(designs);
        QCOMPARE(designs->size(), std::size_t{1});
        const auto built = study::decodeTrack(track, designs->front());
        VERIFY_OK(built);
        trial::TrialBatch batch;
        batch.track = std::make_shared<const track::Track>(*built);
        trial::TrialSpec spec;
        spec.stream.trial = 1;
        spec.parts.resize(1);
        spec.parts.front().pose.rotation = Eigen::AngleAxisd(0.5 * base::kPi, base::Vec3::UnitZ());
        QCOMPARE(findWay(turningLaw(batch, spec).farthest.rotation), 0);
    }

    void cutsNothingWhereFallsCount() {
        const study::StudyInputs inputs = sieveInputs("disorder");
        const auto designs = study::planDesigns(inputs, 1, {}, {});
        VERIFY_OK(designs);
        QCOMPARE(designs->size(), std::size_t{1});
        const auto [inner, outer] = findCuts(inputs.settings, designs->front());
        QVERIFY(inner <= kCut && outer <= kCut);
    }

    void givesTheSameForAnyNumberOfThreads() {
        const auto one = study::planDesigns(sieveInputs("sorting", 1), 5, {}, {});
        const auto three = study::planDesigns(sieveInputs("sorting", 3), 5, {}, {});
        VERIFY_OK(one);
        VERIFY_OK(three);
        QVERIFY(*one == *three);
    }

    // Learning begins with them, and goes on after a stop as if there had been none.
    void learningBeginsWithThem_data() {
        QTest::addColumn<int>("search");
        QTest::newRow("bred") << static_cast<int>(search::Method::genetic);
        QTest::newRow("exchanged") << static_cast<int>(search::Method::exchange);
    }
    void learningBeginsWithThem() {
        QFETCH(int, search);
        study::StudyInputs inputs = sieveInputs("sorting");
        inputs.settings.evolution.search = search::Method(search);
        inputs.settings.evolution.generations = 2;
        const auto designs = study::planDesigns(inputs, 3, {}, {});
        VERIFY_OK(designs);
        std::vector<study::GenerationRecord> whole;
        study::LearningEvents events;
        std::int64_t plannedTrials = 0;
        events.planned = [&](const study::GenerationPlan& plan) {
            plannedTrials = std::max(plannedTrials, plan.trials);
        };
        events.save = [&](const study::GenerationRecord& record) {
            whole.push_back(record);
            return base::success();
        };
        VERIFY_OK(study::evolve(inputs, {}, events, {}));
        QCOMPARE(whole.size(), std::size_t{2});
        QVERIFY(plannedTrials > 6 * inputs.settings.evolution.trialsPerEvaluation);
        for (std::size_t i = 0; i < designs->size(); ++i)
            QVERIFY(whole[0].individuals[i].design == (*designs)[i]);
        const auto& best = whole[0].individuals[static_cast<std::size_t>(whole[0].winner)];
        QCOMPARE(best.fellOff + best.finished, best.trials);
        QVERIFY(best.fellOff > 0);
        QCOMPARE(best.oriented.value_or(0), best.finished);

        study::LearningEvents again;
        again.save = [&](const study::GenerationRecord& record) {
            return record.index == 1 && record.individuals == whole[1].individuals
                       ? base::success()
                       : base::Status(base::Error{"other individuals"});
        };
        VERIFY_OK(study::evolve(inputs, study::stateAfter(whole[0]), again, {}));
    }

    // Nothing that is planned turns parts to lie as none of them comes.
    void tellsThatNoPartComesAsItIsWanted() {
        study::StudyInputs inputs = sieveInputs("sorting");
        const part::NearestPose lying = part::findStablePose(*inputs.part, base::Quaternion::Identity());
        const std::size_t other = lying.index == 0 ? 1 : 0;
        inputs.settings.target.poses = std::to_string(other + 1);
        inputs.settings.evolution.objectives = objectives::kWantedObjectives;
        const auto none = study::planDesigns(inputs, 3, {}, {});
        QVERIFY(!none.ok());
        QCOMPARE(none.error().kind, base::ErrorKind::unattainable);
        const QString message = QString::fromStdString(none.error().message);
        const QString known = QString("% in pose %1, turned to ").arg(lying.index + 1);
        QVERIFY2(message.contains("Parts shall end in stable pose " + QString::number(other + 1)),
                 qPrintable(message));
        QCOMPARE(message.count(known), 4);

        // What it offers can be had.
        const qsizetype at = message.indexOf(known) + known.size();
        inputs.settings.target.poses = std::to_string(lying.index + 1);
        inputs.settings.target.heading = message.mid(at, message.indexOf("°", at) - at).toStdString();
        std::optional<double> told;
        const auto tell = [&](const study::GenerationPlan& plan) { told = plan.wantedUnturned; };
        const auto designs = study::planDesigns(inputs, 3, tell, {});
        VERIFY_OK(designs);
        QVERIFY(!designs->empty());
        QVERIFY(told.has_value());
        QVERIFY2(std::abs(*told - 0.25) < 0.05, qPrintable(QString::number(*told)));
    }

    // A plan of nothing is no plan, and a first generation at random is not what was asked for.
    void tellsThatNoPartComesToTheTraps_data() {
        QTest::addColumn<int>("ending");
        QTest::addColumn<QString>("told");
        QTest::newRow("they fall off")
            << static_cast<int>(trial::Ending::fellOff) << "100.0 % fall off before it, 0.0 % get stuck";
        QTest::newRow("they get stuck")
            << static_cast<int>(trial::Ending::stuck) << "0.0 % fall off before it, 100.0 % get stuck";
    }
    void tellsThatNoPartComesToTheTraps() {
        QFETCH(int, ending);
        QFETCH(QString, told);
        study::StudyInputs inputs = sieveInputs("sorting");
        inputs.engine = std::make_shared<fake::FakeEngine>(
            [ending](const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
                trial::PartOutcome outcome = sieveLaw(batch, spec);
                outcome.ending = static_cast<trial::Ending>(ending);
                return outcome;
            });
        const auto none = study::planDesigns(inputs, 3, {}, {});
        QVERIFY(!none.ok());
        QCOMPARE(none.error().kind, base::ErrorKind::unattainable);
        const QString message = QString::fromStdString(none.error().message);
        QVERIFY2(message.contains(told), qPrintable(message));
    }

    void stopsWhenCancelled() {
        study::LearningControl control;
        const auto designs = study::planDesigns(
            sieveInputs("sorting"), 3, [&](const study::GenerationPlan&) { control.run.cancel(); }, control);
        QVERIFY(!designs.ok());
    }

    // A stop behind the generation does not wait for the whole plan, which would be lost.
    void stopsBetweenTraps() {
        study::LearningControl control;
        study::LearningEvents events;
        int told = 0;
        events.planned = [&](const study::GenerationPlan&) {
            if (++told == 2) control.stopAfterGeneration();
        };
        events.save = [](const study::GenerationRecord&) { return base::success(); };
        const auto end = study::evolve(sieveInputs("sorting"), {}, events, control);
        VERIFY_OK(end);
        QCOMPARE(*end, study::LearningEnd::stopped);
        QCOMPARE(told, 2);
    }

    void tellsWhatCannotBePlanned_data() {
        QTest::addColumn<QString>("traps");
        QTest::addColumn<bool>("can");
        QTest::newRow("cut-outs") << "groove, groove, 3 x cut-out" << true;
        QTest::newRow("drops, cut-outs and gaps") << "2 x groove, drop, 3 x cut-out, gap, drop" << true;
        QTest::newRow("ledges") << "4 x ledge" << true;
        QTest::newRow("one ledge, the run-up") << "ledge" << false;
        QTest::newRow("ledges behind gaps") << "groove, groove, 3 x gap, 2 x ledge" << true;
        QTest::newRow("one ledge behind gaps") << "groove, groove, 3 x gap, ledge" << false;
        QTest::newRow("gaps behind ledges") << "groove, groove, gap, 2 x ledge, gap" << false;
        QTest::newRow("ledges and others") << "2 x ledge, step" << false;
        QTest::newRow("one groove") << "groove, 3 x cut-out" << false;
        QTest::newRow("nothing behind") << "groove, groove" << false;
        QTest::newRow("free-form") << "groove, groove, cut-out, free-form" << false;
        QTest::newRow("paper") << "free-form" << false;
    }
    void tellsWhatCannotBePlanned() {
        QFETCH(QString, traps);
        QFETCH(bool, can);
        study::StudyInputs inputs = sieveInputs("sorting");
        inputs.settings.track.traps = traps.toStdString();
        QCOMPARE(study::findPlanningProblem(inputs.settings.track).empty(), can);
        const auto problems = study::findProblems(inputs.settings);
        QCOMPARE(problems.empty(), can);
        if (can) return;
        QCOMPARE(problems.size(), std::size_t{1});
        QVERIFY(problems.front().starts_with("evolution.firstGeneration is planned. Traps can be planned"));
        QVERIFY(problems.front().find(traps.toStdString()) != std::string::npos);
        inputs.settings.evolution.search = search::Method::random;
        QVERIFY(study::findProblems(inputs.settings).empty());
    }
};

QTEST_APPLESS_MAIN(PlanningTest)
#include "planning_test.moc"
