#include "core/drive/supervisor.h"

#include <QtTest>
#include <cmath>

using namespace trapwright;
using drive::Command;
using drive::Reading;
using drive::State;

namespace {

constexpr double kBeat = 0.125;  // [s]

drive::Agreement strict() {
    drive::Agreement agreement;
    agreement.tolerance = 0.02;
    agreement.settlingTime = 0.5;
    agreement.restAcceleration = 2.0;
    agreement.longestGap = 1.0;
    return agreement;
}

/// A supervisor, a clock made by hand, and a drive that does what it is told unless the test says otherwise.
struct Bench {
    drive::Supervisor supervisor = drive::Supervisor(drive::Limits{0.8, 0.4}, strict());
    double now = 100.0;
    Command told;
    double offset = 0.0;  // of what the drive says from what it was told
    std::optional<bool> enabled;
    std::optional<double> acceleration = 0.0;
    std::optional<std::string> fault;

    void beat(double gap = kBeat) {
        now += gap;
        told = supervisor.command(now);
        Reading reading;
        reading.setPoint = told.setPoint + offset;
        reading.enabled = enabled.value_or(told.enable);
        reading.acceleration = acceleration;
        reading.fault = fault;
        supervisor.observe(reading, now);
    }
    void beatFor(double seconds) {
        for (const double end = now + seconds; now < end - 1e-9;)
            beat();
    }
    void run(double target) {
        supervisor.connected(now);
        beatFor(1.0);
        supervisor.setTarget(target);
        QVERIFY(supervisor.start());
        beatFor(3.0);
        QCOMPARE(supervisor.state(), State::running);
    }
};

bool rests(const Command& command) {
    return command.setPoint == 0.0 && !command.enable;
}

}  // namespace

class SupervisorTest : public QObject {
    Q_OBJECT

 private slots:
    void nothingMovesWithoutStart() {
        Bench bench;
        bench.supervisor.setTarget(0.5);
        QVERIFY(!bench.supervisor.start());
        bench.supervisor.connected(bench.now);
        bench.supervisor.setTarget(0.7);
        bench.supervisor.setFrequency(50.0);
        bench.supervisor.setLimits({1.0, 10.0});
        for (int i = 0; i < 100; ++i) {
            bench.beat();
            QVERIFY(rests(bench.told));
            QCOMPARE(bench.supervisor.state(), State::idle);
        }
    }

    void setPointsFollowTheRamp() {
        Bench bench;
        bench.supervisor.connected(bench.now);
        bench.beat();
        bench.supervisor.setTarget(0.5);
        QVERIFY(bench.supervisor.start());
        QCOMPARE(bench.supervisor.state(), State::ramping);
        double before = 0.0;
        const double begin = bench.now;
        while (bench.supervisor.state() == State::ramping) {
            bench.beat();
            QVERIFY(bench.told.setPoint - before <= 0.4 * kBeat + 1e-12);
            before = bench.told.setPoint;
        }
        QCOMPARE(bench.told.setPoint, 0.5);
        // 0.5 of full at 0.4 of full per second, and at most a beat more.
        QVERIFY(bench.now - begin > 1.25 - 1e-9 && bench.now - begin < 1.25 + kBeat + 1e-9);
        // Down as well, while it runs.
        bench.supervisor.setTarget(0.3);
        bench.beat();
        QVERIFY(std::abs(bench.told.setPoint - 0.45) < 1e-12);
        QVERIFY(bench.told.enable);
    }

    void noTargetIsAboveTheLimit_data() {
        QTest::addColumn<double>("target");
        QTest::addColumn<double>("expected");
        QTest::newRow("below") << 0.6 << 0.6;
        QTest::newRow("at") << 0.8 << 0.8;
        QTest::newRow("above") << 1.0 << 0.8;
        QTest::newRow("far above") << 1e9 << 0.8;
        QTest::newRow("below zero") << -0.5 << 0.0;
        QTest::newRow("infinite") << std::numeric_limits<double>::infinity() << 0.8;
        QTest::newRow("not a number") << std::nan("") << 0.0;
    }
    void noTargetIsAboveTheLimit() {
        QFETCH(double, target);
        QFETCH(double, expected);
        Bench bench;
        bench.run(target);
        QCOMPARE(bench.told.setPoint, expected);
    }

    void limitsThatAreNoNumbersLetNothingMove() {
        const double none = std::nan("");
        Bench bench;
        bench.run(0.5);
        bench.supervisor.setLimits({none, 0.4});
        bench.beatFor(3.0);
        QCOMPARE(bench.told.setPoint, 0.0);
        Bench other;
        other.supervisor.setLimits({0.8, none});
        other.supervisor.connected(other.now);
        other.beatFor(1.0);
        other.supervisor.setTarget(0.5);
        QVERIFY(other.supervisor.start());
        other.beatFor(3.0);
        QCOMPARE(other.told.setPoint, 0.0);
    }

