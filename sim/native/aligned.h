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

/// Rows of floats, all equally long and padded to whole vectors.
class FloatRows {
 public:
    FloatRows() = default;
    FloatRows(int rows, int count)
        : stride_(padToVectors(count)), values_(static_cast<std::size_t>(rows * stride_)) {}

    [[nodiscard]] float* row(int r) { return values_.data() + static_cast<std::ptrdiff_t>(r) * stride_; }
    [[nodiscard]] const float* row(int r) const {
        return values_.data() + static_cast<std::ptrdiff_t>(r) * stride_;
    }
    [[nodiscard]] int stride() const { return stride_; }

 private:
    int stride_ = 0;
    AlignedVector<float> values_;
};

}  // namespace trapwright::native
