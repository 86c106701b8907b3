#include <QTemporaryDir>
#include <QtTest>

#include "app/transports/modbus_transport.h"
#include "tests/app/transports/hostile_sequence.h"

using namespace trapwright;

Q_DECLARE_METATYPE(trapwright::tests::Mood)

/// Some sequences of a hostile peer over each of the real transports; tests/studies/hostile_device.sh runs
/// 1000 of each, tests/core/drive/hostile_device_test.cpp many more without a wire.
class HostileDeviceTest : public QObject {
    Q_OBJECT

 private slots:
    // Bytes that come after a time-out belong to a question that nobody waits for any more.
    void noiseAfterATimeOut_data() {
        QTest::addColumn<QString>("link");
        QTest::newRow("Modbus TCP") << "tcp";
        QTest::newRow("Modbus RTU") << "rtu";
    }
    void noiseAfterATimeOut() {
        QFETCH(QString, link);
        const QTemporaryDir folder;
        const drive::Profile profile = tests::hostileProfile(link);
        tests::HostilePeer peer(profile, 1, folder.path().toStdString());
        const drive::Address address = peer.address();
        const auto transport = link == "tcp" ? transports::makeTcpTransport(address.host, address.port, 1)
                                             : transports::makeRtuTransport(address.line, profile.modbus, 1);
        QVERIFY(transport->open(1.0));
        const std::vector<std::uint16_t> value = {0};
        for (int i = 0; i < 10; ++i) {
            peer.setMood(tests::Mood::deaf);
            QVERIFY(!transport->write(drive::Table::holdingRegister, 0, value, 0.02));
            peer.setMood(tests::Mood::flood);
            static_cast<void>(transport->write(drive::Table::holdingRegister, 0, value, 0.1));
        }
        peer.setMood(tests::Mood::honest);
        QTest::qWait(100);
        transport->close();
        QVERIFY(transport->open(1.0));
        QVERIFY(transport->write(drive::Table::holdingRegister, 0, value, 1.0));
    }

    void liesAreFaults_data() {
        QTest::addColumn<QString>("link");
        QTest::addColumn<tests::Mood>("mood");
        const std::pair<const char*, tests::Mood> moods[] = {{"mute", tests::Mood::mute},
                                                             {"deaf", tests::Mood::deaf},
                                                             {"refusing", tests::Mood::refusing},
                                                             {"another mark", tests::Mood::wrongMark},
                                                             {"another unit", tests::Mood::wrongUnit},
                                                             {"another length", tests::Mood::wrongLength},
                                                             {"another value", tests::Mood::wrongEcho},
                                                             {"garbage", tests::Mood::garbage},
                                                             {"half a frame", tests::Mood::half},
                                                             {"a reset", tests::Mood::reset},
                                                             {"the end", tests::Mood::closing},
                                                             {"an echo", tests::Mood::echo}};
        for (const char* link : {"tcp", "rtu", "reo"}) {
            for (const auto& [name, mood] : moods) {
                // A line has no end that it could tell, and what follows a whole frame there is noise.
                const bool onlyTcp = mood == tests::Mood::reset || mood == tests::Mood::closing;
                if (onlyTcp && QString(link) != "tcp") continue;
                if (mood == tests::Mood::wrongLength && QString(link) == "rtu") continue;
                // REO has neither units nor values; over TCP many devices answer with any unit, and Qt takes
                // it.
                if (mood == tests::Mood::wrongUnit && QString(link) != "rtu") continue;
                if (mood == tests::Mood::wrongEcho && QString(link) == "reo") continue;
                QTest::addRow("%s, %s", link, name) << QString(link) << mood;
            }
        }
    }
    void liesAreFaults() {
        QFETCH(QString, link);
        QFETCH(tests::Mood, mood);
        const QTemporaryDir folder;
        const drive::Profile profile = tests::hostileProfile(link);
        tests::HostilePeer peer(profile, 1, folder.path().toStdString());
        drive::DriveLoop loop(profile, {0.9, 4.0},
                              [&] { return transports::makeDrive(profile, peer.address()); }, {});
        const auto isIn = [&](drive::State state) {
            return QTest::qWaitFor([&] { return loop.snapshot().state == state; }, 5000);
        };
        QVERIFY2(isIn(drive::State::idle), loop.snapshot().fault.c_str());
        loop.setTarget(0.5);
        // A machine that stands still for a moment makes an honest device's answer late, which is a fault,
        // too: begin again as an operator would.
        for (int attempt = 0; attempt < 3; ++attempt) {
            loop.start();
            QVERIFY(QTest::qWaitFor(
                [&] {
                    const drive::State state = loop.snapshot().state;
                    return state == drive::State::running || state == drive::State::faulted;
                },
                5000));
            if (loop.snapshot().state == drive::State::running) break;
            qInfo("honest, but %s", loop.snapshot().fault.c_str());
            loop.acknowledge();
            QVERIFY(isIn(drive::State::idle));
        }
        QVERIFY2(isIn(drive::State::running), loop.snapshot().fault.c_str());
        peer.setMood(mood);
        QVERIFY(isIn(drive::State::faulted));
        qInfo("%s", loop.snapshot().fault.c_str());
        QTRY_VERIFY_WITH_TIMEOUT(peer.isAtRest(), 7000);
    }

    void restsInTime_data() {
        QTest::addColumn<QString>("link");
        QTest::newRow("Modbus TCP") << "tcp";
        QTest::newRow("Modbus RTU") << "rtu";
        QTest::newRow("REO") << "reo";
    }
    void restsInTime() {
        QFETCH(QString, link);
        const QTemporaryDir folder;
        const auto outcomes = tests::runHostile(link, 1, 24, 12, folder.path().toStdString());
        QCOMPARE(outcomes.size(), std::size_t(24));
        int moved = 0;
        for (const tests::Outcome& outcome : outcomes) {
            const QString what = QString("seed %1, %2, moods %3: %4 s")
                                     .arg(outcome.seed)
                                     .arg(outcome.reason, outcome.mood)
                                     .arg(outcome.rest);
            if (!outcome.started) continue;
            ++moved;
            QVERIFY2(outcome.rested, qPrintable(what));
            QVERIFY2(!outcome.selfMoved, qPrintable(what));
            QVERIFY2(outcome.recovered, qPrintable(what));
        }
        QVERIFY(moved > 16);
    }
};

QTEST_GUILESS_MAIN(HostileDeviceTest)
#include "hostile_device_test.moc"
