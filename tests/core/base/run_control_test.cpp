#include "core/base/run_control.h"

#include <QtTest>
#include <atomic>
#include <thread>
#include <vector>

using namespace trapwright;

/// Work on several threads that is held up, goes on and is cancelled.
class RunControlTest : public QObject {
    Q_OBJECT

 private slots:
    void cancelEndsTheWork() {
        Work work(4);
        QTRY_VERIFY(work.control.done() > 100);
        base::RunControl copy = work.control;
        copy.cancel();
        work.join();
        QVERIFY(work.control.cancelled() && !work.control.mayGoOn());
    }

    void pausedWorkStandsStill() {
        Work work(4);
        QTRY_VERIFY(work.control.done() > 100);
        work.control.pause();
        QVERIFY(work.control.paused() && !work.control.cancelled());
        QTest::qWait(50);
        const std::int64_t done = work.control.done();
        QTest::qWait(100);
        QCOMPARE(work.control.done(), done);
        work.control.resume();
        QVERIFY(!work.control.paused());
        QTRY_VERIFY(work.control.done() > done + 100);
        work.control.cancel();
        work.join();
    }

    void cancelWakesWhatWaits() {
        Work work(4);
        work.control.pause();
        QTest::qWait(50);
        work.control.cancel();
        work.join();
        // What is cancelled does not wait any more.
        work.control.pause();
        QVERIFY(!work.control.mayGoOn());
    }

 private:
    struct Work {
        explicit Work(int count) {
            for (int i = 0; i < count; ++i)
                threads.emplace_back([control = control]() mutable {
                    while (control.mayGoOn())
                        control.advance(1);
                });
        }
        ~Work() { control.cancel(); }
        void join() { threads.clear(); }

        base::RunControl control;
        std::vector<std::jthread> threads;
    };
};

QTEST_APPLESS_MAIN(RunControlTest)
#include "run_control_test.moc"
