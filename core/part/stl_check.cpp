#include "core/part/stl_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>

namespace trapwright::part {

namespace {

constexpr std::uint64_t kHeader = 84;  // 80 bytes of text and the number of triangles
constexpr std::uint64_t kFacet = 50;
constexpr std::size_t kProbe = 4096;

bool isText(const std::string& bytes) {
    return std::all_of(bytes.begin(), bytes.end(),
                       [](unsigned char c) { return c >= 0x20 || (c >= 0x09 && c <= 0x0d); });
}

std::string readBytes(std::ifstream& file, std::uint64_t from, std::size_t count) {
    std::string bytes(count, '\0');
    file.clear();
    file.seekg(static_cast<std::streamoff>(from));
    file.read(bytes.data(), static_cast<std::streamsize>(count));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

}  // namespace

base::Status checkStlFile(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::error_code failure;
    const std::uint64_t size = std::filesystem::file_size(path, failure);
    if (!file || failure) return base::Error{fmt::format("{} could not be opened", path.string())};
    const std::string head = readBytes(file, 0, kProbe);

    std::uint32_t announced = 0;
    if (size >= kHeader) {
        std::memcpy(&announced, head.data() + 80, sizeof announced);
        if (size == kHeader + kFacet * announced) {
            if (announced > 0) return base::success();
            return base::Error{
                fmt::format("{} is an STL file without triangles. Export the part again", path.string())};
        }
    }
    if (isText(head)) {
        const std::string text = lowerCase(head);
        const std::size_t word = text.find_first_not_of(" \t\r\n");
        if (word == std::string::npos || text.compare(word, 5, "solid") != 0) {
            return base::Error{
                fmt::format("{} is a text file but not an STL file: it does not begin with \"solid\". Export "
                            "the part as STL",
                            path.string())};
        }
        const std::string tail = lowerCase(readBytes(file, size > kProbe ? size - kProbe : 0, kProbe));
        if (text.find("facet") == std::string::npos) {
            return base::Error{fmt::format(
                "{} begins like an ASCII STL file but has no facets. Export the part again", path.string())};
        }
        if (tail.find("endsolid") == std::string::npos) {
            return base::Error{
                fmt::format("{} is an ASCII STL file that was cut short: \"endsolid\" is missing. Copy or "
                            "export it again",
                            path.string())};
        }
        return base::success();
    }
    if (size < kHeader) {
        return base::Error{
            fmt::format("{} is too short to be an STL file ({} bytes, the header alone has {}). Copy or "
                        "export it again",
                        path.string(), size, kHeader)};
    }
    const bool truncated = size < kHeader + kFacet * announced;
    return base::Error{fmt::format(
        "{} is a {} binary STL file: its header announces {} triangles, {} bytes, but it has {} bytes. Copy "
        "or export "
        "it again",
        path.string(), truncated ? "truncated" : "damaged", announced, kHeader + kFacet * announced, size)};
}

}  // namespace trapwright::part
