#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace trapwright::base {

/// Numbers as bytes, little-endian on every machine: how they lie in files and in messages between processes.
class ByteWriter {
 public:
    void put8(std::uint8_t value) { put(value, 1); }
    void put32(std::uint32_t value) { put(value, 4); }
    void put64(std::uint64_t value) { put(value, 8); }
    void putDouble(double value);
    void putBytes(std::string_view bytes) { bytes_ += bytes; }

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
    void put(std::uint64_t value, int size);

    std::string bytes_;
};

/// Reads what ByteWriter wrote. Behind the end everything is 0, and ok() is false from then on.
class ByteReader {
 public:
    explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

    std::uint8_t get8() { return static_cast<std::uint8_t>(get(1)); }
    std::uint32_t get32() { return static_cast<std::uint32_t>(get(4)); }
    std::uint64_t get64() { return get(8); }
    double getDouble();
    std::string_view getBytes(std::size_t count);

    [[nodiscard]] bool ok() const { return ok_; }
    /// Whether all was read, and no more.
    [[nodiscard]] bool atEnd() const { return ok_ && at_ == bytes_.size(); }
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

 private:
    std::uint64_t get(std::size_t size);

    std::string_view bytes_;
    std::size_t at_ = 0;
    bool ok_ = true;
};

}  // namespace trapwright::base
