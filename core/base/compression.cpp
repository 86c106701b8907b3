#include "core/base/compression.h"

#include <zstd.h>

#include <memory>
#include <new>

namespace trapwright::base {

namespace {

constexpr int kLevel = 3;

struct FreeContext {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

}  // namespace

std::string compress(std::span<const std::string> parts) {
    const std::unique_ptr<ZSTD_CCtx, FreeContext> context(ZSTD_createCCtx());
    if (!context) throw std::bad_alloc();
    std::size_t size = 0;
    for (const std::string& part : parts)
        size += part.size();
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, kLevel);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
    ZSTD_CCtx_setPledgedSrcSize(context.get(), size);

    // A part that is flushed ends its block, and a block has a table of frequencies of its own.
    constexpr std::size_t kPerPart = 64;
    std::string bytes(ZSTD_compressBound(size) + kPerPart * parts.size(), '\0');
    ZSTD_outBuffer out{bytes.data(), bytes.size(), 0};
    for (std::size_t i = 0; i <= parts.size(); ++i) {
        const bool end = i == parts.size();
        ZSTD_inBuffer in{end ? nullptr : parts[i].data(), end ? 0 : parts[i].size(), 0};
        std::size_t left = 0;
        do {
            left = ZSTD_compressStream2(context.get(), &out, &in, end ? ZSTD_e_end : ZSTD_e_flush);
            if (ZSTD_isError(left) != 0U) throw std::bad_alloc();  // the only way in which it can fail
            if (left > 0) {
                bytes.resize(2 * bytes.size());
                out.dst = bytes.data();
                out.size = bytes.size();
            }
        } while (left > 0);
    }
    bytes.resize(out.pos);
    return bytes;
}

std::optional<std::string> decompress(std::string_view bytes, std::size_t size) {
    if (ZSTD_getFrameContentSize(bytes.data(), bytes.size()) != size) return std::nullopt;
    std::string unpacked(size, '\0');
    if (ZSTD_decompress(unpacked.data(), size, bytes.data(), bytes.size()) != size) return std::nullopt;
    return unpacked;
}

}  // namespace trapwright::base