    void theSameWishTwiceChangesNothing() {
        Bench bench;
        bench.run(0.5);
        bench.supervisor.setTarget(0.5);
        QCOMPARE(bench.supervisor.state(), State::running);
        bench.supervisor.setTarget(0.6);
        QCOMPARE(bench.supervisor.state(), State::ramping);
    }

    void aLoweredLimitLowersWhatRuns() {
        Bench bench;
        bench.run(0.8);
        bench.supervisor.setLimits({0.2, 0.4});
        bench.beat();
        QVERIFY(bench.told.setPoint <= 0.2);
    }

    void stopIsAtOnce() {
        Bench bench;
        bench.run(0.8);
        bench.supervisor.stop();
        QCOMPARE(bench.supervisor.state(), State::stopping);
        bench.beat(0.001);
        QVERIFY(rests(bench.told));
        QCOMPARE(bench.supervisor.state(), State::idle);
        // The wish is still there, and moves nothing.
        bench.beatFor(2.0);
        QVERIFY(rests(bench.told));
        QVERIFY(bench.supervisor.start());
        bench.beat();
        QVERIFY(bench.told.setPoint <= 0.4 * kBeat + 1e-12);
    }

    void stoppingLastsUntilTheFeederRests() {
        Bench bench;
        bench.run(0.5);
        bench.acceleration = 30.0;
        bench.supervisor.stop();
        bench.beat();
        QCOMPARE(bench.supervisor.state(), State::stopping);
        QVERIFY(!bench.supervisor.start());
        bench.acceleration = 0.5;
        bench.beat();
        QCOMPARE(bench.supervisor.state(), State::idle);
    }

    void motionAtRestIsAFault() {
        Bench bench;
        bench.run(0.5);
        bench.acceleration = 30.0;
        bench.supervisor.stop();
        bench.beatFor(3.0);
        QCOMPARE(bench.supervisor.state(), State::faulted);
        QVERIFY(bench.supervisor.fault().find("vibrates") != std::string::npos);
    }

    void faultsOfTheDriveRestIt() {
        Bench bench;
        bench.run(0.5);
        bench.fault = "over temperature";
        bench.beat();
        QCOMPARE(bench.supervisor.state(), State::faulted);
        QVERIFY(bench.supervisor.fault().find("over temperature") != std::string::npos);
        bench.beat(0.001);
        QVERIFY(rests(bench.told));
    }

    void onlyAcknowledgementLeadsOutOfAFault() {
        Bench bench;
        bench.run(0.5);
        bench.fault = "over temperature";
        bench.beat();
        QVERIFY(!bench.supervisor.start());
        // The fault is still there.
        QVERIFY(!bench.supervisor.acknowledge());
        bench.fault.reset();
        bench.beatFor(5.0);
        QCOMPARE(bench.supervisor.state(), State::faulted);
        QVERIFY(!bench.supervisor.start());
        bench.beat();
        QVERIFY(rests(bench.told));
        QVERIFY(bench.supervisor.acknowledge());
        QCOMPARE(bench.supervisor.state(), State::idle);
        QVERIFY(bench.supervisor.fault().empty());
        bench.beatFor(2.0);
        QVERIFY(rests(bench.told));
        QVERIFY(bench.supervisor.start());
        bench.beat();
        QVERIFY(bench.told.enable);
    }

    void aLostConnectionIsAFault() {
        Bench bench;
        bench.run(0.5);
        bench.supervisor.failed("no answer");
        QCOMPARE(bench.supervisor.state(), State::faulted);
        QCOMPARE(bench.supervisor.fault(), std::string("no answer"));
        bench.beat();
        QVERIFY(rests(bench.told));
        // Not while nobody knows what the drive does.
        drive::Supervisor& supervisor = bench.supervisor;
        supervisor.failed("no answer either");
        QVERIFY(!supervisor.acknowledge());
        supervisor.connected(bench.now);
        QCOMPARE(supervisor.state(), State::faulted);
        QVERIFY(!supervisor.acknowledge());
        bench.beat();
        QVERIFY(rests(bench.told));
        // The first cause counts.
        QCOMPARE(supervisor.fault(), std::string("no answer"));
        QVERIFY(supervisor.acknowledge());
        QCOMPARE(supervisor.state(), State::idle);
    }

    void disconnectingIsNoFault() {
        Bench bench;
        bench.run(0.5);
        bench.supervisor.disconnected();
        QCOMPARE(bench.supervisor.state(), State::disconnected);
        QVERIFY(rests(bench.supervisor.command(bench.now + kBeat)));
        QVERIFY(!bench.supervisor.start());
    }

