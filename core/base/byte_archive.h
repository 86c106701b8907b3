#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/math.h"

/// Values as bytes, for another process or machine: little-endian on every machine, every double bit for bit.
///
/// What a type consists of is told once for both directions, by a function beside it that its namespace
/// finds:
///
///     template <class Archive, base::OrConst<PartOutcome> T>
///     void serialize(Archive& archive, T& outcome) {
///         auto& [ending, initial, farthest, time] = outcome;
///         archive(ending, initial, farthest, time);
///     }
///
/// Who adds a field to PartOutcome is told so by the compiler, which counts the names in the brackets. Of an
/// enumeration `lastOf(Ending)` gives the last value. Numbers have as many bytes as in memory, texts and
/// lists a count before them, what is optional a byte that tells whether it is there.
namespace trapwright::base {

template <class T, class Plain>
concept OrConst = std::same_as<std::remove_const_t<T>, Plain>;

static_assert(sizeof(std::size_t) == sizeof(std::uint64_t) && sizeof(int) == sizeof(std::uint32_t));

/// How many elements a text or a list has.
using ByteCount = std::uint32_t;

/// Appends values to its bytes.
class ByteWriter {
 public:
    template <class... T>
    void operator()(const T&... values) {
        (write(values), ...);
    }

    /// As they are, without a count.
    void appendBytes(std::string_view bytes) { bytes_ += bytes; }

    [[nodiscard]] const std::string& bytes() const& { return bytes_; }
    [[nodiscard]] std::string bytes() && { return std::move(bytes_); }

 private:
    template <class T>
    void write(const T& value) {
        if constexpr (std::is_same_v<T, double>) {
            append(std::bit_cast<std::uint64_t>(value));
        } else if constexpr (std::is_same_v<T, bool>) {
            append(std::uint8_t{value});
        } else if constexpr (std::is_enum_v<T>) {
            write(static_cast<std::underlying_type_t<T>>(value));
        } else if constexpr (std::is_integral_v<T>) {
            append(static_cast<std::make_unsigned_t<T>>(value));
        } else {
            serialize(*this, value);
        }
    }
    void write(const std::string& text) {
        writeCount(text.size());
        bytes_ += text;
    }
    template <class T>
    void write(const std::vector<T>& values) {
        writeCount(values.size());
        for (const T& value : values)
            write(value);
    }
    template <class T, std::size_t size>
    void write(const std::array<T, size>& values) {
        for (const T& value : values)
            write(value);
    }
    template <class T>
    void write(const std::optional<T>& value) {
        write(value.has_value());
        if (value) write(*value);
    }
    template <int rows, int columns>
    void write(const Eigen::Matrix<double, rows, columns>& matrix) {
        for (Eigen::Index i = 0; i < matrix.size(); ++i)
            write(matrix.data()[i]);
    }
    void write(const Quaternion& rotation) { write(rotation.coeffs()); }
    void write(const Pose& pose) { (*this)(pose.rotation, pose.position); }
    void writeCount(std::size_t count) {
        assert(count <= std::numeric_limits<ByteCount>::max());
        append(static_cast<ByteCount>(count));
    }

    template <std::unsigned_integral Word>
    void append(Word word) {
        std::array<char, sizeof(Word)> places;
        for (std::size_t i = 0; i < sizeof(Word); ++i)
            places[i] = static_cast<char>(static_cast<std::uint64_t>(word) >> (8 * i));
        bytes_.append(places.data(), places.size());
    }

    std::string bytes_;
};

/// Takes values from bytes of anybody. What cannot be is refused: an end too early, a count of more than
/// there are bytes left, a truth value or an enumerator that does not exist. From then on nothing is read,
/// and what was read is of no use. Never takes more memory than a small multiple of the bytes.
class ByteReader {
 public:
    /// `bytes` must outlive this.
    explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

    template <class... T>
    void operator()(T&... values) {
        (read(values), ...);
    }

