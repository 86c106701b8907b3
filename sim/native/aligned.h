#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace trapwright::native {

/// Of any instruction set, in floats: arrays are padded to whole numbers of it.
inline constexpr int kWidestVector = 16;

/// Gives memory that whole vectors can be loaded from.
template <class T>
struct AlignedAllocator {
    using value_type = T;
    static constexpr std::align_val_t kAlignment{64};

    AlignedAllocator() = default;
    template <class U>
    explicit AlignedAllocator(const AlignedAllocator<U>& /*other*/) {}

    T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kAlignment)); }
    void deallocate(T* memory, std::size_t /*count*/) { ::operator delete(memory, kAlignment); }

    friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) = default;
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

/// `count` rounded up to whole vectors.
constexpr int padToVectors(int count) {
    return (count + kWidestVector - 1) / kWidestVector * kWidestVector;
}

}  // namespace trapwright::native
