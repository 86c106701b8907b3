#include "core/objectives/objectives.h"

#include <QtTest>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "core/base/random.h"
#include "core/objectives/paper_scores.h"
#include "core/objectives/success_share.h"
#include "core/track/track_builder.h"
#include "core/track/track_solid.h"
#include "tests/core/objectives/paper_fitness.h"
#include "tests/core/trial/symmetry_groups.h"

using namespace trapwright;
using objectives::Evaluation;
using objectives::Fitness;
using testing::drawRotations;
using testing::scoreOf;
using testing::turn;
using trial::OrientationDistance;
using trial::Outcome;

namespace {

track::Track makeTrack() {
    const track::CrossSection section{30e-3, {base::Vec2(-30e-3, 15e-3), base::Vec2(30e-3, 15e-3)}};
    return *track::buildTrack({}, std::vector{section});
}

objectives::ObjectiveList paperObjectives() {
    return *objectives::readObjectives(objectives::kPaperObjectives);
}

/// Of trials on makeTrack().
struct Judge {
    track::Track track = makeTrack();
    part::SymmetryGroup symmetry = testing::makeC1();
    OrientationDistance distance = OrientationDistance::symmetric;

    [[nodiscard]] Evaluation evaluation(std::span<const Outcome> outcomes, int overlaps = 0) const {
        Evaluation evaluation{&track, &symmetry, overlaps, outcomes, distance, 25.0 * base::kDegree};
        evaluation.isVaried = evaluation.hasCorners = true;
        return evaluation;
    }
    [[nodiscard]] Fitness judge(std::span<const Outcome> outcomes, int overlaps = 0) const {
        return objectives::measureAll(evaluation(outcomes, overlaps), paperObjectives());
    }
};

/// In all of these trials' scores, without being named in F.
bool isScored(const objectives::Objective& objective) {
    return !objective.needsWanted && objective.key != "F_P" && objective.key != objectives::kThroughput &&
           objective.key != objectives::kPurity && objective.key != objectives::kYield;
}

Outcome finishedAfter(double way, double seconds, const base::Quaternion& rotation) {
    Outcome outcome{{trial::PartOutcome()}, {}};
    outcome.parts[0].ending = trial::Ending::finished;
    outcome.parts[0].initial.position.x() = 60e-3;
    outcome.parts[0].farthest.position.x() = 60e-3 + way;
    outcome.parts[0].farthest.rotation = rotation;
    outcome.parts[0].time = seconds;
    return outcome;
}

/// Some finish, some do not, some turn.
Outcome drawOutcome(base::Random& random) {
    Outcome outcome = finishedAfter(104e-3, 1.0 + 0.2 * random.normal(),
                                    turn(random.uniform() < 0.7 ? 0.0 : 90.0, base::Vec3::UnitX()));
    outcome.parts[0].initial.rotation = random.rotation();
    if (random.uniform() < 0.2) {
        outcome.parts[0].ending = trial::Ending::stuck;
        outcome.parts[0].farthest.position.x() = random.uniform(80e-3, 160e-3);
        outcome.parts[0].farthest.rotation = random.rotation();
    }
    return outcome;
}

}  // namespace

class ObjectivesTest : public QObject {
    Q_OBJECT

