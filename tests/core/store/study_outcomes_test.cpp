#include <QTemporaryDir>
#include <QtTest>
#include <optional>

#include "core/store/study_file.h"
#include "core/trial/outcome_codec.h"
#include "old_study.h"
#include "sample_study.h"
#include "stored_outcomes.h"

using namespace trapwright;
using store::StudyFile;

namespace {

const trial::OutcomeMaker kMaker{"", "native", "AVX3"};

std::vector<trial::Outcome> outcomes(std::size_t count, std::uint32_t seed) {
    base::Random random({.seed = 3, .generation = seed});
    std::vector<trial::Outcome> all(count);
    for (trial::Outcome& one : all) {
        trial::PartOutcome& outcome = one.parts.emplace_back();
        outcome.ending = static_cast<trial::Ending>(random.below(4));
        outcome.time = 2e-4 * random.below(50000);
        outcome.farthest = {random.rotation(), {random.uniform(), random.uniform(), random.uniform()}};
    }
    return all;
}

/// With the trials of all its individuals, of different numbers, some of which were not simulated.
study::GenerationRecord generation(int index) {
    study::GenerationRecord record = sample::generation(index);
    record.individuals[0].trials = 0;
    record.individuals[3].trials = 0;
    for (study::IndividualRecord& individual : record.individuals) {
        individual.oriented.reset();
        individual.finished = individual.fellOff = individual.stuck = 0;
    }
    std::size_t trials = 0;
    for (const study::IndividualRecord& individual : record.individuals)
        trials += static_cast<std::size_t>(individual.trials);
    record.made = {kMaker, outcomes(trials, static_cast<std::uint32_t>(index))};
    return record;
}

/// These trials of what was made.
bool hold(const base::Result<std::optional<store::PackedOutcomes>>& packed, const trial::MadeOutcomes& made,
          std::size_t first, std::size_t count) {
    if (!packed || !*packed || (*packed)->count != count) return false;
    const auto read = store::unpack(**packed);
    if (!read || read->size() != count) return false;
    for (std::size_t i = 0; i < count; ++i)
        if (!trial::endAlike((*read)[i].parts.at(0), made.outcomes[first + i].parts.at(0))) return false;
    return true;
}

}  // namespace

