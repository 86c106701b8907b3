// A file that a program of schema version 7, which kept genes, has really written.

#include <SQLiteCpp/SQLiteCpp.h>

#include <QCryptographicHash>
#include <QTemporaryDir>
#include <QtTest>
#include <fstream>
#include <sstream>

#include "core/search/ga/genes.h"
#include "core/store/study_file.h"
#include "core/study/track_design.h"
#include "sample_study.h"

using namespace trapwright;
using store::StudyFile;

namespace {

std::string contentOf(const char* file) {
    std::ostringstream content;
    content << std::ifstream(file).rdbuf();
    return content.str();
}

QByteArray hashOf(const std::string& text) {
    return QCryptographicHash::hash(QByteArray::fromStdString(text), QCryptographicHash::Sha256)
        .toHex()
        .left(16);
}

}  // namespace

class StudyOfVersion7Test : public QObject {
    Q_OBJECT

 private slots:
    void init() {
        folder_.emplace();
        path_ = std::filesystem::path(folder_->path().toStdString()) / "old.trap";
        SQLite::Database(path_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
            .exec(contentOf(TRAPWRIGHT_OLD_STUDY));
    }

    void everythingIsStillThere_data() {
        QTest::addColumn<bool>("isRead");
        QTest::newRow("for reading, which leaves it as it is") << true;
        QTest::newRow("for writing, which brings it up to date") << false;
    }
    void everythingIsStillThere() {
        QFETCH(bool, isRead);
        const std::string before = contentOf(path_.c_str());
        const auto study = isRead ? StudyFile::openReadOnly(path_) : StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        QCOMPARE(study->generationCount().value(), 3);
        QVERIFY(study->loadSettings().value().evolution.search == search::Method::genetic);
        // The designs are those of the genes, the strategy values as the old program printed them.
        std::string designs;
        for (int index = 0; index < 3; ++index) {
            const auto generation = study->loadGeneration(index);
            VERIFY_OK(generation);
            QCOMPARE(generation->individuals.size(), std::size_t{4});
            for (const study::IndividualRecord& individual : generation->individuals) {
                QCOMPARE(individual.traits.size(), std::size_t{3});
                QVERIFY(study::decodeTrack(study->loadSettings()->track, individual.design).ok());
                designs += search::packDesign(individual.design);
            }
        }
        QCOMPARE(designs.size(), std::size_t{12 * (5 + 107)});
        const auto summaries = study->loadSummaries();
        VERIFY_OK(summaries);
        const std::vector<std::array<double, 3>> printed = {
            {{0.2202, 0.4725, 0.2105}, {0.5181, 0.5948, 0.1923}, {0.1932, 0.2665, 0.2474}}};
        for (std::size_t g = 0; g < 3; ++g) {
            const auto& curves = (*summaries)[g].statistics.curves;
            QCOMPARE(curves.size(), std::size_t{3});
            for (std::size_t k = 0; k < 3; ++k) {
                QCOMPARE(curves[k].key, search::describeMethod(search::Method::genetic).curves[k].key);
                QVERIFY(std::abs(curves[k].value - printed[g][k]) <= 0.5e-4);
            }
        }
        if (isRead) QVERIFY(contentOf(path_.c_str()) == before);
        // Generation 0 is the one that its seed gives.
        const auto settings = study->loadSettings().value();
        const auto first = study::makeSearch(settings)->ask();
        const auto stored = study->loadGeneration(0).value().individuals;
        for (std::size_t i = 0; i < first.size(); ++i)
            QVERIFY(first[i].design == stored[i].design && first[i].traits == stored[i].traits);
    }

    void outcomesAreNotKnown() {
        const auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        for (int i = 0; i < 4; ++i)
            QVERIFY(!study->loadLearningOutcomes({2, i}).value());
    }

    /// The next generation is that which the old program had.
    void learningGoesOnAsItWouldHave() {
        const auto study = StudyFile::open(path_, sample::kProgram);
        VERIFY_OK(study);
        const auto state = study->loadLearningState();
        VERIFY_OK(state);
        QCOMPARE(state->value().index, 2);
        const auto search = study::makeSearch(study->loadSettings().value());
        const auto loaded = search->load(state->value().search);
        QVERIFY2(loaded.ok(), loaded.ok() ? "" : loaded.error().message.c_str());
        std::string genes;
        const search::DesignSpace space = study::designSpace(study->loadSettings()->track);
        for (const search::Proposal& proposal : search->ask()) {
            search::ga::Chromosome chromosome;
            search::ga::encodeDesign(proposal.design, space, chromosome);
            genes += search::ga::packBits(chromosome.points) + search::ga::packBits(chromosome.singles);
        }
        QCOMPARE(hashOf(genes), QByteArray("4d82e41d3628b0fa"));
    }

    void genesThatAreNoneAreDamage_data() {
        QTest::addColumn<QString>("damage");
        QTest::newRow("cut off") << "UPDATE individual SET points = x'20030000ff' WHERE number = 2";
        QTest::newRow("no numbers of 10 bits")
            << "UPDATE individual SET lengths = x'0300000007' WHERE number = 0";
        QTest::newRow("no strategy") << "UPDATE individual SET strategy = x'' WHERE generation = 1";
        QTest::newRow("no settings") << "UPDATE study SET settings = '{\"evolution\": 3}'";
    }
    void genesThatAreNoneAreDamage() {
        QFETCH(QString, damage);
        SQLite::Database(path_.string(), SQLite::OPEN_READWRITE).exec(damage.toStdString());
        const auto study = StudyFile::open(path_, sample::kProgram);
        QVERIFY(!study.ok());
        QVERIFY2(study.error().kind == base::ErrorKind::damaged, study.error().message.c_str());
        // And left as it was.
        SQLite::Database database(path_.string(), SQLite::OPEN_READONLY);
        QCOMPARE(database.execAndGet("PRAGMA user_version").getInt(), 7);
        QCOMPARE(
            database.execAndGet("SELECT count(*) FROM pragma_table_info('individual') WHERE name = 'points'")
                .getInt(),
            1);
    }

 private:
    std::optional<QTemporaryDir> folder_;
    std::filesystem::path path_;
};

QTEST_APPLESS_MAIN(StudyOfVersion7Test)
#include "study_of_version_7_test.moc"
