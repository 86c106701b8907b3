#include "core/base/parallel.h"

#include <sys/resource.h>

#include <QtTest>
#include <thread>

using namespace trapwright;

class ThreadPriorityTest : public QObject {
    Q_OBJECT

 private slots:
    void onlyTheThreadAndThoseItStartsStepBack() {
        const int before = ::getpriority(PRIO_PROCESS, 0);
        int own = -1;
        int started = -1;
        std::thread thread([&] {
            base::lowerPriority();
            own = ::getpriority(PRIO_PROCESS, 0);
            std::thread([&] { started = ::getpriority(PRIO_PROCESS, 0); }).join();
        });
        thread.join();
        QCOMPARE(own, 19);
        QCOMPARE(started, 19);
        QCOMPARE(::getpriority(PRIO_PROCESS, 0), before);
    }

    void stepsAreFromWhereTheThreadIs() {
        const int before = ::getpriority(PRIO_PROCESS, 0);
        int once = -1;
        int twice = -1;
        std::thread([&] {
            base::lowerPriority(3);
            once = ::getpriority(PRIO_PROCESS, 0);
            base::lowerPriority(4);
            twice = ::getpriority(PRIO_PROCESS, 0);
        }).join();
        QCOMPARE(once, std::min(before + 3, 19));
        QCOMPARE(twice, std::min(before + 7, 19));
    }
};

QTEST_APPLESS_MAIN(ThreadPriorityTest)
#include "thread_priority_test.moc"
