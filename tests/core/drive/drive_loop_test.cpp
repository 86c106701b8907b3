#include "core/drive/drive_loop.h"

#include <QtTest>
#include <atomic>
#include <mutex>

using namespace trapwright;
using drive::Command;
using drive::LogKind;
using drive::State;
using std::chrono::milliseconds;

namespace {

/// What the test and the drive on the loop's thread share.
struct Plant {
    std::mutex mutex;
    std::vector<Command> told;
    std::vector<drive::LogEntry> log;
    std::atomic<int> logged = 0;
    std::atomic<bool> reachable = true;
    std::atomic<bool> answers = true;
    std::atomic<int> stall = 0;  // [ms] that the next exchange takes
    std::atomic<bool> logIsAhead = true;
    std::atomic<std::thread::id> made;
    std::atomic<bool> oneThread = true;

    Command last() {
        const std::lock_guard lock(mutex);
        return told.empty() ? Command{} : told.back();
    }
};

class FakeDrive final : public drive::Drive {
 public:
    explicit FakeDrive(Plant& plant) : plant_(plant) { plant_.made = std::this_thread::get_id(); }
    FakeDrive(const FakeDrive&) = delete;
    FakeDrive& operator=(const FakeDrive&) = delete;
    ~FakeDrive() override { checkThread(); }

    base::Status connect() override {
        checkThread();
        if (!plant_.reachable) return base::Error{"nobody there"};
        connected_ = true;
        return base::success();
    }
    [[nodiscard]] bool connected() const override { return connected_; }
    base::Result<drive::Reading> exchange(const Command& command) override {
        checkThread();
        std::this_thread::sleep_for(milliseconds(plant_.stall.exchange(0)));
        if (!plant_.answers) return base::Error{"no answer"};
        take(command);
        drive::Reading reading;
        reading.setPoint = command.setPoint;
        reading.enabled = command.enable;
        return reading;
    }
    void disconnect() override {
        checkThread();
        if (connected_) take(Command{});
        connected_ = false;
    }

 private:
    void checkThread() {
        if (plant_.made.load() != std::this_thread::get_id()) plant_.oneThread = false;
    }
    void take(const Command& command) {
        const std::lock_guard lock(plant_.mutex);
        plant_.told.push_back(command);
        int commands = 0;
        for (const drive::LogEntry& entry : plant_.log)
            commands += entry.kind == LogKind::command ? 1 : 0;
        if (commands < static_cast<int>(plant_.told.size())) plant_.logIsAhead = false;
    }

    Plant& plant_;
    bool connected_ = false;
};

drive::Profile quick() {
    drive::Profile profile;
    profile.heartbeat = 20.0;
    profile.timeOut = 0.1;
    profile.watchdog = 1.0;
    profile.settlingTime = 0.2;
    return profile;
}

std::unique_ptr<drive::DriveLoop> run(Plant& plant) {
    return std::make_unique<drive::DriveLoop>(
        quick(), drive::Limits{0.8, 4.0},
        [&plant]() -> base::Result<std::unique_ptr<drive::Drive>> {
            return std::unique_ptr<drive::Drive>(std::make_unique<FakeDrive>(plant));
        },
        [&plant](const drive::LogEntry& entry) {
            const std::lock_guard lock(plant.mutex);
            plant.log.push_back(entry);
        });
}

bool isIn(const drive::DriveLoop& loop, State state) {
    return QTest::qWaitFor([&] { return loop.snapshot().state == state; }, 3000);
}

bool rests(const Command& command) {
    return command.setPoint == 0.0 && !command.enable;
}

std::unique_ptr<drive::DriveLoop> runAt(Plant& plant, double target) {
    auto loop = run(plant);
    if (!isIn(*loop, State::idle)) return nullptr;
    loop->setTarget(target);
    loop->start();
    return isIn(*loop, State::running) ? std::move(loop) : nullptr;
}

int count(Plant& plant, LogKind kind) {
    const std::lock_guard lock(plant.mutex);
    return static_cast<int>(
        std::count_if(plant.log.begin(), plant.log.end(),
                      [kind](const drive::LogEntry& entry) { return entry.kind == kind; }));
}

}  // namespace

class DriveLoopTest : public QObject {
    Q_OBJECT

 private slots:
    void runsAndEndsAtRest() {
        Plant plant;
        auto loop = runAt(plant, 0.5);
        QVERIFY(loop);
        QCOMPARE(loop->snapshot().command.setPoint, 0.5);
        QElapsedTimer timer;
        timer.start();
        loop.reset();
        QVERIFY(timer.elapsed() < 400);
        QVERIFY(rests(plant.last()));
        QVERIFY(plant.oneThread);
        QVERIFY(plant.logIsAhead);
        QCOMPARE(count(plant, LogKind::disconnected), 1);
    }

    void theHeartbeatIsSteady() {
        Plant plant;
        auto loop = run(plant);
        QVERIFY(isIn(*loop, State::idle));
        const int before = count(plant, LogKind::reading);
        QTest::qWait(1000);
        const int beats = count(plant, LogKind::reading) - before;
        QVERIFY2(beats >= 15 && beats <= 22, qPrintable(QString::number(beats)));
    }

