#include "core/verify/scenes.h"

#include <QtTest>
#include <cmath>

#include "core/base/random.h"
#include "core/geometry/mesh_check.h"

using namespace trapwright;
using base::kMillimetre;
using base::Vec3;

class ScenesTest : public QObject {
    Q_OBJECT

 private slots:
    void tracksAreSolids_data() {
        QTest::addColumn<int>("scene");
        QTest::newRow("flat") << 0;
        QTest::newRow("slope") << 1;
        QTest::newRow("rough") << 2;
        QTest::newRow("hills") << 3;
    }
    void tracksAreSolids() {
        QFETCH(int, scene);
        const auto track = scene == 0   ? verify::makeFlat()
                           : scene == 1 ? verify::makeSlope(0.3, 0.2)
                           : scene == 2 ? verify::makeRough()
                                        : verify::makeHills(1.0 * kMillimetre);
        QVERIFY(geometry::checkMesh(track->solid, true).isSolid());
        QCOMPARE(geometry::checkMesh(track->solid, true).overlappingTriangles, 0);
        // The surface comes first, and all of it looks up.
        for (std::size_t t = 0; t < track->surfaceTriangles; ++t)
            QVERIFY(geometry::triangleNormal(track->solid, t).z() > 0.1);
        QVERIFY(std::abs(track->start - track->begin() - 60.0 * kMillimetre) < 1e-15);
        QVERIFY(track->finish > track->start && track->finish <= track->end());
    }

    void surfaceHeightOfAPlaneIsThePlane() {
        const double slopeX = 0.2;
        const double slopeY = 0.1;
        const auto slope = verify::makeSlope(slopeX, slopeY);
        base::Random random({1, 0, 0, 0, base::Purpose::test});
        const double corner = verify::findSurfaceHeight(*slope, 0.0, 0.0);
        for (int i = 0; i < 200; ++i) {
            const double x = random.uniform(0.0, 0.6);
            const double y = random.uniform(-0.3, 0.3);
            const double expected = corner + x * std::tan(slopeX) + y * std::tan(slopeY);
            QVERIFY(std::abs(verify::findSurfaceHeight(*slope, x, y) - expected) < 1e-12);
        }
    }

    // At the grid's points the surface is the function; in between it stays between its neighbours.
    void surfaceHeightIsTheFunctionOnTheGrid() {
        const auto height = [](double x, double y) { return 0.01 + 3.0 * x * x + x * y - 2.0 * y * y; };
        const std::vector<double> xs = {0.0, 0.01, 0.03, 0.04};
        const std::vector<double> ys = {-0.02, 0.0, 0.01};
        const auto track = verify::makeSurface(xs, ys, height);
        for (std::size_t i = 0; i < xs.size(); ++i) {
            for (std::size_t j = 0; j < ys.size(); ++j) {
                QVERIFY(std::abs(verify::findSurfaceHeight(*track, xs[i], ys[j]) - height(xs[i], ys[j])) <
                        1e-12);
                if (i == 0 || j == 0) continue;
                const double corners[4] = {height(xs[i - 1], ys[j - 1]), height(xs[i - 1], ys[j]),
                                           height(xs[i], ys[j - 1]), height(xs[i], ys[j])};
                const double middle =
                    verify::findSurfaceHeight(*track, 0.5 * (xs[i - 1] + xs[i]), 0.5 * (ys[j - 1] + ys[j]));
                QVERIFY(middle >= *std::min_element(corners, corners + 4));
                QVERIFY(middle <= *std::max_element(corners, corners + 4));
            }
        }
        QVERIFY(verify::findSurfaceHeight(*track, 0.05, 0.0) < -1.0);
    }

    void aCuboidsMassPropertiesAreTheClosedForm() {
        const Vec3 size(3e-3, 5e-3, 7e-3);
        const auto part = verify::makeCuboid(size, 2000.0);
        const double mass = 2000.0 * size.prod();
        const geometry::MassProperties& got = part->massProperties;
        QVERIFY(std::abs(got.mass / mass - 1.0) < 1e-12);
        QVERIFY(got.centre.norm() < 1e-15);
        const Vec3 squares = size.cwiseProduct(size);
        const Vec3 inertia = mass / 12.0 * (Vec3::Constant(squares.sum()) - squares);
        QVERIFY((got.inertia - base::Mat3(inertia.asDiagonal())).norm() < 1e-12 * inertia.norm());
        QVERIFY(geometry::checkMesh(part->mesh, true).isSolid());
        QCOMPARE(part->pieces.size(), 1U);
        QCOMPARE(part->hull.vertices.size(), 8U);
        QCOMPARE(part->hull.faces.size(), 6U);
        QVERIFY(std::abs(part->boundingRadius - 0.5 * size.norm()) < 1e-15);
        // The named symmetries map the corners onto corners.
        for (const base::Quaternion& rotation : part->symmetry.rotations)
            for (const Vec3& vertex : part->hull.vertices)
                QVERIFY(((rotation * vertex).cwiseAbs() - 0.5 * size).norm() < 1e-15);
    }

    void thePapersCuboidWeighs400Milligrams() {
        QVERIFY(std::abs(verify::makePaperCuboid()->massProperties.mass - 0.39936e-3) < 1e-12);
    }

    void energyIsKineticAndPotential() {
        const trial::TrialBatch scene =
            verify::makeStillScene(verify::makeFlat(), verify::makePaperCuboid(), {}, 1.0);
        const double mass = 0.39936e-3;
        trial::TrajectorySample sample;
        sample.parts.resize(1);
        sample.parts[0].room.position.z() = 0.5;
        sample.parts[0].velocity = Vec3(0.3, -0.4, 0.0);
        // About the long axis, which the rotation lays along the room's x axis.
        sample.parts[0].room.rotation = base::Quaternion::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitX());
        sample.parts[0].angularVelocity = Vec3(50.0, 0.0, 0.0);
        const double inertia = mass / 12.0 * (16e-6 + 64e-6);
        const double expected =
            0.5 * mass * 0.25 + 0.5 * inertia * 2500.0 + mass * base::kStandardGravity * 0.5;
        QVERIFY(std::abs(verify::calcEnergy(scene, sample) / expected - 1.0) < 1e-12);
    }

    void aStillSceneIsStill() {
        const base::Pose pose{base::Quaternion::Identity(), Vec3(0.1, 0.0, 0.03)};
        const trial::TrialBatch scene =
            verify::makeStillScene(verify::makeFlat(), verify::makePaperCuboid(), pose, 3.0);
        QCOMPARE(scene.trials.size(), 1U);
        QVERIFY(scene.trials[0].parts[0].pose == pose);
        QCOMPARE(scene.drive.halfStroke, 0.0);
        QCOMPARE(scene.termination.timeLimit, 3.0);
        QVERIFY(scene.termination.stuckTime > 3.0);
        QVERIFY(!trial::findProblem(scene).has_value());
    }
};

QTEST_APPLESS_MAIN(ScenesTest)
#include "scenes_test.moc"
