#include "core/part/part_builder.h"

#include <QTest>
#include <cmath>

#include "core/part/bundled.h"
#include "core/part/import.h"
#include "core/part/materials.h"
#include "core/part/shapes.h"
#include "tests/core/geometry/multi_shell_scenes.h"

using namespace trapwright;
using base::kMillimetre;
using base::Vec3;

namespace {

double calcVolume(const geometry::ConvexPolytope& piece) {
    double volume = 0.0;
    for (const geometry::PolytopeFace& face : piece.faces) {
        const auto vertex = [&](std::size_t i) {
            return piece.vertices[static_cast<std::size_t>(face.loop[i])];
        };
        for (std::size_t i = 1; i + 1 < face.loop.size(); ++i) {
            volume += vertex(0).dot(vertex(i).cross(vertex(i + 1))) / 6.0;
        }
    }
    return volume;
}

}  // namespace

class PartBuilderTest : public QObject {
    Q_OBJECT

 private slots:
    void cuboidHasClosedFormProperties() {
        geometry::TriangleMesh mesh = part::makeBox(Vec3(4, 8, 12) * kMillimetre);
        for (Vec3& vertex : mesh.vertices)
            vertex += Vec3(1, 2, 3) * kMillimetre;
        const auto built = part::buildPart(mesh, {.name = "cuboid", .source = "here", .density = 1040.0});
        QVERIFY2(built.ok(), built ? "" : built.error().message.c_str());
        const part::Part& part = built->part;
        QCOMPARE(part.name, std::string("cuboid"));
        QCOMPARE(part.source, std::string("here"));
        const double mass = 1040.0 * 384e-9;
        QVERIFY(std::abs(part.massProperties.mass - mass) < 1e-15);
        QVERIFY(part.massProperties.centre.norm() == 0.0);
        const Vec3 moments = mass / 12.0 * 1e-6 * Vec3(64 + 144, 16 + 144, 16 + 64);
        QVERIFY((part.massProperties.inertia - base::Mat3(moments.asDiagonal())).norm() <
                1e-12 * moments.norm());
        const geometry::Box box = geometry::calcBoundingBox(part.mesh);
        QVERIFY((box.low + box.high).norm() < 1e-12);
        QVERIFY((box.size() - Vec3(4, 8, 12) * kMillimetre).norm() < 1e-12);
        QVERIFY(std::abs(part.boundingRadius - std::sqrt(56.0) * kMillimetre) < 1e-12);
        QCOMPARE(part.pieces.size(), std::size_t{1});
        QCOMPARE(part.symmetry.name, std::string("D2"));
        QCOMPARE(part.stablePoses.size(), std::size_t{6});
    }

    void aMoveOfTheOriginIsToldInWholeMicrometres_data() {
        QTest::addColumn<double>("offset");
        QTest::addColumn<QString>("told");
        QTest::newRow("none") << 0.0 << "";
        QTest::newRow("of rounding") << 3.159e-20 << "";
        QTest::newRow("less than is told") << 0.4e-6 << "";
        QTest::newRow("far") << 12.3456789e-3
                             << "moved the origin to the centre of mass, by (-12.346, 0, 0) mm";
    }

    void aMoveOfTheOriginIsToldInWholeMicrometres() {
        QFETCH(double, offset);
        QFETCH(QString, told);
        geometry::TriangleMesh mesh = part::makeBox(Vec3(4, 8, 12) * kMillimetre);
        for (Vec3& vertex : mesh.vertices)
            vertex.x() += offset;
        const auto built = part::buildPart(mesh, {});
        QVERIFY2(built.ok(), built ? "" : built.error().message.c_str());
        QStringList notes;
        for (const std::string& note : built->notes)
            notes << QString::fromStdString(note);
        QCOMPARE(notes.join("; "), told);
    }

