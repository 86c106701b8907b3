#include "core/trial/orientations.h"

#include <QtTest>
#include <vector>

#include "core/base/random.h"
#include "symmetry_groups.h"

using namespace trapwright;
using testing::drawRotations;
using testing::turn;
using trial::OrientationDistance;

Q_DECLARE_METATYPE(OrientationDistance)

class OrientationsTest : public QObject {
    Q_OBJECT

    static void addTurningGroups() {
        QTest::addColumn<part::SymmetryGroup>("group");
        QTest::newRow("C1") << testing::makeC1();
        QTest::newRow("D2") << testing::makeD2();
        QTest::newRow("C6") << testing::makeCn(6);
        QTest::newRow("Cinf") << testing::makeContinuous(false);
        QTest::newRow("Dinf") << testing::makeContinuous(true);
    }

    static base::Quaternion drawCopy(const part::SymmetryGroup& group, base::Random& random) {
        if (!group.continuous) {
            return group.rotations[random.below(static_cast<std::uint32_t>(group.rotations.size()))];
        }
        base::Quaternion copy(Eigen::AngleAxisd(random.uniform(0.0, 2.0 * base::kPi), group.axis));
        if (group.flip && random.boolean()) copy = trial::makeFlip(group.axis) * copy;
        return copy;
    }

 private slots:
    void angle_data() {
        QTest::addColumn<part::SymmetryGroup>("group");
        QTest::addColumn<OrientationDistance>("distance");
        QTest::addColumn<double>("turned");
        QTest::addColumn<double>("degrees");
        const auto symmetric = OrientationDistance::symmetric;
        const auto plain = OrientationDistance::plain;
        QTest::newRow("C1 30") << testing::makeC1() << symmetric << 30.0 << 30.0;
        QTest::newRow("C1 180") << testing::makeC1() << symmetric << 180.0 << 180.0;
        QTest::newRow("C1 270 is -90") << testing::makeC1() << symmetric << 270.0 << 90.0;
        QTest::newRow("D2 180 is alike") << testing::makeD2() << symmetric << 180.0 << 0.0;
        QTest::newRow("D2 170") << testing::makeD2() << symmetric << 170.0 << 10.0;
        QTest::newRow("D2 plain") << testing::makeD2() << plain << 170.0 << 170.0;
        QTest::newRow("C5 72 is alike") << testing::makeCn(5) << symmetric << 72.0 << 0.0;
        QTest::newRow("C5 100") << testing::makeCn(5) << symmetric << 100.0 << 28.0;
        QTest::newRow("tiny") << testing::makeC1() << symmetric << 1e-7 << 1e-7;
    }
    void angle() {
        QFETCH(part::SymmetryGroup, group);
        QFETCH(OrientationDistance, distance);
        QFETCH(double, turned);
        QFETCH(double, degrees);
        // About the part's own z, in any orientation.
        for (const auto& a : drawRotations(1, 20)) {
            const base::Quaternion b = a * turn(turned, base::Vec3::UnitZ());
            const double got = trial::calcOrientationAngle(a, b, group, distance) / base::kDegree;
            QVERIFY2(std::abs(got - degrees) < 1e-12 * (1.0 + 1e4 * degrees),
                     qPrintable(QString::number(got)));
        }
    }

    void angleOfAxes() {
        const auto arrow = testing::makeContinuous(false);
        const auto rod = testing::makeContinuous(true);
        const base::Vec3 across = arrow.axis.unitOrthogonal();
        for (const auto& a : drawRotations(2, 20)) {
            const auto spun = a * turn(77.0, arrow.axis);
            QVERIFY(trial::calcOrientationAngle(a, spun, arrow, OrientationDistance::symmetric) < 1e-12);
            const auto tilted = a * turn(120.0, across) * turn(33.0, arrow.axis);
            const double directed =
                trial::calcOrientationAngle(a, tilted, arrow, OrientationDistance::symmetric);
            const double undirected =
                trial::calcOrientationAngle(a, tilted, rod, OrientationDistance::symmetric);
            QVERIFY(std::abs(directed - 120.0 * base::kDegree) < 1e-12);
            QVERIFY(std::abs(undirected - 60.0 * base::kDegree) < 1e-12);
        }
    }

