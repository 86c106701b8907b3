#include "core/base/command.h"

#include <QTemporaryDir>
#include <QtTest>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

using namespace trapwright;
using namespace std::chrono_literals;

class CommandTest : public QObject {
    Q_OBJECT

 private slots:
    void tellsHowItEndedAndWhatItSaid() {
        const QTemporaryDir folder;
        const std::string path = std::filesystem::canonical(folder.path().toStdString()).string();
        const auto ran = base::runCommand({"sh", "-c", "pwd; echo wrong >&2; exit 7"}, path, 60s);
        QVERIFY2(ran.ok(), ran.ok() ? "" : ran.error().message.c_str());
        QCOMPARE(ran->code, 7);
        QCOMPARE(ran->output, path + "\nwrong\n");
        QCOMPARE(base::runCommand({"sh", "-c", "kill -TERM $$"}, "", 60s)->code, 128 + SIGTERM);
        // Words stay words, and nothing can be read.
        QCOMPARE(base::runCommand({"printf", "%s|", "a b", "$HOME", "'"}, "", 60s)->output,
                 std::string("a b|$HOME|'|"));
        QCOMPARE(base::runCommand({"cat"}, "", 60s)->output, std::string());
    }

    // No more is kept than somebody would read, and who says more is not held up.
    void keepsAMebibyte() {
        const auto ran = base::runCommand({"head", "-c", "3000000", "/dev/zero"}, "", 60s);
        QVERIFY(ran.ok());
        QCOMPARE(ran->code, 0);
        QCOMPARE(ran->output.size(), std::size_t{1} << 20U);
    }

    void whatTakesTooLongIsKilled() {
        const auto ran = base::runCommand({"sh", "-c", "sleep 600 & sleep 600"}, "", 300ms);
        QVERIFY(!ran.ok());
        QVERIFY2(ran.error().message.find("did not end") != std::string::npos, ran.error().message.c_str());
    }

    void whatIsNotWaitedForIsKilled() {
        base::RunControl control;
        std::thread canceller([control]() mutable {
            std::this_thread::sleep_for(200ms);
            control.cancel();
        });
        const auto ran = base::runCommand({"sh", "-c", "sleep 600 & sleep 600"}, "", 600s, control);
        canceller.join();
        QVERIFY(!ran.ok());
        QVERIFY2(ran.error().message.find("not waited for") != std::string::npos,
                 ran.error().message.c_str());
    }

    void whatIsNotThereCannotBeStarted() {
        QVERIFY(base::hasCommand("sh"));
        QVERIFY(!base::hasCommand("no-such-program"));
        const auto ran = base::runCommand({"no-such-program"}, "", 60s);
        QVERIFY(!ran.ok());
        QVERIFY2(ran.error().message.find("no-such-program cannot be started") != std::string::npos,
                 ran.error().message.c_str());
        QVERIFY(!base::runCommand({"true"}, "/nowhere", 60s).ok());
    }
};

QTEST_GUILESS_MAIN(CommandTest)
#include "command_test.moc"
