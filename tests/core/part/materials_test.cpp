#include "core/part/materials.h"

#include <QTemporaryDir>
#include <QTest>
#include <fstream>

#include "core/base/file.h"

using namespace trapwright;

namespace {

constexpr const char* kGood = R"({
  "format": "trapwright material", "version": 1, "name": "nut", "material": "nut shell",
  "density_kg_m3": { "value": 1300, "spread": 50, "source": "weighed" },
  "pairs": [ { "surface": "cork",
    "staticFriction": { "value": 0.62, "spread": 0.04, "source": "slid down a slope, 20 times" },
    "kineticFriction": { "value": 0.5, "source": "assumed" },
    "restitution": { "value": 0.1, "source": "assumed" } } ] })";

std::string replaced(std::string text, const std::string& before, const std::string& after) {
    const std::size_t at = text.find(before);
    return at == std::string::npos ? text : text.replace(at, before.size(), after);
}

}  // namespace

class MaterialsTest : public QObject {
    Q_OBJECT

    QTemporaryDir folder_;
    std::filesystem::path own_;

    void write(const char* file, const std::string& text) const { std::ofstream(own_ / file) << text; }

 private slots:
    void init() {
        own_ = std::filesystem::path(folder_.path().toStdString()) / QTest::currentTestFunction();
        std::filesystem::create_directories(own_);
    }

    // Handbook values that the files must not lose: EN 1991-1-1, EN 12164, and Marks' table of friction.
    void bundledOnesTellValuesAndSources() {
        const part::MaterialLibrary library = part::readMaterials();
        QVERIFY2(library.problems.empty(), library.problems.empty() ? "" : library.problems[0].c_str());
        QVERIFY(library.materials.size() >= 12);
        QCOMPARE(part::findMaterial(library, "abs")->density.value, 1040.0);
        QCOMPARE(part::findMaterial(library, "Brass")->density.value, 8500.0);
        QVERIFY(part::findMaterial(library, "unobtainium") == nullptr);
        const part::MaterialPair* steel = part::findPair(library, "aluminium", "steel sheet");
        QVERIFY(steel != nullptr);
        QCOMPARE(steel->staticFriction.value, 0.61);
        QCOMPARE(steel->kineticFriction.value, 0.47);
        QVERIFY(part::describeSources(*steel).find("Marks") != std::string::npos);
        for (const part::MaterialPair& pair : library.pairs) {
            QVERIFY2(part::findProblems(pair).empty(), pair.name.c_str());
            QVERIFY2(pair.staticFriction.spread > 0.0 && pair.restitution.spread > 0.0, pair.name.c_str());
            QVERIFY(!pair.own && pair.density.value > 500.0);
        }
        // Every part material on every surface that any has.
        for (const part::Material& material : library.materials)
            for (const char* surface : {"printed PLA", "printed ABS", "printed PETG", "SLA resin",
                                        "steel sheet", "brushed stainless sheet", "polyurethane coating"})
                QVERIFY2(part::findPair(library, material.name, surface) != nullptr, material.name.c_str());
    }

    void pairsAreFoundByName() {
        const part::MaterialLibrary library = part::readMaterials();
        const auto* pair = part::findPair(library, "ABS-on-printed-PLASTIC");
        QVERIFY(pair != nullptr);
        QCOMPARE(part::pairTitle(*pair), std::string("ABS on printed plastic"));
        QCOMPARE(part::findPair(library, "abs", "printed-plastic"), pair);
        const auto none = part::requirePair(library, "glass");
        QVERIFY(none.error().message.find("\"brass-on-printed-plastic\"") != std::string::npos);
    }

    void badFilesAreTold_data() {
        QTest::addColumn<QString>("before");
        QTest::addColumn<QString>("after");
        QTest::addColumn<QString>("told");
        QTest::newRow("no JSON") << "1300,"
                                 << "1300 \""
                                 << "line 3";
        QTest::newRow("another format") << "trapwright material"
                                        << "trapwright drive"
                                        << "at \"format\"";
        QTest::newRow("a later version") << "\"version\": 1"
                                         << "\"version\": 2"
                                         << "at \"version\"";
        QTest::newRow("another name") << "\"name\": \"nut\""
                                      << "\"name\": \"bolt\""
                                      << "rename one of them";
        QTest::newRow("friction out of range")
            << "0.62"
            << "6.2"
            << "at \"pairs[0].staticFriction.value\": 6.2 is not within 0 and 2";
        QTest::newRow("friction is a text") << "0.62"
                                            << "\"much\""
                                            << "is no number";
        QTest::newRow("kinetic above static") << "0.62"
                                              << "0.4"
                                              << "above the static friction";
        QTest::newRow("no density") << "density_kg_m3"
                                    << "densiti"
                                    << "at \"density_kg_m3\": this is missing";
        QTest::newRow("no source told") << "\"weighed\""
                                        << "\"\""
                                        << "at \"density_kg_m3.source\"";
        QTest::newRow("no value") << "\"value\": 0.1, "
                                  << ""
                                  << "restitution.value\": this is missing";
        QTest::newRow("unknown key") << "\"surface\""
                                     << "\"surfaces\": 1, \"surface\""
                                     << "nobody knows";
        QTest::newRow("pairs are no list") << "[ {"
                                           << "{ \"a\": {"
                                           << "JSON";
    }

