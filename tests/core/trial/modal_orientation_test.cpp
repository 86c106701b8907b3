#include <QtTest>
#include <vector>

#include "core/base/random.h"
#include "core/trial/fitness.h"
#include "core/trial/orientation_metric.h"
#include "symmetry_groups.h"

using namespace trapwright;
using trial::OrientationDistance;

Q_DECLARE_METATYPE(part::SymmetryGroup)

class ModalOrientationTest : public QObject {
    Q_OBJECT

    static void addGroups() {
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
    // 60 of 100 parts scattered by a few degrees about one orientation, in any of its copies; the rest
    // anyhow.
    void findsTheCluster_data() { addGroups(); }
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

    void nearestCopyIsNearest_data() { addGroups(); }
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

QTEST_APPLESS_MAIN(ModalOrientationTest)
#include "modal_orientation_test.moc"
