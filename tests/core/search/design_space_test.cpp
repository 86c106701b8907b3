#include "core/search/design_space.h"

#include <QtTest>
#include <cmath>
#include <limits>

using namespace trapwright;
using search::Design;

namespace {

Design designOf(int bits, std::size_t count, base::Random& random) {
    Design design;
    const std::uint32_t values = std::uint32_t{1} << static_cast<unsigned>(bits);
    for (std::size_t i = 0; i < count; ++i)
        design.push_back(random.below(values) / static_cast<double>(values - 1));
    return design;
}

}  // namespace

class DesignSpaceTest : public QObject {
    Q_OBJECT

 private slots:
    void designsComeBackToTheLastBit() {
        base::Random random({.seed = 5});
        for (int bits = 1; bits <= 24; ++bits) {
            for (const std::size_t count : {1U, 2U, 7U, 85U}) {
                const Design design = designOf(bits, count, random);
                const auto back = search::unpackDesign(search::packDesign(design));
                QVERIFY(back == design);
            }
        }
        QVERIFY(search::unpackDesign(search::packDesign({})) == Design());
    }

    // 85 numbers of 10 bits: a header of 5 bytes and 850 bits.
    void numbersOfFewBitsTakeFewBytes() {
        base::Random random({.seed = 6});
        QCOMPARE(search::packDesign(designOf(10, 85, random)).size(), std::size_t{5 + 107});
        QCOMPARE(search::packDesign({0.0, 1.0, 1.0}), std::string("\x03\0\0\0\x01\x06", 6));
    }

    void anyNumberIsKept() {
        base::Random random({.seed = 7});
        Design design;
        for (int i = 0; i < 20; ++i)
            design.push_back(random.uniform());
        QVERIFY(search::unpackDesign(search::packDesign(design)) == design);
        QCOMPARE(search::packDesign(design).size(), std::size_t{5 + 160});
        const auto odd =
            search::unpackDesign(search::packDesign({-0.0, 2.0, std::numeric_limits<double>::quiet_NaN()}));
        QVERIFY(odd && std::signbit((*odd)[0]) && (*odd)[1] == 2.0 && std::isnan((*odd)[2]));
    }

    // A quarter of numbers of relief are level, besides one in 2^7 that would be; no others.
    void oneInFourIsDrawnLevel() {
        constexpr int kDraws = 8000;
        for (const bool isRelief : {false, true}) {
            search::Dimension dimension;
            dimension.bits = 7;
            dimension.isRelief = isRelief;
            base::Random random({.seed = 8});
            int level = 0;
            for (int i = 0; i < kDraws; ++i) {
                const double drawn = search::drawNumber(dimension, random);
                QVERIFY(drawn >= 0.0 && drawn <= 1.0 && search::roundToBits(drawn, 7) == drawn);
                level += drawn == search::roundToBits(0.5, 7) ? 1 : 0;
            }
            const double expected = kDraws * (isRelief ? 0.25 + 0.75 / 128.0 : 1.0 / 128.0);
            QVERIFY(std::abs(level - expected) < 5.0 * std::sqrt(expected));
        }
    }

    // One to three numbers change, most by little, and all stay what they can be.
    void aMutantIsLikeItsParent() {
        search::Dimension dimension;
        dimension.bits = 10;
        const std::vector<search::Dimension> dimensions(9, dimension);
        base::Random random({.seed = 9});
        int changes = 0;
        int small = 0;
        for (int i = 0; i < 2000; ++i) {
            const Design parent = designOf(10, dimensions.size(), random);
            Design mutant = parent;
            search::mutateNumbers(mutant, dimensions, random);
            int changed = 0;
            for (std::size_t k = 0; k < mutant.size(); ++k) {
                QVERIFY(mutant[k] >= 0.0 && mutant[k] <= 1.0);
                QCOMPARE(search::roundToBits(mutant[k], 10), mutant[k]);
                if (mutant[k] == parent[k]) continue;
                ++changed;
                small += std::abs(mutant[k] - parent[k]) < 0.25 ? 1 : 0;
            }
            QVERIFY(changed <= 3);
            changes += changed;
        }
        QVERIFY(changes > 2000 && small > 0.75 * changes);
    }

    void otherBytesAreRefused() {
        const std::string bytes = search::packDesign({0.0, 1.0, 1.0});
        QVERIFY(!search::unpackDesign(""));
        QVERIFY(!search::unpackDesign(bytes.substr(0, bytes.size() - 1)));
        QVERIFY(!search::unpackDesign(bytes + "x"));
        QVERIFY(!search::unpackDesign(std::string("\x03\0\0\0\x19\x06", 6)));  // 25 bits
        QVERIFY(!search::unpackDesign(std::string("\xff\xff\xff\xff\0", 5)));  // 32 GB
        QVERIFY(!search::unpackDesign(std::string("\xff\xff\xff\x00\x01", 5) + "short"));
    }

    void spaceChecksItsDesigns() {
        search::DesignSpace space;
        space.dimensions = {{"height", "mm", 0.0, 30.0}, {"length", "mm", 10.0, 40.0}};
        QVERIFY(space.check({0.0, 1.0}).ok());
        const auto messageOf = [&](const Design& design) {
            const auto checked = space.check(design);
            return QString::fromStdString(checked.ok() ? "" : checked.error().message);
        };
        QVERIFY(messageOf({0.5}).contains("has 1 numbers, where these settings need 2"));
        QVERIFY(messageOf({0.5, 1.5}).contains("length is 1.5"));
        QVERIFY(messageOf({std::nan(""), 0.5}).contains("height"));
    }

    void roundsToItsBits() {
        QCOMPARE(search::roundToBits(0.123456789, 0), 0.123456789);
        QCOMPARE(search::roundToBits(0.4, 1), 0.0);
        QCOMPARE(search::roundToBits(0.4, 2), 1.0 / 3.0);
        for (int k = 0; k < 1024; ++k)
            QCOMPARE(search::roundToBits(k / 1023.0, 10), k / 1023.0);
    }
};

QTEST_APPLESS_MAIN(DesignSpaceTest)
#include "design_space_test.moc"
