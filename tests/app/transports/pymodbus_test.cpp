#include <QProcess>
#include <QtTest>
#include <bit>

#include "tests/app/transports/feeder_run.h"

using namespace trapwright;

namespace {

QString script(const char* name) {
    return QString(TRAPWRIGHT_SOURCE_DIR) + "/tests/app/transports/" + name;
}

/// A Modbus device by pymodbus in a process of its own.
class Device {
 public:
    explicit Device(const char* protocol) {
        process_.setProcessChannelMode(QProcess::ForwardedErrorChannel);
        process_.start("/usr/bin/python3", {script("modbus_device.py"), protocol});
        place_ = line();
    }
    ~Device() {
        process_.closeWriteChannel();
        if (!process_.waitForFinished(3000)) process_.kill();
        process_.waitForFinished();
    }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] QString place() const { return place_; }
    QString ask(const QString& question) {
        process_.write(question.toUtf8() + "\n");
        return line();
    }
    void kill() {
        process_.kill();
        process_.waitForFinished();
    }

 private:
    QString line() {
        while (!process_.canReadLine()) {
            if (!process_.waitForReadyRead(20000)) return {};
        }
        return QString::fromUtf8(process_.readLine()).trimmed();
    }

    QProcess process_;
    QString place_;
};

}  // namespace

/// An implementation of Modbus that is not ours and not Qt's, at either end.
class PymodbusTest : public QObject {
    Q_OBJECT

 private slots:
    void ourClientAndItsDevice_data() {
        QTest::addColumn<QString>("protocol");
        QTest::newRow("TCP") << "tcp";
        QTest::newRow("RTU") << "rtu";
    }
    void ourClientAndItsDevice() {
        QFETCH(QString, protocol);
        Device device(qPrintable(protocol));
        QVERIFY2(!device.place().isEmpty(), "is python3-pymodbus installed?");
        drive::Profile profile = tests::bundledProfile("virtual-modbus");
        profile.modbus.parity = 'N';
        drive::Address address;
        address.host = "127.0.0.1";
        address.port = device.place().toInt();
        address.line = device.place().toStdString();
        if (protocol == "rtu") profile.protocol = drive::Protocol::modbusRtu;
        // 19200 baud or a network: a heartbeat has twelve questions.
        profile.timeOut = 1.0;
        auto made = transports::makeDrive(profile, address);
        QVERIFY(made.ok());
        drive::Drive& drive = **made;

        QCOMPARE(device.ask("set 3 0 777 888"), QString("done"));
        QCOMPARE(device.ask("set 1 0 1"), QString("done"));
        const auto connected = drive.connect();
        QVERIFY2(connected.ok(), connected.ok() ? "" : connected.error().message.c_str());
        // At rest before anything else; the frequency is nobody's business yet.
        QCOMPARE(device.ask("get 3 0 2"), QString("0 888"));
        QCOMPARE(device.ask("get 1 0 1"), QString("0"));

        const auto bits = std::bit_cast<std::uint32_t>(12.5F);
        QCOMPARE(device.ask(QString("set 4 0 4321 4567 %1 %2 3000 0").arg(bits >> 16U).arg(bits & 0xFFFFU)),
                 QString("done"));
        QCOMPARE(device.ask("set 2 0 1"), QString("done"));
        const auto reading = drive.exchange({0.4321, 45.67, true});
        QVERIFY2(reading.ok(), reading.ok() ? "" : reading.error().message.c_str());
        QCOMPARE(device.ask("get 3 0 2"), QString("4321 4567"));
        QCOMPARE(device.ask("get 1 0 1"), QString("1"));
        QCOMPARE(reading->setPoint.value(), 0.4321);
        QCOMPARE(reading->frequency.value(), 45.67);
        QCOMPARE(reading->acceleration.value(), 12.5);
        QCOMPARE(reading->current.value(), 0.3);
        QCOMPARE(reading->enabled.value(), true);
        QVERIFY(!reading->fault);

        QCOMPARE(device.ask("set 4 5 1"), QString("done"));
        QVERIFY(drive.exchange({0.4321, 45.67, true})->fault.has_value());
        drive.disconnect();
        QCOMPARE(device.ask("get 3 0 1"), QString("0"));
        QCOMPARE(device.ask("get 1 0 1"), QString("0"));
    }

    void addressesThatTheDeviceHasNot() {
        Device device("tcp");
        drive::Profile profile = tests::bundledProfile("iologik-e1241");
        drive::Address address;
        address.host = "127.0.0.1";
        address.port = device.place().toInt();
        auto drive = transports::makeDrive(profile, address);
        const auto status = (*drive)->connect();
        QVERIFY(!status.ok());
        const QString message = QString::fromStdString(status.error().message);
        QVERIFY2(message.contains("holding register 1025") && message.contains("exception 2") &&
                     message.contains("no such address"),
                 qPrintable(message));
    }

    void aDeviceThatDies() {
        Device device("tcp");
        const drive::Profile profile = tests::bundledProfile("modbus-0-10v");
        drive::Address address;
        address.host = "127.0.0.1";
        address.port = device.place().toInt();
        auto drive = transports::makeDrive(profile, address);
        QVERIFY((*drive)->connect().ok());
        QVERIFY((*drive)->exchange({0.5, std::nullopt, true}).ok());
        QCOMPARE(device.ask("get 3 0 1"), QString("2048"));
        device.kill();
        QElapsedTimer timer;
        timer.start();
        QVERIFY(!(*drive)->exchange({0.5, std::nullopt, true}).ok());
        QVERIFY(timer.elapsed() < 600);
        (*drive)->disconnect();
        QVERIFY(timer.elapsed() < 1200);
    }

    void itsClientAndOurFeeder() {
        tests::FeederRun run("virtual-modbus");
        QProcess client;
        client.setProcessChannelMode(QProcess::ForwardedErrorChannel);
        client.start("/usr/bin/python3", {script("modbus_operator.py"),
                                          QString::number(run.feeder->address().port), "6000", "2.0"});
        QVERIFY(client.waitForFinished(30000));
        QCOMPARE(client.exitCode(), 0);
        // It ended with the feeder on, and without a word.
        QVERIFY(!run.feeder->isAtRest());
        const qint64 time = run.timeToRest();
        QVERIFY2(time < tests::kRestTime, qPrintable(QString::number(time)));
        QVERIFY(run.feeder->watchdogActed());

        const QStringList read = QString::fromUtf8(client.readAllStandardOutput()).trimmed().split(' ');
        QCOMPARE(read.size(), 9);
        QCOMPARE(read[0], QString("6000"));
        QCOMPARE(read[1], QString("5000"));
        // 0.6 mm at 50 Hz, and a noise of 0.5 % of full.
        const double expected = drive::calcAcceleration(0.6e-3, 50.0);
        QVERIFY2(std::abs(read[2].toDouble() - expected) < 3.0, qPrintable(read[2]));
        QVERIFY(std::abs(read[3].toInt() - 5400) < 300);
        QCOMPARE(read.mid(4), QStringList({"0", "1", "6000", "5000", "2"}));
    }
};

QTEST_GUILESS_MAIN(PymodbusTest)
#include "pymodbus_test.moc"
