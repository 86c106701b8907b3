#include "core/part/stable_poses.h"

#include <QTest>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/random.h"
#include "core/part/bundled.h"
#include "core/part/shapes.h"
#include "tests/core/part/centred_solid.h"

using namespace trapwright;
using base::kMillimetre;
using base::Quaternion;
using base::Vec2;
using base::Vec3;
using part::CentredSolid;

namespace {

double sumOf(const std::vector<part::StablePose>& poses) {
    double sum = 0.0;
    for (const part::StablePose& pose : poses)
        sum += pose.probability;
    return sum;
}

part::Part partOf(const CentredSolid& solid) {
    part::Part result;
    result.hull = solid.hull;
    result.symmetry = solid.symmetry();
    result.stablePoses = solid.poses();
    return result;
}

CentredSolid cuboid() {
    return CentredSolid(part::makeBox(Vec3(4, 8, 12) * kMillimetre));
}

}  // namespace

class StablePosesTest : public QObject {
    Q_OBJECT

 private slots:
    /// Closed form: a rectangle 2a x 2b at distance d has the solid angle 4 asin(ab / sqrt((a^2 + d^2)(b^2 +
    /// d^2))).
    void cuboidHasSolidAngles() {
        const std::vector<part::StablePose> poses = cuboid().poses();
        QCOMPARE(poses.size(), std::size_t{6});
        const std::array<double, 6> heights = {2, 2, 4, 4, 6, 6};
        const std::array<double, 6> published = {0.645, 0.645, 0.243, 0.243, 0.112, 0.112};
        for (std::size_t i = 0; i < 6; ++i) {
            const double d = heights[i];
            const double a = d == 2 ? 4 : 2;
            const double b = d == 6 ? 4 : 6;
            const double solidAngle = 4 * std::asin(a * b / std::sqrt((a * a + d * d) * (b * b + d * d)));
            QVERIFY(std::abs(poses[i].probability - solidAngle / (4 * base::kPi)) < 1e-12);
            QVERIFY(std::abs(2 * poses[i].probability - published[i]) < 5e-4);
            QVERIFY(std::abs(poses[i].height - d * kMillimetre) < 1e-12);
            QCOMPARE(poses[i].multiplicity, 1);
        }
        QVERIFY(std::abs(sumOf(poses) - 1.0) < 1e-12);
    }

    void alikePosesMerge() {
        const std::vector<part::StablePose> poses = cuboid().poses(true);
        QCOMPARE(poses.size(), std::size_t{3});
        for (const part::StablePose& pose : poses)
            QCOMPARE(pose.multiplicity, 2);
        QVERIFY(std::abs(poses[0].probability - 0.645) < 5e-4);
        QVERIFY(std::abs(sumOf(poses) - 1.0) < 1e-12);
    }

