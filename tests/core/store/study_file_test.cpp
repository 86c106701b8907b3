#include "core/store/study_file.h"

#include <QTemporaryDir>
#include <QtTest>
#include <set>

#include "old_study.h"
#include "sample_study.h"

using namespace trapwright;
using store::StudyFile;

namespace {

std::set<std::string> filesIn(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.insert(entry.path().filename().string());
    return names;
}

study::SelectionRecord sampleSelection(double offset) {
    study::SelectionRecord record{"simbody", {}};
    for (int i = 0; i < 3; ++i) {
        record.entries.push_back({{10 - i, i},
                                  testing::paperFitness(-1.0 * i, -0.1 - offset, 0.7 + 0.01 * i),
                                  1000,
                                  999 - i,
                                  990 - i,
                                  trial::makeGoal(base::Quaternion(0.5, -0.5, 0.1 + 0.2, offset)),
                                  i == 0 ? stats::Count{} : stats::Count{470 + i, 480}});
    }
    record.entries[1].goal.orientations.push_back({base::Quaternion(1.0 / 3.0, 0.1, offset, 0.7), false});
    record.entries[2].goal.orientations.front().anyHeading = true;
    return record;
}

study::ValidationRecord sampleValidation(int generation) {
    study::ValidationRecord record;
    record.generation = generation;
    record.individual = 3;
    record.engine = "native";
    record.goal = trial::makeGoal(base::Quaternion(0.1, 0.2, 0.3, 0.4));
    if (generation == 9) record.goal.orientations.front().anyHeading = true;
    record.tolerance = 25.0 * base::kDegree;
    for (int i = 0; i < 3; ++i)
        record.rows.push_back({i, {994 - 10 * i, 10 * i, 4, 2}});
    return record;
}

}  // namespace

class StudyFileTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_.emplace();
        path_ = std::filesystem::path(folder_->path().toStdString()) / "a study.trap";
    }

    void keepsSettingsPartAndOrigin() {
        sample::write(path_, 0);
        for (const bool readOnly : {true, false}) {
            auto study = readOnly ? StudyFile::openReadOnly(path_) : StudyFile::open(path_, sample::kProgram);
            VERIFY_OK(study);
            QCOMPARE(study->writable(), !readOnly);
            const auto settings = study->loadSettings();
            VERIFY_OK(settings);
            QVERIFY(*settings == sample::settings());
            const auto part = study->loadPart();
            VERIFY_OK(part);
            QVERIFY(part->mesh.vertices == sample::part().mesh.vertices);
            QVERIFY(part->mesh.triangles == sample::part().mesh.triangles);
            QCOMPARE(part->options.name, std::string("tetrahedron"));
            QCOMPARE(part->options.source, std::string("/parts/tetra.stl"));
            QCOMPARE(part->options.density, 1041.5);
            QCOMPARE(part->options.symmetryTolerance, 0.0125);
            QVERIFY(part->options.symmetry == part::SymmetryUse::none);
            QCOMPARE(study->generationCount().value(), 0);
        }
    }

    void keepsGenerationsExactly() {
        sample::write(path_, 3);
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        VERIFY_OK(study->saveGeneration(sample::generation(3)));
        QCOMPARE(study->generationCount().value(), 4);
        for (int i = 0; i < 4; ++i) {
            const auto record = study->loadGeneration(i);
            VERIFY_OK(record);
            QVERIFY(sample::equal(*record, sample::generation(i)));
        }
        QVERIFY(study->loadIndividual({2, 5}).value() == sample::generation(2).individuals[5]);

        const auto winners = study->loadWinners();
        VERIFY_OK(winners);
        const auto summaries = study->loadSummaries(1);
        VERIFY_OK(summaries);
        QCOMPARE(winners->size(), std::size_t{4});
        QCOMPARE(summaries->size(), std::size_t{3});
        for (int i = 0; i < 4; ++i) {
            const study::GenerationRecord expected = sample::generation(i);
            const study::Individual& winner = (*winners)[static_cast<std::size_t>(i)];
            QCOMPARE(winner.generation, i);
            QCOMPARE(winner.individual, expected.winner);
            QVERIFY(winner.record == expected.individuals[static_cast<std::size_t>(expected.winner)]);
            if (i == 0) continue;
            const study::GenerationSummary& summary = (*summaries)[static_cast<std::size_t>(i - 1)];
            QCOMPARE(summary.index, i);
            QCOMPARE(summary.winner, expected.winner);
            QVERIFY(summary.statistics == expected.statistics);
            QCOMPARE(summary.seconds, expected.seconds);
            QCOMPARE(summary.trials, study::summarize(expected).trials);
        }
    }

    /// Two scores of all that were simulated; of an objective that is not there, of nobody.
    void loadsScoresInPairs() {
        sample::write(path_, 3);
        const auto study = StudyFile::openReadOnly(path_);
        VERIFY_OK(study);
        const auto pairs = study->loadScorePairs("F_O", "F_D");
        VERIFY_OK(pairs);
        std::vector<study::ScorePair> expected;
        for (int g = 0; g < 3; ++g) {
            const study::GenerationRecord record = sample::generation(g);
            for (std::size_t i = 0; i < record.individuals.size(); ++i) {
                const study::IndividualRecord& individual = record.individuals[i];
                if (individual.trials == 0) continue;
                expected.push_back({{g, static_cast<int>(i)},
                                    individual.trials,
                                    objectives::findScore(individual.fitness, "F_O")->value,
                                    objectives::findScore(individual.fitness, "F_D")->value});
            }
        }
        QVERIFY(!expected.empty());
        QVERIFY(*pairs == expected);
        QVERIFY(study->loadScorePairs("F_O", "nothing").value().empty());
    }

    /// Who has few trials by a race is not compared; less is better where the objective says so.
    void findsTheFrontOfPairs() {
        const objectives::Objective& more = *objectives::findObjective("success");
        const objectives::Objective& less = *objectives::findObjective("disorder");
        QVERIFY(more.moreIsBetter && !less.moreIsBetter);
        const std::vector<study::ScorePair> pairs = {{{0, 0}, 20, 0.5, 1.0},
                                                     {{0, 1}, 5, 1.0, 0.0},
                                                     {{1, 0}, 20, 0.9, 1.5},
                                                     {{1, 1}, 20, 0.4, 1.1},
                                                     {{1, 2}, 30, 0.1, 0.2}};
        QVERIFY((study::findParetoFront(pairs, more, less, 20) == std::vector<std::size_t>{2, 0, 4}));
        QVERIFY((study::findParetoFront(pairs, more, less, 1) == std::vector<std::size_t>{1}));
        QVERIFY((study::findParetoFront(pairs, more, more, 20) == std::vector<std::size_t>{2}));
    }

    void refusesAGenerationOutOfTurn() {
        sample::write(path_, 2);
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        QVERIFY(
            sample::messageOf(study->saveGeneration(sample::generation(1))).contains("has 2 generations"));
        QVERIFY(
            sample::messageOf(study->saveGeneration(sample::generation(3))).contains("has 2 generations"));
        QCOMPARE(study->generationCount().value(), 2);
        QVERIFY(sample::messageOf(study->loadGeneration(2)).contains("has 2 generations"));
        QVERIFY(sample::messageOf(study->loadIndividual({1, 6})).contains("no individual 6 of generation 1"));
    }

    // The newest of each individual, with every number, and nothing for one that is damaged.
    void keepsRobustness() {
        const auto resultOf = [](std::optional<trial::BoxPlace> place, int first, trial::Tally tally) {
            return study::PlaceResult{{place, first, tally.trials()}, tally, 0.1 / 3.0};
        };
        trial::BoxPlace corner = trial::kMiddle;
        corner[0] = 1.0 / 3.0;
        study::RobustnessRecord record{{3, 5}, "native", {}, {}};
        record.box.friction = 0.15;
        study::Robustness& robustness = record.robustness;
        robustness.nominal = resultOf(trial::kMiddle, 0, {99, 1, 0, 0});
        robustness.overBox = resultOf(std::nullopt, 0, {90, 4, 5, 1});
        robustness.sweeps = {
            {trial::Condition::halfStroke, {robustness.nominal, resultOf(corner, 0, {10, 0, 0, 0})}}};
        robustness.corners = {resultOf(corner, 100, {1, 2, 3, 4})};
        robustness.worstPair =
            study::PairMap{trial::Condition::friction, trial::Condition::halfStroke, 1, {robustness.nominal}};
        auto study = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
        VERIFY_OK(study);
        QVERIFY(study->loadRobustness().value().empty());
        study::RobustnessRecord older = record;
        older.engine = "simbody";
        older.robustness.worstPair.reset();
        VERIFY_OK(study->saveRobustness(older));
        older.individual = 6;
        VERIFY_OK(study->saveRobustness(older));
        VERIFY_OK(study->saveRobustness(record));
        const auto all = study->loadRobustness();
        VERIFY_OK(all);
        QCOMPARE(all->size(), std::size_t{2});
        const study::RobustnessRecord& back = all->front();
        QCOMPARE(back.generation, 3);
        QCOMPARE(back.individual, 5);
        QCOMPARE(back.engine, std::string("native"));
        QVERIFY(back.box == record.box);
        QCOMPARE(study::robustnessToJson(back.robustness), study::robustnessToJson(robustness));
        QVERIFY(back.robustness.corners.front().trials == robustness.corners.front().trials);
        QVERIFY(back.robustness.goal == robustness.goal);
        QVERIFY(!all->back().robustness.worstPair);
        for (const char* damaged : {"", "{}", "[1]", R"({"goal": 1})"})
            QVERIFY(!study::robustnessFromJson(damaged).ok());
        QVERIFY(study::robustnessFromJson(study::robustnessToJson(robustness)).ok());
        std::string negative = study::robustnessToJson(robustness);
        negative.replace(negative.find("[99,1,0,0]"), 10, "[99,-1,0,0]");
        QVERIFY(!study::robustnessFromJson(negative).ok());
    }

    // The newest of each individual, with the box that they varied over or none.
    void keepsStreams() {
        study::StreamsRecord record{{3, 5}, "native", study::Settings().box, {}};
        record.streams.results = {
            {30.0, 60.0, {{9, 8, 7, 1, 2, 0, 1, 1, 0.5}, {1, 1, 1, 0, 0, 0, 0, 0, 0.0}}, 4.0, 2.0, 1.0}};
        auto study = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
        VERIFY_OK(study);
        QVERIFY(study->loadStreams().value().empty());
        study::StreamsRecord older = record;
        older.box.reset();
        older.engine = "simbody";
        VERIFY_OK(study->saveStreams(older));
        older.individual = 6;
        VERIFY_OK(study->saveStreams(older));
        VERIFY_OK(study->saveStreams(record));
        const auto all = study->loadStreams();
        VERIFY_OK(all);
        QCOMPARE(all->size(), std::size_t{2});
        QCOMPARE(all->front().engine, std::string("native"));
        QVERIFY(all->front().box == record.box);
        QVERIFY(all->front().streams.results == record.streams.results);
        QVERIFY(!all->back().box && all->back().individual == 6);
    }

    void keepsSelectionsAndValidations() {
        {
            auto study = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
            VERIFY_OK(study);
            QVERIFY(study->loadSelections().value().empty());
            QVERIFY(study->loadValidations().value().empty());
            for (const double offset : {0.0, 0.25})
                VERIFY_OK(study->saveSelection(sampleSelection(offset)));
            for (const int generation : {7, 9})
                VERIFY_OK(study->saveValidation(sampleValidation(generation)));
        }
        const auto study = StudyFile::openReadOnly(path_);
        VERIFY_OK(study);
        const auto selections = study->loadSelections();
        const auto validations = study->loadValidations();
        VERIFY_OK(selections);
        VERIFY_OK(validations);
        QCOMPARE(selections->size(), std::size_t{2});
        QCOMPARE(validations->size(), std::size_t{2});
        for (std::size_t s = 0; s < 2; ++s) {
            const study::SelectionRecord expected = sampleSelection(s == 0 ? 0.0 : 0.25);
            const study::SelectionRecord& actual = (*selections)[s];
            QCOMPARE(actual.engine, expected.engine);
            QCOMPARE(actual.entries.size(), expected.entries.size());
            for (std::size_t i = 0; i < expected.entries.size(); ++i) {
                const study::SelectionEntry& a = actual.entries[i];
                const study::SelectionEntry& e = expected.entries[i];
                QCOMPARE(a.generation, e.generation);
                QCOMPARE(a.individual, e.individual);
                QVERIFY(a.fitness == e.fitness);
                QCOMPARE(a.trials, e.trials);
                QCOMPARE(a.finished, e.finished);
                QCOMPARE(a.oriented, e.oriented);
                QVERIFY(a.goal == e.goal);
                QCOMPARE(a.corners, e.corners);
            }
            const study::ValidationRecord expectedTable = sampleValidation(s == 0 ? 7 : 9);
            const study::ValidationRecord& table = (*validations)[s];
            QCOMPARE(table.generation, expectedTable.generation);
            QCOMPARE(table.individual, 3);
            QCOMPARE(table.engine, std::string("native"));
            QCOMPARE(table.tolerance, expectedTable.tolerance);
            QVERIFY(table.goal == expectedTable.goal);
            QCOMPARE(table.rows.size(), std::size_t{3});
            for (std::size_t i = 0; i < 3; ++i) {
                const study::ValidationRow& a = table.rows[i];
                const study::ValidationRow& e = expectedTable.rows[i];
                QCOMPARE(a.pose, e.pose);
                QVERIFY(a.tally == e.tally);
            }
        }
    }

    // What an older program judged by is the one orientation that it stored.
    void goalsOfVersion15AreOrientations() {
        {
            auto study = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
            VERIFY_OK(study);
            VERIFY_OK(study->saveSelection(sampleSelection(0.5)));
            VERIFY_OK(study->saveValidation(sampleValidation(9)));
        }
        sample::makeOld(path_, 15);
        QVERIFY(!StudyFile::openReadOnly(path_)->loadSettings().value().target.isSet());
        const auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        QVERIFY(!study->loadSettings().value().target.isSet());
        const auto goal = [](const trial::Goal& full) { return trial::makeGoal(full.shown()); };
        const study::SelectionRecord selection = study->loadSelections().value()[0];
        for (std::size_t i = 0; i < 3; ++i)
            QVERIFY(selection.entries[i].goal == goal(sampleSelection(0.5).entries[i].goal));
        QVERIFY(study->loadValidations().value()[0].goal == goal(sampleValidation(9).goal));
    }

    void readerSeesEachGenerationAsItIsSaved() {
        auto writer = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
        VERIFY_OK(writer);
        const auto reader = StudyFile::openReadOnly(path_);
        VERIFY_OK(reader);
        for (int i = 0; i < 20; ++i) {
            VERIFY_OK(writer->saveGeneration(sample::generation(i)));
            QCOMPARE(reader->generationCount().value(), i + 1);
            QVERIFY(sample::equal(reader->loadGeneration(i).value(), sample::generation(i)));
        }
        // The reader stays while writers go and come.
        *writer = StudyFile::openReadOnly(path_).value();
        auto second = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(second);
        VERIFY_OK(second->saveGeneration(sample::generation(20)));
        QCOMPARE(reader->generationCount().value(), 21);
    }

    void readerCannotWrite() {
        sample::write(path_, 1);
        auto reader = StudyFile::openReadOnly(path_);
        VERIFY_OK(reader);
        const QString refused = "open for reading only";
        QVERIFY(sample::messageOf(reader->saveGeneration(sample::generation(1))).contains(refused));
        QVERIFY(sample::messageOf(reader->saveSelection(sampleSelection(0))).contains(refused));
        QVERIFY(sample::messageOf(reader->saveValidation(sampleValidation(0))).contains(refused));
        QVERIFY(sample::messageOf(reader->changeSettings(sample::settings())).contains(refused));
    }

    void partIsReplacedUntilThereAreGenerations() {
        store::StoredPart other = sample::part();
        other.mesh.triangles.pop_back();
        other.options.name = "open";
        study::Settings settings = sample::settings();
        settings.part.file = "/parts/open.stl";
        {
            auto study = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
            VERIFY_OK(study);
            VERIFY_OK(study->changePart(other, settings));
        }
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        QVERIFY(study->loadSettings().value() == settings);
        QVERIFY(study->loadPart().value().mesh.triangles == other.mesh.triangles);
        QCOMPARE(study->loadPart().value().options.name, std::string("open"));
        VERIFY_OK(study->saveGeneration(sample::generation(0)));
        QVERIFY(sample::messageOf(study->changePart(sample::part(), settings)).contains("new study"));
        QCOMPARE(study->loadPart().value().options.name, std::string("open"));
        auto reader = StudyFile::openReadOnly(path_);
        VERIFY_OK(reader);
        QVERIFY(sample::messageOf(reader->changePart(other, settings)).contains("reading only"));
    }

    void copyHoldsAll() {
        sample::write(path_, 3);
        const std::filesystem::path other = path_.parent_path() / "copy.trap";
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        // Also what still is in the log.
        VERIFY_OK(study->saveGeneration(sample::generation(3)));
        VERIFY_OK(study->saveSelection(sampleSelection(0.5)));
        VERIFY_OK(study->copyTo(other));
        QVERIFY(sample::messageOf(study->copyTo(other)).contains("exists already"));
        QVERIFY(
            sample::messageOf(study->copyTo(path_.parent_path() / "none" / "a.trap")).contains("no folder"));
        auto copy = StudyFile::open(other, sample::kProgram);
        VERIFY_OK(copy);
        QVERIFY(copy->loadSettings().value() == sample::settings());
        for (int i = 0; i < 4; ++i)
            QVERIFY(sample::equal(copy->loadGeneration(i).value(), sample::generation(i)));
        QCOMPARE(copy->loadSelections().value().size(), std::size_t{1});
        VERIFY_OK(copy->saveGeneration(sample::generation(4)));
        QCOMPARE(study->generationCount().value(), 4);
    }

    void closingLeavesOneFile() {
        sample::write(path_, 3);
        QCOMPARE(filesIn(path_.parent_path()), std::set<std::string>{path_.filename().string()});
    }

    void onlyHarmlessSettingsChangeOnceThereAreGenerations() {
        auto study = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
        VERIFY_OK(study);
        study::Settings settings = sample::settings();
        settings.evolution.seed = 5;
        VERIFY_OK(study->changeSettings(settings));
        VERIFY_OK(study->saveGeneration(sample::generation(0)));

        settings.evolution.generations = 500;
        settings.validation.selectionWinners = 30;
        VERIFY_OK(study->changeSettings(settings));
        QVERIFY(study->loadSettings().value() == settings);

        study::Settings other = settings;
        other.evolution.seed = 6;
        QVERIFY(sample::messageOf(study->changeSettings(other)).contains("make a new study"));
        other = settings;
        other.simulation.contact.restitution = 0.31;
        QVERIFY(!study->changeSettings(other).ok());
        QVERIFY(study->loadSettings().value() == settings);
    }

 private:
    std::optional<QTemporaryDir> folder_;
    std::filesystem::path path_;
};

QTEST_APPLESS_MAIN(StudyFileTest)
#include "study_file_test.moc"
