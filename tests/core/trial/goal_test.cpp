#include "core/trial/goal.h"

#include <QtTest>

#include "core/base/random.h"
#include "symmetry_groups.h"

using namespace trapwright;
using testing::drawRotations;
using testing::turn;

namespace {

trial::Outcome ended(trial::Ending ending, const base::Quaternion& rotation = base::Quaternion::Identity()) {
    trial::Outcome outcome{{trial::PartOutcome()}, {}};
    outcome.parts[0].ending = ending;
    outcome.parts[0].farthest.rotation = rotation;
    return outcome;
}

constexpr double kTolerance = 25.0 * base::kDegree;

}  // namespace

class GoalTest : public QObject {
    Q_OBJECT

 private slots:
    void whateverTheHeadingTheTiltIsTheLeastAngle_data() { testing::addGroups(); }
    void whateverTheHeadingTheTiltIsTheLeastAngle() {
        QFETCH(part::SymmetryGroup, group);
        const auto some = drawRotations(31, 12);
        const auto others = drawRotations(32, 12);
        for (std::size_t i = 0; i < some.size(); ++i) {
            const double tilt = trial::calcTiltAngle(some[i], others[i], group);
            // By trying all headings.
            double least = base::kPi;
            for (int degrees = 0; degrees < 3600; ++degrees) {
                const base::Quaternion turned = turn(0.1 * degrees, base::Vec3::UnitZ()) * others[i];
                least = std::min(least, trial::calcOrientationAngle(some[i], turned, group,
                                                                    trial::OrientationDistance::symmetric));
            }
            QVERIFY2(std::abs(tilt - least) < 0.2 * base::kDegree,
                     qPrintable(QString("%1 %2").arg(tilt).arg(least)));
            QVERIFY(tilt <= least + 1e-9);
        }
    }

    void whatLeansIsAsNearAsAnyLeanBrings_data() { testing::addGroups(); }
    void whatLeansIsAsNearAsAnyLeanBrings() {
        QFETCH(part::SymmetryGroup, group);
        const auto some = drawRotations(35, 12);
        const auto others = drawRotations(36, 12);
        constexpr int kLean = 24;
        for (std::size_t i = 0; i < some.size(); ++i) {
            for (const bool anyHeading : {false, true}) {
                const trial::Goal goal{{{others[i], anyHeading, kLean * base::kDegree}}};
                const double angle = trial::calcAngleToGoal(some[i], goal, group);
                // By trying all leans, and taking each back.
                double least = base::kPi;
                for (int lean = -10 * kLean; lean <= 10 * kLean; ++lean) {
                    const base::Quaternion back = turn(-0.1 * lean, base::Vec3::UnitX()) * some[i];
                    least = std::min(least, trial::calcAngleToGoal(back, {{{others[i], anyHeading}}}, group));
                }
                QVERIFY2(std::abs(angle - least) < 0.1 * base::kDegree,
                         qPrintable(QString("%1 %2").arg(angle).arg(least)));
                QVERIFY(angle <= least + 1e-9);
            }
        }
        const trial::Goal leaning{{{base::Quaternion::Identity(), false, 0.1}}};
        QVERIFY(!leaning.isOneOrientation());
        QVERIFY(!(leaning == trial::makeGoal(base::Quaternion::Identity())));
    }

    void theNearestOrientationCounts() {
        const part::SymmetryGroup none = testing::makeC1();
        const base::Quaternion side = turn(90.0, base::Vec3::UnitX());
        const trial::Goal goal{{{base::Quaternion::Identity(), true}, {side, false}}};
        const auto angle = [&](const base::Quaternion& q) {
            return trial::calcAngleToGoal(q, goal, none) / base::kDegree;
        };
        QVERIFY(angle(turn(123.0, base::Vec3::UnitZ())) < 1e-6);
        QVERIFY(std::abs(angle(turn(40.0, base::Vec3::UnitX())) - 40.0) < 1e-6);
        QVERIFY(std::abs(angle(turn(80.0, base::Vec3::UnitX())) - 10.0) < 1e-6);
        QVERIFY(std::abs(angle(turn(30.0, base::Vec3::UnitZ()) * side) - 30.0) < 1e-6);
        QVERIFY(!goal.isOneOrientation());
        QVERIFY(trial::makeGoal(side).isOneOrientation());
        QVERIFY(trial::makeGoal(side) == trial::makeGoal(side));
        QVERIFY(!(trial::makeGoal(side) == goal));
    }

    void withoutAWishTheModeIsTheGoal() {
        const part::SymmetryGroup group = testing::makeD2();
        std::vector<trial::Outcome> outcomes;
        for (const base::Quaternion& q : drawRotations(33, 40))
            outcomes.push_back(ended(trial::Ending::finished, q));
        outcomes.push_back(ended(trial::Ending::stuck));
        const base::Quaternion mode =
            trial::findModalOrientation(trial::finalOrientations(outcomes), group, kTolerance);
        const trial::Goal goal = trial::findGoal(std::nullopt, outcomes, group, kTolerance);
        QVERIFY(goal == trial::makeGoal(mode));
        const trial::Goal wanted{{{base::Quaternion::Identity(), true}}};
        QVERIFY(trial::findGoal(wanted, outcomes, group, kTolerance) == wanted);
    }

    void endsAreTallied() {
        const base::Quaternion flat = base::Quaternion::Identity();
        const std::vector<trial::Outcome> outcomes = {
            ended(trial::Ending::finished, flat),
            ended(trial::Ending::finished, turn(180.0, base::Vec3::UnitX())),
            ended(trial::Ending::finished, turn(24.0, base::Vec3::UnitX())),
            ended(trial::Ending::finished, turn(26.0, base::Vec3::UnitX())),
            ended(trial::Ending::finished, turn(90.0, base::Vec3::UnitZ())),
            ended(trial::Ending::fellOff, flat),
            ended(trial::Ending::stuck, flat),
            ended(trial::Ending::timedOut, flat)};
        const part::SymmetryGroup group = testing::makeD2();
        const trial::Tally oneHeading = trial::tally(outcomes, trial::makeGoal(flat), group, kTolerance);
        QVERIFY((oneHeading == trial::Tally{3, 2, 2, 1}));
        const trial::Tally anyHeading = trial::tally(outcomes, {{{flat, true}}}, group, kTolerance);
        QVERIFY((anyHeading == trial::Tally{4, 1, 2, 1}));
    }
};

QTEST_APPLESS_MAIN(GoalTest)
#include "goal_test.moc"
