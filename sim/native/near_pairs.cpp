#include "sim/native/near_pairs.h"

#include <algorithm>

namespace trapwright::native {

void PairTable::resize(int slot, int count) {
    const int held = static_cast<int>(trackFeatures_.size()) / kWidestVector;
    if (count > held) {
        const auto rows = static_cast<std::size_t>(count) * kWidestVector;
        values_.resize(rows * static_cast<std::size_t>(fields_));
        due_.resize(rows, kUntouchable);
        trackFeatures_.resize(rows);
        partFeatures_.resize(rows);
        for (int row = held; row < count; ++row)
            std::fill_n(&at(row, untouchable_, 0), kWidestVector, kUntouchable);
    }
    for (int row = count; row < counts_[slot]; ++row) {
        for (int f = 0; f < fields_; ++f)
            at(row, f, slot) = f == untouchable_ ? kUntouchable : 0.0F;
        due(row)[slot] = kUntouchable;
    }
    counts_[slot] = count;
    rows_ = *std::max_element(counts_.begin(), counts_.end());
}

void PairTable::copy(int slot, const PairTable& from, int fromSlot) {
    const int count = from.counts_[fromSlot];
    resize(slot, count);
    for (int row = 0; row < count; ++row) {
        due(row)[slot] = from.due(row)[fromSlot];
        for (int f = 0; f < fields_; ++f)
            at(row, f, slot) = from.field(row, f)[fromSlot];
        const int place = row * kWidestVector + slot;
        trackFeatures_[place] = from.trackFeature(row)[fromSlot];
        partFeatures_[place] = from.partFeature(row)[fromSlot];
    }
}

void NearPairs::clear(int slot) {
    for (PairTable* table : {&vertices, &edges, &faces})
        table->resize(slot, 0);
}

void NearPairs::copy(int slot, const NearPairs& from, int fromSlot) {
    vertices.copy(slot, from.vertices, fromSlot);
    edges.copy(slot, from.edges, fromSlot);
    faces.copy(slot, from.faces, fromSlot);
}

}  // namespace trapwright::native
