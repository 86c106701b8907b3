#include "core/geometry/contact_shape.h"

#include <QTest>
#include <algorithm>

#include "core/base/random.h"
#include "core/geometry/convex_hull.h"
#include "core/geometry/convex_pieces.h"
#include "core/geometry/mass_properties.h"
#include "core/geometry/surface_distance.h"
#include "core/geometry/triangle_mesh.h"
#include "shapes.h"

using namespace trapwright;
using namespace trapwright::geometry;

namespace {

constexpr double kMm = base::kMillimetre;

/// A pin with a waist and a fillet below its head, both curved inward.
TriangleMesh makeWaistedPin(int sides, int steps) {
    std::vector<base::Vec2> profile = {{2.0 * kMm, 0.0}};
    for (int i = 0; i <= steps; ++i) {
        const double angle = base::kPi * i / steps;
        profile.emplace_back((2.0 - 0.6 * std::sin(angle)) * kMm, (1.0 + 5.0 * i / steps) * kMm);
    }
    for (int i = 0; i <= steps; ++i) {
        const double angle = 0.5 * base::kPi * i / steps;
        profile.emplace_back((3.0 - std::cos(angle)) * kMm, (7.0 + std::sin(angle)) * kMm);
    }
    profile.emplace_back(4.0 * kMm, 8.0 * kMm);
    profile.emplace_back(4.0 * kMm, 9.5 * kMm);
    return shapes::makeTurned(profile, sides);
}

/// A ball; the poles are small discs.
TriangleMesh makeBall(int sides, int rows, double radius) {
    std::vector<base::Vec2> profile;
    for (int i = 1; i < rows; ++i) {
        const double angle = base::kPi * i / rows;
        profile.emplace_back(radius * std::sin(angle), -radius * std::cos(angle));
    }
    return shapes::makeTurned(profile, sides);
}

double sumVolumes(const std::vector<ConvexPolytope>& pieces) {
    double sum = 0.0;
    for (const ConvexPolytope& piece : pieces)
        sum += calcMassProperties(toMesh(piece), 1.0).volume;
    return sum;
}

/// How far the point is beyond the nearest of the pieces, as they see it; below 0 inside one. [m]
double calcOutside(const std::vector<ConvexPolytope>& pieces, const base::Vec3& point) {
    double least = 1e9;
    for (const ConvexPolytope& piece : pieces) {
        double height = -1e9;
        for (const PolytopeFace& face : piece.faces)
            height = std::max(height, face.normal.dot(point) - face.offset);
        least = std::min(least, height);
    }
    return least;
}

/// From the nearest of the surfaces. [m]
double calcDistance(const std::vector<SurfaceDistance>& surfaces, const base::Vec3& point) {
    double least = 1e9;
    for (const SurfaceDistance& surface : surfaces)
        least = std::min(least, surface.calcDistance(point));
    return least;
}

/// Corners, the middles of edges and of faces.
std::vector<base::Vec3> listFeatures(const ConvexPolytope& piece) {
    std::vector<base::Vec3> points = piece.vertices;
    for (const PolytopeEdge& edge : piece.edges)
        points.emplace_back(0.5 * (piece.vertices[edge.from] + piece.vertices[edge.to]));
    for (const PolytopeFace& face : piece.faces) {
        base::Vec3 sum = base::Vec3::Zero();
        for (const int vertex : face.loop)
            sum += piece.vertices[vertex];
        points.emplace_back(sum / static_cast<double>(face.loop.size()));
    }
    return points;
}

}  // namespace

class ContactShapeTest : public QObject {
    Q_OBJECT

 private slots:
    void curvedSolidsAreMadeOfPiecesNearThem_data() {
        QTest::addColumn<TriangleMesh>("mesh");
        QTest::addColumn<std::size_t>("mostPieces");
        QTest::addColumn<std::size_t>("mostCorners");
        QTest::newRow("torus of 64 x 32")
            << shapes::makeTorus(64, 32, 10 * kMm, 3 * kMm) << std::size_t{48} << std::size_t{2900};
        QTest::newRow("turned, 10,000 triangles")
            << makeWaistedPin(96, 24) << std::size_t{16} << std::size_t{1400};
        QTest::newRow("turned, 40,000 triangles")
            << makeWaistedPin(200, 50) << std::size_t{16} << std::size_t{1400};
    }

