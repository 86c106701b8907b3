#include "core/evolution/gray.h"

#include <QtTest>
#include <array>

#include "core/base/random.h"

using namespace trapwright;
using evolution::Bits;

class GrayTest : public QObject {
    Q_OBJECT

 private slots:
    // The three-bit reflected code as Gray's patent (1953) lists it.
    void threeBits() {
        const std::array<Bits, 8> code = {Bits{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0},
                                          {1, 1, 0},     {1, 1, 1}, {1, 0, 1}, {1, 0, 0}};
        for (std::size_t k = 0; k < 8; ++k) {
            const std::array value = {static_cast<double>(k) / 7.0};
            QCOMPARE(evolution::encodeGray(value, 3), code[k]);
            QCOMPARE(evolution::decodeGray(code[k], 3)[0], static_cast<double>(k) / 7.0);
        }
    }

    void neighboursDifferInOneBit() {
        Bits before = evolution::encodeGray(std::array{0.0}, 10);
        for (int k = 1; k < 1024; ++k) {
            const Bits bits = evolution::encodeGray(std::array{k / 1023.0}, 10);
            int changed = 0;
            for (std::size_t i = 0; i < 10; ++i)
                changed += bits[i] != before[i] ? 1 : 0;
            QCOMPARE(changed, 1);
            before = bits;
        }
    }

    void bitsSurviveARoundTrip_data() {
        QTest::addColumn<int>("bits");
        for (const int bits : {1, 2, 10, 20, 31})
            QTest::addRow("%d bits", bits) << bits;
    }
    void bitsSurviveARoundTrip() {
        QFETCH(int, bits);
        base::Random random({1, 0, 0, 0, base::Purpose::test});
        Bits gene(static_cast<std::size_t>(50 * bits));
        for (auto& bit : gene)
            bit = random.boolean() ? 1 : 0;
        const auto values = evolution::decodeGray(gene, bits);
        QCOMPARE(values.size(), std::size_t{50});
        for (const double value : values)
            QVERIFY(value >= 0.0 && value <= 1.0);
        QCOMPARE(evolution::encodeGray(values, bits), gene);
    }

    void valuesAreRounded() {
        for (int k = 0; k <= 73; ++k) {
            const double value = k / 73.0;
            const double back = evolution::decodeGray(evolution::encodeGray(std::array{value}, 10), 10)[0];
            QVERIFY(std::abs(back - value) <= 0.5 / 1023.0 + 1e-12);
        }
    }
};

QTEST_APPLESS_MAIN(GrayTest)
#include "gray_test.moc"
