#include "core/drive/log_entry.h"

#include <QtTest>

using namespace trapwright;

class LogEntryTest : public QObject {
    Q_OBJECT

 private slots:
    void linesOfCsv() {
        drive::LogEntry entry;
        entry.number = 7;
        entry.time = 1763646300.125;  // date -u -d @1763646300
        entry.kind = drive::LogKind::reading;
        entry.setPoint = 0.25;
        entry.enabled = true;
        entry.acceleration = 12.5;
        entry.halfStroke = 0.4e-3;
        entry.text = "say \"hot\", twice";
        QCOMPARE(QString::fromStdString(drive::toCsv(entry)),
                 QString("7,2025-11-20T13:45:00.125Z,reading,25,,1,12.5,0.4,,\"say \"\"hot\"\", twice\"\n"));
        const auto header = QString::fromStdString(drive::logHeaderCsv());
        QCOMPARE(header.count(','), QString::fromStdString(drive::toCsv(drive::LogEntry{})).count(','));
        const std::vector<drive::LogEntry> entries = {entry, entry};
        QCOMPARE(QString::fromStdString(drive::toCsv(entries)).count("\n"), 3);
    }

    void millisecondsRoundUpToTheNextSecond() {
        drive::LogEntry entry;
        entry.time = 1763646300.9996;
        QVERIFY(drive::toCsv(entry).find("13:45:01.000Z") != std::string::npos);
    }

    void kindsByName() {
        for (const auto kind :
             {drive::LogKind::connected, drive::LogKind::disconnected, drive::LogKind::command,
              drive::LogKind::reading, drive::LogKind::state, drive::LogKind::fault, drive::LogKind::note}) {
            QCOMPARE(drive::findLogKind(drive::nameOf(kind)), std::optional(kind));
        }
        QVERIFY(!drive::findLogKind("nothing"));
    }
};

QTEST_APPLESS_MAIN(LogEntryTest)
#include "log_entry_test.moc"