    /// Points of the solid are in a piece, and points of pieces in the solid, up to the deviation that is
    /// told.
    void curvedSolidsAreMadeOfPiecesNearThem() {
        QFETCH(TriangleMesh, mesh);
        const auto shape = computeContactShape(mesh);
        QVERIFY2(shape.ok(), shape.ok() ? "" : shape.error().message.c_str());
        const double size = calcBoundingBox(mesh).size().norm();
        const double volume = calcMassProperties(mesh, 1.0).volume;
        QFETCH(std::size_t, mostPieces);
        QFETCH(std::size_t, mostCorners);
        std::size_t corners = 0;
        for (const ConvexPolytope& piece : shape->pieces)
            corners += piece.vertices.size();
        QVERIFY2(shape->pieces.size() > 1 && shape->pieces.size() <= mostPieces,
                 qPrintable(QString::number(shape->pieces.size())));
        QVERIFY2(corners <= mostCorners, qPrintable(QString::number(corners)));
        QVERIFY2(shape->deviation > 0.0 && shape->deviation < 0.005 * size,
                 qPrintable(QString::number(shape->deviation / size)));
        QVERIFY(std::abs(sumVolumes(shape->pieces) / volume - 1.0) < 0.02);

        const SurfaceDistance surface(mesh);
        std::vector<SurfaceDistance> surfaces;
        for (const ConvexPolytope& piece : shape->pieces)
            surfaces.emplace_back(toMesh(piece));
        const Box box = calcBoundingBox(mesh);
        base::Random random({.seed = 5});
        int inside = 0;
        for (int i = 0; i < 600; ++i) {
            base::Vec3 point;
            for (int axis = 0; axis < 3; ++axis)
                point[axis] = random.uniform(box.low[axis], box.high[axis]);
            const double outside = calcOutside(shape->pieces, point);
            if (calcWindingNumber(mesh, point) > 0.5) {
                ++inside;
                QVERIFY(outside <= 0.0 || calcDistance(surfaces, point) <= shape->deviation);
            } else if (outside < 0.0) {
                QVERIFY(surface.calcDistance(point) <= shape->deviation);
            }
        }
        QVERIFY(inside > 50);
        // Corners of the surface are where simplifying would lose most.
        for (std::size_t i = 0; i < mesh.vertices.size(); i += mesh.vertices.size() / 1000 + 1)
            QVERIFY(calcOutside(shape->pieces, mesh.vertices[i]) <= 0.0 ||
                    calcDistance(surfaces, mesh.vertices[i]) <= shape->deviation);
        // Corners of pieces and the middles of their faces and edges are where they would reach out most.
        std::vector<base::Vec3> features;
        for (const ConvexPolytope& piece : shape->pieces) {
            for (const base::Vec3& point : listFeatures(piece))
                if (surface.calcDistance(point) > shape->deviation) features.push_back(point);
        }
        for (const base::Vec3& point : features)  // deep inside, between pieces
            QVERIFY(calcWindingNumber(mesh, point) > 0.5);
    }

    void simpleSolidsAreAsTheyWere_data() {
        QTest::addColumn<TriangleMesh>("mesh");
        QTest::newRow("box") << shapes::makeBox({0, 0, 0}, {4 * kMm, 8 * kMm, 12 * kMm});
        QTest::newRow("L bracket") << shapes::makeL();
        QTest::newRow("cup") << shapes::makeCup(32, 5 * kMm, 10 * kMm, kMm);
        QTest::newRow("ball") << makeBall(48, 24, 5 * kMm);
    }

    void simpleSolidsAreAsTheyWere() {
        QFETCH(TriangleMesh, mesh);
        const auto shape = computeContactShape(mesh);
        const auto pieces = computeConvexPieces(mesh);
        const auto hull = computeConvexHull(mesh);
        QVERIFY(shape.ok() && pieces.ok() && hull.ok());
        QCOMPARE(shape->deviation, 0.0);
        QCOMPARE(shape->triangles, std::size_t{0});
        QVERIFY(shape->hull.vertices == hull->vertices);
        QCOMPARE(shape->exactCorners, hull->vertices.size());
        QCOMPARE(shape->pieces.size(), pieces->size());
        for (std::size_t i = 0; i < pieces->size(); ++i)
            QVERIFY(shape->pieces[i].vertices == (*pieces)[i].vertices);
    }

    void fineBallHasASimplerHull() {
        const TriangleMesh mesh = makeBall(240, 120, 5 * kMm);
        const auto shape = computeContactShape(mesh);
        QVERIFY2(shape.ok(), shape.ok() ? "" : shape.error().message.c_str());
        QCOMPARE(shape->pieces.size(), std::size_t{1});
        QVERIFY(shape->hull.vertices.size() < 4000 && shape->exactCorners > 28000);
        QVERIFY(shape->hullDeviation > 0.0 && shape->hullDeviation < 0.02 * kMm);
        for (const base::Vec3& corner : mesh.vertices)
            QVERIFY(calcOutside(shape->pieces, corner) <= shape->hullDeviation + 1e-12);
    }

    /// A bar through a ball: told so, with a place.
    void surfaceThatCrossesItselfIsTold_data() {
        QTest::addColumn<int>("sides");
        QTest::newRow("few triangles") << 24;
        QTest::newRow("more than are cut apart exactly") << 160;
    }

    void surfaceThatCrossesItselfIsTold() {
        QFETCH(int, sides);
        TriangleMesh mesh = makeBall(sides, sides / 2, 3 * kMm);
        shapes::append(mesh, shapes::makeBox({-5 * kMm, -1 * kMm, -1 * kMm}, {5 * kMm, 1 * kMm, 1 * kMm}));
        const auto shape = computeContactShape(mesh);
        QVERIFY(!shape.ok());
        const QString told = QString::fromStdString(shape.error().message);
        QVERIFY2(told.contains("crosses or touches itself, at ("), qPrintable(told));
    }
};

QTEST_APPLESS_MAIN(ContactShapeTest)
#include "contact_shape_test.moc"
