#include "core/store/compare.h"

#include <QTemporaryDir>
#include <QtTest>

#include "sample_study.h"

using namespace trapwright;
using store::StudyFile;

using Change = void (*)(study::GenerationRecord&);
Q_DECLARE_METATYPE(Change)

class CompareTest : public QObject {
    Q_OBJECT

 private slots:
    void findsTheFirstDifference_data() {
        QTest::addColumn<Change>("change");
        QTest::addColumn<QString>("expected");
        const auto row = [](const char* name, Change change, const char* expected) {
            QTest::newRow(name) << change << QString(expected);
        };
        row(
            "none", [](study::GenerationRecord&) {}, "");
        row(
            "wall time", [](study::GenerationRecord& g) { g.seconds += 1; }, "");
        row(
            "one step of a number",
            [](study::GenerationRecord& g) {
                g.individuals[4].design[59] = 1.0 - g.individuals[4].design[59];
            },
            "generation 1, individual 4: the designs differ");
        row(
            "a trait",
            [](study::GenerationRecord& g) {
                g.individuals[4].traits[2].value = std::nextafter(g.individuals[4].traits[2].value, 9.0);
            },
            "generation 1, individual 4: the designs differ");
        row(
            "a curve", [](study::GenerationRecord& g) { g.statistics.curves[1].value = 0.5; },
            "generation 1: the winner or the statistics differ");
        row(
            "last bit of a score",
            [](study::GenerationRecord& g) {
                double& distance = g.individuals[2].fitness.scores[1].value;
                distance = std::nextafter(distance, 9.0);
            },
            "generation 1, individual 2: the scores differ");
        row(
            "a count", [](study::GenerationRecord& g) { ++g.individuals[5].stuck; },
            "generation 1, individual 5: the scores differ");
        row(
            "success", [](study::GenerationRecord& g) { g.individuals[3].oriented = 9; },
            "generation 1, individual 3: the scores differ");
        row(
            "the winner", [](study::GenerationRecord& g) { g.winner = (g.winner + 1) % 6; },
            "generation 1: the winner or the statistics differ");
        row(
            "population", [](study::GenerationRecord& g) { g.individuals.push_back(g.individuals[0]); },
            "generation 1 has 6 individuals in one and 7 in the other");
    }
    void findsTheFirstDifference() {
        QFETCH(Change, change);
        QFETCH(QString, expected);
        const QTemporaryDir folder;
        const std::filesystem::path path = folder.path().toStdString();
        sample::write(path / "a.trap", 3);
        auto b = StudyFile::create(path / "b.trap", sample::settings(), sample::part(), sample::kProgram);
        VERIFY_OK(b);
        for (int i = 0; i < 3; ++i) {
            study::GenerationRecord record = sample::generation(i);
            if (i == 1) change(record);
            VERIFY_OK(b->saveGeneration(record));
        }
        const auto a = StudyFile::openReadOnly(path / "a.trap");
        VERIFY_OK(a);
        const auto difference = store::findDifference(*a, *b);
        VERIFY_OK(difference);
        QCOMPARE(QString::fromStdString(*difference), expected);

        // The dumps agree exactly when designs and scores do.
        std::string dumpA;
        std::string dumpB;
        VERIFY_OK(store::dumpIndividuals(*a, [&](std::string_view lines) { dumpA += lines; }));
        VERIFY_OK(store::dumpIndividuals(*b, [&](std::string_view lines) { dumpB += lines; }));
        QCOMPARE(std::count(dumpA.begin(), dumpA.end(), '\n'), 18);
        QCOMPARE(dumpA == dumpB, expected.isEmpty() || expected.contains("winner"));
    }

    /// A study that was begun before success was counted is still the same study.
    void successCountsWhereBothHaveIt() {
        const QTemporaryDir folder;
        const std::filesystem::path path = folder.path().toStdString();
        sample::write(path / "a.trap", 2);
        auto b = StudyFile::create(path / "b.trap", sample::settings(), sample::part(), sample::kProgram);
        VERIFY_OK(b);
        VERIFY_OK(b->saveGeneration(sample::generationWithoutSuccess(0)));
        VERIFY_OK(b->saveGeneration(sample::generation(1)));
        const auto a = StudyFile::openReadOnly(path / "a.trap");
        VERIFY_OK(a);
        QCOMPARE(store::findDifference(*a, *b).value(), std::string());
        QCOMPARE(store::findDifference(*b, *a).value(), std::string());
        std::string dump;
        VERIFY_OK(store::dumpIndividuals(*b, [&](std::string_view lines) { dump += lines; }));
        QVERIFY(dump.substr(0, dump.find('\n')).ends_with(" -"));
        QVERIFY(!dump.ends_with(" -\n"));
    }

    void oneMayBeLonger() {
        const QTemporaryDir folder;
        const std::filesystem::path path = folder.path().toStdString();
        sample::write(path / "a.trap", 3);
        sample::write(path / "b.trap", 2);
        const auto difference = store::findDifference(StudyFile::openReadOnly(path / "a.trap").value(),
                                                      StudyFile::openReadOnly(path / "b.trap").value());
        QCOMPARE(difference.value(), std::string("one has 3 generations, the other 2"));
    }
};

QTEST_APPLESS_MAIN(CompareTest)
#include "compare_test.moc"