    void bundledPartsHavePoses_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<int>("poses");
        QTest::newRow("cuboid") << "cuboid" << 6;
        QTest::newRow("cone") << "cone" << 4;
        QTest::newRow("bracket") << "bracket" << 5;
        QTest::newRow("pin") << "pin" << 3;
        QTest::newRow("cup") << "cup" << 3;
    }

    /// Every pose puts all of the hull on or above the plane, with its centre of mass above the contact.
    void bundledPartsHavePoses() {
        QFETCH(QString, name);
        QFETCH(int, poses);
        const CentredSolid solid(part::makeBundledShape(name.toStdString()));
        const std::vector<part::StablePose> found = solid.poses();
        QCOMPARE(static_cast<int>(found.size()), poses);
        QVERIFY(std::abs(sumOf(found) - 1.0) < 1e-9);
        for (const part::StablePose& pose : found) {
            int touching = 0;
            Vec2 low = Vec2::Constant(1.0);
            Vec2 high = Vec2::Constant(-1.0);
            for (const Vec3& vertex : solid.hull.vertices) {
                const Vec3 placed = pose.rotation * vertex;
                QVERIFY(placed.z() > -pose.height - 1e-9);
                if (placed.z() > -pose.height + 1e-9) continue;
                ++touching;
                low = low.cwiseMin(placed.head<2>());
                high = high.cwiseMax(placed.head<2>());
            }
            QVERIFY(touching >= 3);
            QVERIFY((low.array() <= 0.0).all() && (high.array() >= 0.0).all());
        }
    }

    /// The cone's poses are the paper's four, each frequent enough to matter and far from the others.
    void conePosesAreDistinct() {
        const CentredSolid solid(part::makeBundledShape("cone"));
        const std::vector<part::StablePose> poses = solid.poses();
        const Vec3 axis = solid.symmetry().axis;
        std::vector<double> tilts;
        for (const part::StablePose& pose : poses) {
            QVERIFY(pose.probability > 0.02);
            tilts.push_back(std::acos(std::clamp((pose.rotation * axis).z(), -1.0, 1.0)) / base::kDegree);
        }
        std::sort(tilts.begin(), tilts.end());
        QCOMPARE(std::round(tilts.front()), 0.0);
        QCOMPARE(std::round(tilts.back()), 180.0);
        for (std::size_t i = 1; i < tilts.size(); ++i)
            QVERIFY(tilts[i] - tilts[i - 1] > 30.0);
    }

    /// A slab cut so askew that it cannot stand on its small end: that face's share goes to where it falls.
    void unstableFaceRollsOver() {
        const double mm = kMillimetre;
        const std::array<Vec2, 4> profile = {Vec2(0, 0), Vec2(3 * mm, 0), Vec2(15 * mm, 12 * mm),
                                             Vec2(12 * mm, 12 * mm)};
        const CentredSolid solid(part::makePrism(profile, 6 * mm));
        double unstable = 0.0;
        double below = 0.0;
        for (std::size_t i = 0; i < solid.hull.faces.size(); ++i) {
            const Vec3& normal = solid.hull.faces[i].normal;
            if (std::abs(normal.y()) > 0.999) unstable += part::calcSolidAngleShare(solid.hull, i);
            if (std::abs(normal.z()) < 0.1 && std::abs(normal.y()) < 0.999) {
                below += part::calcSolidAngleShare(solid.hull, i);
            }
        }
        QVERIFY(unstable > 0.01);
        const std::vector<part::StablePose> poses = solid.poses();
        QCOMPARE(poses.size(), std::size_t{4});
        double onSlope = 0.0;
        for (const part::StablePose& pose : poses) {
            const Vec3 down = pose.rotation.conjugate() * -Vec3::UnitZ();
            if (std::abs(down.z()) < 0.1) onSlope += pose.probability;
        }
        QVERIFY(std::abs(onSlope - below - unstable) < 1e-12);
    }

    /// A half round bar: its round side is one pose for all of its facets, although no symmetry says so.
    void facetsOfRoundSideAreOnePose() {
        std::vector<Vec2> profile;
        for (int i = 0; i <= 24; ++i) {
            const double angle = base::kPi * i / 24;
            profile.emplace_back(4 * kMillimetre * std::cos(angle), 4 * kMillimetre * std::sin(angle));
        }
        const std::vector<part::StablePose> poses =
            CentredSolid(part::makePrism(profile, 14 * kMillimetre)).poses();
        QCOMPARE(poses.size(), std::size_t{4});  // flat side, round side, two ends
    }

    /// Any stable pose turned about the vertical is found again; so is one that is a little off.
    void nearestPoseIsFound_data() {
        QTest::addColumn<QString>("name");
        for (const part::BundledPart& entry : part::listBundledParts()) {
            QTest::newRow(entry.name.data()) << QString::fromUtf8(entry.name.data());
        }
    }

    void nearestPoseIsFound() {
        QFETCH(QString, name);
        const part::Part part = partOf(CentredSolid(part::makeBundledShape(name.toStdString())));
        base::Random random({.seed = 3});
        for (std::size_t i = 0; i < part.stablePoses.size(); ++i) {
            for (int k = 0; k < 20; ++k) {
                const Quaternion heading(Eigen::AngleAxisd(random.uniform(0.0, 6.28), Vec3::UnitZ()));
                const Vec3 horizontal = heading * Vec3::UnitX();
                const Quaternion tilt(Eigen::AngleAxisd(5.0 * base::kDegree, horizontal));
                const Quaternion spin(Eigen::AngleAxisd(
                    part.symmetry.continuous ? random.uniform(0.0, 6.28) : 0.0, part.symmetry.axis));
                const Quaternion exact = heading * part.stablePoses[i].rotation * spin;
                QCOMPARE(part::findStablePose(part, exact).index, i);
                QVERIFY(part::findStablePose(part, exact).angle < 1e-6);
                const part::NearestPose near = part::findStablePose(part, tilt * exact);
                QCOMPARE(near.index, i);
                QVERIFY(near.angle < 5.1 * base::kDegree);
                // Laid down it is turned back by as much as it was tilted, and rests.
                const Quaternion laid = part::layDown(part, tilt * exact);
                QVERIFY(part::findStablePose(part, laid).angle < 1e-6);
                QVERIFY(std::abs(laid.angularDistance(tilt * exact) - near.angle) < 1e-6);
                QVERIFY(part.symmetry.continuous || laid.angularDistance(exact) < 1e-6);
            }
        }
    }

    /// Groups of alike poses: how many poses each has, most probable group first.
    void alikePosesAreOneGroup_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QList<int>>("sizes");
        QTest::newRow("cuboid, opposite faces") << "cuboid" << QList<int>{2, 2, 2};
        QTest::newRow("bolt: lying, on its head, on its tip") << "bolt" << QList<int>{6, 1, 1};
        QTest::newRow("cone") << "cone" << QList<int>{1, 1, 1, 1};
    }

    void alikePosesAreOneGroup() {
        QFETCH(QString, name);
        QFETCH(QList<int>, sizes);
        part::Part part = partOf(CentredSolid(part::makeBundledShape(name.toStdString())));
        const std::vector<part::PoseGroup> groups = part::findPoseGroups(part);
        QCOMPARE(static_cast<qsizetype>(groups.size()), sizes.size());
        double sum = 0.0;
        std::vector<bool> seen(part.stablePoses.size(), false);
        for (std::size_t i = 0; i < groups.size(); ++i) {
            QCOMPARE(static_cast<int>(groups[i].poses.size()), sizes[static_cast<qsizetype>(i)]);
            if (i > 0) QVERIFY(groups[i].probability <= groups[i - 1].probability);
            double own = 0.0;
            for (const int pose : groups[i].poses) {
                QVERIFY(!seen[static_cast<std::size_t>(pose)]);
                seen[static_cast<std::size_t>(pose)] = true;
                own += part.stablePoses[static_cast<std::size_t>(pose)].probability;
                QCOMPARE(part::findPoseGroup(groups, pose), static_cast<int>(i));
            }
            QVERIFY(std::abs(own - groups[i].probability) < 1e-12);
            sum += groups[i].probability;
        }
        QVERIFY(std::abs(sum - 1.0) < 1e-9);
        QVERIFY(std::find(seen.begin(), seen.end(), false) == seen.end());

        // Without symmetry every pose stands for itself.
        part.symmetry = {};
        QCOMPARE(part::findPoseGroups(part).size(), part.stablePoses.size());
    }

    void bracketHasNoAlikePosesWithoutSymmetry() {
        part::Part part = partOf(CentredSolid(part::makeBundledShape("bracket")));
        part.symmetry = {};
        QVERIFY(part.stablePoses.size() > 4);
        QCOMPARE(part::findPoseGroups(part).size(), part.stablePoses.size());
    }

    /// Both ends of a cylinder are one pose, and its round side is another.
    void endsOfACylinderAreAlike() {
        const std::array<Vec2, 4> profile = {Vec2(0, 0), Vec2(3e-3, 0), Vec2(3e-3, 10e-3), Vec2(0, 10e-3)};
        const part::Part part = partOf(CentredSolid(part::makeTurned(profile, 32)));
        QCOMPARE(part.stablePoses.size(), std::size_t{3});
        const std::vector<part::PoseGroup> groups = part::findPoseGroups(part);
        QCOMPARE(groups.size(), std::size_t{2});
        QCOMPARE(groups[0].poses.size(), std::size_t{1});
        QCOMPARE(groups[1].poses.size(), std::size_t{2});
    }

    // A pin of two cylinders: 8 mm of radius 3 mm and 5 mm of radius 1.5 mm. Its centre of mass is at
    // (9 x 8 x 4 + 2.25 x 5 x 10.5) / (9 x 8 + 2.25 x 5) = 4.88 mm of 13.
    void lengthAndOffsetAreThoseOfTheAxis() {
        const std::array<Vec2, 6> profile = {Vec2(0, 0),         Vec2(3e-3, 0),       Vec2(3e-3, 8e-3),
                                             Vec2(1.5e-3, 8e-3), Vec2(1.5e-3, 13e-3), Vec2(0, 13e-3)};
        const part::Part part = partOf(CentredSolid(part::makeTurned(profile, 48)));
        const part::LengthInPose found = part::findUnevenLength(part);
        QVERIFY2(std::abs(found.length - 13e-3) < 0.05e-3, QByteArray::number(1e3 * found.length));
        QVERIFY2(std::abs(found.offset - (6.5 - 4.878) * 1e-3) < 0.05e-3,
                 QByteArray::number(1e3 * found.offset));
        // The heading does not matter.
        part::StablePose turned = part.stablePoses.front();
        const part::LengthInPose before = part::findLength(part, turned);
        turned.rotation = base::Quaternion(Eigen::AngleAxisd(0.7, base::Vec3::UnitZ())) * turned.rotation;
        const part::LengthInPose after = part::findLength(part, turned);
        QVERIFY(std::abs(after.length - before.length) < 0.05e-3);
        QVERIFY(std::abs(after.offset - before.offset) < 0.05e-3);
    }

    void posesHaveNames_data() {
        QTest::addColumn<QList<int>>("poses");
        QTest::addColumn<QString>("name");
        QTest::newRow("one") << QList<int>{6} << "7";
        QTest::newRow("two") << QList<int>{0, 1} << "1-2";
        QTest::newRow("the bolt's sides") << QList<int>{0, 1, 2, 3, 4, 5} << "1-6";
        QTest::newRow("with gaps") << QList<int>{0, 1, 2, 4, 7} << "1-3, 5, 8";
        QTest::newRow("none") << QList<int>{} << "";
    }

    void posesHaveNames() {
        QFETCH(QList<int>, poses);
        QFETCH(QString, name);
        const std::vector<int> indices(poses.begin(), poses.end());
        QCOMPARE(QString::fromStdString(part::namePoses(indices)), name);
    }
};

QTEST_APPLESS_MAIN(StablePosesTest)
#include "stable_poses_test.moc"
