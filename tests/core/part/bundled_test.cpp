#include "core/part/bundled.h"

#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <string_view>

#include "core/base/file.h"
#include "core/geometry/mesh_files.h"
#include "core/part/cad_export.h"
#include "core/part/import.h"
#include "core/part/materials.h"
#include "core/part/part_builder.h"
#include "tests/core/part/centred_solid.h"

using namespace trapwright;

class BundledTest : public QObject {
    Q_OBJECT

    QTemporaryDir folder_;

    void addParts() {
        QTest::addColumn<QString>("name");
        for (const part::BundledPart& entry : part::listBundledParts()) {
            const QString name = QString::fromUtf8(entry.name.data());
            QTest::newRow(qPrintable(name)) << name;
        }
    }

 private slots:
    void initTestCase() { qunsetenv("TRAPWRIGHT_RESOURCES"); }

    void filesAreTheGenerators_data() { addParts(); }

    void filesAreTheGenerators() {
        QFETCH(QString, name);
        const auto entry = part::findBundledPart(name.toStdString());
        QVERIFY(entry.ok());
        const std::filesystem::path made = folder_.filePath(name + ".stl").toStdString();
        QVERIFY(geometry::writeStl(made, part::makeBundledShape(entry->name)).ok());
        const auto expected = base::readFile(made);
        const auto committed = base::readFile(part::findBundledFile(*entry));
        QVERIFY(expected.ok() && committed.ok());
        QVERIFY2(*expected == *committed, "run generate_parts resources/parts");
    }

    void partsCanBeImported_data() { addParts(); }

    void partsCanBeImported() {
        QFETCH(QString, name);
        const auto entry = part::findBundledPart(name.toStdString());
        QVERIFY(entry.ok());
        QVERIFY(part::findMaterial(part::readMaterials(), entry->material) != nullptr);
        const auto imported = part::importMesh(part::findBundledFile(*entry));
        QVERIFY(imported.ok());
        const double expected = geometry::calcMassProperties(part::makeBundledShape(entry->name), 1.0).volume;
        QVERIFY(expected > 0.0);
        QVERIFY(std::abs(geometry::calcMassProperties(imported->mesh, 1.0).volume / expected - 1.0) < 1e-6);
    }

