#include "core/trial/fitness.h"

#include <QtTest>
#include <vector>

#include "core/base/random.h"
#include "core/track/track_builder.h"
#include "symmetry_groups.h"

using namespace trapwright;
using trial::OrientationDistance;

Q_DECLARE_METATYPE(part::SymmetryGroup)
Q_DECLARE_METATYPE(OrientationDistance)

namespace {

std::vector<base::Quaternion> drawRotations(std::uint64_t seed, int count) {
    base::Random random({seed, 0, 0, 0, base::Purpose::test});
    std::vector<base::Quaternion> rotations;
    rotations.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
        rotations.push_back(random.rotation());
    return rotations;
}

base::Quaternion turn(double degrees, const base::Vec3& axis) {
    return base::Quaternion(Eigen::AngleAxisd(degrees * base::kDegree, axis));
}

track::Track makeTrack() {
    const track::CrossSection section{30e-3, {base::Vec2(-30e-3, 15e-3), base::Vec2(30e-3, 15e-3)}};
    return *track::buildTrack({}, std::vector{section});
}

}  // namespace

class FitnessTest : public QObject {
    Q_OBJECT

    static void addGroups() {
        QTest::addColumn<part::SymmetryGroup>("group");
        QTest::newRow("C1") << testing::makeC1();
        QTest::newRow("D2") << testing::makeD2();
        QTest::newRow("C5") << testing::makeCn(5);
        QTest::newRow("Cinf") << testing::makeContinuous(false);
        QTest::newRow("Dinf") << testing::makeContinuous(true);
        QTest::newRow("SO3") << testing::makeSphere();
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
    void angleIsInvariant_data() { addGroups(); }
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

    // Eq. 5 written down as it stands, with rotation matrices: another way than the one tested.
    void concentrationIsEquation5_data() { addGroups(); }
    void concentrationIsEquation5() {
        QFETCH(part::SymmetryGroup, group);
        const auto rotations = drawRotations(6, 40);
        const double n = 40.0;
        double sum = 0.0;
        for (std::size_t j = 0; j < 39; ++j) {
            for (std::size_t k = j + 1; k < 40; ++k) {
                double least = base::kPi;
                for (const auto& g : group.rotations) {
                    const base::Mat3 r =
                        rotations[j].toRotationMatrix().transpose() * (rotations[k] * g).toRotationMatrix();
                    least = std::min(least, std::acos(std::clamp(0.5 * (r.trace() - 1.0), -1.0, 1.0)));
                }
                if (group.continuous) {
                    const double cosine = (rotations[j] * group.axis).dot(rotations[k] * group.axis);
                    least = std::acos(group.flip ? std::abs(cosine) : cosine);
                }
                if (group.sphere) least = 0.0;
                sum += std::sqrt(least);
            }
        }
        const double expected = -2.0 / (n * n - n) * sum;
        const double got = trial::calcConcentration(rotations, group, OrientationDistance::symmetric);
        QVERIFY(std::abs(got - expected) < 1e-10);
    }

    void perfectConcentrationIsZero_data() { addGroups(); }
    void perfectConcentrationIsZero() {
        QFETCH(part::SymmetryGroup, group);
        const std::vector<base::Quaternion> same(50, drawRotations(7, 1)[0]);
        QCOMPARE(trial::calcConcentration(same, group, OrientationDistance::symmetric), 0.0);
        QCOMPARE(trial::calcConcentration(std::span(same).first(1), group, OrientationDistance::symmetric),
                 0.0);
    }

    // Two clusters of 10, a quarter turn apart: 100 of the 190 pairs are sqrt(pi / 2) apart.
    void twoClusters() {
        std::vector<base::Quaternion> clusters;
        clusters.reserve(20);
        for (int i = 0; i < 20; ++i)
            clusters.push_back(turn(i % 2 == 0 ? 0.0 : 90.0, base::Vec3::UnitX()));
        const double got = trial::calcConcentration(clusters, testing::makeC1(), OrientationDistance::plain);
        QVERIFY(std::abs(got + 100.0 / 190.0 * std::sqrt(0.5 * base::kPi)) < 1e-12);
    }

    // Paper, section 4.1: -1.3 is the last segment plus 30 percent of the one before.
    void distanceIsEquation3() {
        const track::Track track = makeTrack();
        trial::Outcome outcome;
        outcome.ending = trial::Ending::stuck;
        // Sections at 0, 80, 110, 146, 182 mm, finish at 164 mm: half of the last segment and 0.8 of the one
        // before.
        outcome.farthest.position.x() = 110e-3 + 0.2 * 36e-3;
        std::vector<trial::Outcome> outcomes(3, outcome);
        const auto group = testing::makeC1();
        const auto fitness = trial::calcFitness(track, outcomes, 0, group, OrientationDistance::symmetric);
        QVERIFY(std::abs(fitness.distance + 1.3) < 1e-12);

        trial::Outcome finished = outcome;
        finished.ending = trial::Ending::finished;
        finished.farthest.position.x() = 164e-3;
        outcomes.push_back(finished);
        QVERIFY(
            std::abs(trial::calcFitness(track, outcomes, 0, group, OrientationDistance::symmetric).distance +
                     0.75 * 1.3) < 1e-12);
    }

    void scoresAddUp() {
        const track::Track track = makeTrack();
        const auto initial = drawRotations(8, 30);
        const auto final = drawRotations(9, 1);
        std::vector<trial::Outcome> outcomes(30);
        for (std::size_t i = 0; i < 30; ++i) {
            outcomes[i].ending = trial::Ending::finished;
            outcomes[i].initial.rotation = initial[i];
            outcomes[i].farthest.rotation = final[0];
        }
        const auto group = testing::makeD2();
        const auto fitness = trial::calcFitness(track, outcomes, 4, group, OrientationDistance::symmetric);
        QCOMPARE(fitness.collision, -4.0);
        QCOMPARE(fitness.distance, 0.0);
        QCOMPARE(fitness.orientation,
                 -trial::calcConcentration(initial, group, OrientationDistance::symmetric));
        QVERIFY(fitness.orientation > 0.0);
        QCOMPARE(fitness.total(), -4.0 + fitness.orientation);
        // Nothing gained where nothing was turned.
        for (auto& outcome : outcomes)
            outcome.farthest = outcome.initial;
        QCOMPARE(trial::calcFitness(track, outcomes, 0, group, OrientationDistance::plain).orientation, 0.0);
    }

    void unsimulatedIsWorst() {
        const track::Track track = makeTrack();
        const auto worst = trial::calcUnsimulatedFitness(track, 3);
        QCOMPARE(worst.collision, -3.0);
        QVERIFY(std::abs(worst.distance + 2.75) < 1e-12);
        // Even from equal starts to random ends.
        std::vector<trial::Outcome> outcomes(20);
        const auto ends = drawRotations(10, 20);
        for (std::size_t i = 0; i < 20; ++i)
            outcomes[i].farthest.rotation = ends[i];
        const auto bad =
            trial::calcFitness(track, outcomes, 3, testing::makeC1(), OrientationDistance::plain);
        QVERIFY(worst.orientation < bad.orientation);
    }
};

QTEST_APPLESS_MAIN(FitnessTest)
#include "fitness_test.moc"
