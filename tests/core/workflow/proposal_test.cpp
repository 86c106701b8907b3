#include "core/workflow/proposal.h"

#include <QtTest>

#include "core/part/bundled.h"
#include "core/part/part_builder.h"
#include "core/study/planning.h"
#include "core/study/presets.h"
#include "core/study/settings.h"
#include "tests/core/study/fake_engine.h"

using namespace trapwright;

namespace {

study::StudyInputs inputsFor(const char* name) {
    study::StudyInputs inputs = fake::waveInputs();
    auto built = part::buildPart(part::makeBundledShape(name), {.name = name});
    inputs.part = std::make_shared<const part::Part>(std::move(built.value().part));
    inputs.settings.simulation.drive.halfStroke = 0.7e-3;
    inputs.settings.evolution.seed = 5;
    return inputs;
}

/// Bolts lie along the track with either end ahead, and a slot as deep as this turns all of them tip first.
trial::PartOutcome hangingLaw(const trial::TrialBatch& batch, const trial::TrialSpec& spec) {
    constexpr double kDeep = 8e-3;
    constexpr double kWidest = 12e-3;
    const track::Track& track = *batch.track;
    // The bolt's axis is z, from its head to its tip.
    bool isTipFirst = (spec.parts.front().pose.rotation * base::Vec3::UnitZ()).x() >= 0.0;
    for (const track::CrossSection& section : track.sections) {
        const std::size_t middle = section.points.size() / 2;
        const base::Vec2 rail = section.points[middle - 2] - section.points[middle];
        isTipFirst = isTipFirst || (rail.y() > kDeep && -rail.x() < 0.5 * kWidest);
    }
    trial::PartOutcome outcome;
    outcome.initial = {spec.parts.front().pose.rotation, {track.start, 0.0, 0.0}};
    outcome.farthest.position = {track.finish, 0.0, 0.0};
    outcome.farthest.rotation = base::Quaternion::FromTwoVectors(
        base::Vec3::UnitZ(), isTipFirst ? base::Vec3::UnitX() : base::Vec3(-base::Vec3::UnitX()));
    outcome.ending = trial::Ending::finished;
    outcome.time = 1.0;
    return outcome;
}

}  // namespace

/// What is proposed for a part and for the time that the user has.
class ProposalTest : public QObject {
    Q_OBJECT

 private slots:
    void fitsThePartAndTheTime_data() {
        QTest::addColumn<QByteArray>("name");
        QTest::addColumn<bool>("isSorted");
        QTest::newRow("no symmetry") << QByteArray("clip") << true;
        QTest::newRow("half turns") << QByteArray("cuboid") << false;
        QTest::newRow("round, two ends") << QByteArray("cup") << true;
        QTest::newRow("round, ends alike") << QByteArray("washer") << false;
        QTest::newRow("sixth turns") << QByteArray("bolt") << true;
    }
    void fitsThePartAndTheTime() {
        QFETCH(QByteArray, name);
        QFETCH(bool, isSorted);
        const study::StudyInputs inputs = inputsFor(name.constData());
        double before = 0.0;
        bool hadLedges = false;
        for (const double seconds : {60.0, 600.0, 36000.0}) {
            const auto proposal = workflow::proposeSettings(inputs, seconds, {});
            QVERIFY2(proposal.ok(), proposal.ok() ? "" : proposal.error().message.c_str());
            const study::Settings& settings = proposal->settings;
            QVERIFY(study::findProblems(settings).empty());
            QVERIFY(study::findPartProblems(settings, *inputs.part).empty());
            QCOMPARE(study::isPlanned(settings.evolution), isSorted);
            const bool hasLedges = settings.track.traps.ends_with("ledge");
            QCOMPARE(settings.evolution.objectives == "sorting", isSorted && !hasLedges);
            QCOMPARE(settings.evolution.search == search::Method::exchange, hasLedges);
            QVERIFY(!hasLedges || settings.evolution.plannedTraps >= 1000);
            // None wrong where there is time for it.
            if (seconds == 36000.0) QCOMPARE(hasLedges, isSorted);
            QVERIFY(proposal->seconds > 0.0 && proposal->seconds <= seconds);
            QVERIFY(proposal->reasons.size() >= 3);
            // More of it where there is more time.
            const double traps = isSorted ? settings.evolution.plannedTraps : 0.0;
            const double size = 100.0 * traps + 1.0 * settings.evolution.populationSize *
                                                    settings.evolution.generations *
                                                    settings.evolution.trialsPerEvaluation;
            QVERIFY(size >= before || hasLedges != hadLedges);
            before = size;
            hadLedges = hasLedges;
            // What is not learning is the user's.
            QCOMPARE(settings.simulation.drive.halfStroke, 0.7e-3);
            QCOMPARE(settings.evolution.seed, std::uint64_t{5});
            study::SimulationSettings simulation = inputs.settings.simulation;
            if (isSorted) simulation.termination.timeLimit = 30.0;
            QVERIFY(settings.simulation == simulation && settings.part == inputs.settings.part);
        }
    }

