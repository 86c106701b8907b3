#include "core/trial/returns.h"

#include <QtTest>

#include "core/track/track_builder.h"

using namespace trapwright;
using trial::Returns;

namespace {

/// Cut away from the outer edge beyond y = -10 mm, from x = 110 to 140 mm.
track::Track makeCutTrack() {
    const auto section = [](double x, double outer) {
        return track::CrossSection{x, {base::Vec2(-30e-3, 15e-3), base::Vec2(outer, 15e-3)}};
    };
    return *track::buildTrack({}, std::vector{section(29e-3, 30e-3), section(30e-3, -10e-3),
                                              section(60e-3, -10e-3), section(61e-3, 30e-3)});
}

trial::PartOutcome fallenAt(double x, double y) {
    trial::PartOutcome outcome;
    outcome.ending = trial::Ending::fellOff;
    outcome.farthest.position = {x, y, -1e-3};
    return outcome;
}

}  // namespace

class ReturnsTest : public QObject {
    Q_OBJECT

 private slots:
    void whatFallsAtTheSideComesAgain_data() {
        QTest::addColumn<double>("x");  // [mm]
        QTest::addColumn<double>("y");
        QTest::addColumn<bool>("outer");
        QTest::newRow("over the inner edge") << 50.0 << -31.0 << false;
        QTest::newRow("over the outer edge") << 50.0 << 31.0 << true;
        QTest::newRow("over the inner edge, beside the cut") << 120.0 << -31.0 << false;
        QTest::newRow("through the cut") << 120.0 << 5.0 << true;
        QTest::newRow("through the cut, inside of the middle") << 120.0 << -8.0 << true;
        QTest::newRow("behind the track") << 900.0 << 31.0 << true;
        QTest::newRow("before the track") << -20.0 << -31.0 << false;
    }
    void whatFallsAtTheSideComesAgain() {
        QFETCH(double, x);
        QFETCH(double, y);
        QFETCH(bool, outer);
        const track::Track track = makeCutTrack();
        const trial::PartOutcome fallen = fallenAt(1e-3 * x, 1e-3 * y);
        QVERIFY(trial::comesAgain(fallen, track, Returns::anywhere));
        QVERIFY(!trial::comesAgain(fallen, track, Returns::nowhere));
        QCOMPARE(trial::comesAgain(fallen, track, Returns::outerSide), outer);
        QCOMPARE(trial::comesAgain(fallen, track, Returns::innerSide), !outer);
    }

    void whatDoesNotFallDoesNot() {
        const track::Track track = makeCutTrack();
        for (const trial::Ending ending :
             {trial::Ending::finished, trial::Ending::stuck, trial::Ending::timedOut}) {
            trial::PartOutcome outcome = fallenAt(50e-3, 31e-3);
            outcome.ending = ending;
            QVERIFY(!trial::comesAgain(outcome, track, Returns::anywhere));
        }
    }
};

QTEST_APPLESS_MAIN(ReturnsTest)
#include "returns_test.moc"
