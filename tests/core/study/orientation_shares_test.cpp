#include "core/study/orientation_shares.h"

#include <QtTest>
#include <array>
#include <cmath>

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
        const study::OrientationShares shares = study::calcOrientationShares(cuboid(), {}, trial::Goal());
        QCOMPARE(shares.poses.size(), std::size_t{3});
        for (const study::PoseShare& share : shares.poses)
            QCOMPARE(share.poses.size(), std::size_t{2});  // opposite faces
    }

    void coneHasNoAlikePoses() {
        const part::Part part = cone();
        const study::OrientationShares shares = study::calcOrientationShares(part, {}, trial::Goal());
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
        const study::OrientationShares shares =
            study::calcOrientationShares(part, outcomes, trial::makeGoal(first));
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

    // Three ways of a wedge, 5, 3 and 2 parts, each scattered by less than the tolerance; who does not finish
    // ends in no way.
    void endsAreFoundByFrequency() {
        const std::array corners{base::Vec2(0.0, 0.0), base::Vec2(12e-3, 0.0), base::Vec2(0.0, 7e-3)};
        const part::Part part = built(part::makePrism(corners, 6e-3));
        QVERIFY(part.stablePoses.size() >= 3);
        struct Way {
            std::size_t pose;
            double heading, tilt;  // [deg]
            int count;
        };
        const std::array ways{Way{1, 120.0, 0.0, 5}, Way{1, -60.0, 0.0, 3}, Way{2, 30.0, 12.0, 2}};
        std::vector<trial::Outcome> outcomes{
            ended(trial::Ending::stuck, base::Quaternion::Identity(), base::Quaternion::Identity())};
        for (const Way& way : ways) {
            for (int i = 0; i < way.count; ++i) {
                const base::Quaternion end = about(base::Vec3::UnitX(), way.tilt) *
                                             about(base::Vec3::UnitZ(), way.heading + 4.0 * (i % 2)) *
                                             part.stablePoses[way.pose].rotation;
                outcomes.push_back(ended(trial::Ending::finished, base::Quaternion::Identity(), end));
            }
        }
        const auto modes = study::findEndModes(part, outcomes, 25.0 * base::kDegree, 12);
        QCOMPARE(modes.size(), ways.size());
        for (std::size_t i = 0; i < ways.size(); ++i) {
            QCOMPARE(modes[i].count, ways[i].count);
            QCOMPARE(modes[i].pose, ways[i].pose);
            QVERIFY(std::abs(modes[i].tilt / base::kDegree - ways[i].tilt) < 0.5);
            QVERIFY(std::abs(modes[i].heading / base::kDegree - ways[i].heading - 2.0) < 3.0);
        }
        QCOMPARE(study::findEndModes(part, outcomes, 25.0 * base::kDegree, 2).size(), std::size_t{2});
        QVERIFY(study::findEndModes(part, {}, 25.0 * base::kDegree, 2).empty());
    }
};

QTEST_APPLESS_MAIN(OrientationSharesTest)
#include "orientation_shares_test.moc"
