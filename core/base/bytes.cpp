#include "core/base/bytes.h"

#include <bit>

namespace trapwright::base {

namespace {

constexpr unsigned kBitsPerByte = 8;

}  // namespace

void ByteWriter::putDouble(double value) {
    put64(std::bit_cast<std::uint64_t>(value));
}

void ByteWriter::put(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) {
        bytes_ += static_cast<char>(value & 0xFFU);
        value >>= kBitsPerByte;
    }
}

double ByteReader::getDouble() {
    return std::bit_cast<double>(get64());
}

std::string_view ByteReader::getBytes(std::size_t count) {
    if (count > left()) {
        ok_ = false;
        at_ = bytes_.size();
        return {};
    }
    const std::string_view bytes = bytes_.substr(at_, count);
    at_ += count;
    return bytes;
}

std::uint64_t ByteReader::get(std::size_t size) {
    std::uint64_t value = 0;
    const std::string_view bytes = getBytes(size);
    for (std::size_t i = bytes.size(); i > 0; --i)
        value = (value << kBitsPerByte) | static_cast<unsigned char>(bytes[i - 1]);
    return value;
}

}  // namespace trapwright::base
