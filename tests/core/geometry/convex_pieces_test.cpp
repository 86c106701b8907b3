#include "core/geometry/convex_pieces.h"

#include <QTest>
#include <algorithm>

#include "core/base/random.h"
#include "core/geometry/convex_hull.h"
#include "core/geometry/mass_properties.h"
#include "core/geometry/triangle_mesh.h"
#include "shapes.h"

using namespace trapwright;
using namespace trapwright::geometry;

namespace {

constexpr double kMm = base::kMillimetre;

double sumVolumes(const std::vector<ConvexPolytope>& pieces) {
    double sum = 0.0;
    for (const ConvexPolytope& piece : pieces)
        sum += calcMassProperties(toMesh(piece), 1.0).volume;
    return sum;
}

int countContaining(const std::vector<ConvexPolytope>& pieces, const base::Vec3& point, double margin) {
    return static_cast<int>(std::count_if(pieces.begin(), pieces.end(), [&](const ConvexPolytope& piece) {
        return contains(piece, point, margin);
    }));
}

/// Turned, and rounded as in an STL file, so that no two triangles are exactly in one plane.
TriangleMesh makeNoisy(TriangleMesh mesh) {
    shapes::transform(mesh, {base::Quaternion(Eigen::AngleAxisd(0.4, base::Vec3(3, 1, 2).normalized())),
                             base::Vec3(0.001, 0.002, 0.003)});
    for (base::Vec3& vertex : mesh.vertices)
        vertex = vertex.cast<float>().cast<double>();
    return mesh;
}

}  // namespace

class ConvexPiecesTest : public QObject {
    Q_OBJECT

 private slots:
    void solids_data() {
        QTest::addColumn<TriangleMesh>("mesh");
        QTest::addColumn<int>("most");
        QTest::addColumn<double>("tolerance");
        const auto row = [](const char* name, const TriangleMesh& mesh, int most) {
            QTest::newRow(name) << mesh << most << 1e-9;
            QTest::addRow("%s, noisy", name) << makeNoisy(mesh) << most << 1e-4;
        };
        row("cuboid", shapes::makeBox({0, 0, 0}, {4 * kMm, 8 * kMm, 12 * kMm}), 1);
        row("64-sided cylinder", shapes::makePrism(shapes::makeCircle(64, 3 * kMm), 10 * kMm), 1);
        row("L bracket", shapes::makeL(), 2);
        row("24-sided cup", shapes::makeCup(24, 5 * kMm, 10 * kMm, kMm), 25);
        row("32-sided cup", shapes::makeCup(32, 5 * kMm, 10 * kMm, kMm), 33);
        row("stepped pin",
            shapes::makeTurned({{2 * kMm, 0}, {2 * kMm, 6 * kMm}, {4 * kMm, 6 * kMm}, {4 * kMm, 8 * kMm}},
                               64),
            2);
        TriangleMesh two = shapes::makeBox({0, 0, 0}, {kMm, kMm, kMm});
        shapes::append(two, shapes::makeBox({2 * kMm, 0, 0}, {4 * kMm, kMm, kMm}));
        row("two boxes apart", two, 2);
        TriangleMesh hollow = shapes::makeBox({0, 0, 0}, {6 * kMm, 6 * kMm, 6 * kMm});
        TriangleMesh cavity = shapes::makeBox({kMm, kMm, kMm}, {5 * kMm, 4 * kMm, 3 * kMm});
        shapes::turnInsideOut(cavity);
        shapes::append(hollow, cavity);
        row("box with a cavity", hollow, 6);
    }
    /// Volumes add up, points inside are in exactly one piece, points outside in none.
    void solids() {
        QFETCH(TriangleMesh, mesh);
        QFETCH(int, most);
        QFETCH(double, tolerance);
        const auto pieces = computeConvexPieces(mesh);
        QVERIFY2(pieces.ok(), pieces.ok() ? "" : pieces.error().message.c_str());
        QVERIFY2(static_cast<int>(pieces->size()) <= most, qPrintable(QString::number(pieces->size())));
        const double volume = calcMassProperties(mesh, 1.0).volume;
        QVERIFY(std::abs(sumVolumes(*pieces) / volume - 1.0) <= tolerance);

        const Box box = calcBoundingBox(mesh);
        base::Random random({.seed = 1});
        int inside = 0;
        for (int i = 0; i < 2000; ++i) {
            base::Vec3 point;
            for (int axis = 0; axis < 3; ++axis)
                point[axis] = random.uniform(box.low[axis], box.high[axis]);
            const double margin = 1e-3 * kMm;
            if (calcWindingNumber(mesh, point) > 0.5) {
                ++inside;
                QVERIFY(countContaining(*pieces, point, margin) >= 1);
                QVERIFY(countContaining(*pieces, point, -margin) <= 1);
            } else {
                QCOMPARE(countContaining(*pieces, point, -margin), 0);
            }
        }
        QVERIFY(inside > 100);
    }