    void stopDoesNotWaitForTheBeat() {
        Plant plant;
        drive::Profile slow = quick();
        slow.heartbeat = 2.0;
        drive::DriveLoop loop(slow, {0.8, 100.0},
                              [&plant]() -> base::Result<std::unique_ptr<drive::Drive>> {
                                  return std::unique_ptr<drive::Drive>(std::make_unique<FakeDrive>(plant));
                              },
                              {});
        QVERIFY(isIn(loop, State::idle));
        loop.setTarget(0.5);
        loop.start();
        QVERIFY(isIn(loop, State::running));
        QElapsedTimer timer;
        timer.start();
        loop.stop();
        QVERIFY(QTest::qWaitFor([&] { return rests(plant.last()); }, 450));
        QVERIFY2(timer.elapsed() < 250, qPrintable(QString::number(timer.elapsed())));
    }

    void aDriveThatComesLaterIsFound() {
        Plant plant;
        plant.reachable = false;
        auto loop = run(plant);
        QVERIFY(QTest::qWaitFor([&] { return loop->snapshot().fault == "nobody there"; }, 2000));
        QCOMPARE(loop->snapshot().state, State::disconnected);
        loop->start();
        QVERIFY(QTest::qWaitFor([&] { return !loop->snapshot().refusal.empty(); }, 2000));
        plant.reachable = true;
        QVERIFY(isIn(*loop, State::idle));
        QTest::qWait(200);
        QVERIFY(rests(plant.last()));
        QCOMPARE(count(plant, LogKind::note), 2);
    }

    void silenceIsAFaultThatMustBeAcknowledged() {
        Plant plant;
        auto loop = runAt(plant, 0.5);
        QVERIFY(loop);
        plant.answers = false;
        QVERIFY(isIn(*loop, State::faulted));
        QVERIFY(rests(plant.last()));
        plant.answers = true;
        QVERIFY(QTest::qWaitFor([&] { return loop->snapshot().connected; }, 3000));
        QTest::qWait(300);
        QCOMPARE(loop->snapshot().state, State::faulted);
        QCOMPARE(loop->snapshot().fault, std::string("no answer"));
        loop->acknowledge();
        QVERIFY(isIn(*loop, State::idle));
        QVERIFY(rests(plant.last()));
    }

    // Nobody can be told any more: the last snapshot says so.
    void whoeverLeavesASilentDriveIsWarned() {
        Plant plant;
        auto loop = runAt(plant, 0.5);
        QVERIFY(loop);
        QVERIFY(loop->snapshot().warning.empty());
        plant.answers = false;
        loop->finish();
        QVERIFY(loop->ended());
        QVERIFY(!loop->snapshot().warning.empty());

        Plant good;
        loop = runAt(good, 0.5);
        QVERIFY(loop);
        loop->finish();
        QVERIFY(loop->snapshot().warning.empty());
        QVERIFY(rests(good.last()));
    }

    void aStalledHeartbeatIsAFault() {
        Plant plant;
        auto loop = runAt(plant, 0.5);
        QVERIFY(loop);
        plant.stall = 1200;
        QVERIFY(isIn(*loop, State::faulted));
        QVERIFY(QString::fromStdString(loop->snapshot().fault).contains("late"));
        QVERIFY(rests(plant.last()));
    }

    void aWindowThatHangsRestsTheFeeder() {
        Plant plant;
        auto loop = runAt(plant, 0.5);
        QVERIFY(loop);
        for (int i = 0; i < 5; ++i) {
            loop->attend();
            QTest::qWait(200);
        }
        QCOMPARE(loop->snapshot().state, State::running);
        // From here on the window is silent.
        QElapsedTimer timer;
        timer.start();
        QVERIFY(isIn(*loop, State::faulted));
        QVERIFY(timer.elapsed() < 2500);
        QVERIFY(rests(plant.last()));
        QVERIFY(QString::fromStdString(loop->snapshot().fault).contains("window"));
    }

    void theLogIsWhole() {
        Plant plant;
        {
            auto loop = runAt(plant, 0.5);
            QVERIFY(loop);
            loop->note("first part, upside down");
            loop->stop();
            QVERIFY(isIn(*loop, State::idle));
            loop->note("the last word");
        }
        std::int64_t number = 0;
        double time = 0.0;
        std::vector<std::string> states;
        for (const drive::LogEntry& entry : plant.log) {
            QCOMPARE(entry.number, ++number);
            QVERIFY(entry.time >= time);
            time = entry.time;
            if (entry.kind == LogKind::state) states.push_back(entry.text);
        }
        QCOMPARE(states, (std::vector<std::string>{"idle", "ramping", "running", "stopping", "idle",
                                                   "disconnected"}));
        QCOMPARE(count(plant, LogKind::note), 2);
        QCOMPARE(count(plant, LogKind::command), static_cast<int>(plant.told.size()));
        QVERIFY(std::abs(time - static_cast<double>(QDateTime::currentMSecsSinceEpoch()) * 1e-3) < 5.0);
    }
};

QTEST_GUILESS_MAIN(DriveLoopTest)
#include "drive_loop_test.moc"
