#include "core/track/printer.h"

#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

using namespace trapwright;
using track::Printer;

namespace {

constexpr double kMm = base::kMillimetre;

Printer makePrinter() {
    Printer printer;
    printer.name = "my-printer-2";
    printer.title = "My printer 2";
    printer.sources = {"measured"};
    printer.space = {0.3, 0.2, 0.15};
    printer.thinnestWall = 0.9 * kMm;
    printer.steepestOverhang = 50 * base::kDegree;
    return printer;
}

void write(const QString& path, const std::string& text) {
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(QByteArray::fromStdString(text));
}

}  // namespace

class PrinterTest : public QObject {
    Q_OBJECT

 private slots:
    void printersThatComeWithTheProgramAreGood() {
        const track::PrinterList list = track::readPrinters({});
        QVERIFY(list.problems.empty());
        QVERIFY(list.printers.size() >= 6);
        for (const Printer& printer : list.printers) {
            QVERIFY(!printer.own);
            QVERIFY(!printer.sources.empty());
        }
        const auto mk4 = track::findPrinter(list, "prusa-mk4");
        QVERIFY(mk4.ok());
        QCOMPARE(track::formatSpace(mk4->space), std::string("250 x 210 x 220 mm"));
        const auto none = track::findPrinter(list, "prusa");
        QVERIFY(!none.ok() && none.error().message.find("prusa-mk4") != std::string::npos);
    }

    void textIsReadAsItWasWritten() {
        const auto read = track::readPrinter(track::printerToJson(makePrinter()));
        QVERIFY(read.ok());
        QCOMPARE(track::printerToJson(*read), track::printerToJson(makePrinter()));
        QVERIFY(std::abs(read->space.y - 0.2) < 1e-12);
        QVERIFY(std::abs(read->steepestOverhang - 50 * base::kDegree) < 1e-9);
    }

    void ownOnesAreKeptAndGoBeforeOthers() {
        const QTemporaryDir folder;
        const std::filesystem::path own = folder.filePath("printers").toStdString();
        QVERIFY(track::savePrinter(own, makePrinter()).ok());
        Printer mine = track::findPrinter(track::readPrinters(own), "prusa-mk4").value();
        mine.space.x = 0.24;
        QVERIFY(track::savePrinter(own, mine).ok());
        const track::PrinterList list = track::readPrinters(own);
        QCOMPARE(list.printers.size(), track::readPrinters({}).printers.size() + 1);
        QVERIFY(track::findPrinter(list, "my-printer-2")->own);
        QVERIFY(track::findPrinter(list, "prusa-mk4")->own);
        QVERIFY(std::abs(track::findPrinter(list, "prusa-mk4")->space.x - 0.24) < 1e-12);
        QVERIFY(track::removePrinter(own, "prusa-mk4").ok());
        QVERIFY(std::abs(track::findPrinter(track::readPrinters(own), "prusa-mk4")->space.x - 0.25) < 1e-12);
        QVERIFY(!track::removePrinter(own, "prusa-mk4").ok());
    }

    void filesAreImportedOnce() {
        const QTemporaryDir folder;
        const std::filesystem::path own = folder.filePath("printers").toStdString();
        const QString file = folder.filePath("from-a-friend.json");
        write(file, track::printerToJson(makePrinter()));
        const auto imported = track::importPrinter(file.toStdString(), own);
        QVERIFY(imported.ok());
        QVERIFY(imported->own);
        QVERIFY(track::findPrinter(track::readPrinters(own), "my-printer-2").ok());
        const auto again = track::importPrinter(file.toStdString(), own);
        QVERIFY(!again.ok() && again.error().message.find("already") != std::string::npos);
    }

    void whatIsWrongIsNamed_data() {
        QTest::addColumn<QString>("from");
        QTest::addColumn<QString>("to");
        QTest::addColumn<QString>("word");
        QTest::newRow("no JSON") << "{"
                                 << ""
                                 << "not JSON";
        QTest::newRow("format") << "trapwright printer"
                                << "trapwright drive"
                                << "\"format\"";
        QTest::newRow("version") << "\"version\": 1"
                                 << "\"version\": 2"
                                 << "\"version\"";
        QTest::newRow("name") << "\"my-printer-2\""
                              << "\"../elsewhere\""
                              << "\"name\"";
        QTest::newRow("no bed") << "\"bedX_mm\": 300.0,"
                                << ""
                                << "\"bedX_mm\": this is missing";
        QTest::newRow("text") << "\"bedY_mm\": 200.0"
                              << "\"bedY_mm\": \"200\""
                              << "\"bedY_mm\"";
        QTest::newRow("too large") << "\"height_mm\": 150.0"
                                   << "\"height_mm\": 150000"
                                   << "\"height_mm\"";
        QTest::newRow("angle") << "\"steepestOverhang_deg\": 50.0"
                               << "\"steepestOverhang_deg\": 91"
                               << "\"steepestOverhang_deg\"";
        QTest::newRow("unknown") << "\"title\""
                                 << "\"Title\""
                                 << "\"title\": this is missing";
    }

    void whatIsWrongIsNamed() {
        QFETCH(QString, from);
        QFETCH(QString, to);
        QFETCH(QString, word);
        QString text = QString::fromStdString(track::printerToJson(makePrinter()));
        QVERIFY(text.contains(from));
        text.replace(text.indexOf(from), from.size(), to);
        const auto read = track::readPrinter(text.toStdString());
        QVERIFY(!read.ok());
        QVERIFY2(read.error().message.find(word.toStdString()) != std::string::npos,
                 read.error().message.c_str());
    }

    void badFileHidesNoOther() {
        const QTemporaryDir folder;
        write(folder.filePath("bad.json"), "{");
        write(folder.filePath("other.json"), track::printerToJson(makePrinter()));
        const track::PrinterList list = track::readPrinters(folder.path().toStdString());
        QCOMPARE(list.problems.size(), 2U);
        QVERIFY(list.problems[0].find("bad.json") != std::string::npos);
        QVERIFY(list.problems[1].find("other.json") != std::string::npos);  // not its name
        QVERIFY(list.printers.size() >= 6);
    }

    void namesOfTitles() {
        QCOMPARE(track::nameOfTitle("My Printer 2"), std::string("my-printer-2"));
        QCOMPARE(track::nameOfTitle("  Prusa -- MK4! "), std::string("prusa-mk4"));
        QCOMPARE(track::nameOfTitle("..."), std::string());
    }
};

QTEST_APPLESS_MAIN(PrinterTest)
#include "printer_test.moc"
