#include "tests/fuzz/scratch_folder.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>

namespace trapwright::fuzz {

namespace {

constexpr const char* kMemory = "/dev/shm";

}  // namespace

ScratchFolder::ScratchFolder() {
    const bool inMemory = std::filesystem::is_directory(kMemory);
    const auto parent = inMemory ? std::filesystem::path(kMemory) : std::filesystem::temp_directory_path();
    std::string name = (parent / "trapwright-fuzz-XXXXXX").string();
    require(::mkdtemp(name.data()) != nullptr, "a folder for scratch files");
    path_ = name;
}

ScratchFolder::~ScratchFolder() {
    std::error_code failure;
    std::filesystem::remove_all(path_, failure);
}

std::filesystem::path ScratchFolder::keepOnly(std::string_view name,
                                              std::span<const std::uint8_t> content) const {
    clear();
    std::filesystem::path file = path_ / name;
    std::ofstream stream(file, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
    stream.close();
    require(stream.good(), "a scratch file");
    return file;
}

void ScratchFolder::clear() const {
    for (const auto& entry : std::filesystem::directory_iterator(path_))
        std::filesystem::remove_all(entry.path());
}

void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "This does not hold: %s\n", what);
    std::abort();
}

}  // namespace trapwright::fuzz