    // Changing an orientation by a symmetry of the part changes no angle; turning the whole world neither.
    void angleIsInvariant_data() { testing::addGroups(); }
    void angleIsInvariant() {
        QFETCH(part::SymmetryGroup, group);
        const auto as = drawRotations(3, 30);
        const auto bs = drawRotations(4, 30);
        const auto worlds = drawRotations(5, 30);
        for (std::size_t i = 0; i < as.size(); ++i) {
            const auto measure = [&](const base::Quaternion& a, const base::Quaternion& b) {
                return trial::calcOrientationAngle(a, b, group, OrientationDistance::symmetric);
            };
            const double angle = measure(as[i], bs[i]);
            QVERIFY(angle >= 0.0 && angle <= base::kPi);
            QVERIFY(std::abs(measure(bs[i], as[i]) - angle) < 1e-12);
            QVERIFY(std::abs(measure(worlds[i] * as[i], worlds[i] * bs[i]) - angle) < 1e-12);
            base::Quaternion negative = bs[i];
            negative.coeffs() = -negative.coeffs();
            QVERIFY(std::abs(measure(as[i], negative) - angle) < 1e-12);
            for (const auto& g : group.rotations)
                QVERIFY(std::abs(measure(as[i], bs[i] * g) - angle) < 1e-12);
        }
    }

    // 60 of 100 parts scattered by a few degrees about one orientation, in any of its copies; the rest
    // anyhow.
    void findsTheCluster_data() { addTurningGroups(); }
    void findsTheCluster() {
        QFETCH(part::SymmetryGroup, group);
        base::Random random({3, 0, 0, 0, base::Purpose::test});
        const base::Quaternion centre = random.rotation();
        std::vector<base::Quaternion> orientations;
        for (int i = 0; i < 100; ++i) {
            if (i % 5 >= 3) {
                orientations.push_back(random.rotation());
                continue;
            }
            const double s = 3.0 * base::kDegree;
            const base::Vec3 scatter(s * random.normal(), s * random.normal(), s * random.normal());
            const base::Quaternion noise(Eigen::AngleAxisd(scatter.norm(), scatter.normalized()));
            orientations.push_back(noise * centre * drawCopy(group, random));
        }
        const auto mode = trial::findModalOrientation(orientations, group, 15.0 * base::kDegree);
        QVERIFY(std::abs(mode.norm() - 1.0) < 1e-14);
        const double off = trial::calcOrientationAngle(mode, centre, group, OrientationDistance::symmetric);
        // Mean of 60: 3 degrees times sqrt(3 / 60), and some strangers within the tolerance.
        QVERIFY2(off < 2.5 * base::kDegree, qPrintable(QString::number(off / base::kDegree)));
    }

    void nearestCopyIsNearest_data() { addTurningGroups(); }
    void nearestCopyIsNearest() {
        QFETCH(part::SymmetryGroup, group);
        base::Random random({5, 0, 0, 0, base::Purpose::test});
        for (int i = 0; i < 100; ++i) {
            const base::Quaternion q = random.rotation();
            const base::Quaternion reference = random.rotation();
            const auto copy = trial::findNearestCopy(q, reference, group);
            QVERIFY(trial::calcOrientationAngle(copy, q, group, OrientationDistance::symmetric) < 1e-7);
            QVERIFY(copy.dot(reference) >= 0.0);
            const double angle =
                trial::calcOrientationAngle(copy, reference, group, OrientationDistance::plain);
            for (int k = 0; k < 50; ++k) {
                const double other = trial::calcOrientationAngle(q * drawCopy(group, random), reference,
                                                                 group, OrientationDistance::plain);
                QVERIFY(angle <= other + 1e-9);
            }
        }
    }

    void equalsKeepTheFirst() {
        const std::vector<base::Quaternion> two = {{1, 0, 0, 0}, {0, 1, 0, 0}};
        const auto mode = trial::findModalOrientation(two, testing::makeC1(), 0.1);
        QCOMPARE(mode.coeffs(), two[0].coeffs());
        QCOMPARE(trial::findModalOrientation({}, testing::makeC1(), 0.1).coeffs(),
                 base::Quaternion::Identity().coeffs());
    }
};

QTEST_APPLESS_MAIN(OrientationsTest)
#include "orientations_test.moc"
