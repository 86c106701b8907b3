#include "core/geometry/convex_hull.h"

#include <QTest>
#include <algorithm>

#include "core/base/random.h"
#include "core/geometry/mass_properties.h"
#include "shapes.h"

using namespace trapwright;
using namespace trapwright::geometry;

namespace {

/// Euler's formula, planes that bound every vertex, and edges with their faces on the sides they say.
void verifyPolytope(const ConvexPolytope& polytope) {
    QCOMPARE(polytope.vertices.size() + polytope.faces.size(), polytope.edges.size() + 2);
    double size = 0.0;
    for (const base::Vec3& vertex : polytope.vertices)
        size = std::max(size, (vertex - polytope.vertices[0]).norm());
    for (const PolytopeFace& face : polytope.faces) {
        QVERIFY(std::abs(face.normal.norm() - 1.0) < 1e-12);
        for (const base::Vec3& vertex : polytope.vertices)
            QVERIFY(face.normal.dot(vertex) <= face.offset + 1e-5 * size);
        for (const int vertex : face.loop)
            QVERIFY(face.normal.dot(polytope.vertices[vertex]) >= face.offset - 1e-5 * size);
    }
    const auto follows = [&](int face, int from, int to) {
        const std::vector<int>& loop = polytope.faces[face].loop;
        const auto place = std::find(loop.begin(), loop.end(), from);
        if (place == loop.end()) return false;
        return (place + 1 == loop.end() ? loop.front() : *(place + 1)) == to;
    };
    for (const PolytopeEdge& edge : polytope.edges) {
        QVERIFY(follows(edge.left, edge.from, edge.to));
        QVERIFY(follows(edge.right, edge.to, edge.from));
    }
}

}  // namespace

class ConvexHullTest : public QObject {
    Q_OBJECT

 private slots:
    /// Not on what was in memory before.
    void trianglesDependOnThePointsOnly() {
        const TriangleMesh torus = shapes::makeTorus(64, 32, 10 * base::kMillimetre, 3 * base::kMillimetre);
        base::Random random({.seed = 3});
        const auto first = computeHullMesh(torus.vertices);
        QVERIFY(first.ok());
        std::vector<std::vector<char>> other;
        for (int round = 0; round < 8; ++round) {
            // Of every size, and every other one given back: new memory then has addresses in any order.
            for (int i = 0; i < 4000; ++i)
                other.emplace_back(static_cast<std::size_t>(random.uniform(1.0, i % 2 == 0 ? 1e3 : 1e5)));
            for (std::size_t i = round % 2; i < other.size(); i += 2)
                std::vector<char>().swap(other[i]);
            const auto again = computeHullMesh(torus.vertices);
            QVERIFY(again.ok());
            QVERIFY(again->vertices == first->vertices);
            QVERIFY(again->triangles == first->triangles);
        }
        // Closed, and as large as the one of polygons.
        const auto polytope = computeConvexHull(torus.vertices);
        QVERIFY(polytope.ok());
        const double volume = calcMassProperties(toMesh(*polytope), 1.0).volume;
        QVERIFY(std::abs(calcMassProperties(*first, 1.0).volume / volume - 1.0) < 1e-6);
        QCOMPARE(first->triangles.size(), 2 * first->vertices.size() - 4);
    }