 private slots:
    // Eq. 5 written down as it stands, with rotation matrices: another way than the one tested.
    void concentrationIsEquation5_data() { testing::addGroups(); }
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
        const double got =
            objectives::calcConcentration(rotations, group, OrientationDistance::symmetric).value;
        QVERIFY(std::abs(got - expected) < 1e-10);
    }

    void perfectConcentrationIsZero_data() { testing::addGroups(); }
    void perfectConcentrationIsZero() {
        QFETCH(part::SymmetryGroup, group);
        const std::vector<base::Quaternion> same(50, drawRotations(7, 1)[0]);
        QCOMPARE(objectives::calcConcentration(same, group, OrientationDistance::symmetric).value, 0.0);
        QCOMPARE(
            objectives::calcConcentration(std::span(same).first(1), group, OrientationDistance::symmetric)
                .value,
            0.0);
    }

    // Two clusters of 10, a quarter turn apart: 100 of the 190 pairs are sqrt(pi / 2) apart.
    void twoClusters() {
        std::vector<base::Quaternion> clusters;
        clusters.reserve(20);
        for (int i = 0; i < 20; ++i)
            clusters.push_back(turn(i % 2 == 0 ? 0.0 : 90.0, base::Vec3::UnitX()));
        const double got =
            objectives::calcConcentration(clusters, testing::makeC1(), OrientationDistance::plain).value;
        QVERIFY(std::abs(got + 100.0 / 190.0 * std::sqrt(0.5 * base::kPi)) < 1e-12);
    }

    // Paper, section 4.1: -1.3 is the last segment plus 30 percent of the one before.
    void distanceIsEquation3() {
        const Judge judge;
        Outcome outcome{{trial::PartOutcome()}, {}};
        outcome.parts[0].ending = trial::Ending::stuck;
        // Sections at 0, 80, 110, 146, 182 mm, finish at 164 mm: half of the last segment and 0.8 of the one
        // before.
        outcome.parts[0].farthest.position.x() = 110e-3 + 0.2 * 36e-3;
        std::vector<Outcome> outcomes(3, outcome);
        const Fitness alike = judge.judge(outcomes);
        QVERIFY(std::abs(scoreOf(alike, "F_D") + 1.3) < 1e-12);
        QVERIFY(objectives::findScore(alike, "F_D")->error < 1e-12);

        outcomes.push_back(finishedAfter(104e-3, 1.0, base::Quaternion::Identity()));
        const Fitness fitness = judge.judge(outcomes);
        QVERIFY(std::abs(scoreOf(fitness, "F_D") + 0.75 * 1.3) < 1e-12);
        // Of 1.3, 1.3, 1.3 and 0 the deviation is 0.65, with n - 1.
        QVERIFY(std::abs(objectives::findScore(fitness, "F_D")->error - 0.65 / 2.0) < 1e-12);
    }

    void scoresAddUp() {
        Judge judge;
        judge.symmetry = testing::makeD2();
        const auto initial = drawRotations(8, 30);
        const auto final = drawRotations(9, 1);
        std::vector<Outcome> outcomes(30, Outcome{{trial::PartOutcome()}, {}});
        for (std::size_t i = 0; i < 30; ++i) {
            outcomes[i].parts[0].ending = trial::Ending::finished;
            outcomes[i].parts[0].initial.rotation = initial[i];
            outcomes[i].parts[0].farthest.rotation = final[0];
        }
        const Fitness fitness = judge.judge(outcomes, 4);
        const double orientation = scoreOf(fitness, "F_O");
        QCOMPARE(scoreOf(fitness, "F_C"), -4.0);
        QCOMPARE(scoreOf(fitness, "F_D"), 0.0);
        QCOMPARE(
            orientation,
            -objectives::calcConcentration(initial, judge.symmetry, OrientationDistance::symmetric).value);
        QVERIFY(orientation > 0.0);
        QCOMPARE(fitness.total, -4.0 + orientation);
        // Nothing gained where nothing was turned.
        for (auto& outcome : outcomes)
            outcome.parts[0].farthest = outcome.parts[0].initial;
        judge.distance = OrientationDistance::plain;
        QCOMPARE(scoreOf(judge.judge(outcomes), "F_O"), 0.0);
    }

    void unsimulatedIsWorst() {
        Judge judge;
        judge.distance = OrientationDistance::plain;
        const Fitness worst = judge.judge({}, 3);
        QCOMPARE(scoreOf(worst, "F_C"), -3.0);
        QVERIFY(std::abs(scoreOf(worst, "F_D") + 2.75) < 1e-12);
        // Even from equal starts to random ends.
        std::vector<Outcome> outcomes(20, Outcome{{trial::PartOutcome()}, {}});
        const auto ends = drawRotations(10, 20);
        for (std::size_t i = 0; i < 20; ++i) {
            outcomes[i].parts[0].farthest.position.x() = judge.track.start;
            outcomes[i].parts[0].farthest.rotation = ends[i];
        }
        const Fitness bad = judge.judge(outcomes, 3);
        for (const objectives::Objective& objective : objectives::allObjectives()) {
            if (!isScored(objective)) continue;
            const double sign = objective.moreIsBetter ? 1.0 : -1.0;
            QVERIFY(sign * scoreOf(worst, objective.key) <= sign * scoreOf(bad, objective.key) + 1e-12);
        }
        QVERIFY(scoreOf(worst, "F_O") < scoreOf(bad, "F_O"));
    }

    void successIsTheShareOfTheMode() {
        const Judge judge;
        std::vector<Outcome> outcomes;
        outcomes.reserve(10);
        for (int i = 0; i < 10; ++i)  // six within the tolerance of each other, two elsewhere, two stuck
            outcomes.push_back(finishedAfter(104e-3, 2.0, turn(i < 6 ? 3.0 * i : 90.0, base::Vec3::UnitX())));
        outcomes[8].parts[0].ending = outcomes[9].parts[0].ending = trial::Ending::stuck;
        const objectives::Fitness fitness = judge.judge(outcomes);
        const objectives::Score& success = *objectives::findScore(fitness, "success");
        QCOMPARE(success.value, 0.6);
        QVERIFY(std::abs(success.error - std::sqrt(0.6 * 0.4 / 9.0)) < 1e-12);
        // In the orientation that is wanted, which is not the mode.
        Evaluation wanted = judge.evaluation(outcomes);
        wanted.wanted = trial::makeGoal(turn(90.0, base::Vec3::UnitX()));
        QCOMPARE(scoreOf(objectives::measureAll(wanted, paperObjectives()), "success"), 0.2);
    }

    // So many ways of equal frequency, all further from each other than the tolerance, of parts that finish
    // and others that do not: the likelihood that two of n end alike, counted.
    void disorderCountsTheWays_data() {
        QTest::addColumn<int>("ways");
        QTest::addColumn<int>("stuck");
        QTest::addColumn<double>("bits");
        constexpr double kLeast = 1.0 / 256.0;
        const auto bits = [](double alike, double pairs) {
            return -std::log2(kLeast + (1.0 - kLeast) * alike / pairs);
        };
        QTest::newRow("one") << 1 << 0 << 0.0;
        QTest::newRow("two") << 2 << 0 << bits(2 * 30 * 29, 60 * 59);
        QTest::newRow("four") << 4 << 0 << bits(4 * 15 * 14, 60 * 59);
        QTest::newRow("one, half are stuck") << 1 << 30 << bits(30 * 29, 60 * 59);
        QTest::newRow("none finishes") << 1 << 60 << 8.0;
    }

    void disorderCountsTheWays() {
        QFETCH(int, ways);
        QFETCH(int, stuck);
        QFETCH(double, bits);
        constexpr int kTrials = 60;
        std::vector<Outcome> outcomes;
        outcomes.reserve(kTrials);
        // Half a turn about three axes and none: all half a turn apart.
        const std::array ends = {base::Quaternion::Identity(), turn(180.0, base::Vec3::UnitX()),
                                 turn(180.0, base::Vec3::UnitY()), turn(180.0, base::Vec3::UnitZ())};
        for (int i = 0; i < kTrials; ++i) {
            outcomes.push_back(finishedAfter(104e-3, 2.0, ends[static_cast<std::size_t>(i % ways)]));
            if (i < stuck) outcomes.back().parts[0].ending = trial::Ending::stuck;
        }
        const Judge judge;
        QVERIFY(std::abs(scoreOf(judge.judge(outcomes), "disorder") - bits) < 1e-9);
        // Less is better: it counts as minus.
        const auto sum = *objectives::readObjectives("disorder");
        QCOMPARE(objectives::measureAll(judge.evaluation(outcomes), sum).total,
                 -scoreOf(judge.judge(outcomes), "disorder"));
    }

    // So many of four equally frequent ways are thrown out, whole: bits tell how often the right ones of
    // those that stay have to double, and each halving of the parts costs a little.
    void sortingForgivesWhatFallsOff_data() {
        QTest::addColumn<int>("thrown");
        QTest::addColumn<int>("stuck");
        QTest::addColumn<double>("right");  // of those that stay
        QTest::newRow("none") << 0 << 0 << 0.25;
        QTest::newRow("one way") << 1 << 0 << 1.0 / 3.0;
        QTest::newRow("two ways") << 2 << 0 << 0.5;
        QTest::newRow("three ways") << 3 << 0 << 1.0;
        QTest::newRow("two ways, and some are stuck") << 2 << 8 << 0.48;
        QTest::newRow("all") << 4 << 0 << 0.0;
    }
    void sortingForgivesWhatFallsOff() {
        QFETCH(int, thrown);
        QFETCH(int, stuck);
        QFETCH(double, right);
        constexpr int kTrials = 400;
        const std::array ends = {base::Quaternion::Identity(), turn(180.0, base::Vec3::UnitX()),
                                 turn(180.0, base::Vec3::UnitY()), turn(180.0, base::Vec3::UnitZ())};
        std::vector<Outcome> outcomes;
        for (int i = 0; i < kTrials; ++i) {
            Outcome outcome = finishedAfter(104e-3, 2.0, ends[static_cast<std::size_t>(i % 4)]);
            if (i % 4 < thrown) {
                outcome.parts[0].ending = trial::Ending::fellOff;
            } else if (i < 2 * stuck) {
                outcome.parts[0].ending = trial::Ending::stuck;
            }
            outcomes.push_back(outcome);
        }
        const Judge judge;
        Evaluation evaluation = judge.evaluation(outcomes);
        evaluation.returns = trial::Returns::anywhere;
        const auto score = [&] {
            return scoreOf(objectives::measureAll(evaluation, paperObjectives()), "sorting");
        };
        const double bits = score();
        // What is lost counts as wrong.
        evaluation.returns = trial::Returns::nowhere;
        QVERIFY(thrown == 0 ? score() == bits : score() > bits - 1e-9);
        if (thrown == 4) {
            QCOMPARE(bits, 8.0);
            return;
        }
        const double expected =
            -std::log2(right) + objectives::kBitsOfHalving * std::log2(4.0 / (4 - thrown));
        QVERIFY2(std::abs(bits - expected) < 0.03, qPrintable(QString::number(bits)));
        // Order is worth what it costs.
        if (stuck == 0)
            QVERIFY(std::abs(bits - (2.0 - (1.0 - objectives::kBitsOfHalving) *
                                               std::log2(4.0 / (4 - thrown)))) < 0.03);
    }

    // Of two parts that end in two ways each is the mode, by chance: that is no order.
    void sortingIsNotImpressedByFewParts() {
        std::vector<Outcome> outcomes{finishedAfter(104e-3, 2.0, base::Quaternion::Identity()),
                                      finishedAfter(104e-3, 2.0, turn(180.0, base::Vec3::UnitX()))};
        Outcome fallen = outcomes.front();
        fallen.parts[0].ending = trial::Ending::fellOff;
        outcomes.push_back(fallen);
        const Judge judge;
        objectives::Evaluation told = judge.evaluation(outcomes);
        told.returns = trial::Returns::anywhere;
        QVERIFY(scoreOf(objectives::measureAll(told, paperObjectives()), "sorting") > 8.0);
        told.wanted = trial::makeGoal(base::Quaternion::Identity());
        QVERIFY(scoreOf(objectives::measureAll(told, objectives::readObjectives("sorting").value()),
                        "sorting") < 1.3);
    }

    // Of 100 parts that do not come again so many are wrong.
    void purityCountsNines_data() {
        QTest::addColumn<int>("right");
        QTest::addColumn<int>("wrong");
        QTest::addColumn<int>("stuck");
        QTest::addColumn<int>("fallen");
        QTest::addColumn<bool>("returns");
        QTest::addColumn<double>("share");  // of wrong ones
        QTest::newRow("none is wrong") << 98 << 0 << 0 << 0 << true << 0.01;
        QTest::newRow("more of them, more certainty") << 998 << 0 << 0 << 0 << true << 0.001;
        QTest::newRow("some are wrong") << 88 << 10 << 0 << 0 << true << 0.11;
        QTest::newRow("stuck ones are wrong") << 88 << 5 << 5 << 0 << true << 0.11;
        QTest::newRow("what comes again is not") << 98 << 0 << 0 << 50 << true << 0.01;
        QTest::newRow("what is lost is") << 88 << 0 << 0 << 10 << false << 0.11;
        QTest::newRow("all come again") << 0 << 0 << 0 << 50 << true << 0.5;
    }
    void purityCountsNines() {
        QFETCH(int, right);
        QFETCH(int, wrong);
        QFETCH(int, stuck);
        QFETCH(int, fallen);
        QFETCH(bool, returns);
        QFETCH(double, share);
        std::vector<Outcome> outcomes;
        const auto add = [&](int count, trial::Ending ending, double turned) {
            for (int i = 0; i < count; ++i) {
                outcomes.push_back(finishedAfter(104e-3, 2.0, turn(turned, base::Vec3::UnitX())));
                outcomes.back().parts[0].ending = ending;
            }
        };
        add(right, trial::Ending::finished, 0.0);
        add(wrong, trial::Ending::finished, 90.0);
        add(stuck, trial::Ending::stuck, 0.0);
        add(fallen, trial::Ending::fellOff, 0.0);
        const Judge judge;
        Evaluation evaluation = judge.evaluation(outcomes);
        evaluation.returns = returns ? trial::Returns::innerSide : trial::Returns::nowhere;
        for (Outcome& outcome : outcomes)
            outcome.parts[0].farthest.position.y() = -25e-3;
        const auto sum = objectives::readObjectives("purity").value();
        const double nines = objectives::measureAll(evaluation, sum).total;
        QVERIFY2(std::abs(nines + std::log10(share)) < 1e-9, qPrintable(QString::number(nines)));
    }

    // Of what is fed, however much of it comes again.
    void yieldCountsDecades_data() {
        QTest::addColumn<int>("right");
        QTest::addColumn<int>("wrong");
        QTest::addColumn<int>("fallen");
        QTest::addColumn<double>("share");
        QTest::newRow("all right") << 98 << 0 << 0 << 0.99;
        QTest::newRow("half of them come again") << 49 << 0 << 49 << 0.5;
        QTest::newRow("half of them are wrong") << 49 << 49 << 0 << 0.5;
        QTest::newRow("few") << 9 << 1 << 88 << 0.1;
        QTest::newRow("none") << 0 << 0 << 98 << 0.01;
    }
    void yieldCountsDecades() {
        QFETCH(int, right);
        QFETCH(int, wrong);
        QFETCH(int, fallen);
        QFETCH(double, share);
        std::vector<Outcome> outcomes(static_cast<std::size_t>(right + wrong + fallen),
                                      finishedAfter(104e-3, 2.0, base::Quaternion::Identity()));
        for (int i = 0; i < wrong + fallen; ++i) {
            trial::PartOutcome& part = outcomes[static_cast<std::size_t>(i)].parts[0];
            part.farthest.rotation = turn(90.0, base::Vec3::UnitX());
            if (i >= wrong) part.ending = trial::Ending::fellOff;
        }
        const Judge judge;
        Evaluation evaluation = judge.evaluation(outcomes);
        evaluation.returns = trial::Returns::anywhere;
        evaluation.wanted = trial::makeGoal(base::Quaternion::Identity());
        const auto sum = objectives::readObjectives("yield").value();
        const Fitness fitness = objectives::measureAll(evaluation, sum);
        QVERIFY2(std::abs(fitness.total - std::log10(share)) < 1e-9,
                 qPrintable(QString::number(fitness.total)));
        // The binomial's error of the share, as the logarithm has it.
        const double error =
            std::sqrt(share * (1.0 - share) / (right + wrong + fallen + 2)) / share / std::log(10.0);
        QVERIFY(std::abs(objectives::findScore(fitness, "yield")->error - error) < 1e-9);
    }

    // Of studies whose parts do not come again it says nothing.
    void purityIsOfPartsThatComeAgain() {
        const Judge judge;
        const std::vector outcomes(4, finishedAfter(104e-3, 2.0, base::Quaternion::Identity()));
        Evaluation evaluation = judge.evaluation(outcomes);
        const auto isMeasured = [&] {
            return objectives::findScore(objectives::measureAll(evaluation, paperObjectives()), "purity") !=
                   nullptr;
        };
        QVERIFY(!isMeasured());
        evaluation.returns = trial::Returns::innerSide;
        QVERIFY(isMeasured());
    }

    void throughputIsOfStreamsAlone() {
        const Judge judge;
        const std::vector outcomes(4, finishedAfter(104e-3, 2.0, base::Quaternion::Identity()));
        const auto sum = objectives::readObjectives("success, throughput").value();
        Evaluation evaluation = judge.evaluation(outcomes);
        QCOMPARE(objectives::measureAll(evaluation, sum).total, 1.0);
        QVERIFY(objectives::findScore(judge.judge(outcomes), "throughput") == nullptr);
        evaluation.streams = stats::Count{30, 40};
        QCOMPARE(objectives::measureAll(evaluation, sum).total, 1.75);
        QCOMPARE(scoreOf(judge.judge(outcomes), "success"), 1.0);
    }

    // 80 trials on a grid of friction and stroke: those of low friction fail, and one of high.
    void theWorstHalfOfTheBox() {
        const Judge judge;
        std::vector<Outcome> outcomes;
        std::vector<trial::BoxPlace> places;
        for (int i = 0; i < 80; ++i) {
            trial::BoxPlace place = trial::kMiddle;
            place[static_cast<std::size_t>(trial::Condition::friction)] = (i % 8 + 0.5) / 8.0;
            const int row = i / 8;
            place[static_cast<std::size_t>(trial::Condition::halfStroke)] = (row + 0.5) / 10.0;
            const bool fails = i % 8 < 2 || i == 7;
            places.push_back(place);
            outcomes.push_back(finishedAfter(104e-3, 1.0, turn(fails ? 90.0 + i : 0.0, base::Vec3::UnitX())));
        }
        Evaluation evaluation = judge.evaluation(outcomes);
        const auto worst = [&] { return objectives::findObjective("worst_half")->measure(evaluation); };
        QVERIFY(std::abs(worst().value - 59.0 / 80.0) < 1e-12);  // no box: success of all
        // Where nothing varies it is no score of its own, unless it counts.
        evaluation.isVaried = false;
        const auto scoreIn = [&](const char* sum) {
            const Fitness fitness =
                objectives::measureAll(evaluation, objectives::readObjectives(sum).value());
            return objectives::findScore(fitness, "worst_half") != nullptr;
        };
        QVERIFY(!scoreIn("F_D") && scoreIn("F_D, worst_half"));
        evaluation.isVaried = true;
        QVERIFY(scoreIn("F_D"));
        evaluation.places = places;
        QVERIFY(std::abs(worst().value - 20.0 / 40.0) < 1e-12);
        QVERIFY(std::abs(worst().error - std::sqrt(0.25 / 39.0)) < 1e-12);
        // Where friction does not vary, strokes alone divide the box: ...
        for (trial::BoxPlace& place : places)
            place[static_cast<std::size_t>(trial::Condition::friction)] = 0.5;
        // ... the lower half of the strokes has the failure of trial 7 as well.
        QVERIFY(std::abs(worst().value - 29.0 / 40.0) < 1e-12);
    }

    // 12 trials, four of them in corners of friction and stroke; of these one fails, of the others three.
    void theCornersOfTheBox() {
        const Judge judge;
        std::vector<Outcome> outcomes;
        std::vector<trial::BoxPlace> places;
        for (int i = 0; i < 12; ++i) {
            const bool isCorner = i % 3 == 0;
            trial::BoxPlace place = trial::kMiddle;
            place[static_cast<std::size_t>(trial::Condition::friction)] = isCorner ? i / 3 % 2 : 0.25;
            place[static_cast<std::size_t>(trial::Condition::halfStroke)] = i < 6 ? 0.0 : 1.0;
            places.push_back(place);
            const bool fails = i == 1 || i == 3 || i == 7 || i == 8;
            outcomes.push_back(finishedAfter(104e-3, 1.0, turn(fails ? 90.0 + i : 0.0, base::Vec3::UnitX())));
        }
        Evaluation evaluation = judge.evaluation(outcomes);
        const objectives::Objective& corners = *objectives::findObjective("corners");
        evaluation.hasCorners = false;
        QVERIFY(!corners.applies(evaluation));
        QCOMPARE(corners.measure(evaluation).value, 0.0);  // nothing is known of them
        evaluation.places = places;
        evaluation.hasCorners = true;
        QVERIFY(corners.applies(evaluation));
        QVERIFY(std::abs(corners.measure(evaluation).value - 0.75) < 1e-12);
        QVERIFY(std::abs(corners.measure(evaluation).error - std::sqrt(0.1875 / 3.0)) < 1e-12);
        evaluation.corners = stats::Count{9, 10};  // of a selection, which tries them apart
        QVERIFY(std::abs(corners.measure(evaluation).value - 0.9) < 1e-12);
        evaluation.corners.reset();
        QVERIFY(std::abs(objectives::findObjective("success")->measure(evaluation).value - 8.0 / 12.0) <
                1e-12);
    }

    void speedIsThatOfThePartsThatFinish() {
        const Judge judge;
        std::vector<Outcome> outcomes{finishedAfter(104e-3, 1.0, base::Quaternion::Identity()),
                                      finishedAfter(104e-3, 2.0, base::Quaternion::Identity())};
        QVERIFY(std::abs(scoreOf(judge.judge(outcomes), "conveying_speed") - 78e-3) < 1e-12);
        outcomes.push_back(finishedAfter(20e-3, 5.0, base::Quaternion::Identity()));
        outcomes.back().parts[0].ending = trial::Ending::stuck;
        QVERIFY(std::abs(scoreOf(judge.judge(outcomes), "conveying_speed") - 78e-3) < 1e-12);
        QCOMPARE(scoreOf(judge.judge(std::span(outcomes).last(1)), "conveying_speed"), 0.0);
    }

    // Of the track alone: a flat one is perfect, 20 mm of a rib that is too thin, 10 mm high, are 200 mm^2.
    void printabilityIsOfTheTrackAlone() {
        Judge judge;
        const auto sum = *objectives::readObjectives("F_P");
        const auto flawsOf = [&](const Judge& judged, int overlaps) {
            return objectives::measureAll(judged.evaluation({}, overlaps), sum).total;
        };
        QCOMPARE(flawsOf(judge, 0), 0.0);
        constexpr double kMm = base::kMillimetre;
        track::CrossSection rib{20 * kMm, {}};
        for (const auto& [y, z] :
             {std::pair{-30.0, 5.0}, {-0.31, 5.0}, {-0.3, 15.0}, {0.3, 15.0}, {0.31, 5.0}, {30.0, 5.0}})
            rib.points.emplace_back(y * kMm, z * kMm);
        track::CrossSection begin = rib;
        begin.x = 0.0;
        judge.track.sections = {begin, rib};
        judge.track.baseThickness = 3 * kMm;
        judge.track.solid = track::buildTrackSolid({}, judge.track.sections, judge.track.baseThickness).mesh;
        const double flaws = flawsOf(judge, 0);
        QVERIFY2(std::abs(flaws + 200.0) < 0.1, qPrintable(QString::number(flaws)));
        QCOMPARE(flawsOf(judge, 3), flaws);
        // It costs too much to be told where it does not count.
        QVERIFY(objectives::findScore(judge.judge({}), "F_P") == nullptr);
    }

    // The standard errors that one set of trials tells are the scatter of the scores over many sets.
    void errorsAreTheScatterOverManySets() {
        const Judge judge;
        constexpr int kSets = 600;
        std::map<std::string, std::vector<objectives::Score>> scores;
        base::Random random({21, 0, 0, 0, base::Purpose::test});
        // All in one corner, so that all objectives are of the same trials.
        trial::BoxPlace corner = trial::kMiddle;
        corner[static_cast<std::size_t>(trial::Condition::friction)] = 1.0;
        const std::vector<trial::BoxPlace> places(60, corner);
        for (int set = 0; set < kSets; ++set) {
            std::vector<Outcome> outcomes;
            outcomes.reserve(60);
            for (int i = 0; i < 60; ++i)
                outcomes.push_back(drawOutcome(random));
            Evaluation evaluation = judge.evaluation(outcomes);
            evaluation.places = places;
            for (const objectives::Score& score :
                 objectives::measureAll(evaluation, paperObjectives()).scores)
                scores[score.key].push_back(score);
        }
        for (const objectives::Objective& objective : objectives::allObjectives()) {
            if (!isScored(objective)) continue;
            double mean = 0.0;
            double told = 0.0;
            for (const objectives::Score& score : scores[std::string(objective.key)]) {
                mean += score.value / kSets;
                told += score.error * score.error / kSets;
            }
            double scatter = 0.0;
            for (const objectives::Score& score : scores[std::string(objective.key)])
                scatter += (score.value - mean) * (score.value - mean) / (kSets - 1);
            if (!objective.isNoisy) {
                QCOMPARE(scatter, 0.0);
                QCOMPARE(told, 0.0);
                continue;
            }
            // A deviation of so many is known to 3 %; 4 of these, and the bias of the U-statistic's.
            const double ratio = std::sqrt(told / scatter);
            QVERIFY2(ratio > 0.87 && ratio < 1.15,
                     qPrintable(QString("%1: %2").arg(objective.key.data()).arg(ratio)));
        }
    }

    void everyObjectiveIsDescribed() {
        std::set<std::string_view> keys;
        for (const objectives::Objective& objective : objectives::allObjectives()) {
            QVERIFY(keys.insert(objective.key).second);
            QCOMPARE(objectives::findObjective(objective.key), &objective);
            QVERIFY(!objective.symbol.empty() && !objective.name.empty() && objective.shownAs > 0.0);
            QVERIFY(objective.help.ends_with('.') && objective.measure != nullptr);
        }
        QVERIFY(keys.count(objectives::kSuccess) == 1);
        QVERIFY(objectives::findObjective("F_X") == nullptr);
        QCOMPARE(objectives::findObjective("conveying_speed")->title(), std::string("Speed [mm/s]"));
        QCOMPARE(objectives::shown(*objectives::findObjective("success"), 0.9876), std::string("98.8"));
        QCOMPARE(objectives::shown(*objectives::findObjective("F_C"), -0.0), std::string("0"));
    }

    void aPerfectFeederIsWorthWhatIsAttainable() {
        const part::SymmetryGroup none = testing::makeC1();
        const auto attainable = objectives::listAttainable({&none, OrientationDistance::symmetric, false});
        const Fitness perfect{0.0, attainable};
        QCOMPARE(scoreOf(perfect, "F_D"), 0.0);
        QCOMPARE(scoreOf(perfect, "success"), 1.0);
        QVERIFY(std::abs(scoreOf(perfect, "F_O") - 1.4664) < 1e-3);
        QVERIFY(objectives::findScore(perfect, "conveying_speed") == nullptr);
        QVERIFY(objectives::findScore(perfect, "F_W") == nullptr);
        const Fitness wanted{0.0, objectives::listAttainable({&none, OrientationDistance::symmetric, true})};
        QCOMPARE(scoreOf(wanted, "F_W"), 1.0);
        QCOMPARE(scoreOf(wanted, "F_O"), scoreOf(perfect, "F_O"));
    }

    void whatIsWantedCountsWhereItIsWantedAlone() {
        const Judge judge;
        // 3 of 5 lie on a side, 1 stands, 1 fell off: the mode is a side, and standing is wanted.
        const base::Quaternion side = turn(90.0, base::Vec3::UnitX());
        std::vector<Outcome> outcomes(3, finishedAfter(104e-3, 1.0, side));
        outcomes.push_back(finishedAfter(104e-3, 1.0, turn(130.0, base::Vec3::UnitZ())));
        outcomes.push_back(outcomes.front());
        outcomes.back().parts.front().ending = trial::Ending::fellOff;
        objectives::Evaluation evaluation = judge.evaluation(outcomes);
        const auto sum = objectives::readObjectives("F_O, F_W").value();
        const Fitness any = objectives::measureAll(evaluation, paperObjectives());
        QVERIFY(objectives::findScore(any, "F_W") == nullptr);
        QCOMPARE(scoreOf(any, "success"), 0.6);

        evaluation.wanted = trial::Goal{{{base::Quaternion::Identity(), true}}};
        const Fitness wanted = objectives::measureAll(evaluation, sum);
        QCOMPARE(scoreOf(wanted, "F_W"), 0.2);
        QCOMPARE(scoreOf(wanted, "success"), 0.2);
        QCOMPARE(scoreOf(wanted, "correct"), 0.25);
        QCOMPARE(scoreOf(wanted, "worst_half"), 0.2);
        QCOMPARE(wanted.total, scoreOf(any, "F_O") + 0.2);
        // The binomial's: sqrt(p (1 - p) / (n - 1)).
        QVERIFY(std::abs(objectives::findScore(wanted, "F_W")->error - 0.2) < 1e-12);
        // In one heading alone it does not stand right.
        evaluation.wanted = trial::makeGoal(base::Quaternion::Identity());
        QCOMPARE(scoreOf(objectives::measureAll(evaluation, sum), "F_W"), 0.0);
        // Several are as good as each other.
        evaluation.wanted = trial::Goal{{{base::Quaternion::Identity(), true}, {side, false}}};
        QCOMPARE(scoreOf(objectives::measureAll(evaluation, sum), "F_W"), 0.8);
    }

    void whatCountsIsSummed() {
        const auto list = objectives::readObjectives(" F_D,success ");
        QVERIFY(list.ok());
        QCOMPARE(objectives::describeSum(*list), std::string("F_D + Success"));
        const Judge judge;
        const std::vector<Outcome> outcomes(4, finishedAfter(104e-3, 1.0, base::Quaternion::Identity()));
        const Fitness some = objectives::measureSum(judge.evaluation(outcomes), *list);
        QCOMPARE(some.scores.size(), std::size_t{2});
        QCOMPARE(some.total, 1.0);
        const Fitness all = objectives::measureOthers(judge.evaluation(outcomes), some);
        QCOMPARE(all.total, 1.0);
        QCOMPARE(all.scores.size(),
                 objectives::allObjectives().size() - 5);  // all but F_W, F_P, purity, yield and throughput
        QVERIFY(all == objectives::measureAll(judge.evaluation(outcomes), *list));
        const Fitness errors{0.0, {{"F_D", 1.0, 3.0}, {"success", 1.0, 4.0}, {"F_O", 1.0, 9.0}}};
        QCOMPARE(objectives::calcTotalError(errors, *list), 5.0);
    }

    void unknownObjectivesAreNamed_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("told");
        QTest::newRow("unknown") << "F_C, F_Q"
                                 << "There is no objective named \"F_Q\". The objectives are: F_C, F_D, F_O, "
                                    "F_W, disorder, sorting, success, correct, purity, yield, throughput, "
                                    "worst_half, corners, conveying_speed, "
                                    "F_P. Write "
                                    "several with commas between them.";
        QTest::newRow("empty") << ""
                               << "There is no objective named \"\".";
        QTest::newRow("end") << "F_C,"
                             << "There is no objective named \"\".";
        QTest::newRow("twice") << "F_C, F_D, F_C"
                               << "The objective F_C is named twice; once is enough.";
    }
    void unknownObjectivesAreNamed() {
        QFETCH(QString, text);
        QFETCH(QString, told);
        const auto list = objectives::readObjectives(text.toStdString());
        QVERIFY(!list.ok());
        QVERIFY2(list.error().message.starts_with(told.toStdString()), list.error().message.c_str());
    }
};

QTEST_APPLESS_MAIN(ObjectivesTest)
#include "objectives_test.moc"