class StudyOutcomesTest : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_.emplace();
        path_ = std::filesystem::path(folder_->path().toStdString()) / "study.trap";
    }

    void everyIndividualHasItsOwn() {
        {
            auto study = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
            VERIFY_OK(study);
            for (int index = 0; index < 2; ++index)
                VERIFY_OK(study->saveGeneration(generation(index)));
        }
        const auto study = StudyFile::openReadOnly(path_);
        VERIFY_OK(study);
        for (int index = 0; index < 2; ++index) {
            const study::GenerationRecord record = generation(index);
            std::size_t first = 0;
            for (int i = 0; i < 6; ++i) {
                const auto count =
                    static_cast<std::size_t>(record.individuals[static_cast<std::size_t>(i)].trials);
                const auto packed = study->loadLearningOutcomes({index, i});
                VERIFY_OK(packed);
                QCOMPARE(packed->has_value(), count > 0);
                if (count == 0) continue;
                QVERIFY(hold(packed, record.made, first, count));
                QVERIFY(((*packed)->maker ==
                         trial::OutcomeMaker{sample::kProgram, kMaker.engine, kMaker.instructionSet}));
                first += count;
            }
            // Whoever reads the individuals does not read these.
            QVERIFY(study->loadGeneration(index).value().made.outcomes.empty());
        }
        VERIFY_OK(study->loadLearningOutcomes({2, 0}));
        QVERIFY(!study->loadLearningOutcomes({2, 0}).value());
        QVERIFY(!study->loadLearningOutcomes({0, 6}).value());
    }

    /// More than are packed together, so that individuals, ranks and poses lie in several pieces.
    void manyTrialsAreInPieces() {
        auto study = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
        VERIFY_OK(study);
        const int most = static_cast<int>(trial::kMostPacked);
        const std::vector<int> counts = {most - 1, 2, most + 5, 3 * most};
        std::vector<std::size_t> firsts;
        std::size_t all = 0;
        study::SelectionRecord selection{"native", {}};
        study::ValidationRecord validation;
        validation.engine = "native";
        for (const int count : counts) {
            firsts.push_back(all);
            all += static_cast<std::size_t>(count);
            study::SelectionEntry entry;
            entry.trials = count;
            selection.entries.push_back(entry);
            // Not all poses were tried.
            validation.rows.push_back({static_cast<int>(2 * firsts.size()), {count, 0, 0, 0}});
        }
        selection.made = {kMaker, outcomes(all, 1)};
        validation.made = {{"", "simbody", "FMA"}, outcomes(all, 2)};
        for (int number = 0; number < 2; ++number) {
            VERIFY_OK(study->saveSelection(selection));
            VERIFY_OK(study->saveValidation(validation));
        }
        for (int i = 0; i < 4; ++i) {
            const auto first = firsts[static_cast<std::size_t>(i)];
            const auto count = static_cast<std::size_t>(counts[static_cast<std::size_t>(i)]);
            QVERIFY(hold(study->loadSelectionOutcomes(1, i), selection.made, first, count));
            const auto pose = study->loadValidationOutcomes(1, 2 * (i + 1));
            QVERIFY(hold(pose, validation.made, first, count));
            QCOMPARE((*pose)->maker.engine, std::string("simbody"));
        }
        QVERIFY(!study->loadValidationOutcomes(1, 3).value());
        QVERIFY(!study->loadSelectionOutcomes(2, 0).value());
    }

    void whatHasNoneIsSavedAsWell() {
        auto study = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
        VERIFY_OK(study);
        VERIFY_OK(study->saveGeneration(sample::generation(0)));
        QVERIFY(!study->loadLearningOutcomes({0, 0}).value());
    }

    void olderStudiesHaveNone() {
        {
            auto study = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
            VERIFY_OK(study);
            VERIFY_OK(study->saveGeneration(generation(0)));
        }
        sample::makeOld(path_, 7);
        auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        for (int i = 0; i < 6; ++i)
            QVERIFY(!study->loadLearningOutcomes({0, i}).value());
        // What is learned from now on has some.
        const study::GenerationRecord next = generation(1);
        VERIFY_OK(study->saveGeneration(next));
        QVERIFY(hold(study->loadLearningOutcomes({1, 1}), next.made, 0,
                     static_cast<std::size_t>(next.individuals[1].trials)));
    }

    void aCopyHasThemToo() {
        const study::GenerationRecord record = generation(0);
        auto study = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
        VERIFY_OK(study);
        VERIFY_OK(study->saveGeneration(record));
        const std::filesystem::path copied = path_.parent_path() / "copy.trap";
        VERIFY_OK(study->copyTo(copied));
        const auto copy = StudyFile::openReadOnly(copied);
        VERIFY_OK(copy);
        QVERIFY(hold(copy->loadLearningOutcomes({0, 1}), record.made, 0,
                     static_cast<std::size_t>(record.individuals[1].trials)));
    }

    void damageIsAnErrorWithAdvice_data() {
        QTest::addColumn<QString>("damage");
        QTest::newRow("cut off") << "UPDATE outcomes SET trials = substr(trials, 1, length(trials) - 3)";
        QTest::newRow("emptied") << "UPDATE outcomes SET trials = x''";
        QTest::newRow("something else") << "UPDATE outcomes SET trials = x'0103ffffffffffffffffffffffff'";
        QTest::newRow("a byte changed") << "UPDATE outcomes SET trials = CAST(substr(trials, 1, 200) || "
                                           "x'5a5a' || substr(trials, 203) AS BLOB)";
        QTest::newRow("no number") << "UPDATE outcomes SET count = 'many'";
        QTest::newRow("too few") << "UPDATE outcomes SET count = 3";
        QTest::newRow("too many") << "UPDATE outcomes SET count = 4000000000";
        QTest::newRow("less than none") << "UPDATE outcomes SET count = -9";
        QTest::newRow("elsewhere") << "UPDATE outcomes SET first = 1000";
        QTest::newRow("before the beginning") << "UPDATE outcomes SET first = -5";
        QTest::newRow("of nobody") << "UPDATE outcomes SET maker = 7";
        QTest::newRow("other counts") << "UPDATE individual SET trials = trials + 100 WHERE number = 1";
        QTest::newRow("counts below zero") << "UPDATE individual SET trials = -100 WHERE number < 2";
    }
    void damageIsAnErrorWithAdvice() {
        QFETCH(QString, damage);
        {
            auto study = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
            VERIFY_OK(study);
            VERIFY_OK(study->saveGeneration(generation(0)));
        }
        sample::alter(path_, damage.toStdString());
        const auto study = StudyFile::openReadOnly(path_);
        VERIFY_OK(study);
        int damaged = 0;
        for (int i = 0; i < 6; ++i) {
            const auto packed = study->loadLearningOutcomes({0, i});
            if (packed && !*packed) continue;
            const auto read = packed ? store::unpack(**packed) : packed.error();
            if (read) continue;
            ++damaged;
            QVERIFY(read.error().kind == base::ErrorKind::damaged);
            const QString message = sample::messageOf(read);
            QVERIFY2(message.contains("study.trap is damaged") && message.contains("from a copy"),
                     qPrintable(message));
        }
        QVERIFY(damaged > 0);
    }

    /// How a person would forge or spoil one.
    void poseThatIsNoNumberIsDamage() {
        {
            auto study = StudyFile::create(path_, sample::settings(), sample::part(), sample::kProgram);
            VERIFY_OK(study);
            VERIFY_OK(study->saveGeneration(generation(0)));
        }
        sample::changeOutcomes(path_, 0, [](std::size_t trial, trial::PartOutcome& outcome) {
            if (trial == 2) outcome.farthest.position.y() = std::nan("");
        });
        const auto study = StudyFile::openReadOnly(path_);
        VERIFY_OK(study);
        const auto packed = study->loadLearningOutcomes({0, 1});
        VERIFY_OK(packed);
        QVERIFY(!store::unpack(**packed).ok());
    }

 private:
    std::optional<QTemporaryDir> folder_;
    std::filesystem::path path_;
};

QTEST_APPLESS_MAIN(StudyOutcomesTest)
#include "study_outcomes_test.moc"
