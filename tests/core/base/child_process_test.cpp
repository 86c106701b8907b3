#include "core/base/child_process.h"

#include <QTemporaryFile>
#include <QtTest>
#include <csignal>
#include <thread>

using namespace trapwright;
using base::ChildEnd;

namespace {

base::Result<base::ChildOutcome> run(std::string_view request, const base::ChildLimits& limits = {},
                                     const base::RunControl& control = {},
                                     const std::function<void(std::string_view)>& tellStage = {}) {
    return base::runChild(TRAPWRIGHT_MISBEHAVING_CHILD, request, limits, control, tellStage);
}

}  // namespace

/// Whatever a child does, who asked gets to know and goes on.
class ChildProcessTest : public QObject {
    Q_OBJECT

 private slots:
    void itsAnswerAndItsStages() {
        std::vector<std::string> stages;
        const auto outcome =
            run("hello", {}, {}, [&](std::string_view stage) { stages.emplace_back(stage); });
        QVERIFY2(outcome.ok(), outcome.ok() ? "" : outcome.error().message.c_str());
        QVERIFY(outcome->end == ChildEnd::finished);
        QCOMPARE(outcome->result, std::string("answer to hello"));
        QCOMPARE(stages, (std::vector<std::string>{"waking up", "hello"}));
    }

    void requestAndAnswerOfAnySize() {
        const std::string large(20U << 20U, '\x7f');
        QCOMPARE(run(large)->result, "answer to " + large);
        QCOMPARE(run({})->result, std::string("answer to "));
        const std::string zeros("\0a\0", 3);
        QCOMPARE(run(zeros)->result, "answer to " + zeros);
    }

    void whatEndsOrHangsIt_data() {
        QTest::addColumn<QByteArray>("request");
        QTest::addColumn<int>("end");
        QTest::addColumn<int>("signal");
        const auto row = [](const char* request, ChildEnd end, int signal = 0) {
            QTest::newRow(request) << QByteArray(request) << static_cast<int>(end) << signal;
        };
        row("abort", ChildEnd::crashed, SIGABRT);
        row("segfault", ChildEnd::crashed, SIGSEGV);
        row("exit", ChildEnd::crashed);
        row("stack", ChildEnd::crashed, SIGSEGV);
        row("hang", ChildEnd::outOfTime);
        row("spin", ChildEnd::outOfTime);
        row("memory", ChildEnd::outOfMemory);
        row("chatter", ChildEnd::finished);
        row("nonsense", ChildEnd::crashed);
        row("flood", ChildEnd::crashed);
        row("half", ChildEnd::crashed);
        row("open files", ChildEnd::finished);
    }

    void whatEndsOrHangsIt() {
        const QByteArray row = QTest::currentDataTag();
        if (base::kSanitized && (row == "memory" || row == "segfault" || row == "stack"))
            QSKIP("A sanitizer limits no memory and takes the signals.");
        QFETCH(QByteArray, request);
        QFETCH(int, end);
        QFETCH(int, signal);
        base::ChildLimits limits;
        limits.time = std::chrono::seconds(end == static_cast<int>(ChildEnd::outOfTime) ? 1 : 300);
        limits.memory = 512U << 20U;
        limits.messages = 64U << 20U;
        // A file that is open here is not the child's.
        QTemporaryFile open;
        QVERIFY(open.open());
        const auto outcome = run(request.toStdString(), limits);
        QVERIFY(outcome.ok());
        QCOMPARE(static_cast<int>(outcome->end), end);
        QCOMPARE(outcome->signal, signal);
        if (request == "nonsense" || request == "flood") return;
        QCOMPARE(outcome->stage, request.toStdString());
    }

    void cancellingEndsIt() {
        const base::RunControl control;
        std::atomic<bool> begun = false;
        std::thread other([&] {
            while (!begun)
                std::this_thread::yield();
            base::RunControl copy = control;
            copy.cancel();
        });
        const auto outcome = run("hang", {}, control, [&](std::string_view) { begun = true; });
        other.join();
        QVERIFY(outcome->end == ChildEnd::cancelled);
    }

    void nothingOfItStays() {
        pid_t process = 0;
        {
            base::ChildLimits limits;
            limits.time = std::chrono::seconds(1);
            const auto outcome = run("process", limits);
            QVERIFY(outcome->end == ChildEnd::outOfTime);
            process = static_cast<pid_t>(std::stol(outcome->result));
        }
        QVERIFY(::kill(process, 0) != 0 && errno == ESRCH);
    }

    void aProgramThatIsMissingIsAnError() {
        const auto outcome = base::runChild("/nowhere/program", {}, {}, {});
        QVERIFY(!outcome.ok());
        QVERIFY(QString::fromStdString(outcome.error().message)
                    .contains("/nowhere/program cannot be started: No such"));
        QVERIFY(!base::findOwnProgram("trapwright-nothing").ok());
    }

    void nobodyElseStartsIt() {
        QProcess alone;
        alone.start(TRAPWRIGHT_MISBEHAVING_CHILD, {"1", "2", "3"});
        QVERIFY(alone.waitForFinished());
        QCOMPARE(alone.exitCode(), 2);
    }
};

QTEST_GUILESS_MAIN(ChildProcessTest)
#include "child_process_test.moc"
