#include <QApplication>

#include "tests/ui/feeder/hostile_window.h"

using namespace trapwright;
using namespace trapwright::feeder;

/// Whatever the peer does, the window answers and the feeder rests: some sequences over each of the real
/// transports. tests/studies/hostile_device.sh runs many more.
class HostileWindowTest : public QObject {
    Q_OBJECT

 private slots:
    void answersAndRests_data() {
        QTest::addColumn<QString>("link");
        QTest::newRow("Modbus TCP") << "tcp";
        QTest::newRow("Modbus RTU") << "rtu";
        QTest::newRow("REO") << "reo";
    }
    void answersAndRests() {
        QFETCH(QString, link);
        constexpr int kSequences = 5;
        constexpr double kLatest = 750.0;  // [ms] on a busy machine; waiting for the drive took up to 4.3 s
        HostileWindow window(link, studies_.files(), studies_.folder());
        int started = 0;
        for (std::uint64_t seed = 1; seed <= kSequences; ++seed) {
            const WindowOutcome outcome = window.run(seed);
            const QString what = QString("seed %1, %2, moods%3: rest after %4 s, done after %5 s, %6 ms late")
                                     .arg(seed)
                                     .arg(outcome.deed, outcome.moods)
                                     .arg(outcome.rest)
                                     .arg(outcome.end)
                                     .arg(outcome.late);
            QVERIFY2(outcome.late < kLatest, qPrintable(what));
            if (!outcome.started) continue;
            ++started;
            QVERIFY2(outcome.rested, qPrintable(what));
            QVERIFY2(outcome.left, qPrintable(what));
        }
        QVERIFY(started > kSequences / 2);
    }

 private:
    HostileStudies studies_{"hostile_window_test"};
};

int main(int argc, char** argv) {
    QApplication application(argc, argv);
    HostileWindowTest test;
    return QTest::qExec(&test, argc, argv);
}

#include "hostile_window_test.moc"
