#include <signal.h>

#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest>

#include "tests/app/transports/feeder_run.h"

using namespace trapwright;

namespace {

/// A log as another program has left it.
std::vector<drive::LogEntry> readLog(const QString& name) {
    QFile file(name);
    if (!file.open(QIODevice::ReadOnly)) return {};
    std::vector<drive::LogEntry> entries;
    const QByteArray text = file.readAll();
    for (const QByteArray& line : text.split('\n')) {
        const QList<QByteArray> cells = line.split(',');
        if (cells.size() < 10) continue;
        drive::LogEntry entry;
        entry.number = cells[0].toLongLong();
        entry.time =
            static_cast<double>(QDateTime::fromString(cells[1], Qt::ISODateWithMs).toMSecsSinceEpoch()) *
            1e-3;
        entry.kind = drive::findLogKind(cells[2].toStdString()).value_or(drive::LogKind::note);
        if (!cells[3].isEmpty()) entry.setPoint = cells[3].toDouble() * 0.01;
        entries.push_back(entry);
    }
    if (!text.endsWith("\n")) entries.clear();
    return entries;
}

}  // namespace

/// The program that drives the feeder is killed: nobody tells the drive anything any more.
class KilledTest : public QObject {
    Q_OBJECT

 private slots:
    void theFeederRestsAndTheLogIsWhole_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<int>("signal");
        QTest::newRow("Modbus TCP, killed") << "virtual-modbus" << SIGKILL;
        QTest::newRow("REO, killed") << "virtual-reo" << SIGKILL;
        // A window that crashes, and one that is frozen by a debugger or a full memory.
        QTest::newRow("Modbus TCP, crashed") << "virtual-modbus" << SIGABRT;
        QTest::newRow("REO, crashed") << "virtual-reo" << SIGABRT;
        QTest::newRow("Modbus TCP, frozen") << "virtual-modbus" << SIGSTOP;
        QTest::newRow("REO, frozen") << "virtual-reo" << SIGSTOP;
    }
    void theFeederRestsAndTheLogIsWhole() {
        QFETCH(QString, name);
        QFETCH(int, signal);
        tests::FeederRun run(name.toStdString());
        const QTemporaryDir folder;
        const QString log = folder.filePath("log.csv");
        const drive::Address address = run.feeder->address();
        const auto begin = [&](QProcess& program) {
            program.setProcessChannelMode(QProcess::ForwardedChannels);
            program.start(DRIVEN_UNTIL_KILLED,
                          {name, QString::fromStdString(address.host), QString::number(address.port),
                           QString::fromStdString(address.line), log});
            return QTest::qWaitFor([&] { return run.feeder->halfStroke() > 0.65e-3; }, 10000);
        };
        {
            QProcess program;
            QVERIFY(begin(program));
            QCOMPARE(::kill(static_cast<pid_t>(program.processId()), signal), 0);
            const qint64 time = run.timeToRest();
            QVERIFY2(time < tests::kRestTime, qPrintable(QString::number(time)));
            QVERIFY(run.feeder->watchdogActed());
            program.kill();
            QTRY_COMPARE(program.state(), QProcess::NotRunning);
            QTest::qWait(300);
            QVERIFY(run.feeder->isAtRest());
            const auto entries = readLog(log);
            QVERIFY(entries.size() > 10);
            QCOMPARE(tests::findGap(entries, run.feeder->commands()), QString());
        }
        // Who comes next finds the drive free.
        QVERIFY(QFile::remove(log));
        QProcess next;
        QVERIFY(begin(next));
        next.kill();
        QTRY_COMPARE(next.state(), QProcess::NotRunning);
        QVERIFY(run.timeToRest() < tests::kRestTime);
    }
};

QTEST_GUILESS_MAIN(KilledTest)
#include "killed_test.moc"
