#include "core/study/orientation_shares.h"

#include <QtTest>

#include "core/part/part_builder.h"
#include "core/part/shapes.h"

using namespace trapwright;

namespace {

base::Quaternion about(const base::Vec3& axis, double degrees) {
    return base::Quaternion(Eigen::AngleAxisd(degrees * base::kDegree, axis));
}

part::Part built(const geometry::TriangleMesh& mesh) {
    part::PartOptions options;
    options.density = 1000.0;
    return part::buildPart(mesh, options)->part;
}

part::Part cuboid() {
    return built(part::makeBox({4e-3, 8e-3, 12e-3}));
}

part::Part cone() {
    const std::vector<base::Vec2> profile{{0.0, 0.0}, {5e-3, 0.0}, {0.0, 12e-3}};
    return built(part::makeTurned(profile, 48));
}

trial::Outcome ended(trial::Ending ending, const base::Quaternion& start, const base::Quaternion& finish) {
    trial::Outcome trial;
    trial::PartOutcome& outcome = trial.parts.emplace_back();
    outcome.ending = ending;
    outcome.initial.rotation = start;
    outcome.farthest.rotation = finish;
    return trial;
}

}  // namespace

class OrientationSharesTest : public QObject {
    Q_OBJECT

 private slots:
    void cuboidHasThreeKindsOfPoses() {
        const study::OrientationShares shares =
            study::calcOrientationShares(cuboid(), {}, base::Quaternion::Identity());
        QCOMPARE(shares.poses.size(), std::size_t{3});
        for (const study::PoseShare& share : shares.poses)
            QCOMPARE(share.poses.size(), std::size_t{2});  // opposite faces
    }

    void coneHasNoAlikePoses() {
        const part::Part part = cone();
        const study::OrientationShares shares =
            study::calcOrientationShares(part, {}, base::Quaternion::Identity());
        QCOMPARE(shares.poses.size(), part.stablePoses.size());
    }

    void partsAreCountedWhereTheyLie() {
        const part::Part part = cuboid();
        const base::Quaternion& first = part.stablePoses[0].rotation;
        // The same face below with another heading, and turned about a symmetry axis.
        const base::Quaternion turned = about(base::Vec3::UnitZ(), 70) * first;
        const base::Quaternion opposite = about(base::Vec3::UnitX(), 180) * first;
        const base::Quaternion other = about(base::Vec3::UnitX(), 90) * first;
        const std::vector<trial::Outcome> outcomes{ended(trial::Ending::finished, other, turned),
                                                   ended(trial::Ending::finished, turned, opposite),
                                                   ended(trial::Ending::fellOff, first, other)};
        const study::OrientationShares shares = study::calcOrientationShares(part, outcomes, first);
        QCOMPARE(shares.poses[0].start, 2);
        QCOMPARE(shares.poses[0].finish, 2);
        int starts = 0;
        int finishes = 0;
        for (const study::PoseShare& share : shares.poses) {
            starts += share.start;
            finishes += share.finish;
        }
        QCOMPARE(starts, 3);
        QCOMPARE(finishes, 2);
        QCOMPARE(shares.startAngles.size(), std::size_t{3});
        QCOMPARE(shares.finishAngles.size(), std::size_t{2});
        QVERIFY(std::abs(shares.finishAngles[0]) < 1e-6);  // turned about a symmetry axis
        QVERIFY(std::abs(shares.finishAngles[1] / base::kDegree - 70.0) < 1e-6);
        QVERIFY(std::is_sorted(shares.startAngles.begin(), shares.startAngles.end()));
    }
};

QTEST_APPLESS_MAIN(OrientationSharesTest)
#include "orientation_shares_test.moc"
