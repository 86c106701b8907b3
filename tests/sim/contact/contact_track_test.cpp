#include "sim/contact/contact_track.h"

#include <QtTest>
#include <cmath>

#include "core/verify/scenes.h"
#include "sim/contact/formulas/scalar.h"

using namespace trapwright;
using base::Vec3;

namespace {

/// An open sheet over a grid of 10 mm cells, two along y; heights of its columns x = 0, 10, 20 mm ...
geometry::TriangleMesh makeSheet(const std::vector<double>& heights) {
    constexpr int kRows = 3;
    geometry::TriangleMesh mesh;
    for (std::size_t i = 0; i < heights.size(); ++i)
        for (int j = 0; j < kRows; ++j)
            mesh.vertices.emplace_back(0.01 * static_cast<double>(i), 0.01 * j, heights[i]);
    for (int i = 0; i + 1 < static_cast<int>(heights.size()); ++i) {
        for (int j = 0; j + 1 < kRows; ++j) {
            const int a = kRows * i + j;
            mesh.triangles.push_back({a, a + kRows, a + 1});
            mesh.triangles.push_back({a + 1, a + kRows, a + kRows + 1});
        }
    }
    return mesh;
}

/// How far a triangle reaches past its own border. [m]
double slackOf(const contact::TrackTriangle& triangle, int side, const geometry::TriangleMesh& mesh,
               std::size_t index) {
    const Vec3& corner = mesh.vertices[mesh.triangles[index][side]];
    return triangle.edgeOffset[side] - triangle.edgeNormal[side].dot(corner);
}

}  // namespace

class ContactTrackTest : public QObject {
    Q_OBJECT

 private slots:
    void nothingActsOnAFlatSheet() {
        const auto mesh = makeSheet({0.0, 0.0, 0.0});
        const contact::ContactTrack track = contact::prepareTrack(mesh);
        QCOMPARE(track.triangles.size(), mesh.triangles.size());
        QVERIFY(track.edges.empty() && track.vertices.empty());
        for (std::size_t t = 0; t < track.triangles.size(); ++t) {
            QVERIFY((track.triangles[t].normal - Vec3::UnitZ()).norm() < 1e-15);
            for (int side = 0; side < 3; ++side)
                QVERIFY(std::abs(slackOf(track.triangles[t], side, mesh, t) - contact::kEdgeSlack) < 1e-15);
        }
    }

    void aRidgeActsAlongItsCrest() {
        const auto mesh = makeSheet({0.0, 0.01, 0.0});
        const contact::ContactTrack track = contact::prepareTrack(mesh);
        QCOMPARE(track.edges.size(), 2U);  // the crest is two cells long
        for (const contact::TrackEdge& edge : track.edges) {
            QVERIFY(std::abs(edge.centre.x() - 0.01) < 1e-15 && std::abs(edge.centre.z() - 0.01) < 1e-15);
            QVERIFY(std::abs(std::abs(edge.direction.y()) - 1.0) < 1e-15);
            // At the sheet's borders, which no solid has, it may be longer.
            QVERIFY(edge.radius > 5e-3 - 1e-15 && edge.radius < 5e-3 + 0.5 * contact::kCornerSlack + 1e-15);
            QVERIFY((edge.outward - Vec3::UnitZ()).norm() < 1e-12);
            // Both flanks fall away at 45 degrees, one to each side.
            QVERIFY(std::abs(edge.into[0].z() + std::sqrt(0.5)) < 1e-12);
            QVERIFY(std::abs(edge.into[1].z() + std::sqrt(0.5)) < 1e-12);
            QVERIFY(std::abs(edge.into[0].x() + edge.into[1].x()) < 1e-12);
        }
        QCOMPARE(track.vertices.size(), 3U);
        // No triangle reaches to the crest.
        for (std::size_t t = 0; t < track.triangles.size(); ++t) {
            for (int side = 0; side < 3; ++side) {
                const Vec3 middle = 0.5 * (mesh.vertices[mesh.triangles[t][side]] +
                                           mesh.vertices[mesh.triangles[t][(side + 1) % 3]]);
                const bool crest = middle.z() == 0.01;
                const double expected = crest ? -contact::scalar::kBorder : contact::kEdgeSlack;
                QCOMPARE(track.triangles[t].ridges[side], crest ? contact::kFar : 0.0);
                QVERIFY(std::abs(slackOf(track.triangles[t], side, mesh, t) - expected) < 1e-15);
            }
        }
    }

