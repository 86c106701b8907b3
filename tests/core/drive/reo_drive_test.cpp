#include "core/drive/reo_drive.h"

#include <QtTest>
#include <cmath>

using namespace trapwright;

namespace {

/// A line that answers what the test wants.
class ScriptedLine final : public drive::LineTransport {
 public:
    base::Status open(double /*timeOut*/) override {
        isOpen_ = true;
        return base::success();
    }
    [[nodiscard]] bool isOpen() const override { return isOpen_; }
    base::Result<std::string> exchange(std::string_view line, double /*timeOut*/) override {
        sent->emplace_back(line);
        return *answer;
    }
    void close() override { isOpen_ = false; }

    std::shared_ptr<std::vector<std::string>> sent = std::make_shared<std::vector<std::string>>();
    std::shared_ptr<std::string> answer = std::make_shared<std::string>("0000000000A5\r");

 private:
    bool isOpen_ = false;
};

drive::Profile reoProfile() {
    drive::Profile profile;
    profile.protocol = drive::Protocol::reo;
    profile.frequency = 50.0;
    profile.reo.fullAcceleration = 100.0;
    profile.reo.code.meanings[0x70] = "over temperature";
    return profile;
}

}  // namespace

class ReoDriveTest : public QObject {
    Q_OBJECT

 private slots:
    void linesAsTheManualWritesThem() {
        // 70 % and enable: three words of four upper-case digits and CR.
        QCOMPARE(drive::reo::encode({0xB333, 0, 1}), std::string("B33300000001\r"));
        const auto words = drive::reo::decode("8000400000A5\r");
        QVERIFY(words.has_value());
        QCOMPARE((*words)[0], std::uint16_t(0x8000));
        QCOMPARE((*words)[1], std::uint16_t(0x4000));
        QCOMPARE((*words)[2], std::uint16_t(0x00A5));
    }

    void otherLinesAreNone_data() {
        QTest::addColumn<QByteArray>("line");
        QTest::newRow("lower case") << QByteArray("b33300000001\r");
        QTest::newRow("short") << QByteArray("B3330000001\r");
        QTest::newRow("long") << QByteArray("B333000000010\r");
        QTest::newRow("line feed") << QByteArray("B33300000001\n");
        QTest::newRow("no end") << QByteArray("B33300000001");
        QTest::newRow("two words") << QByteArray("B3330000\r");
        QTest::newRow("empty") << QByteArray("");
        QTest::newRow("blank") << QByteArray("B333 0000 01\r");
    }
    void otherLinesAreNone() {
        QFETCH(QByteArray, line);
        QVERIFY(!drive::reo::decode(line.toStdString()).has_value());
    }

    void accelerationIsThatOfTheManual() {
        // The manual of the controllers: g = f^2 s / 497, s in mm from peak to peak.
        for (const double f : {25.0, 50.0, 100.0}) {
            for (const double peakToPeak : {0.2, 1.6}) {
                const double manual = f * f * peakToPeak / 497.0;
                const double ours = drive::calcAcceleration(peakToPeak / 2.0 * 1e-3, f) / 9.80665;
                QVERIFY(std::abs(ours / manual - 1.0) < 1e-3);
                QVERIFY(std::abs(drive::calcHalfStroke(ours * 9.80665, f) - peakToPeak / 2.0 * 1e-3) < 1e-12);
            }
        }
    }

    void commandsAndReadings() {
        auto line = std::make_unique<ScriptedLine>();
        const auto sent = line->sent;
        const auto answer = line->answer;
        auto drive = drive::makeReoDrive(reoProfile(), std::move(line));
        QVERIFY(drive->connect());
        QCOMPARE(sent->back(), std::string("000000000000\r"));

        *answer = "4000200000A5\r";
        drive::Command command;
        command.setPoint = 0.7;
        command.enable = true;
        const auto reading = drive->exchange(command);
        QVERIFY(reading.ok());
        QCOMPARE(sent->back(), std::string("B33300000001\r"));
        QCOMPARE(reading->acceleration.value(), 50.0);
        QCOMPARE(reading->current.value(), 0.25);
        QVERIFY(!reading->fault);

        // A set-point without enable is none.
        command.enable = false;
        QVERIFY(drive->exchange(command).ok());
        QCOMPARE(sent->back(), std::string("000000000000\r"));

        *answer = "000000000070\r";
        QCOMPARE(drive->exchange(command)->fault.value(), std::string("over temperature"));
        *answer = "HELLO\r";
        QVERIFY(!drive->exchange(command).ok());

        command.enable = true;
        QVERIFY(!drive->exchange(command).ok());
        drive->disconnect();
        QCOMPARE(sent->back(), std::string("000000000000\r"));
        QVERIFY(!drive->connected());
    }
};

QTEST_APPLESS_MAIN(ReoDriveTest)
#include "reo_drive_test.moc"
