#include <QtTest>
#include <vector>

#include "core/base/random.h"
#include "core/objectives/paper_scores.h"
#include "tests/core/trial/symmetry_groups.h"

using namespace trapwright;
using trial::OrientationDistance;

Q_DECLARE_METATYPE(OrientationDistance)

class BestScoreTest : public QObject {
    Q_OBJECT

 private slots:
    // C1: (2/3 pi^1.5 + S) / pi with the Fresnel integral S of sin(u^2) over [0, sqrt(pi)] = 0.8948314695.
    void closedForms() {
        const double plain =
            objectives::calcBestOrientationScore(testing::makeC1(), OrientationDistance::plain);
        QVERIFY(std::abs(plain - (2.0 / 3.0 * std::pow(base::kPi, 1.5) + 0.8948314695) / base::kPi) < 1e-9);
        QCOMPARE(objectives::calcBestOrientationScore(testing::makeSphere(), OrientationDistance::symmetric),
                 0.0);
        QVERIFY(std::abs(objectives::calcBestOrientationScore(testing::makeSphere(),
                                                              OrientationDistance::plain)) < 1e-12);
    }

    // decisions.md#symmetric-distance: with the plain angle a perfect feeder of cuboids gains only 0.137 over
    // random.
    void plainCuboidGainsLittle() {
        const double score =
            objectives::calcBestOrientationScore(testing::makeD2(), OrientationDistance::plain);
        QVERIFY(std::abs(score - 0.137) < 5e-4);
    }

    void agreesWithSampling_data() {
        QTest::addColumn<part::SymmetryGroup>("group");
        QTest::addColumn<OrientationDistance>("distance");
        for (const auto distance : {OrientationDistance::symmetric, OrientationDistance::plain}) {
            const char* name = distance == OrientationDistance::plain ? "plain" : "symmetric";
            QTest::addRow("C1 %s", name) << testing::makeC1() << distance;
            QTest::addRow("D2 %s", name) << testing::makeD2() << distance;
            QTest::addRow("C6 %s", name) << testing::makeCn(6) << distance;
            QTest::addRow("Cinf %s", name) << testing::makeContinuous(false) << distance;
            QTest::addRow("Dinf %s", name) << testing::makeContinuous(true) << distance;
        }
    }
    // A perfect feeder acted out: uniform starts, and ends that are one orientation in any of its copies.
    void agreesWithSampling() {
        QFETCH(part::SymmetryGroup, group);
        QFETCH(OrientationDistance, distance);
        base::Random random({4, 0, 0, 0, base::Purpose::test});
        const base::Quaternion end = random.rotation();
        const base::Vec3 across = group.axis.unitOrthogonal();
        double sum = 0.0;
        constexpr int kPairs = 400000;
        const auto drawEnd = [&]() -> base::Quaternion {
            if (!group.continuous) {
                return end *
                       group.rotations[random.below(static_cast<std::uint32_t>(group.rotations.size()))];
            }
            const base::Quaternion spin(Eigen::AngleAxisd(random.uniform(0.0, 2.0 * base::kPi), group.axis));
            if (group.flip && random.boolean()) {
                return end * base::Quaternion(Eigen::AngleAxisd(base::kPi, across)) * spin;
            }
            return end * spin;
        };
        for (int i = 0; i < kPairs; ++i) {
            const double starts =
                trial::calcOrientationAngle(random.rotation(), random.rotation(), group, distance);
            const double ends = trial::calcOrientationAngle(drawEnd(), drawEnd(), group, distance);
            sum += std::sqrt(starts) - std::sqrt(ends);
        }
        const double expected = sum / kPairs;
        const double got = objectives::calcBestOrientationScore(group, distance);
        // The sample's own standard error is below 0.001.
        QVERIFY2(std::abs(got - expected) < 0.004, qPrintable(QString("%1 %2").arg(got).arg(expected)));
    }
};

QTEST_APPLESS_MAIN(BestScoreTest)
#include "best_score_test.moc"
