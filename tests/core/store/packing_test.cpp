#include "core/store/packing.h"

#include <QtTest>
#include <bit>
#include <limits>

#include "core/base/random.h"

using namespace trapwright;

class PackingTest : public QObject {
    Q_OBJECT

 private slots:
    void bitsComeBack() {
        base::Random random({.seed = 1});
        for (std::size_t size = 0; size < 100; ++size) {
            evolution::Bits bits(size);
            for (auto& bit : bits)
                bit = random.boolean() ? 1 : 0;
            const std::string blob = store::packBits(bits);
            QCOMPARE(blob.size(), 4 + (size + 7) / 8);
            QVERIFY(store::unpackBits(blob) == bits);
        }
    }

    void bitsLieAsDocumented() {
        QCOMPARE(store::packBits({1, 0, 0, 0, 0, 0, 0, 0, 0, 1}), std::string("\x0a\0\0\0\x01\x02", 6));
    }

    void wrongBlobsAreRefused() {
        const std::string blob = store::packBits(evolution::Bits(20, 1));
        QVERIFY(!store::unpackBits(""));
        QVERIFY(!store::unpackBits(blob.substr(0, 3)));
        QVERIFY(!store::unpackBits(blob.substr(0, blob.size() - 1)));
        QVERIFY(!store::unpackBits(blob + "x"));
        QVERIFY(!store::unpackBits(std::string(4, '\xff')));
        QVERIFY(!store::unpackVertices("12345"));
        QVERIFY(!store::unpackTriangles("12345", 10));
        QVERIFY(!store::unpackTriangles(store::packTriangles({{0, 1, 3}}), 3));
        QVERIFY(!store::unpackTriangles(store::packTriangles({{0, 1, -1}}), 3));
    }

    void meshComesBackToTheLastBit() {
        const std::vector<base::Vec3> vertices = {
            {0.1 + 0.2, -0.0, std::numeric_limits<double>::denorm_min()},
            {1e300, -1.0 / 3.0, std::numeric_limits<double>::infinity()}};
        const auto back = store::unpackVertices(store::packVertices(vertices));
        QVERIFY(back.has_value());
        QCOMPARE(back->size(), vertices.size());
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            for (int k = 0; k < 3; ++k) {
                QCOMPARE(std::bit_cast<std::uint64_t>((*back)[i][k]),
                         std::bit_cast<std::uint64_t>(vertices[i][k]));
            }
        }
        const std::vector<geometry::Triangle> triangles = {{0, 1, 2}, {70000, 3, 1}};
        QVERIFY(store::unpackTriangles(store::packTriangles(triangles), 70001) == triangles);
    }
};

QTEST_APPLESS_MAIN(PackingTest)
#include "packing_test.moc"
