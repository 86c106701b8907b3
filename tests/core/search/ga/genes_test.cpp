#include "core/search/ga/genes.h"

#include <QtTest>
#include <array>

#include "core/base/random.h"

using namespace trapwright;
namespace ga = trapwright::search::ga;
using ga::Bits;

class GenesTest : public QObject {
    Q_OBJECT

 private slots:
    // The three-bit reflected code as Gray's patent (1953) lists it.
    void threeBits() {
        const std::array<Bits, 8> code = {Bits{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0},
                                          {1, 1, 0},     {1, 1, 1}, {1, 0, 1}, {1, 0, 0}};
        for (std::size_t k = 0; k < 8; ++k) {
            const std::array value = {static_cast<double>(k) / 7.0};
            QCOMPARE(ga::encodeGray(value, 3), code[k]);
            QCOMPARE(ga::decodeGray(code[k], 3)[0], static_cast<double>(k) / 7.0);
        }
    }

    void neighboursDifferInOneBit() {
        Bits before = ga::encodeGray(std::array{0.0}, 10);
        for (int k = 1; k < 1024; ++k) {
            const Bits bits = ga::encodeGray(std::array{k / 1023.0}, 10);
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
        const auto values = ga::decodeGray(gene, bits);
        QCOMPARE(values.size(), std::size_t{50});
        for (const double value : values)
            QVERIFY(value >= 0.0 && value <= 1.0);
        QCOMPARE(ga::encodeGray(values, bits), gene);
    }

    void valuesAreRounded() {
        for (int k = 0; k <= 73; ++k) {
            const double value = k / 73.0;
            const double back = ga::decodeGray(ga::encodeGray(std::array{value}, 10), 10)[0];
            QVERIFY(std::abs(back - value) <= 0.5 / 1023.0 + 1e-12);
        }
    }

    void bitsComeBack() {
        base::Random random({.seed = 1});
        for (std::size_t size = 0; size < 100; ++size) {
            Bits bits(size);
            for (auto& bit : bits)
                bit = random.boolean() ? 1 : 0;
            const std::string blob = ga::packBits(bits);
            QCOMPARE(blob.size(), 4 + (size + 7) / 8);
            QVERIFY(ga::unpackBits(blob) == bits);
        }
    }

    void bitsLieAsDocumented() {
        QCOMPARE(ga::packBits({1, 0, 0, 0, 0, 0, 0, 0, 0, 1}), std::string("\x0a\0\0\0\x01\x02", 6));
    }

    void wrongBytesAreRefused() {
        const std::string bytes = ga::packBits(Bits(20, 1));
        QVERIFY(!ga::unpackBits(""));
        QVERIFY(!ga::unpackBits(bytes.substr(0, 3)));
        QVERIFY(!ga::unpackBits(bytes.substr(0, bytes.size() - 1)));
        QVERIFY(!ga::unpackBits(bytes + "x"));
        QVERIFY(!ga::unpackBits(std::string(4, '\xff')));
    }
};

QTEST_APPLESS_MAIN(GenesTest)
#include "genes_test.moc"
