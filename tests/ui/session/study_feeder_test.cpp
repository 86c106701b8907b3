#include <QtTest>
#include <algorithm>
#include <atomic>
#include <limits>

#include "core/verify/conveying.h"
#include "sim/native/native_engine.h"
#include "tests/ui/session/session_fixture.h"
#include "ui/session/study_design.h"
#include "ui/session/study_feeder.h"
#include "ui/session/study_runs.h"
#include "ui/session/study_writing.h"

using namespace trapwright;
using namespace trapwright::session;

namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();

study::PhysicalValidation plan(int repetitions = 2) {
    study::PhysicalValidation validation;
    validation.plan = {{0, 3}, repetitions, true, 5};
    validation.operatorName = "S. Mathiesen";
    validation.track = "ABS";
    validation.drive = "Virtual feeder";
    return validation;
}

study::PhysicalTrial outcome(trial::Verdict outcome, double setPoint = 0.6) {
    study::PhysicalTrial trial;
    trial.outcome = outcome;
    trial.setPoint = setPoint;
    return trial;
}

calibration::Calibration measured(calibration::Method method, double value) {
    calibration::Calibration calibration;
    calibration.method = method;
    calibration.readings = calibration::emptyReadings(method);
    for (int i = 0; i < 2; ++i)
        calibration::addReading(calibration.readings, std::vector<double>(3, value));
    calibration.result = {value, 0.9 * value, 1.1 * value};
    return calibration;
}

drive::LogEntry command(int number) {
    drive::LogEntry entry;
    entry.number = number;
    entry.time = 100.0 + number;
    entry.kind = drive::LogKind::command;
    entry.setPoint = 0.5;
    return entry;
}

}  // namespace

/// What is noted at the real feeder, and what follows from it.
class StudyFeederTest : public QObject {
    Q_OBJECT

 private slots:
    void init() { fixture_ = std::make_unique<SessionFixture>(); }

    void validationGoesOnDaysLater() {
        auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session);
        QSignalSpy changed(&session->feeder(), &StudyFeeder::physicalValidationChanged);
        QCOMPARE(session->feeder().startPhysicalValidation(plan()), 0);
        const std::vector<int> order = study::orderOfTrials(plan().plan);
        session->feeder().addPhysicalTrial(0, outcome(trial::Verdict::success));
        session->feeder().addPhysicalTrial(0, outcome(trial::Verdict::stuck));
        session->feeder().undoPhysicalTrial(0);
        session->feeder().addPhysicalTrial(0, outcome(trial::Verdict::fellOff));
        QCOMPARE(changed.count(), 5);
        const study::PhysicalValidation before = session->feeder().physicalValidations().at(0);
        QCOMPARE(before.program, kProgram);
        QVERIFY(QDateTime::fromString(QString::fromStdString(before.started), Qt::ISODate).isValid());
        QCOMPARE(before.trials.size(), std::size_t{2});
        for (std::size_t i = 0; i < 2; ++i) {
            QCOMPARE(before.trials[i].number, static_cast<int>(i));
            QCOMPARE(before.trials[i].pose, order[i]);
            QVERIFY(!before.trials[i].time.empty());
        }
        QVERIFY(before.trials[1].outcome == trial::Verdict::fellOff);
        session.reset();
        QVERIFY(!std::filesystem::exists(fixture_->path("a.trap-wal")));