    void readingsMayLagBehindTheRamp() {
        Bench bench;
        bench.supervisor.connected(bench.now);
        bench.beatFor(1.0);
        bench.supervisor.setTarget(0.8);
        QVERIFY(bench.supervisor.start());
        // Two beats late: more than the tolerance, less than the time to settle.
        std::deque<double> late(3, 0.0);
        for (int i = 0; i < 40; ++i) {
            bench.now += kBeat;
            const Command told = bench.supervisor.command(bench.now);
            late.push_back(told.setPoint);
            late.pop_front();
            Reading reading;
            reading.setPoint = late.front();
            bench.supervisor.observe(reading, bench.now);
            QVERIFY(bench.supervisor.state() != State::faulted);
        }
        QCOMPARE(bench.supervisor.state(), State::running);
    }

    void disagreementIsAFault_data() {
        QTest::addColumn<double>("offset");
        QTest::addColumn<bool>("fault");
        QTest::newRow("exact") << 0.0 << false;
        QTest::newRow("within the tolerance") << 0.019 << false;
        QTest::newRow("above") << 0.021 << true;
        QTest::newRow("below") << -0.021 << true;
        QTest::newRow("far") << 0.5 << true;
    }
    void disagreementIsAFault() {
        QFETCH(double, offset);
        QFETCH(bool, fault);
        Bench bench;
        bench.run(0.5);
        bench.offset = offset;
        bench.beatFor(1.0);
        QCOMPARE(bench.supervisor.state(), fault ? State::faulted : State::running);
        QCOMPARE(rests(bench.told), fault);
    }

    void anEnableThatDisagreesIsAFault() {
        Bench off;
        off.run(0.5);
        off.enabled = false;
        off.beatFor(1.0);
        QCOMPARE(off.supervisor.state(), State::faulted);

        Bench on;
        on.supervisor.connected(on.now);
        on.beatFor(1.0);
        on.enabled = true;
        on.beatFor(1.0);
        QCOMPARE(on.supervisor.state(), State::faulted);
        QVERIFY(!on.supervisor.acknowledge());
    }

    void aDriveIsFoundAsItIs() {
        Bench bench;
        // Another program has left it on. It is told to rest and gets the time to do so.
        bench.supervisor.connected(bench.now);
        bench.offset = 0.6;
        bench.enabled = true;
        bench.beatFor(0.5);
        QCOMPARE(bench.supervisor.state(), State::idle);
        bench.beatFor(0.5);
        QCOMPARE(bench.supervisor.state(), State::faulted);
    }

    void whatIsNoNumberIsNoRest_data() {
        QTest::addColumn<double>("acceleration");
        QTest::newRow("not a number") << std::nan("");
        QTest::newRow("infinite") << std::numeric_limits<double>::infinity();
        QTest::newRow("below zero") << -30.0;
    }
    void whatIsNoNumberIsNoRest() {
        QFETCH(double, acceleration);
        Bench bench;
        bench.run(0.5);
        bench.acceleration = acceleration;
        bench.supervisor.stop();
        bench.beat();
        QVERIFY(bench.supervisor.state() != State::idle);
        bench.beatFor(2.0);
        QCOMPARE(bench.supervisor.state(), State::faulted);
        QVERIFY(bench.supervisor.mayMove());
        QVERIFY(!bench.supervisor.acknowledge());
    }

    void aLostDriveMayMoveUntilItSaysOtherwise() {
        Bench bench;
        bench.supervisor.connected(bench.now);
        bench.beat();
        // One that was never started is lost without a warning.
        bench.supervisor.failed("no answer");
        QVERIFY(!bench.supervisor.mayMove());
        bench.supervisor.connected(bench.now);
        bench.beat();
        QVERIFY(bench.supervisor.acknowledge());
        bench.supervisor.setTarget(0.5);
        QVERIFY(bench.supervisor.start());
        bench.beat();
        bench.supervisor.failed("no answer");
        QVERIFY(bench.supervisor.mayMove());
        bench.supervisor.connected(bench.now);
        QVERIFY(bench.supervisor.mayMove());
        bench.beat();
        QVERIFY(!bench.supervisor.mayMove());
        QVERIFY(bench.supervisor.restConfirmed());
    }

    void aHeartbeatThatIsMissedIsAFault() {
        Bench bench;
        bench.run(0.5);
        bench.beat(0.9);
        QCOMPARE(bench.supervisor.state(), State::running);
        bench.beat(1.1);
        QCOMPARE(bench.supervisor.state(), State::faulted);
        QVERIFY(rests(bench.told));
        QVERIFY(bench.supervisor.fault().find("late") != std::string::npos);
        // At rest nothing depends on the heartbeat.
        bench.beat();
        QVERIFY(bench.supervisor.acknowledge());
        bench.beat(30.0);
        QCOMPARE(bench.supervisor.state(), State::idle);
    }
};

QTEST_APPLESS_MAIN(SupervisorTest)
#include "supervisor_test.moc"