    // At the foot of a wall, where it lies on or in the solid beyond its end; not over an edge, nor where it
    // only goes on as it was.
    void aRidgeActsBeyondItsEndInsideTheSolid() {
        const auto lengthOf = [](double before, double behind) {
            // A crest along x at y = 0 in 20 mm steps, the middle one level.
            const auto solid =
                verify::makeSurface({0.0, 0.02, 0.04, 0.06}, {-0.03, 0.0, 0.03}, [&](double x, double y) {
                    const double crest = x == 0.0 ? before : x == 0.06 ? behind : 0.0;
                    return 20e-3 + crest - 0.5 * std::abs(y);
                });
            const contact::ContactTrack track = contact::prepareTrack(solid->solid);
            for (const contact::TrackEdge& edge : track.edges) {
                if (std::abs(edge.centre.y()) < 1e-12 && std::abs(edge.centre.x() - 0.03) < 1e-3 &&
                    std::abs(edge.centre.z() - 20e-3) < 1e-3)
                    return 2.0 * edge.radius - 0.02;
            }
            return -1.0;
        };
        QVERIFY(std::abs(lengthOf(0.0, 0.0)) < 1e-12);
        QVERIFY(std::abs(lengthOf(-5e-3, -5e-3)) < 1e-12);
        QVERIFY(std::abs(lengthOf(5e-3, -5e-3) - contact::kCornerSlack) < 1e-12);
        QVERIFY(std::abs(lengthOf(5e-3, 5e-3) - 2.0 * contact::kCornerSlack) < 1e-12);
    }

    // A border goes on straight, and beside it rises a wall.
    void aRidgeActsBeyondItsEndAlongAWall() {
        const auto solid =
            verify::makeSurface({0.0, 0.02, 0.025, 0.06}, {-0.03, 0.0, 0.03},
                                [](double x, double y) { return x > 0.022 && y > -0.01 ? 40e-3 : 20e-3; });
        const contact::ContactTrack track = contact::prepareTrack(solid->solid);
        double length = 0.0;
        for (const contact::TrackEdge& edge : track.edges) {
            const Vec3 off = edge.centre - Vec3(0.0225, -0.03, 20e-3);
            if (off.norm() < 1e-3 && std::abs(edge.direction.x()) > 0.999) length = 2.0 * edge.radius;
        }
        QVERIFY(std::abs(length - 0.005 - contact::kCornerSlack) < 1e-12);
    }

    void theBorderOfAValleyActsBeyondItsEnd_data() {
        QTest::addColumn<double>("bend");  // of the upright side at the valley, outward [deg]
        QTest::addColumn<bool>("acts");
        QTest::newRow("straight") << 0.0 << true;
        QTest::newRow("as from piece to piece of a bowl") << 2.5 << true;
        QTest::newRow("a corner") << 10.0 << false;
    }

    // A bowl's border comes down into a valley and goes up again, bending: its way on is in the solid, but
    // for what the side bends outward.
    void theBorderOfAValleyActsBeyondItsEnd() {
        QFETCH(double, bend);
        QFETCH(bool, acts);
        const auto solid = verify::makeSurface({-5e-3, 0.0, 5e-3}, {-0.01, 0.01}, [](double x, double /*y*/) {
            return 10e-3 + 2.0 * std::abs(x);
        });
        geometry::TriangleMesh mesh = solid->solid;
        for (Vec3& vertex : mesh.vertices)
            if (vertex.y() < 0.0) vertex.y() += std::abs(vertex.x()) * std::tan(0.5 * bend * base::kDegree);
        double length = 0.0;
        for (const contact::TrackEdge& edge : contact::prepareTrack(mesh).edges)
            if ((edge.centre - Vec3(-2.5e-3, -0.01, 15e-3)).norm() < 1e-3) length = 2.0 * edge.radius;
        const double own = std::hypot(5e-3, 5e-3 * std::tan(0.5 * bend * base::kDegree), 10e-3);
        QVERIFY(std::abs(length - own - (acts ? contact::kCornerSlack : 0.0)) < 1e-12);
    }

    void aValleyHasSlackInstead() {
        const auto mesh = makeSheet({0.01, 0.0, 0.01});
        const contact::ContactTrack track = contact::prepareTrack(mesh);
        QVERIFY(track.edges.empty() && track.vertices.empty());
        for (std::size_t t = 0; t < track.triangles.size(); ++t) {
            for (int side = 0; side < 3; ++side) {
                const Vec3 middle = 0.5 * (mesh.vertices[mesh.triangles[t][side]] +
                                           mesh.vertices[mesh.triangles[t][(side + 1) % 3]]);
                const double expected = middle.z() == 0.0 ? contact::kCornerSlack : contact::kEdgeSlack;
                QVERIFY(std::abs(slackOf(track.triangles[t], side, mesh, t) - expected) < 1e-15);
            }
        }
    }