    // The user's idea goes before what the part suggests, and is refused where there is no time for it.
    void whatIsAskedForIsProposed() {
        const study::StudyInputs inputs = inputsFor("clip");
        using workflow::TrackIdea;
        for (const auto& [idea, traps] : {std::pair{TrackIdea::turning, "free-form"},
                                          std::pair{TrackIdea::gaps, "groove, groove, 8 x gap"},
                                          std::pair{TrackIdea::ledges, "groove, groove, 8 x gap, 6 x ledge"},
                                          std::pair{TrackIdea::hanging, "groove, groove, 3 x slot"},
                                          std::pair{TrackIdea::rails, "drop, groove, narrow rails"}}) {
            const auto proposal = workflow::proposeSettings(inputs, 36000.0, {}, idea);
            QVERIFY(proposal.ok());
            QCOMPARE(proposal->settings.track.traps, traps);
        }
    }

    // Some slots are tried; with the law of fitsThePartAndTheTime() no part hangs in them.
    void partsThatHangAreHung() {
        study::StudyInputs inputs = inputsFor("bolt");
        inputs.engine = std::make_shared<fake::FakeEngine>(hangingLaw);
        const auto proposal = workflow::proposeSettings(inputs, 3600.0, {});
        QVERIFY2(proposal.ok(), proposal.ok() ? "" : proposal.error().message.c_str());
        QCOMPARE(proposal->settings.track.traps, std::string("groove, groove, 3 x slot"));
        QVERIFY(proposal->settings.evolution.plannedTraps <= 3000);
        QVERIFY2(proposal->reasons.front().find("hangs in a slot") != std::string::npos,
                 proposal->reasons.front().c_str());
    }

    void whatIsWantedHangingComesOnRails() {
        study::StudyInputs inputs = inputsFor("bolt");
        for (const bool isWanted : {true, false}) {
            inputs.settings.target.poses = isWanted ? "7-8" : "7";
            const auto proposal = workflow::proposeSettings(inputs, 600.0, {});
            QVERIFY2(proposal.ok(), proposal.ok() ? "" : proposal.error().message.c_str());
            QCOMPARE(proposal->settings.track.traps == study::kRailsTraps, isWanted);
            QCOMPARE(proposal->settings.target.poses, inputs.settings.target.poses);
            QCOMPARE(proposal->reasons.front().find("wanted as it hangs") != std::string::npos, isWanted);
            QVERIFY(proposal->seconds <= 600.0);
        }
    }

    // Whose ends balance is told so.
    void balancedPartsAreToldOf_data() {
        QTest::addColumn<QByteArray>("name");
        QTest::addColumn<bool>("balances");
        for (const char* name : {"d-shaft", "housing", "cup"})
            QTest::newRow(name) << QByteArray(name) << true;
        for (const char* name : {"pin", "wedge", "plate", "bracket", "cuboid"})
            QTest::newRow(name) << QByteArray(name) << false;
    }
    void balancedPartsAreToldOf() {
        QFETCH(QByteArray, name);
        QFETCH(bool, balances);
        const auto proposal = workflow::proposeSettings(inputsFor(name.constData()), 600.0, {});
        QVERIFY(proposal.ok());
        const auto& reasons = proposal->reasons;
        QCOMPARE(std::any_of(reasons.begin(), reasons.end(),
                             [](const std::string& reason) {
                                 return reason.find("from the middle of its length") != std::string::npos;
                             }),
                 balances);
    }

    void tracksAreInProportion() {
        study::StudyInputs inputs = inputsFor("cup");
        const auto small = workflow::proposeSettings(inputs, 600.0, {});
        auto built = part::buildPart(part::makeBundledShape("cup"), {.name = "cup"});
        part::Part large = std::move(built.value().part);
        large.boundingRadius *= 2.0;
        inputs.part = std::make_shared<const part::Part>(std::move(large));
        const auto big = workflow::proposeSettings(inputs, 600.0, {});
        QVERIFY(small.ok() && big.ok());
        QVERIFY(std::abs(big->settings.track.segmentWidth / small->settings.track.segmentWidth - 2.0) < 0.02);
    }

    void whatCannotBeIsRefused() {
        const study::StudyInputs inputs = inputsFor("cuboid");
        for (const double seconds : {0.0, 59.0, std::nan("")}) {
            const auto proposal = workflow::proposeSettings(inputs, seconds, {});
            QVERIFY(!proposal.ok() && proposal.error().message.find("too short") != std::string::npos);
        }
        base::RunControl cancelled;
        cancelled.cancel();
        QVERIFY(!workflow::proposeSettings(inputs, 600.0, cancelled).ok());
    }
};

QTEST_GUILESS_MAIN(ProposalTest)
#include "proposal_test.moc"