    void solidsKeepTheirPolygons_data() {
        QTest::addColumn<TriangleMesh>("mesh");
        QTest::addColumn<int>("vertices");
        QTest::addColumn<int>("faces");
        QTest::addColumn<double>("volume");
        const double mm = base::kMillimetre;
        QTest::newRow("cuboid") << shapes::makeBox({0, 0, 0}, {4 * mm, 8 * mm, 12 * mm}) << 8 << 6 << 384e-9;
        QTest::newRow("L bracket") << shapes::makeL() << 10 << 7 << (100 - 32) * 4e-9;
        QTest::newRow("64-sided cylinder") << shapes::makePrism(shapes::makeCircle(64, 3 * mm), 10 * mm)
                                           << 128 << 66 << shapes::calcCircleArea(64, 3 * mm) * 10 * mm;
    }
    void solidsKeepTheirPolygons() {
        QFETCH(TriangleMesh, mesh);
        QFETCH(int, vertices);
        QFETCH(int, faces);
        QFETCH(double, volume);
        // Turned, and rounded to the single precision of an STL file: faces are no longer exactly plane.
        shapes::transform(mesh, {base::Quaternion(Eigen::AngleAxisd(0.4, base::Vec3(3, 1, 2).normalized())),
                                 base::Vec3(0.001, 0.002, 0.003)});
        for (base::Vec3& vertex : mesh.vertices)
            vertex = vertex.cast<float>().cast<double>();

        const auto hull = computeConvexHull(mesh);
        QVERIFY2(hull.ok(), hull.ok() ? "" : hull.error().message.c_str());
        QCOMPARE(static_cast<int>(hull->vertices.size()), vertices);
        QCOMPARE(static_cast<int>(hull->faces.size()), faces);
        verifyPolytope(*hull);
        QVERIFY(std::abs(calcMassProperties(toMesh(*hull), 1.0).volume / volume - 1.0) < 1e-5);
    }

    void pointsInsideFacesAndOnEdgesAreDropped() {
        std::vector<base::Vec3> points;
        points.reserve(5 * 5 * 5);
        for (int i = 0; i < 5 * 5 * 5; ++i)
            points.emplace_back(i % 5, i / 5 % 5, i / 25);
        const auto hull = computeConvexHull(points);
        QVERIFY(hull.ok());
        QCOMPARE(hull->vertices.size(), std::size_t(8));
        QCOMPARE(hull->faces.size(), std::size_t(6));
        QCOMPARE(hull->edges.size(), std::size_t(12));
        verifyPolytope(*hull);
    }

    void orderOfPointsDoesNotMatter() {
        base::Random random({.seed = 5});
        std::vector<base::Vec3> points;
        points.reserve(300);
        for (int i = 0; i < 300; ++i)
            points.emplace_back(random.normal(), random.normal(), random.normal());
        const auto forward = computeConvexHull(points);
        std::reverse(points.begin(), points.end());
        const auto backward = computeConvexHull(points);
        QVERIFY(forward.ok() && backward.ok());
        verifyPolytope(*forward);
        QVERIFY(forward->vertices == backward->vertices);
        QCOMPARE(forward->faces.size(), backward->faces.size());
        for (std::size_t i = 0; i < forward->faces.size(); ++i)
            QVERIFY(forward->faces[i].loop == backward->faces[i].loop);
        for (const base::Vec3& point : points)
            QVERIFY(contains(*forward, point, 1e-9));
        QVERIFY(!contains(*forward, base::Vec3(10, 0, 0)));
    }

    void flatOrBrokenPointsAreRefused_data() {
        QTest::addColumn<int>("kind");
        QTest::newRow("none") << 0;
        QTest::newRow("one point many times") << 1;
        QTest::newRow("a line") << 2;
        QTest::newRow("a slanted plane") << 3;
        QTest::newRow("not a number") << 4;
    }
    void flatOrBrokenPointsAreRefused() {
        QFETCH(int, kind);
        std::vector<base::Vec3> points;
        for (int i = 0; i < 20 && kind > 0; ++i) {
            const double s = kind >= 2 ? 0.001 * i : 0.0;
            const double t = kind >= 3 ? 0.001 * (i * i % 7) : 0.0;
            points.emplace_back(s, 0.3 * s + 0.7 * t, 0.1 * s - 0.2 * t);
        }
        if (kind == 4) points[7].y() = std::nan("");
        const auto hull = computeConvexHull(points);
        QVERIFY(!hull.ok());
        QVERIFY(hull.error().message.find(kind == 4 ? "point 7" : "one plane") != std::string::npos);
    }

    void convexityIsAboutVolume() {
        QVERIFY(isConvex(shapes::makeBox({0, 0, 0}, {1, 2, 3}), 1e-6));
        QVERIFY(!isConvex(shapes::makeL(), 1e-3));
        QVERIFY(!isConvex(shapes::makeCup(24, 0.005, 0.01, 0.001), 1e-3));
        QVERIFY(!isConvex({}, 1e-3));
    }
};

QTEST_APPLESS_MAIN(ConvexHullTest)
#include "convex_hull_test.moc"