        session = fixture_->open("a.trap");
        QVERIFY(session);
        QCOMPARE(session->feeder().physicalValidations().size(), std::size_t{1});
        QVERIFY(session->feeder().physicalValidations()[0] == before);
        for (int i = 0; i < 5; ++i)
            session->feeder().addPhysicalTrial(0, outcome(trial::Verdict::success));
        // The plan has four.
        QCOMPARE(session->feeder().physicalValidations()[0].trials.size(), order.size());
        QCOMPARE(session->feeder().startPhysicalValidation(plan()), 1);
        session->feeder().undoPhysicalTrial(1);
        session.reset();
        session = fixture_->open("a.trap");
        QCOMPARE(session->feeder().physicalValidations().size(), std::size_t{2});
        QCOMPARE(session->feeder().physicalValidations()[0].trials.size(), order.size());
    }

    // A generation may take minutes; whoever stands at the feeder does not wait, and nothing is lost
    // meanwhile.
    void isSavedWhileTheStudyLearns() {
        fixture_->trialTime = std::chrono::milliseconds(500);
        const auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session);
        session->runs().startLearning();
        session->feeder().startPhysicalValidation(plan());
        session->feeder().addPhysicalTrial(0, outcome(trial::Verdict::success));
        session->feeder().appendDriveLog({command(1), command(2)});
        session->feeder().addCalibration(measured(calibration::Method::bounceTime, 0.3));
        QVERIFY(waitUntil([&] {
            const auto file = store::StudyFile::openReadOnly(session->path());
            if (!file) return false;
            const auto validations = file->loadPhysicalValidations();
            const auto log = file->loadDriveLog(-kForEver, kForEver);
            const auto calibrations = file->loadCalibrations();
            return validations && validations->size() == 1 && validations->front().trials.size() == 1 &&
                   log && log->size() == 2 && calibrations && calibrations->size() == 1;
        }));
        QCOMPARE(session->runs().state(), RunState::learning);
        QVERIFY(session->runs().summaries().empty());
    }

    void driveLogIsReadBack() {
        const auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session);
        session->feeder().appendDriveLog({});
        session->feeder().appendDriveLog({command(1)});
        session->feeder().appendDriveLog({command(2), command(3)});
        QVERIFY(waitUntil(
            [&] { return session->feeder().loadDriveLog(-kForEver, kForEver).value().size() == 3; }));
        const auto some = session->feeder().loadDriveLog(102.0, 103.0).value();
        QCOMPARE(some.size(), std::size_t{1});
        QCOMPARE(some[0].number, 2);
    }

    void finalTrackIsKept() {
        auto session = fixture_->create("a.trap", smallSettings(3));
        QVERIFY(session && learnToTheEnd(*session));
        const study::Individual best = session->runs().chosen().value();
        study::Individual other = session->runs().winners()[best.generation == 0 ? 1 : 0];
        other = session->runs().loadIndividual({other.generation, (other.individual + 1) % 8}).value();
        session->runs().choose(session->runs().winners()[2]);
        session->runs().choose(other);
        session.reset();
        session = fixture_->open("a.trap");
        QVERIFY(session);
        QCOMPARE(session->runs().chosen()->generation, other.generation);
        QCOMPARE(session->runs().chosen()->individual, other.individual);
        QVERIFY(session->runs().chosen()->record == other.record);
        // A new study of the same design has nothing to choose from.
        const auto forked = session->fork(fixture_->path("b.trap"));
        VERIFY_OK(forked);
        QVERIFY(!(*forked)->runs().chosen());
    }

    void measurementsAreApplied() {
        auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session);
        QSignalSpy added(&session->feeder(), &StudyFeeder::calibrationAdded);
        QVERIFY(session->feeder().calibrationChanges(0.5).empty());
        session->feeder().addCalibration(measured(calibration::Method::tiltUntilSliding, 0.42));
        session->feeder().addCalibration(measured(calibration::Method::bounceHeight, 0.31));
        session->feeder().addCalibration(measured(calibration::Method::conveyingSpeed, 1.2e-3));
        QCOMPARE(added.count(), 3);
        QCOMPARE(session->feeder().calibrations()[2].number, 2);
        QVERIFY(!session->feeder().calibrations()[2].time.empty());
        const auto changes = session->feeder().calibrationChanges(0.5);
        session->design().changeSettings(session->feeder().calibratedSettings(changes), "Apply measurements");
        QCOMPARE(session->design().settings().simulation.contact.staticFriction, 0.42);
        QCOMPARE(session->design().settings().simulation.contact.kineticFriction, 0.42);
        QCOMPARE(session->design().settings().simulation.contact.restitution, 0.31);
        QCOMPARE(session->design().settings().simulation.drive.halfStroke, 0.6e-3);
        QVERIFY(session->design().problems().empty());
        QVERIFY(session->feeder().calibrationChanges(0.5).empty());
        session->design().undoStack()->undo();
        QCOMPARE(session->feeder().calibrationChanges(0.5).size(), changes.size());
        const std::vector<calibration::Calibration> before = session->feeder().calibrations();
        session.reset();
        session = fixture_->open("a.trap");
        QVERIFY(session && session->feeder().calibrations() == before);
    }

    void savingAsTakesItAlong() {
        auto session = fixture_->create("a.trap", smallSettings());
        QVERIFY(session);
        session->feeder().startPhysicalValidation(plan());
        session->feeder().addPhysicalTrial(0, outcome(trial::Verdict::success));
        VERIFY_OK(session->saveAs(fixture_->path("b.trap")));
        session->feeder().addPhysicalTrial(0, outcome(trial::Verdict::stuck));
        session.reset();
        session = fixture_->open("b.trap");
        QVERIFY(session);
        QCOMPARE(session->feeder().physicalValidations().at(0).trials.size(), std::size_t{2});
        session = fixture_->open("a.trap");
        QVERIFY(session);
        QCOMPARE(session->feeder().physicalValidations().at(0).trials.size(), std::size_t{1});
    }

    void whatCannotBeWrittenIsTriedAgain() {
        const auto file = fixture_->path("a.trap");
        QVERIFY(fixture_->create("a.trap", smallSettings()));
        auto study = store::StudyFile::open(file, kProgram);
        VERIFY_OK(study);
        std::atomic<int> told = 0;
        std::atomic<bool> full = true;
        std::vector<int> written;
        {
            StudyLedger ledger(std::move(study.value().openBeside()).value(),
                               [&](const std::string&) { ++told; });
            const auto add = [&](int number) {
                ledger.add([&written, &full, number](store::StudyFile&) -> base::Status {
                    if (full) return base::Error{"the disk is full"};
                    written.push_back(number);
                    return base::success();
                });
            };
            add(1);
            add(2);
            QVERIFY(fake::messageOf(ledger.finish()).contains("full"));
            QCOMPARE(told.load(), 1);
            full = false;
            add(3);
            VERIFY_OK(ledger.finish());
            QCOMPARE(written, (std::vector<int>{1, 2, 3}));
            full = true;
            add(4);
            QVERIFY(!ledger.finish().ok());
            QCOMPARE(told.load(), 2);
            full = false;
        }
        QCOMPARE(written, (std::vector<int>{1, 2, 3, 4}));
    }

    // The half-stroke that is set is found again from the speed at which the part is conveyed at it.
    void simulatedSpeedGivesTheHalfStroke() {
        Environment environment = fixture_->environment();
        environment.engines =
            fake::enginesMadeBy([](const std::string&, const trial::EngineOptions& options) {
                return std::make_unique<native::NativeEngine>(options);
            });
        auto made = StudySession::create(fixture_->path("a.trap"), smallSettings(), cuboid(), environment);
        VERIFY_OK(made);
        StudySession& session = **made;
        calibration::SpeedTable table;
        connect(&session.feeder(), &StudyFeeder::speedTableReady, this,
                [&](const calibration::SpeedTable& ready) { table = ready; });
        session.feeder().requestSpeedTable();
        QVERIFY(waitUntil([&] { return !table.speeds.empty(); }));
        QVERIFY(table.speeds.size() >= 8);
        QVERIFY(std::is_sorted(table.speeds.begin(), table.speeds.end()));
        QVERIFY(table.halfStrokes.back() > 0.7e-3);
        verify::ConveyingScene scene;
        scene.part = cuboid().part;
        scene.drive = session.design().settings().simulation.drive;
        scene.drive.halfStroke = 0.5e-3;
        scene.contact = session.design().settings().simulation.contact;
        const native::NativeEngine engine({1, 0.0});
        const auto speed = verify::measureConveyingSpeed(engine, scene, {});
        VERIFY_OK(speed);
        const auto found = calibration::findHalfStroke(table, speed->mean);
        VERIFY_OK(found);
        QVERIFY2(std::abs(*found / 0.5e-3 - 1.0) < 0.1, qPrintable(QString::number(*found * 1e3)));
    }

 private:
    std::unique_ptr<SessionFixture> fixture_;
};

QTEST_GUILESS_MAIN(StudyFeederTest)
#include "study_feeder_test.moc"
