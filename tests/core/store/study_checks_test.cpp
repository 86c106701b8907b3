#include <SQLiteCpp/SQLiteCpp.h>

#include <QTemporaryDir>
#include <QtTest>

#include "core/store/compare.h"
#include "core/store/schema.h"
#include "old_study.h"
#include "sample_study.h"

using namespace trapwright;
using store::StudyFile;

namespace {

study::CheckRecord sampleCheck(int generation) {
    return {{generation, sample::generation(generation).winner},
            97,
            {"native", testing::paperFitness(-1.0, -0.1 - generation, 0.1 + 0.2), 96, 95},
            {"simbody", testing::paperFitness(-1.0, -1.0 / 3.0, 0.7), 94, 90 - generation}};
}

/// A generation whose winner had so many trials.
study::GenerationRecord generationOf(int index, int winnersTrials) {
    study::GenerationRecord record = sample::generation(index);
    record.individuals[static_cast<std::size_t>(record.winner)].trials = winnersTrials;
    return record;
}

}  // namespace

class StudyChecksTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_.emplace();
        path_ = std::filesystem::path(folder_->path().toStdString()) / "checked.trap";
    }

    void keepsChecksOfGenerations() {
        sample::write(path_, 4);
        {
            auto study = StudyFile::open(path_, sample::kProgram);
            VERIFY_OK(study);
            QVERIFY(study->loadChecks().value().empty());
            // As they come in: not in the order of the generations.
            for (const int generation : {2, 0, 3})
                VERIFY_OK(study->saveCheck(sampleCheck(generation)));
        }
        const auto study = StudyFile::openReadOnly(path_);
        VERIFY_OK(study);
        const auto checks = study->loadChecks();
        VERIFY_OK(checks);
        QVERIFY(*checks == (std::vector<study::CheckRecord>{sampleCheck(0), sampleCheck(2), sampleCheck(3)}));
        const std::string lines = store::dumpChecks(*study).value();
        QCOMPARE(std::count(lines.begin(), lines.end(), '\n'), 3);
        const std::string first = "0 " + std::to_string(sampleCheck(0).individual) +
                                  " 97 native -1 0 -0.1 0 0.30000000000000004 0 96 95 simbody -1 0 "
                                  "-0.3333333333333333 0 0.7 0 94 90\n";
        QCOMPARE(lines.substr(0, first.size()), first);
    }

    void generationHasOneCheck() {
        sample::write(path_, 1);
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        VERIFY_OK(study->saveCheck(sampleCheck(0)));
        QVERIFY(sample::messageOf(study->saveCheck(sampleCheck(0))).contains("has one already"));
        auto reader = StudyFile::openReadOnly(path_);
        VERIFY_OK(reader);
        QVERIFY(sample::messageOf(reader->saveCheck(sampleCheck(0))).contains("reading only"));
    }

    void knowsWhatIsUnchecked() {
        sample::write(path_, 0);
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        for (const auto& [index, trials] : {std::pair(0, 20), {1, 0}, {2, 100}, {3, 100}})
            VERIFY_OK(study->saveGeneration(generationOf(index, trials)));
        VERIFY_OK(study->saveCheck(sampleCheck(2)));
        const auto unchecked = study->loadUncheckedWinners();
        VERIFY_OK(unchecked);
        // Not generation 1, whose winner was never simulated.
        QCOMPARE(unchecked->size(), std::size_t{2});
        for (std::size_t i = 0; i < 2; ++i) {
            const study::GenerationRecord record = generationOf(i == 0 ? 0 : 3, i == 0 ? 20 : 100);
            QCOMPARE((*unchecked)[i].generation, record.index);
            QCOMPARE((*unchecked)[i].individual, record.winner);
            QVERIFY((*unchecked)[i].record == record.individuals[static_cast<std::size_t>(record.winner)]);
        }
    }

    void scoresOfVersion8AreKept() {
        sample::write(path_, 3);
        const study::SelectionRecord selection{
            "simbody",
            {{{2, 1}, testing::paperFitness(-1.0, -0.1, 0.1 + 0.2), 10, 9, 8, trial::Goal()},
             {{0, 4}, testing::paperFitness(0.0, -1.0 / 3.0, 0.7), 10, 9, 7, trial::Goal()}}};
        {
            auto study = StudyFile::open(path_, sample::kProgram);
            VERIFY_OK(study);
            VERIFY_OK(study->saveCheck(sampleCheck(1)));
            VERIFY_OK(study->saveSelection(selection));
        }
        sample::makeOld(path_, 8);
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        for (int i = 0; i < 3; ++i)
            QVERIFY(sample::equal(study->loadGeneration(i).value(), sample::generationWithoutErrors(i)));
        QVERIFY(study->loadChecks().value() == std::vector{sampleCheck(1)});
        const study::SelectionRecord read = study->loadSelections().value().at(0);
        for (std::size_t i = 0; i < 2; ++i)
            QVERIFY(read.entries.at(i).fitness == selection.entries[i].fitness);
        QCOMPARE(study->loadSettings().value().evolution.objectives, std::string("F_C, F_D, F_O"));
    }

    void aScoreOfNoObjectiveIsDamage() {
        sample::write(path_, 2);
        {
            SQLite::Database database(path_.string(), SQLite::OPEN_READWRITE);
            database.exec("DELETE FROM objective WHERE place = 1");
        }
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        QVERIFY(sample::messageOf(study->loadGeneration(1)).contains("is damaged"));
        QVERIFY(sample::messageOf(study->loadSummaries()).contains("is damaged"));
        QVERIFY(sample::messageOf(study->loadWinners()).contains("is damaged"));
        const auto saved = study->saveGeneration(sample::generation(2));
        QVERIFY(!saved.ok() && saved.error().kind == base::ErrorKind::damaged);
        QVERIFY2(sample::messageOf(saved).contains("an objective is missing"),
                 qPrintable(sample::messageOf(saved)));
    }

    void studyOfVersion1IsBroughtUpToDate() {
        sample::write(path_, 2);
        sample::makeOld(path_, 1);
        QCOMPARE(StudyFile::openReadOnly(path_)->generationCount().value(), 2);
        {
            auto study = StudyFile::open(path_, sample::kProgram);
            VERIFY_OK(study);
            QCOMPARE(study->generationCount().value(), 2);
            QVERIFY(sample::equal(study->loadGeneration(1).value(), sample::generationWithoutSuccess(1)));
            const auto summaries = study->loadSummaries();
            VERIFY_OK(summaries);
            QVERIFY(summaries->at(1).statistics == sample::generationWithoutSuccess(1).statistics);
            QVERIFY(study->loadChecks().value().empty());
            VERIFY_OK(study->saveCheck(sampleCheck(1)));
        }
        const auto study = StudyFile::openReadOnly(path_);
        VERIFY_OK(study);
        // Learned without a race, and to the last digit with what it had.
        study::Settings expected = sample::settings();
        expected.evolution.learningStuckTime = expected.simulation.termination.stuckTime;
        expected.evolution.learningStep = 0.2e-3;
        expected.evolution.firstGeneration = search::ga::FirstGeneration::random;
        expected.evolution.plannedTraps = 50 * expected.evolution.populationSize;
        expected.evolution.conditions = study::TrialConditions::nominal;
        expected.validation.conditions = study::TrialConditions::nominal;
        QVERIFY(study->loadSettings().value() == expected);
        QCOMPARE(study->loadSettings().value().evolution.racingTrials, 0);
        QVERIFY(study->loadChecks().value() == std::vector{sampleCheck(1)});
        SQLite::Database database(path_.string(), SQLite::OPEN_READONLY);
        QCOMPARE(database.execAndGet("PRAGMA user_version").getInt(), store::currentSchemaVersion());
        const std::string json = database.execAndGet("SELECT settings FROM study").getString();
        for (const char* pinned :
             {"\"racingTrials\":0", "\"racingShare\":0.3", "\"commonRandomNumbers\":false",
              "\"learningStuckTime_s\":1.5", "\"learningStep_ms\":0.2", "\"firstGeneration\":\"random\"",
              "\"plannedTraps\":", "\"strategyScope\":\"individual\""}) {
            QVERIFY2(json.find(pinned) != std::string::npos, json.c_str());
        }
    }

 private:
    std::optional<QTemporaryDir> folder_;
    std::filesystem::path path_;
};

QTEST_APPLESS_MAIN(StudyChecksTest)
#include "study_checks_test.moc"