    void partsOfSeveralShells_data() {
        QTest::addColumn<geometry::TriangleMesh>("mesh");
        QTest::addColumn<double>("volume");
        using namespace geometry::multi_shell;
        for (const Scene& scene : makeScenes())
            for (const Disguise& disguise : {kDisguises[1], kDisguises[4]})
                QTest::addRow("%s, %s", scene.name, disguise.name)
                    << makeSample(scene, disguise).mesh << scene.solid.volume * 1e-9;
    }

    void partsOfSeveralShells() {
        QFETCH(geometry::TriangleMesh, mesh);
        QFETCH(double, volume);
        const auto built = part::buildPart(mesh, {.density = 1000.0});
        QVERIFY2(built.ok(), built ? "" : built.error().message.c_str());
        QVERIFY(std::abs(built->part.massProperties.volume / volume - 1.0) < 1e-6);
        double pieces = 0.0;
        for (const geometry::ConvexPolytope& piece : built->part.pieces)
            pieces += calcVolume(piece);
        QVERIFY(std::abs(pieces / volume - 1.0) < 1e-2);
    }

    void stagesAreToldInOrder() {
        QStringList stages;
        const auto built =
            part::buildPart(part::makeBox(Vec3(4, 8, 12) * kMillimetre), {}, [&](std::string_view stage) {
                stages << QString::fromUtf8(stage.data(), static_cast<qsizetype>(stage.size()));
            });
        QVERIFY(built.ok());
        QCOMPARE(stages.join("; "), QString("mending the mesh; convex pieces; symmetry; stable poses"));
    }

