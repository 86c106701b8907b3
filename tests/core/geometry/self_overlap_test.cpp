#include "core/geometry/self_overlap.h"

#include <QTest>
#include <algorithm>

#include "core/base/random.h"
#include "shapes.h"

using namespace trapwright;
using namespace trapwright::geometry;

namespace {

TriangleMesh makeTriangles(const std::vector<std::array<base::Vec3, 3>>& corners) {
    TriangleMesh mesh;
    for (const auto& triangle : corners) {
        const int first = static_cast<int>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), triangle.begin(), triangle.end());
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

/// A sheet of n x n squares in the plane z = height, two triangles each.
TriangleMesh makeSheet(int n, double height) {
    TriangleMesh mesh;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            mesh.vertices.emplace_back(0.01 * i, 0.01 * j, height);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const int a = i * (n + 1) + j;
            mesh.triangles.push_back({a, a + n + 1, a + n + 2});
            mesh.triangles.push_back({a, a + n + 2, a + 1});
        }
    return mesh;
}

}  // namespace

class SelfOverlapTest : public QObject {
    Q_OBJECT

 private slots:
    void pairs_data() {
        QTest::addColumn<TriangleMesh>("mesh");
        QTest::addColumn<int>("expected");
        const std::array<base::Vec3, 3> flat = {base::Vec3(0, 0, 0), base::Vec3(4, 0, 0),
                                                base::Vec3(0, 4, 0)};
        const auto row = [&](const char* name, const std::array<base::Vec3, 3>& other, int expected) {
            QTest::newRow(name) << makeTriangles({flat, other}) << expected;
        };
        row("apart", {base::Vec3(0, 0, 1), {4, 0, 1}, {0, 4, 2}}, 0);
        row("boxes overlap, triangles do not", {base::Vec3(4, 4, 0), {4, 1, 0}, {1, 4, 0}}, 0);
        row("pierced", {base::Vec3(1, 1, -1), {1, 1, 1}, {5, 5, 1}}, 2);
        row("coplanar, one inside the other", {base::Vec3(1, 1, 0), {2, 1, 0}, {1, 2, 0}}, 2);
        row("coplanar, crossing", {base::Vec3(-1, 1, 0), {3, 1, 0}, {-1, 2, 0}}, 2);
        row("touched by a point inside", {base::Vec3(1, 1, 0), {1, 1, 1}, {2, 1, 1}}, 2);
        row("a corner in common", {base::Vec3(0, 0, 0), {-1, 0, 1}, {0, -1, 1}}, 0);
        row("a corner in common, pierced beyond it", {base::Vec3(0, 0, 0), {2, 1, -1}, {2, 1, 1}}, 2);
        row("a corner in common, folded flat", {base::Vec3(0, 0, 0), {2, 1, 0}, {1, 2, 0}}, 2);
        row("an edge in common", {base::Vec3(4, 0, 0), {0, 0, 0}, {1, -1, 0}}, 0);
        row("an edge in common, a sharp fold", {base::Vec3(4, 0, 0), {0, 0, 0}, {1, 1, 1e-9}}, 0);
        row("an edge in common, folded flat", {base::Vec3(4, 0, 0), {0, 0, 0}, {1, 1, 0}}, 2);
        row("twice the same", {base::Vec3(4, 0, 0), {0, 4, 0}, {0, 0, 0}}, 2);
        row("no area", {base::Vec3(1, 1, -1), {1, 1, 0}, {1, 1, 1}}, 0);
    }
    void pairs() {
        QFETCH(TriangleMesh, mesh);
        QFETCH(int, expected);
        QCOMPARE(countOverlappingTriangles(mesh, 2), expected);
        std::swap(mesh.triangles[0], mesh.triangles[1]);
        QCOMPARE(countOverlappingTriangles(mesh, 2), expected);
        QCOMPARE(countOverlappingTriangles(mesh, 1), 0);
    }

    void sheets() {
        TriangleMesh mesh = makeSheet(8, 0.0);
        QCOMPARE(countOverlappingTriangles(mesh, mesh.triangles.size()), 0);
        // A second sheet on edge crosses one row of squares: x = 0.035 lies within row 3.
        TriangleMesh upright = makeSheet(1, 0.0);
        for (base::Vec3& v : upright.vertices)
            v = base::Vec3(0.035, 20.0 * v.x() - 0.05, 2.0 * v.y() - 0.01);
        shapes::append(mesh, upright);
        QCOMPARE(countOverlappingTriangles(mesh, mesh.triangles.size()), 16 + 2);
        QCOMPARE(countOverlappingTriangles(mesh, 128), 0);
    }

    void orderAndPlaceDoNotMatter() {
        base::Random random({.seed = 3});
        TriangleMesh mesh;
        for (int i = 0; i < 90; ++i)
            mesh.vertices.emplace_back(random.uniform(), random.uniform(), random.uniform());
        for (int i = 0; i < 90; i += 3)
            mesh.triangles.push_back({i, i + 1, i + 2});
        const int count = countOverlappingTriangles(mesh, 30);
        QVERIFY(count > 10);
        std::reverse(mesh.triangles.begin(), mesh.triangles.end());
        QCOMPARE(countOverlappingTriangles(mesh, 30), count);
        shapes::transform(mesh,
                          {base::Quaternion(Eigen::AngleAxisd(1.0, base::Vec3(1, 2, 2) / 3.0)), {1, 2, 3}});
        QCOMPARE(countOverlappingTriangles(mesh, 30), count);
    }

    void costOfATrack() {
        // A learning run asks this for every individual.
        TriangleMesh mesh = makeSheet(8, 0.0);
        base::Random random({.seed = 4});
        for (base::Vec3& v : mesh.vertices)
            v.z() = 0.01 * random.uniform();
        QBENCHMARK {
            QCOMPARE(countOverlappingTriangles(mesh, 128), 0);
        }
    }
};

QTEST_APPLESS_MAIN(SelfOverlapTest)
#include "self_overlap_test.moc"
