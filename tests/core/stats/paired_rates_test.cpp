#include "core/stats/rates.h"

#include <QtTest>
#include <cmath>

using namespace trapwright;

class PairedRatesTest : public QObject {
    Q_OBJECT

 private slots:
    void mcNemar_data() {
        QTest::addColumn<int>("first");
        QTest::addColumn<int>("second");
        QTest::addColumn<double>("p");
        QTest::newRow("nothing differs") << 0 << 0 << 1.0;
        QTest::newRow("even") << 7 << 7 << 1.0;
        QTest::newRow("one") << 1 << 0 << 1.0;
        // Five heads in a row, either way: 2 / 32.
        QTest::newRow("5, 0") << 5 << 0 << 0.0625;
        // 2 (1 + 10) / 1024.
        QTest::newRow("9, 1") << 9 << 1 << 22.0 / 1024.0;
        // Fay, vignette of the R package exact2x2: p = 0.06543.
        QTest::newRow("Fay") << 9 << 2 << 134.0 / 2048.0;
        // sum of C(25, 0 ... 8) = 1807781.
        QTest::newRow("8, 17") << 8 << 17 << 2.0 * 1807781.0 / 33554432.0;
    }
    void mcNemar() {
        QFETCH(int, first);
        QFETCH(int, second);
        QFETCH(double, p);
        QVERIFY(std::abs(stats::testMcNemar(first, second) - p) < 1e-12);
        QVERIFY(std::abs(stats::testMcNemar(second, first) - p) < 1e-12);
    }

    /// For many trials McNemar's own approximation with Edwards' correction, chi^2 = (|b - c| - 1)^2 / (b +
    /// c) with one degree of freedom, comes near.
    void manyTrials() {
        const double z = (60.0 - 1.0) / std::sqrt(640.0);
        const double approximation = std::erfc(z / std::sqrt(2.0));
        QVERIFY(std::abs(stats::testMcNemar(350, 290) / approximation - 1.0) < 0.01);
    }
};

QTEST_APPLESS_MAIN(PairedRatesTest)
#include "paired_rates_test.moc"
