#include "core/geometry/package_size.h"

#include <zip.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>

namespace trapwright::geometry {

namespace {

using base::Error;

constexpr std::uint64_t kMost = 512ULL << 20U;  // [bytes]
// Deflate reaches 1030 to 1; models of one million equal numbers stay below 200.
constexpr std::uint64_t kMostRatio = 250;
constexpr std::uint64_t kRatioFrom = 16ULL << 20U;  // [bytes]

struct Discard {
    void operator()(zip_t* archive) const { zip_discard(archive); }
    void operator()(zip_file_t* file) const { zip_fclose(file); }
};

std::string formatMebibytes(std::uint64_t bytes) {
    return std::to_string(bytes >> 20U) + " MiB";
}

/// Unpacks one file into nothing, because the size in the directory is only its word.
base::Status checkFile(zip_t* archive, const zip_stat_t& entry) {
    const std::string name = std::string("its file \"") + entry.name + "\" ";
    const std::unique_ptr<zip_file_t, Discard> file(zip_fopen_index(archive, entry.index, 0));
    if (!file) return Error{name + "cannot be unpacked: " + zip_strerror(archive)};
    std::array<char, 65536> block{};
    std::uint64_t size = 0;
    while (true) {
        const zip_int64_t read = zip_fread(file.get(), block.data(), block.size());
        if (read < 0) return Error{name + "is damaged: " + zip_file_strerror(file.get())};
        size += static_cast<std::uint64_t>(read);
        if (size > entry.size) return Error{name + "is larger than the package says"};
        if (read == 0) break;
    }
    if (size < entry.size) return Error{name + "is smaller than the package says: the package is damaged"};
    return base::success();
}

}  // namespace

base::Status checkPackageSize(std::string_view package) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(package.data(), package.size(), 0, &error);
    const std::unique_ptr<zip_t, Discard> archive(
        source == nullptr ? nullptr : zip_open_from_source(source, ZIP_RDONLY, &error));
    if (!archive) {
        Error failure{std::string("it is not a zip package, or was cut short: ") +
                      zip_error_strerror(&error)};
        if (source != nullptr) zip_source_free(source);
        zip_error_fini(&error);
        return failure;
    }
    zip_error_fini(&error);

    const auto count = static_cast<zip_uint64_t>(zip_get_num_entries(archive.get(), 0));
    if (count == 0) return Error{"it is a package with nothing in it"};
    constexpr zip_uint64_t kNeeded = ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_NAME | ZIP_STAT_INDEX;
    std::uint64_t unpacked = 0;
    for (zip_uint64_t i = 0; i < count; ++i) {
        zip_stat_t entry;
        if (zip_stat_index(archive.get(), i, 0, &entry) != 0 || (entry.valid & kNeeded) != kNeeded)
            return Error{"its directory is damaged"};
        // Not their sum first: it could overflow.
        if (entry.size > kMost - unpacked)
            return Error{"it unpacks to more than " + formatMebibytes(kMost) + ", the most that is read"};
        unpacked += entry.size;
        if (entry.size > kRatioFrom && entry.size / kMostRatio > entry.comp_size)
            return Error{std::string("its file \"") + entry.name + "\" unpacks from " +
                         std::to_string(entry.comp_size) + " bytes to " + formatMebibytes(entry.size) +
                         ", which no model does"};
    }
    for (zip_uint64_t i = 0; i < count; ++i) {
        zip_stat_t entry;
        zip_stat_index(archive.get(), i, 0, &entry);
        if (base::Status status = checkFile(archive.get(), entry); !status) return status;
    }
    return base::success();
}

}  // namespace trapwright::geometry
