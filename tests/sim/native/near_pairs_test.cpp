#include "sim/native/near_pairs.h"

#include <QtTest>
#include <cstdint>

using namespace trapwright;
using native::kUntouchable;
using native::kWidestVector;
using native::NearPairs;
using native::PairTable;

namespace {

/// Gives a lane so many pairs, whose values tell lane, row and field.
void fill(PairTable& table, int slot, int count, float tag) {
    table.resize(slot, count);
    for (int row = 0; row < count; ++row) {
        table.begin(row, slot,
                    {0.1F * static_cast<float>(row),
                     static_cast<std::uint32_t>(slot),
                     static_cast<std::uint32_t>(row),
                     {}});
        for (int f = 0; f < native::kVertexPairFields; ++f)
            table.at(row, f, slot) = tag + static_cast<float>(100 * row + f);
    }
}

bool has(const PairTable& table, int slot, int count, float tag) {
    for (int row = 0; row < count; ++row) {
        if (table.due(row)[slot] != 0.1F * static_cast<float>(row)) return false;
        if (table.partFeature(row)[slot] != static_cast<std::uint32_t>(row)) return false;
        for (int f = 0; f < native::kVertexPairFields; ++f) {
            if (table.field(row, f)[slot] != tag + static_cast<float>(100 * row + f)) return false;
        }
    }
    return true;
}

/// Whether the lane's place in a row is that of a pair that is never due and never touches.
bool isEmpty(const PairTable& table, int row, int slot) {
    return table.due(row)[slot] == kUntouchable &&
           table.field(row, native::kPlanes + 3)[slot] == kUntouchable &&
           table.field(row, native::kPlanes)[slot] == 0.0F;
}

}  // namespace

/// The pairs of sixteen lanes side by side: each keeps its own, whatever becomes of the others.
class NearPairsTest : public QObject {
    Q_OBJECT

 private slots:
    void thereAreAsManyRowsAsTheLongestLaneNeeds() {
        PairTable table = NearPairs().vertices;
        QCOMPARE(table.rows(), 0);
        fill(table, 3, 2, 1e4F);
        fill(table, 7, 5, 2e4F);
        QCOMPARE(table.rows(), 5);
        QVERIFY(has(table, 3, 2, 1e4F));
        QVERIFY(has(table, 7, 5, 2e4F));
        table.resize(7, 1);
        QCOMPARE(table.rows(), 2);
        QVERIFY(has(table, 3, 2, 1e4F));
        QVERIFY(has(table, 7, 1, 2e4F));
    }

    void placesWithoutAPairNeverTouch() {
        PairTable table = NearPairs().vertices;
        fill(table, 0, 4, 1e4F);
        for (int row = 0; row < 4; ++row) {
            for (int slot = 1; slot < kWidestVector; ++slot)
                QVERIFY(isEmpty(table, row, slot));
        }
        // Nor do those that had one.
        fill(table, 5, 3, 2e4F);
        table.resize(5, 1);
        QVERIFY(has(table, 5, 1, 2e4F));
        for (int row = 1; row < 4; ++row)
            QVERIFY(isEmpty(table, row, 5));
    }

    void aLaneTakesItsPairsAlong() {
        NearPairs from;
        NearPairs to;
        fill(from.vertices, 2, 6, 1e4F);
        fill(to.vertices, 9, 8, 3e4F);
        fill(to.vertices, 1, 2, 5e4F);
        to.copy(9, from, 2);
        QCOMPARE(to.vertices.rows(), 6);
        QVERIFY(has(to.vertices, 9, 6, 1e4F));
        QVERIFY(has(to.vertices, 1, 2, 5e4F));
        from.clear(2);
        QCOMPARE(from.vertices.rows(), 0);
        QVERIFY(has(to.vertices, 9, 6, 1e4F));
    }
};

QTEST_APPLESS_MAIN(NearPairsTest)
#include "near_pairs_test.moc"