    // A flank acts beyond a valley no farther than half of what rises there.
    void aLowStepHasLessSlack() {
        for (const double step : {0.02e-3, 0.1e-3, 0.5e-3}) {
            const auto solid = verify::makeSurface({0.0, 0.05, 0.0501, 0.1}, {-0.03, 0.0, 0.03},
                                                   [&](double x, double) { return x > 0.05 ? step : 0.0; });
            const contact::ContactTrack track = contact::prepareTrack(solid->solid);
            double most = 0.0;
            for (std::size_t t = 0; t < solid->surfaceTriangles; ++t) {
                if (track.triangles[t].centre.x() > 0.05) continue;  // not of what lies before the step
                for (int side = 0; side < 3; ++side)
                    most = std::max(most, slackOf(track.triangles[t], side, solid->solid, t));
            }
            const double rise = 0.5 * std::hypot(step, 0.1e-3);
            QVERIFY(std::abs(most - std::min(rise, contact::kCornerSlack)) < 1e-12);
        }
    }

    void onlyStrictlyConvexEdgesAct_data() {
        QTest::addColumn<double>("degrees");
        QTest::addColumn<int>("edges");
        QTest::newRow("flat but for rounding") << 1e-9 << 0;
        QTest::newRow("1.9 deg") << 1.9 << 0;
        QTest::newRow("2.1 deg") << 2.1 << 2;
        QTest::newRow("90 deg") << 90.0 << 2;
        QTest::newRow("178 deg, a blade") << 178.0 << 2;
        QTest::newRow("a valley of 2.1 deg") << -2.1 << 0;
        QTest::newRow("a cleft of 178 deg") << -178.0 << 0;
    }
    void onlyStrictlyConvexEdgesAct() {
        QFETCH(double, degrees);
        QFETCH(int, edges);
        const double rise = 0.01 * std::tan(0.5 * degrees * base::kDegree);
        QCOMPARE(static_cast<int>(contact::prepareTrack(makeSheet({0.0, rise, 0.0})).edges.size()), edges);
    }

    // The 12 edges of the solid, however many triangles it is made of, and nothing within its faces.
    void theBordersOfAClosedSolidAct() {
        const auto flat = verify::makeFlat();
        const contact::ContactTrack track = contact::prepareTrack(flat->solid);
        const geometry::Box box = geometry::calcBoundingBox(flat->solid);
        double length = 0.0;
        for (const contact::TrackEdge& edge : track.edges) {
            length += 2.0 * edge.radius;
            int faces = 0;
            for (int k = 0; k < 3; ++k)
                faces += std::abs(edge.centre[k] - box.low[k]) < 1e-12 ||
                         std::abs(edge.centre[k] - box.high[k]) < 1e-12;
            QCOMPARE(faces, 2);
            const Vec3 out = edge.centre - 0.5 * (box.low + box.high);
            QVERIFY(edge.outward.dot(out) > 0.0);
        }
        QVERIFY(std::abs(length - 4.0 * box.size().sum()) < 1e-12);
    }

    void aVertexKnowsAllItsEdges() {
        const auto cuboid = verify::makePaperCuboid();
        const contact::ContactTrack track = contact::prepareTrack(cuboid->mesh);
        QCOMPARE(track.edges.size(), 12U);
        QCOMPARE(track.vertices.size(), 8U);
        for (const contact::TrackVertex& vertex : track.vertices) {
            QVERIFY(vertex.edgeCount >= 3);
            for (int e = 0; e < vertex.edgeCount; ++e) {
                const Vec3& direction = track.vertexEdges[vertex.firstEdge + e];
                QVERIFY(std::abs(direction.norm() - 1.0) < 1e-12);
                // All edges of a corner lead into the cuboid's octant.
                QVERIFY((direction.array() * vertex.position.array() < 1e-12).all());
            }
        }
    }

    void degenerateTrianglesAreLeftOut() {
        auto mesh = makeSheet({0.0, 0.01, 0.0});
        const contact::ContactTrack clean = contact::prepareTrack(mesh);
        mesh.triangles.insert(mesh.triangles.begin(), {0, 1, 2});  // three points in a line
        mesh.triangles.push_back({4, 4, 5});
        const contact::ContactTrack track = contact::prepareTrack(mesh);
        QCOMPARE(track.triangles.size(), clean.triangles.size());
        QCOMPARE(track.edges.size(), clean.edges.size());
        for (const contact::TrackTriangle& triangle : track.triangles)
            QVERIFY(triangle.normal.allFinite() && std::abs(triangle.normal.norm() - 1.0) < 1e-12);
    }
};

QTEST_APPLESS_MAIN(ContactTrackTest)
#include "contact_track_test.moc"