    void badFilesAreTold() {
        QFETCH(QString, before);
        QFETCH(QString, after);
        QFETCH(QString, told);
        write("nut.json", replaced(kGood, before.toStdString(), after.toStdString()));
        // A good neighbour stays to be seen.
        write("shell.json", replaced(replaced(kGood, "\"nut\"", "\"shell\""), "cork", "felt"));
        const part::MaterialLibrary library = part::readMaterials(own_);
        QCOMPARE(library.problems.size(), std::size_t{1});
        const QString problem = QString::fromStdString(library.problems[0]);
        QVERIFY2(problem.contains("nut.json") && problem.contains(told), qPrintable(problem));
        QVERIFY(part::findPair(library, "nut shell", "felt") != nullptr);
        QVERIFY(part::findPair(library, "nut shell", "cork") == nullptr);
        QVERIFY(part::findPair(library, "ABS", "printed plastic") != nullptr);
    }

    void ownPairsCountAndAreKept() {
        part::MaterialPair pair = *part::findPair(part::readMaterials(), "ABS", "printed plastic");
        pair.staticFriction = {0.41, 0.03, "measured on our slope"};
        pair.kineticFriction = {0.33, 0.02, "measured on our slope"};
        QVERIFY(part::savePair(own_, pair).ok());
        part::MaterialLibrary library = part::readMaterials(own_);
        const part::MaterialPair kept = *part::findPair(library, "ABS", "printed plastic");
        QVERIFY(kept.own);
        QCOMPARE(kept.staticFriction, pair.staticFriction);
        QCOMPARE(kept.restitution, pair.restitution);
        QCOMPARE(kept.density, pair.density);

        // Once more under the same name is refused; an edit goes to the same file.
        QVERIFY(part::savePair(own_, pair).error().message.find("already") != std::string::npos);
        part::MaterialPair edited = kept;
        edited.surface = "our printed plastic";
        QVERIFY(part::savePair(own_, edited, kept).ok());
        library = part::readMaterials(own_);
        QVERIFY(library.problems.empty());
        QVERIFY(!part::findPair(library, "ABS", "printed plastic")->own);
        const auto* moved = part::findPair(library, "ABS", "our printed plastic");
        QVERIFY(moved != nullptr && moved->file == kept.file);

        QVERIFY(part::removePair(*moved).ok());
        QVERIFY(!std::filesystem::exists(kept.file));
        QVERIFY(part::findPair(part::readMaterials(own_), "ABS", "our printed plastic") == nullptr);
    }

    void wrongPairIsNotSaved() {
        part::MaterialPair pair = *part::findPair(part::readMaterials(), "ABS", "printed plastic");
        pair.kineticFriction.value = 0.9;
        pair.restitution.value = 1.5;
        pair.surface = " ";
        const auto saved = part::savePair(own_, pair);
        QVERIFY(!saved.ok());
        for (const char* told : {"above the static", "restitution is 1.5", "surface has no name"})
            QVERIFY2(saved.error().message.find(told) != std::string::npos, saved.error().message.c_str());
        QVERIFY(std::filesystem::is_empty(own_));
        pair = *part::findPair(part::readMaterials(), "ABS", "printed plastic");
        write("blocked", "a file, not a folder");
        const auto blocked = part::savePair(own_ / "blocked", pair);
        QVERIFY(!blocked.ok() && blocked.error().message.find("blocked") != std::string::npos);
    }

    void filesAreImported() {
        const std::filesystem::path elsewhere = own_ / "elsewhere";
        std::filesystem::create_directories(elsewhere);
        std::ofstream(elsewhere / "nut.json") << kGood;
        std::ofstream(elsewhere / "bad.json") << "{";
        const auto pairs = part::importPairs(elsewhere / "nut.json", own_);
        QVERIFY2(pairs.ok(), pairs ? "" : pairs.error().message.c_str());
        QCOMPARE(pairs->front().name, std::string("nut-shell-on-cork"));
        QCOMPARE(part::findPair(part::readMaterials(own_), "nut-shell-on-cork")->staticFriction.source,
                 std::string("slid down a slope, 20 times"));
        QVERIFY(!part::importPairs(elsewhere / "nut.json", own_).ok());
        QVERIFY(part::importPairs(elsewhere / "nut.json", own_, true).ok());
        const auto bad = part::importPairs(elsewhere / "bad.json", own_);
        QVERIFY(!bad.ok() && bad.error().message.find("bad.json") != std::string::npos);
        QVERIFY(!part::importPairs(elsewhere / "none.json", own_).ok());
    }
};

QTEST_GUILESS_MAIN(MaterialsTest)
#include "materials_test.moc"