    /// The hull of a turned part has a face per facet and conical surface, and two ends.
    void hullsOfTurnedParts_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<int>("faces");
        QTest::newRow("cone") << "cone" << 66;
        QTest::newRow("pin") << "pin" << 66;
        QTest::newRow("cup") << "cup" << 34;
    }

    void hullsOfTurnedParts() {
        QFETCH(QString, name);
        QFETCH(int, faces);
        const part::CentredSolid solid(part::makeBundledShape(name.toStdString()));
        QCOMPARE(static_cast<int>(solid.hull.faces.size()), faces);
    }

    /// Across another program's kernel: the STEP file is the same solid as the STL file.
    void stepBracketIsTheStlBracket() {
        const std::filesystem::path file =
            std::filesystem::path(TRAPWRIGHT_SOURCE_DIR) / "resources/parts" / part::kBracketStepFile;
        const auto imported = part::importMesh(file);
        QVERIFY2(imported.ok(), imported ? "" : imported.error().message.c_str());
        QVERIFY(imported->unitsFromFile);
        QCOMPARE(imported->units, std::string("mm"));
        const auto step = geometry::calcMassProperties(imported->mesh, 1000.0);
        const auto stl = geometry::calcMassProperties(part::makeBundledShape("bracket"), 1000.0);
        QVERIFY(std::abs(step.volume / stl.volume - 1.0) < 1e-9);
        QVERIFY((step.centre - stl.centre).norm() < 1e-9);
        QVERIFY((step.inertia - stl.inertia).norm() < 1e-9 * stl.inertia.norm());
    }

    /// Up to the header, in which another version of OpenCASCADE names itself.
    void stepFileIsTheGenerators() {
        const std::filesystem::path made = folder_.filePath("bracket.step").toStdString();
        QVERIFY(part::writeStepPrism(made, part::bracketProfile(), part::bracketWidth()).ok());
        const auto imported = part::importMesh(made);
        QVERIFY(imported.ok());
        QVERIFY(std::abs(geometry::calcMassProperties(imported->mesh, 1.0).volume - 390e-9) < 1e-15);
        const auto failed =
            part::writeStepPrism("/nowhere/a.step", part::bracketProfile(), part::bracketWidth());
        QVERIFY(!failed.ok());
        QVERIFY(failed.error().message.find("/nowhere/a.step") != std::string::npos);
    }

    /// Volumes in closed form: prisms with so many facets for a circle.
    void partsWithoutSymmetryAreWhatTheyAreCalled_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<double>("volume");  // [mm^3]
        const auto disc = [](double diameter) {
            return 32.0 / 2.0 * std::sin(2.0 * base::kPi / 32.0) * diameter * diameter / 4.0;
        };
        QTest::newRow("clip") << "clip" << (8.0 * 1.5 + 1.5 * 6.5 + 3.5 * 1.5) * 6.0;
        QTest::newRow("wedge") << "wedge" << 12.0 * 7.0 / 2.0 * 6.0;
        QTest::newRow("plate") << "plate" << (14.0 * 10.0 / 2.0 - disc(3.5)) * 3.0;
        QTest::newRow("holed-bracket") << "holed-bracket" << 390.0 - disc(3.2) * 2.5;
        QTest::newRow("housing") << "housing" << 12.0 * 8.0 * 7.0 - 9.6 * 5.6 * 5.0 - 2.5 * 1.2 * 3.5;
    }

    void partsWithoutSymmetryAreWhatTheyAreCalled() {
        QFETCH(QString, name);
        QFETCH(double, volume);
        const auto shape = part::makeBundledShape(name.toStdString());
        const double got = geometry::calcMassProperties(shape, 1.0).volume * 1e9;
        QVERIFY2(std::abs(got / volume - 1.0) < 1e-9, qPrintable(QString::number(got, 'g', 12)));
    }

    /// Through OpenCASCADE and back the part is the same, and nothing of it looks like another side.
    void stepFilesArePartsWithoutSymmetry_data() {
        QTest::addColumn<QString>("name");
        for (const std::string_view name : part::kPartsInStep)
            QTest::newRow(name.data()) << QString::fromUtf8(name.data());
    }

    void stepFilesArePartsWithoutSymmetry() {
        QFETCH(QString, name);
        const std::filesystem::path file =
            std::filesystem::path(TRAPWRIGHT_SOURCE_DIR) / "resources/parts" / (name + ".step").toStdString();
        const auto contents = part::inspectStep(file);
        QVERIFY2(contents.ok(), contents ? "" : contents.error().message.c_str());
        QVERIFY(contents->valid);
        QCOMPARE(contents->solids, 1);
        const auto shape = part::makeBundledShape(name.toStdString());
        const auto imported = part::importMesh(file);
        QVERIFY(imported.ok());
        const auto step = geometry::calcMassProperties(imported->mesh, 1000.0);
        const auto stl = geometry::calcMassProperties(shape, 1000.0);
        QVERIFY(std::abs(step.volume / stl.volume - 1.0) < 1e-6);
        QVERIFY((step.centre - stl.centre).norm() < 1e-8);
        part::PartOptions options;
        options.density = 1000.0;
        const auto built = part::buildPart(imported->mesh, options);
        QVERIFY(built.ok());
        QCOMPARE(built->part.symmetry.rotations.size(), std::size_t{1});
        QVERIFY(!built->part.symmetry.continuous && built->part.stablePoses.size() >= 5);
    }

    void resourcesCanBeElsewhere() {
        const auto entry = part::findBundledPart("cone");
        QVERIFY(entry.ok());
        qputenv("TRAPWRIGHT_RESOURCES", "/elsewhere");
        QCOMPARE(part::findBundledFile(*entry), std::filesystem::path("/elsewhere/parts/cone.stl"));
        qunsetenv("TRAPWRIGHT_RESOURCES");
    }

    void unknownNameIsRefused() {
        const auto entry = part::findBundledPart("sprocket");
        QVERIFY(!entry.ok());
        QVERIFY(entry.error().message.find("cuboid, cone") != std::string::npos);
    }
};

QTEST_GUILESS_MAIN(BundledTest)
#include "bundled_test.moc"