    void bundledPartsFromTheirFiles_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("symmetry");
        QTest::addColumn<int>("poses");
        QTest::addColumn<bool>("convex");
        QTest::newRow("cuboid") << "cuboid"
                                << "D2" << 6 << true;
        QTest::newRow("cone") << "cone"
                              << "Cinf" << 4 << false;
        QTest::newRow("bracket") << "bracket"
                                 << "C1" << 5 << false;
        QTest::newRow("pin") << "pin"
                             << "Cinf" << 3 << false;
        QTest::newRow("cup") << "cup"
                             << "Cinf" << 3 << false;
    }

    void bundledPartsFromTheirFiles() {
        QFETCH(QString, name);
        QFETCH(QString, symmetry);
        QFETCH(int, poses);
        QFETCH(bool, convex);
        const auto entry = part::findBundledPart(name.toStdString());
        QVERIFY(entry.ok());
        const auto imported = part::importMesh(part::findBundledFile(*entry), "mm");
        QVERIFY(imported.ok());
        const double density = part::findMaterial(part::readMaterials(), entry->material)->density.value;
        const auto built =
            part::buildPart(imported->mesh, {.name = std::string(entry->name), .density = density});
        QVERIFY2(built.ok(), built ? "" : built.error().message.c_str());
        const part::Part& part = built->part;
        QCOMPARE(QString::fromStdString(part.symmetry.name), symmetry);
        QCOMPARE(static_cast<int>(part.stablePoses.size()), poses);
        QCOMPARE(part.pieces.size() == 1, convex);
        double volume = 0.0;
        for (const geometry::ConvexPolytope& piece : part.pieces)
            volume += calcVolume(piece);
        QVERIFY(std::abs(volume / part.massProperties.volume - 1.0) < 0.01);
        QVERIFY(std::abs(part.massProperties.mass / (density * part.massProperties.volume) - 1.0) < 1e-12);
    }

    /// The bracket through another program's kernel has the same poses.
    void stepBracketIsTheStlBracket() {
        const auto step = part::importMesh(std::filesystem::path(TRAPWRIGHT_SOURCE_DIR) / "resources/parts" /
                                           part::kBracketStepFile);
        QVERIFY(step.ok());
        const auto fromStep = part::buildPart(step->mesh, {.name = "step"});
        const auto fromShape = part::buildPart(part::makeBundledShape("bracket"), {.name = "shape"});
        QVERIFY2(fromStep.ok(), fromStep ? "" : fromStep.error().message.c_str());
        QVERIFY(fromShape.ok());
        QCOMPARE(fromStep->part.stablePoses.size(), fromShape->part.stablePoses.size());
        for (std::size_t i = 0; i < fromStep->part.stablePoses.size(); ++i) {
            const double a = fromStep->part.stablePoses[i].probability;
            const double b = fromShape->part.stablePoses[i].probability;
            QVERIFY(std::abs(a - b) < 1e-6);
        }
    }

    /// The cylinder comes from its STEP surfaces with seams and facets as OpenCASCADE puts them, and is still
    /// round.
    void stepCylinderIsTurned() {
        const auto imported = part::importMesh(std::filesystem::path(TRAPWRIGHT_SOURCE_DIR) /
                                               "tests/core/part/data/cylinder_inch.step");
        QVERIFY(imported.ok());
        const auto built = part::buildPart(imported->mesh, {.name = "cylinder"});
        QVERIFY2(built.ok(), built ? "" : built.error().message.c_str());
        QCOMPARE(built->part.symmetry.name, std::string("Dinf"));
        QCOMPARE(built->part.stablePoses.size(), std::size_t{3});
        QCOMPARE(built->part.pieces.size(), std::size_t{1});
    }

    void badInputIsRefused_data() {
        QTest::addColumn<double>("density");
        QTest::addColumn<double>("tolerance");
        QTest::addColumn<int>("triangles");
        QTest::addColumn<double>("height");  // [mm]
        QTest::addColumn<QString>("message");
        QTest::newRow("no density") << 0.0 << 0.005 << 12 << 12.0 << "density";
        QTest::newRow("negative density") << -1.0 << 0.005 << 12 << 12.0 << "density";
        QTest::newRow("density of g/cm^3 as mg") << 1e6 << 0.005 << 12 << 12.0 << "density";
        QTest::newRow("density not a number") << std::nan("") << 0.005 << 12 << 12.0 << "density";
        QTest::newRow("tolerance") << 1000.0 << 0.5 << 12 << 12.0 << "tolerance";
        QTest::newRow("open mesh") << 1000.0 << 0.005 << 8 << 12.0 << "hole";
        QTest::newRow("no triangles") << 1000.0 << 0.005 << 0 << 12.0 << "triangles";
        QTest::newRow("no volume") << 1000.0 << 0.005 << 12 << 0.0 << "volume";
    }

    // A cuboid with three different edges has the half turns about its axes (D2), unless its faces are
    // marked.
    void symmetryCanBeLeftOut() {
        const geometry::TriangleMesh mesh = part::makeBox(Vec3(4, 8, 12) * kMillimetre);
        const auto found = part::buildPart(mesh, {.name = "x"});
        const auto none = part::buildPart(mesh, {.name = "x", .symmetry = part::SymmetryUse::none});
        QVERIFY(found.ok() && none.ok());
        QCOMPARE(found->part.symmetry.name, std::string("D2"));
        QCOMPARE(none->part.symmetry.name, std::string("C1"));
        QCOMPARE(none->part.symmetry.rotations.size(), std::size_t{1});
        QCOMPARE(none->part.stablePoses.size(), std::size_t{6});
    }

    void badInputIsRefused() {
        QFETCH(double, density);
        QFETCH(double, tolerance);
        QFETCH(int, triangles);
        QFETCH(double, height);
        QFETCH(QString, message);
        geometry::TriangleMesh mesh = part::makeBox(Vec3(4, 8, height) * kMillimetre);
        mesh.triangles.resize(static_cast<std::size_t>(triangles));
        const auto built =
            part::buildPart(mesh, {.name = "x", .density = density, .symmetryTolerance = tolerance});
        QVERIFY(!built.ok());
        const QString found = QString::fromStdString(built.error().message);
        QVERIFY2(found.contains(message, Qt::CaseInsensitive), qPrintable(found));
    }
};

QTEST_GUILESS_MAIN(PartBuilderTest)
#include "part_builder_test.moc"
