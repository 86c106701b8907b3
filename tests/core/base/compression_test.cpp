#include "core/base/compression.h"

#include <QtTest>
#include <vector>

#include "core/base/random.h"

using namespace trapwright;

class CompressionTest : public QObject {
    Q_OBJECT

 private slots:
    void partsComeBackInTheirOrder() {
        base::Random random({.seed = 5});
        for (const std::size_t count : {0, 1, 3, 60}) {
            std::vector<std::string> parts(count);
            std::string all;
            for (std::size_t i = 0; i < count; ++i) {
                // Empty ones, long ones, what repeats and what does not.
                const std::size_t size = i % 4 == 0 ? 0 : 1 + random.below(300000);
                for (std::size_t k = 0; k < size; ++k)
                    parts[i].push_back(static_cast<char>(i % 2 == 0 ? k / 100 : random.below(256)));
                all += parts[i];
            }
            const std::string bytes = base::compress(parts);
            QVERIFY(base::decompress(bytes, all.size()) == all);
            QVERIFY(!base::decompress(bytes, all.size() + 1));
            QVERIFY(all.empty() || !base::decompress(bytes, all.size() - 1));
        }
    }

    void whatIsAlikeGetsSmallAndNoiseDoesNotGetLarge() {
        base::Random random({.seed = 6});
        std::string noise;
        for (int i = 0; i < 10000; ++i)
            noise.push_back(static_cast<char>(random.below(256)));
        QVERIFY(base::compress(std::vector<std::string>{std::string(10000, 'a')}).size() < 40);
        QVERIFY(base::compress(std::vector<std::string>{noise}).size() < 10040);
        // One after the other, the noise would spoil the rest.
        std::string few;
        for (int i = 0; i < 10000; ++i)
            few.push_back(static_cast<char>(random.below(2)));
        QVERIFY(base::compress(std::vector<std::string>{noise, few}).size() < 10000 + 2500);
    }

    void damageIsFound() {
        const std::string text = "What a file holds may be damaged in any place.";
        const std::vector<std::string> parts(3, text);
        const std::string bytes = base::compress(parts);
        std::string all;
        for (const std::string& part : parts)
            all += part;
        for (std::size_t place = 0; place < bytes.size(); ++place) {
            QVERIFY(!base::decompress(std::string_view(bytes).substr(0, place), all.size()));
            for (int bit = 0; bit < 8; ++bit) {
                std::string damaged = bytes;
                damaged[place] = static_cast<char>(damaged[place] ^ (1 << bit));
                const auto unpacked = base::decompress(damaged, all.size());
                // Bits that mean nothing may be anything.
                QVERIFY(!unpacked || *unpacked == all);
            }
        }
        QVERIFY(!base::decompress({}, 0));
        QVERIFY(!base::decompress("no such bytes", 100));
    }
};

QTEST_APPLESS_MAIN(CompressionTest)
#include "compression_test.moc"
