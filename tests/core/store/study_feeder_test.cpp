#include <SQLiteCpp/SQLiteCpp.h>

#include <QTemporaryDir>
#include <QtTest>
#include <limits>

#include "core/store/schema.h"
#include "old_study.h"
#include "sample_study.h"

using namespace trapwright;
using store::StudyFile;

namespace {

constexpr double kForEver = std::numeric_limits<double>::infinity();

study::PhysicalTrial trialOf(int number, int pose, trial::Verdict outcome) {
    return {number,
            pose,
            outcome,
            1.0 / 3.0,
            0.65,
            49.9,
            "note " + std::to_string(number),
            "2026-03-31T12:00:00Z",
            number % 2 == 0 ? study::FeederKind::real : study::FeederKind::virtualFeeder,
            "REO MFS 268",
            0.55e-3};
}

study::PhysicalValidation validation(int number) {
    study::PhysicalValidation validation;
    validation.number = number;
    validation.plan = {{3, 0, 5}, 10, number % 2 == 1, 0xFEDCBA9876543210ULL};
    validation.generation = 61;
    validation.individual = 43;
    validation.operatorName = "S. Mathiesen";
    validation.track = "FDM, ABS, 0.2 mm; sanded";
    validation.drive = "Virtual feeder";
    validation.program = sample::kProgram;
    validation.started = "2026-03-31T11:00:00Z";
    return validation;
}

drive::LogEntry reading(int number, double time) {
    drive::LogEntry entry;
    entry.number = number;
    entry.time = time;
    entry.kind = drive::LogKind::reading;
    entry.setPoint = 0.1 + 0.2;
    entry.enabled = true;
    entry.acceleration = 42.5;
    return entry;
}

calibration::Calibration measured(int number) {
    calibration::Calibration calibration;
    calibration.number = number;
    calibration.method = calibration::Method::conveyingSpeed;
    calibration.readings = std::vector<calibration::TimedRun>{{0.5, 0.2, 3.1}, {0.6, 0.2, 1.0 / 3.0}};
    calibration.result = {1.1e-3, 0.9e-3, 1.3e-3};
    calibration.frequency = 50.0;
    calibration.operatorName = "S. Mathiesen";
    calibration.note = "level bowl";
    calibration.time = "2026-03-31T10:00:00Z";
    return calibration;
}

}  // namespace

class StudyFeederTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_.emplace();
        path_ = std::filesystem::path(folder_->path().toStdString()) / "fed.trap";
        sample::write(path_, 1);
    }

    void keepsValidationsWithTheirTrials() {
        std::vector<study::PhysicalValidation> expected = {validation(0), validation(1)};
        expected[1].trials = {trialOf(0, 5, trial::Verdict::success),
                              trialOf(1, 3, trial::Verdict::wrongOrientation)};
        {
            auto study = StudyFile::open(path_, sample::kProgram);
            VERIFY_OK(study);
            QVERIFY(study->loadPhysicalValidations().value().empty());
            for (const auto& one : expected)
                VERIFY_OK(study->addPhysicalValidation(one));
            expected[0].trials = {trialOf(0, 3, trial::Verdict::stuck),
                                  trialOf(1, 3, trial::Verdict::fellOff)};
            for (const auto& one : expected[0].trials)
                VERIFY_OK(study->addPhysicalTrial(0, one));
        }
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        QVERIFY(study->loadPhysicalValidations().value() == expected);
        // Days later: one is taken back, and it goes on.
        VERIFY_OK(study->removeLastPhysicalTrial(0));
        VERIFY_OK(study->addPhysicalTrial(0, trialOf(1, 0, trial::Verdict::success)));
        expected[0].trials[1] = trialOf(1, 0, trial::Verdict::success);
        const auto reader = StudyFile::openReadOnly(path_);
        VERIFY_OK(reader);
        QVERIFY(reader->loadPhysicalValidations().value() == expected);
    }

    void trialsHaveNoGapsAndNoTwins() {
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        const auto first = trialOf(0, 3, trial::Verdict::success);
        QVERIFY(sample::messageOf(study->addPhysicalTrial(0, first)).contains("no validation 1"));
        VERIFY_OK(study->addPhysicalValidation(validation(0)));
        QVERIFY(sample::messageOf(study->removeLastPhysicalTrial(0)).contains("none"));
        VERIFY_OK(study->addPhysicalTrial(0, first));
        QVERIFY(sample::messageOf(study->addPhysicalTrial(0, first)).contains("the next one"));
        const auto third = trialOf(2, 3, trial::Verdict::success);
        QVERIFY(sample::messageOf(study->addPhysicalTrial(0, third)).contains("is 2"));
        QCOMPARE(study->loadPhysicalValidations().value()[0].trials.size(), std::size_t{1});
        auto reader = StudyFile::openReadOnly(path_);
        VERIFY_OK(reader);
        QVERIFY(sample::messageOf(reader->addPhysicalTrial(0, first)).contains("reading only"));
    }

    void keepsTheDrivesLog() {
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        drive::LogEntry fault;
        fault.number = 3;
        fault.time = 1000.5;
        fault.kind = drive::LogKind::fault;
        fault.text = "No answer for 0.3 s.";
        VERIFY_OK(study->appendDriveLog(std::vector{reading(1, 1000.0), reading(2, 1000.25)}));
        VERIFY_OK(study->appendDriveLog({&fault, 1}));
        VERIFY_OK(study->appendDriveLog({}));
        const auto all = study->loadDriveLog(-kForEver, kForEver).value();
        QCOMPARE(all.size(), std::size_t{3});
        QCOMPARE(all[1].number, 2);
        QCOMPARE(all[1].time, 1000.25);
        QVERIFY(all[1].kind == drive::LogKind::reading);
        QCOMPARE(all[1].setPoint.value(), 0.1 + 0.2);
        QCOMPARE(all[1].enabled.value(), true);
        QCOMPARE(all[1].acceleration.value(), 42.5);
        QVERIFY(!all[1].frequency && !all[1].halfStroke && !all[1].current && all[1].text.empty());
        QVERIFY(all[2].kind == drive::LogKind::fault && !all[2].setPoint && !all[2].enabled);
        QCOMPARE(all[2].text, fault.text);
        const auto some = study->loadDriveLog(1000.25, 1000.5).value();
        QCOMPARE(some.size(), std::size_t{1});
        QCOMPARE(some[0].number, 2);
    }

    void keepsMeasurements() {
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        calibration::Calibration tilt = measured(1);
        tilt.method = calibration::Method::tiltUntilSliding;
        tilt.readings = std::vector<calibration::Tilt>{{0.3}, {1.0 / 3.0}};
        VERIFY_OK(study->addCalibration(measured(0)));
        VERIFY_OK(study->addCalibration(tilt));
        QVERIFY(study->loadCalibrations().value() == (std::vector{measured(0), tilt}));
    }

    void keepsTheFinalTrack() {
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        QVERIFY(!study->loadChosenWinner().value());
        for (const study::IndividualId place : {study::IndividualId{0, 4}, {0, 2}}) {
            VERIFY_OK(study->chooseWinner(place));
            QVERIFY(study->loadChosenWinner().value() == place);
        }
        VERIFY_OK(study->chooseWinner(std::nullopt));
        QVERIFY(!study->loadChosenWinner().value());
    }

    // One thread learns, another notes what happens at the feeder.
    void isWrittenBesideTheWork() {
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        {
            auto beside = study->openBeside();
            VERIFY_OK(beside);
            VERIFY_OK(beside->addPhysicalValidation(validation(0)));
            VERIFY_OK(study->saveGeneration(sample::generation(1)));
            VERIFY_OK(beside->addPhysicalTrial(0, trialOf(0, 3, trial::Verdict::success)));
            QCOMPARE(beside->generationCount().value(), 2);
            // The lock is held by both.
            study = std::move(beside);
        }
        QVERIFY(!StudyFile::open(path_, sample::kProgram).ok());
        QCOMPARE(study->loadPhysicalValidations().value()[0].trials.size(), std::size_t{1});
        { const auto closed = std::move(study).value(); }
        QVERIFY(!std::filesystem::exists(path_.string() + "-wal"));
        VERIFY_OK(StudyFile::open(path_, sample::kProgram));
        const auto reader = StudyFile::openReadOnly(path_);
        VERIFY_OK(reader);
        QVERIFY(sample::messageOf(reader->openBeside()).contains("reading only"));
    }

    void studyOfVersion3IsBroughtUpToDate() {
        sample::makeOld(path_, 3);
        QCOMPARE(StudyFile::openReadOnly(path_)->generationCount().value(), 1);
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        QCOMPARE(study->generationCount().value(), 1);
        QVERIFY(sample::equal(study->loadGeneration(0).value(), sample::generationWithoutSuccess(0)));
        study::Settings expected = sample::settings();
        expected.evolution.learningStep = 0.2e-3;  // the only one that there was
        expected.evolution.firstGeneration = search::ga::FirstGeneration::random;
        expected.evolution.plannedTraps = 50 * expected.evolution.populationSize;
        expected.evolution.conditions = study::TrialConditions::nominal;
        expected.validation.conditions = study::TrialConditions::nominal;
        QVERIFY(study->loadSettings().value() == expected);
        QVERIFY(study->loadPhysicalValidations().value().empty());
        QVERIFY(study->loadDriveLog(-kForEver, kForEver).value().empty());
        QVERIFY(study->loadCalibrations().value().empty() && !study->loadChosenWinner().value());
        VERIFY_OK(study->addPhysicalValidation(validation(0)));
        VERIFY_OK(study->addPhysicalTrial(0, trialOf(0, 3, trial::Verdict::success)));
        VERIFY_OK(study->appendDriveLog(std::vector{reading(1, 1.0)}));
        VERIFY_OK(study->addCalibration(measured(0)));
        VERIFY_OK(study->chooseWinner(study::IndividualId{0, 1}));
        SQLite::Database database(path_.string(), SQLite::OPEN_READONLY);
        QCOMPARE(database.execAndGet("PRAGMA user_version").getInt(), store::currentSchemaVersion());
    }

    // Version 5 did not note what moved the parts: that is not known, and nothing else is lost.
    void trialsOfVersion5HaveAnUnknownFeeder() {
        auto trial = trialOf(0, 3, trial::Verdict::stuck);
        {
            auto study = StudyFile::open(path_, sample::kProgram);
            VERIFY_OK(study);
            VERIFY_OK(study->addPhysicalValidation(validation(0)));
            VERIFY_OK(study->addPhysicalTrial(0, trial));
        }
        sample::makeOld(path_, 5);
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        trial.feeder = study::FeederKind::unknown;
        trial.drive.clear();
        trial.halfStroke = 0.0;
        QVERIFY(study->loadPhysicalValidations().value()[0].trials == std::vector{trial});
    }

    // What was written once can be read for ever: the file's own words are part of its format.
    void unknownWordsAreDamage() {
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        VERIFY_OK(study->addPhysicalValidation(validation(0)));
        VERIFY_OK(study->addPhysicalTrial(0, trialOf(0, 3, trial::Verdict::success)));
        VERIFY_OK(study->addCalibration(measured(0)));
        VERIFY_OK(study->appendDriveLog(std::vector{reading(1, 1.0)}));
        SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE);
        QCOMPARE(database.execAndGet("SELECT outcome FROM physical_trial").getString(),
                 std::string("success"));
        QCOMPARE(database.execAndGet("SELECT feeder FROM physical_trial").getString(), std::string("real"));
        QCOMPARE(database.execAndGet("SELECT method FROM calibration").getString(),
                 std::string("conveying-speed"));
        QCOMPARE(database.execAndGet("SELECT kind FROM drive_log").getString(), std::string("reading"));
        database.exec(
            "UPDATE physical_trial SET outcome = 'lost'; UPDATE calibration SET method = 'thumb'; "
            "UPDATE drive_log SET kind = 'song'");
        QVERIFY(sample::messageOf(study->loadPhysicalValidations()).contains("damaged"));
        database.exec("UPDATE physical_trial SET outcome = 'stuck', feeder = 'imagined'");
        QVERIFY(sample::messageOf(study->loadPhysicalValidations()).contains("the feeder of a trial"));
        QVERIFY(sample::messageOf(study->loadCalibrations()).contains("damaged"));
        QVERIFY(sample::messageOf(study->loadDriveLog(-kForEver, kForEver)).contains("damaged"));
    }

 private:
    std::optional<QTemporaryDir> folder_;
    std::filesystem::path path_;
};

QTEST_APPLESS_MAIN(StudyFeederTest)
#include "study_feeder_test.moc"