    /// So many bytes as they are; none if there are fewer.
    std::string_view takeBytes(std::size_t count) {
        if (failed_ || count > rest_.size()) {
            failed_ = true;
            return {};
        }
        const std::string_view bytes = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return bytes;
    }
    [[nodiscard]] std::size_t left() const { return rest_.size(); }

    /// Something was refused.
    [[nodiscard]] bool failed() const { return failed_; }
    /// All was read, and is as it can be.
    [[nodiscard]] bool finished() const { return !failed_ && rest_.empty(); }

 private:
    /// The bytes that an element of a list takes at least.
    template <class T>
    static constexpr std::size_t leastSize() {
        if constexpr (std::is_arithmetic_v<T>) return sizeof(T);
        if constexpr (requires { T::SizeAtCompileTime; }) return T::SizeAtCompileTime * sizeof(double);
        if constexpr (requires { std::tuple_size<T>::value; })
            return std::tuple_size_v<T> * leastSize<typename T::value_type>();
        return 1;
    }

    template <class T>
    void read(T& value) {
        if constexpr (std::is_same_v<T, double>) {
            take<std::uint64_t>([&](std::uint64_t word) { value = std::bit_cast<double>(word); });
        } else if constexpr (std::is_same_v<T, bool>) {
            take<std::uint8_t>([&](std::uint8_t word) {
                failed_ = failed_ || word > 1;
                value = word == 1;
            });
        } else if constexpr (std::is_enum_v<T>) {
            using Number = std::underlying_type_t<T>;
            Number number = static_cast<Number>(value);
            read(number);
            using Word = std::make_unsigned_t<Number>;
            failed_ = failed_ || static_cast<Word>(number) > static_cast<Word>(lastOf(T{}));
            if (!failed_) value = static_cast<T>(number);
        } else if constexpr (std::is_integral_v<T>) {
            using Word = std::make_unsigned_t<T>;
            take<Word>([&](Word word) { value = static_cast<T>(word); });
        } else {
            serialize(*this, value);
        }
    }
    void read(std::string& text) {
        const std::size_t size = readCount(1);
        text.assign(rest_.substr(0, size));
        rest_.remove_prefix(size);
    }
    template <class T>
    void read(std::vector<T>& values) {
        const std::size_t count = readCount(leastSize<T>());
        values.clear();
        // Where that is not yet known to be there, no room is made before it has come.
        if constexpr (leastSize<T>() > 1) values.reserve(count);
        for (std::size_t i = 0; i < count && !failed_; ++i)
            read(values.emplace_back());
    }
    template <class T, std::size_t size>
    void read(std::array<T, size>& values) {
        for (T& value : values)
            read(value);
    }
    template <class T>
    void read(std::optional<T>& value) {
        bool there = false;
        read(there);
        if (there && !failed_) {
            T content{};
            read(content);
            value = std::move(content);
        } else {
            value = std::nullopt;
        }
    }
    template <int rows, int columns>
    void read(Eigen::Matrix<double, rows, columns>& matrix) {
        static_assert(rows > 0 && columns > 0, "of a fixed size");
        for (Eigen::Index i = 0; i < matrix.size(); ++i)
            read(matrix.data()[i]);
    }
    void read(Quaternion& rotation) { read(rotation.coeffs()); }
    void read(Pose& pose) { (*this)(pose.rotation, pose.position); }

    /// 0 if there cannot be as many.
    std::size_t readCount(std::size_t leastSize) {
        ByteCount count = 0;
        read(count);
        if (count > rest_.size() / leastSize) failed_ = true;
        return failed_ ? 0 : count;
    }

    template <std::unsigned_integral Word, class Use>
    void take(Use use) {
        if (failed_ || rest_.size() < sizeof(Word)) {
            failed_ = true;
            return;
        }
        std::uint64_t word = 0;
        for (std::size_t i = 0; i < sizeof(Word); ++i)
            word |= std::uint64_t{static_cast<unsigned char>(rest_[i])} << (8 * i);
        rest_.remove_prefix(sizeof(Word));
        use(static_cast<Word>(word));
    }

    std::string_view rest_;
    bool failed_ = false;
};

}  // namespace trapwright::base