    void hollowAndInnerCornerStayFree() {
        const auto cup = computeConvexPieces(shapes::makeCup(24, 5 * kMm, 10 * kMm, kMm));
        QVERIFY(cup.ok());
        QCOMPARE(countContaining(*cup, {0, 0, 5 * kMm}, 0.0), 0);
        QCOMPARE(countContaining(*cup, {3.9 * kMm, 0, 1.01 * kMm}, 0.0), 0);
        const auto bracket = computeConvexPieces(shapes::makeL());
        QVERIFY(bracket.ok());
        QCOMPARE(countContaining(*bracket, {2.01 * kMm, 2.01 * kMm, 2 * kMm}, 0.0), 0);
    }

    /// Curved inward everywhere: only nearly the part, but nowhere fatter.
    void waistedBodyIsNotFattened() {
        std::vector<base::Vec2> profile;
        for (int i = 0; i <= 12; ++i)
            profile.emplace_back((4.0 - 1.5 * std::sin(base::kPi * i / 12)) * kMm, 10.0 * kMm * i / 12);
        const TriangleMesh mesh = makeNoisy(shapes::makeTurned(profile, 24));
        const auto pieces = computeConvexPieces(mesh);
        QVERIFY2(pieces.ok(), pieces.ok() ? "" : pieces.error().message.c_str());
        const double ratio = sumVolumes(*pieces) / calcMassProperties(mesh, 1.0).volume;
        QVERIFY(ratio > 0.99 && ratio < 1.001);

        const Box box = calcBoundingBox(mesh);
        base::Random random({.seed = 2});
        int inside = 0;
        int covered = 0;
        for (int i = 0; i < 2000; ++i) {
            base::Vec3 point;
            for (int axis = 0; axis < 3; ++axis)
                point[axis] = random.uniform(box.low[axis], box.high[axis]);
            const bool isInside = calcWindingNumber(mesh, point) > 0.5;
            const int count = countContaining(*pieces, point, -1e-3 * kMm);
            if (!isInside) QCOMPARE(count, 0);
            if (isInside) ++inside;
            if (isInside && countContaining(*pieces, point, 1e-3 * kMm) > 0) ++covered;
        }
        QVERIFY(covered > 0.98 * inside);
    }

    void mergingStopsAtItsTolerance() {
        const auto box = [](double x0, double x1, double height) {
            return *computeConvexHull(shapes::makeBox({x0, 0, 0}, {x1, 1, height}));
        };
        QCOMPARE(mergePieces({box(0, 1, 1), box(1, 2, 1), box(2, 3, 1)}, 1e-9).size(), std::size_t(1));
        // The hull of the two steps adds 0.0025.
        QCOMPARE(mergePieces({box(0, 1, 1), box(1, 2, 1.005)}, 1e-2).size(), std::size_t(1));
        QCOMPARE(mergePieces({box(0, 1, 1), box(1, 2, 1.005)}, 1e-3).size(), std::size_t(2));
        QCOMPARE(mergePieces({box(0, 1, 1), box(1, 2, 2)}, 10.0).size(), std::size_t(2));
    }

    void whatHasNoVolumeIsRefused() {
        TriangleMesh inverted = shapes::makeL();
        shapes::turnInsideOut(inverted);
        QVERIFY(!computeConvexPieces(inverted).ok());
        QVERIFY(!computeConvexPieces({}).ok());
        // Two boxes through each other: the volumes cannot add up.
        TriangleMesh crossing = shapes::makeBox({0, 0, 0}, {3, 1, 1});
        shapes::append(crossing, shapes::makeBox({1, -1, 0.25}, {2, 2, 0.75}));
        const auto pieces = computeConvexPieces(crossing);
        QVERIFY(!pieces.ok());
        QVERIFY(pieces.error().message.find("crosses or touches itself, at (") != std::string::npos);
    }
};

QTEST_APPLESS_MAIN(ConvexPiecesTest)
#include "convex_pieces_test.moc"
