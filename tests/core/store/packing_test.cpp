#include "core/store/packing.h"

#include <QtTest>
#include <bit>
#include <cmath>
#include <limits>

using namespace trapwright;

class PackingTest : public QObject {
    Q_OBJECT

 private slots:
    void numbersComeBackToTheLastBit() {
        const std::vector<double> numbers = {0.1 + 0.2, -0.0, 1e-300};
        const auto back = store::unpackNumbers(store::packNumbers(numbers));
        QVERIFY(back == numbers);
        QVERIFY(std::signbit((*back)[1]));
        QVERIFY(store::unpackNumbers("")->empty());
    }

    void wrongBlobsAreRefused() {
        QVERIFY(!store::unpackNumbers("12345"));
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
