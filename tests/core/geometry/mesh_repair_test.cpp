#include "core/geometry/mesh_repair.h"

#include <QTest>
#include <algorithm>

#include "core/geometry/mass_properties.h"
#include "core/geometry/mesh_check.h"
#include "shapes.h"

using namespace trapwright;
using namespace trapwright::geometry;

namespace {

constexpr double kMm = base::kMillimetre;

TriangleMesh makeCuboid() {
    return shapes::makeBox({0, 0, 0}, {4 * kMm, 8 * kMm, 12 * kMm});
}
TriangleMesh makeFineCylinder() {
    return shapes::makePrism(shapes::makeCircle(200, 3 * kMm), 10 * kMm);
}

/// Every triangle with vertices of its own, as in an STL file.
TriangleMesh makeSoup(const TriangleMesh& mesh) {
    TriangleMesh soup;
    for (const Triangle& t : mesh.triangles) {
        const int first = static_cast<int>(soup.vertices.size());
        for (const int vertex : t)
            soup.vertices.push_back(mesh.vertices[vertex]);
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    return soup;
}

bool hasNote(const RepairedMesh& repaired, const std::string& text) {
    return std::any_of(repaired.notes.begin(), repaired.notes.end(),
                       [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

}  // namespace

class MeshRepairTest : public QObject {
    Q_OBJECT

 private slots:
    void soundMeshesStayAsTheyAre_data() {
        QTest::addColumn<TriangleMesh>("mesh");
        QTest::newRow("cuboid") << makeCuboid();
        QTest::newRow("L bracket") << shapes::makeL();
        QTest::newRow("cup") << shapes::makeCup(32, 5 * kMm, 10 * kMm, kMm);
    }
    void soundMeshesStayAsTheyAre() {
        QFETCH(TriangleMesh, mesh);
        QVERIFY(checkMesh(mesh).isSolid());
        const auto repaired = repairMesh(makeSoup(mesh));
        QVERIFY2(repaired.ok(), repaired.ok() ? "" : repaired.error().message.c_str());
        QVERIFY(repaired->notes.empty());
        QCOMPARE(repaired->mesh.vertices.size(), mesh.vertices.size());
        QCOMPARE(repaired->mesh.triangles.size(), mesh.triangles.size());
        const double volume = calcMassProperties(mesh, 1.0).volume;
        QVERIFY(std::abs(calcMassProperties(repaired->mesh, 1.0).volume - volume) < 1e-9 * volume);
    }

    void defectsAreCountedAndMended_data() {
        QTest::addColumn<TriangleMesh>("mesh");
        QTest::addColumn<QString>("note");
        QTest::addColumn<double>("volume");
        const double cuboid = 384e-9;
        TriangleMesh mesh = makeCuboid();
        mesh.triangles.push_back({0, 1, 1});
        QTest::newRow("two corners alike") << mesh << "1 triangle without area" << cuboid;
        mesh = makeCuboid();
        mesh.vertices.emplace_back(2 * kMm, 0, 0);
        mesh.triangles.push_back({0, 8, 1});
        QTest::newRow("three corners in a line") << mesh << "1 triangle without area" << cuboid;
        mesh = makeCuboid();
        mesh.triangles.push_back(mesh.triangles[3]);
        QTest::newRow("a triangle twice") << mesh << "1 repeated triangle" << cuboid;
        mesh = makeCuboid();
        std::swap(mesh.triangles[2][0], mesh.triangles[2][1]);
        std::swap(mesh.triangles[9][0], mesh.triangles[9][1]);
        QTest::newRow("two triangles turned") << mesh << "turned 2 triangles" << cuboid;
        mesh = makeCuboid();
        shapes::turnInsideOut(mesh);
        QTest::newRow("inside out") << mesh << "turned 12 triangles" << cuboid;
        mesh = shapes::makeBox({0, 0, 0}, {4 * kMm, 8 * kMm, 12 * kMm});
        shapes::append(mesh, shapes::makeBox({10 * kMm, 0, 0}, {11 * kMm, 2 * kMm, 3 * kMm}));
        QTest::newRow("two shells apart") << mesh << "kept 2 shells, 0 of them cavities" << cuboid + 6e-9;
        mesh = makeCuboid();
        shapes::append(mesh, shapes::makeBox({1 * kMm, 1 * kMm, 1 * kMm}, {2 * kMm, 3 * kMm, 4 * kMm}));
        QTest::newRow("a cavity that faces outward")
            << mesh << "kept 2 shells, 1 of them a cavity" << cuboid - 6e-9;
        mesh = shapes::makeBox({0, 0, 0}, {kMm, kMm, kMm});
        shapes::append(mesh, shapes::makeBox({kMm, kMm, 0}, {2 * kMm, 2 * kMm, kMm}));
        QTest::newRow("two cubes at one edge") << mesh << "1 edge where more than two" << 2e-9;
    }
    void defectsAreCountedAndMended() {
        QFETCH(TriangleMesh, mesh);
        QFETCH(QString, note);
        QFETCH(double, volume);
        const auto repaired = repairMesh(mesh);
        QVERIFY2(repaired.ok(), repaired.ok() ? "" : repaired.error().message.c_str());
        QVERIFY2(hasNote(*repaired, note.toStdString()),
                 repaired->notes.empty() ? "no notes" : repaired->notes.front().c_str());
        QVERIFY(std::abs(calcMassProperties(repaired->mesh, 1.0).volume / volume - 1.0) < 1e-9);
        QVERIFY(checkMesh(repaired->mesh).isSolid());
        // Mended is mended: a second pass changes nothing.
        const auto again = repairMesh(repaired->mesh);
        QVERIFY(again.ok());
        QCOMPARE(again->mesh.triangles.size(), repaired->mesh.triangles.size());
        QVERIFY(!hasNote(*again, "turned") && !hasNote(*again, "dropped") && !hasNote(*again, "filled"));
    }

    void smallHoleIsFilledWhereItIs() {
        // The first triangle of the bottom becomes six around a small triangle (p, q, r) that is missing.
        TriangleMesh mesh = shapes::makeBox({0, 0, 0}, {40 * kMm, 40 * kMm, 40 * kMm});
        mesh.vertices.emplace_back(9.5 * kMm, 10 * kMm, 0);
        mesh.vertices.emplace_back(10.5 * kMm, 10.3 * kMm, 0);
        mesh.vertices.emplace_back(9.5 * kMm, 10.2 * kMm, 0);
        const int p = 8;
        const int q = 9;
        const int r = 10;
        mesh.triangles.erase(mesh.triangles.begin());
        for (const Triangle& t : {Triangle{0, r, p}, {0, 2, r}, {2, q, r}, {2, 1, q}, {1, p, q}, {1, 0, p}})
            mesh.triangles.push_back(t);
        const MeshReport before = checkMesh(mesh);
        QCOMPARE(before.openEdges, 3);
        QCOMPARE(before.holes.size(), std::size_t(1));
        QVERIFY((before.holes[0].centre - base::Vec3(10 * kMm, 10 * kMm, 0)).norm() < kMm);
        const auto repaired = repairMesh(mesh);
        QVERIFY2(repaired.ok(), repaired.ok() ? "" : repaired.error().message.c_str());
        QVERIFY(hasNote(*repaired, "filled a hole: 3 edges around (9."));
        QVERIFY(std::abs(calcMassProperties(repaired->mesh, 1.0).volume / 64e-6 - 1.0) < 1e-9);
        QVERIFY(!repairMesh(mesh, 1e-3).ok());
    }

    void hopelessMeshesAreRefusedWithTheReason_data() {
        QTest::addColumn<TriangleMesh>("mesh");
        QTest::addColumn<QString>("reason");
        QTest::newRow("empty") << TriangleMesh{} << "no triangles";
        TriangleMesh mesh = makeCuboid();
        mesh.vertices[5].z() = std::nan("");
        QTest::newRow("not a number") << mesh << "mm has a coordinate that is not a finite number";
        mesh = makeCuboid();
        mesh.triangles.erase(mesh.triangles.begin() + 2, mesh.triangles.begin() + 4);
        QTest::newRow("no lid") << mesh
                                << "1 hole remains, the largest of 4 edges around (2, 4, 12) mm, 24 mm long";
        mesh = makeFineCylinder();
        mesh.triangles.erase(mesh.triangles.begin() + 400);
        QTest::newRow("a narrow but long gap") << mesh << "1 hole remains, the largest of 3 edges";
        mesh = makeCuboid();
        for (base::Vec3& vertex : mesh.vertices)
            vertex.z() = 0.0;
        QTest::newRow("flat") << mesh << "no volume";
        mesh = TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
        QTest::newRow("a line") << mesh << "no volume";
        mesh = makeCuboid();
        mesh.vertices.emplace_back(2 * kMm, 4 * kMm, 20 * kMm);
        mesh.triangles.push_back({4, 7, 8});
        QTest::newRow("a fin on two corners") << mesh << "open";
        mesh = shapes::makeBox({0, 0, 0}, {kMm, kMm, kMm});
        mesh.triangles.push_back({1, 3, 4});
        mesh.triangles.push_back({3, 6, 4});
        QTest::newRow("a wall inside") << mesh << "without closing a volume";
    }
    void hopelessMeshesAreRefusedWithTheReason() {
        QFETCH(TriangleMesh, mesh);
        QFETCH(QString, reason);
        const auto repaired = repairMesh(mesh);
        QVERIFY(!repaired.ok());
        QVERIFY2(repaired.error().message.find(reason.toStdString()) != std::string::npos,
                 repaired.error().message.c_str());
    }

    void reportCountsEveryKind() {
        TriangleMesh mesh = makeSoup(makeCuboid());
        mesh.triangles.push_back({0, 0, 1});
        mesh.triangles.push_back(mesh.triangles[4]);
        std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
        mesh.vertices.emplace_back(std::nan(""), 0, 0);
        mesh.triangles.push_back({0, 1, 36});
        const MeshReport report = checkMesh(mesh);
        QCOMPARE(report.nonFiniteVertices, 1);
        QCOMPARE(report.duplicateVertices, 36 - 8);
        QCOMPARE(report.degenerateTriangles, 1);
        QCOMPARE(report.duplicateTriangles, 1);
        QCOMPARE(report.inconsistentEdges, 3);
        QCOMPARE(report.openEdges, 0);
        QCOMPARE(report.shells, 1);
        QVERIFY(!report.isSolid());

        TriangleMesh inverted = makeCuboid();
        shapes::turnInsideOut(inverted);
        QCOMPARE(checkMesh(inverted).insideOutShells, 1);
        QVERIFY(!checkMesh(inverted).isSolid());

        TriangleMesh crossing = makeCuboid();
        shapes::append(crossing, shapes::makeBox({kMm, kMm, -kMm}, {2 * kMm, 2 * kMm, 13 * kMm}));
        QCOMPARE(checkMesh(crossing).overlappingTriangles, 0);
        // Top and bottom of the cuboid (one or both triangles of each) and the 8 side triangles of the bar.
        QVERIFY(checkMesh(crossing, true).overlappingTriangles >= 8 + 2);
        QCOMPARE(checkMesh(makeCuboid(), true).overlappingTriangles, 0);
    }
};

QTEST_APPLESS_MAIN(MeshRepairTest)
#include "mesh_repair_test.moc"
