#include "core/geometry/polygon_soup.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

#include "core/geometry/text_words.h"

namespace trapwright::geometry {

namespace {

using base::Error;

constexpr std::size_t kHeader = 84;  // 80 bytes of text and the number of triangles
constexpr std::size_t kFacet = 50;

void appendCorner(const base::Vec3& point, PolygonSoup& soup) {
    soup.corners.push_back(static_cast<int>(soup.points.size()));
    soup.points.push_back(point);
}

/// Whether a word is the keyword, in whatever case. STL's are all in lower case, many writers' are not.
bool isKeyword(std::string_view word, std::string_view keyword) {
    return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(), [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == static_cast<unsigned char>(b);
    });
}

std::string_view skipMark(std::string_view bytes) {
    constexpr std::string_view kMark = "\xef\xbb\xbf";
    return bytes.starts_with(kMark) ? bytes.substr(kMark.size()) : bytes;
}

bool isText(std::string_view bytes) {
    constexpr std::size_t kProbe = 4096;
    const std::string_view head = bytes.substr(0, kProbe);
    return std::all_of(head.begin(), head.end(),
                       [](unsigned char c) { return c >= 0x20 || (c >= 0x09 && c <= 0x0d); });
}

/// Whether it begins as a text does: headers of binary files have "solid", too, but no facet behind it.
bool beginsAsText(std::string_view bytes) {
    std::string_view rest = skipMark(bytes);
    if (!isKeyword(takeWord(rest), "solid")) return false;
    if (isText(skipMark(bytes))) return true;
    rest.remove_prefix(std::min(rest.find_first_of("\r\n"), rest.size()));
    return isKeyword(takeWord(rest), "facet");
}

base::Result<PolygonSoup> parseText(std::string_view text) {
    PolygonSoup soup;
    bool closed = false;
    std::size_t inFacet = 0;
    text = skipMark(text);
    const auto facet = [&] { return "facet " + std::to_string(soup.ends.size() + 1); };
    while (true) {
        const std::string_view word = takeWord(text);
        if (word.empty()) break;
        if (isKeyword(word, "solid") || isKeyword(word, "endsolid")) {
            closed = word.size() > 5;
            text.remove_prefix(std::min(text.find_first_of("\r\n"), text.size()));  // the solid's name
        } else if (isKeyword(word, "vertex")) {
            base::Vec3 point;
            for (int axis = 0; axis < 3; ++axis) {
                const std::string_view number = takeWord(text);
                const std::optional<double> value = parseReal(number);
                if (number.empty()) return Error{"it was cut short in " + facet()};
                if (!value)
                    return Error{facet() + " has the coordinate " + quoteWord(number) +
                                 ", which is not a number"};
                point[axis] = *value;
            }
            appendCorner(point, soup);
            ++inFacet;
        } else if (isKeyword(word, "endfacet")) {
            if (inFacet != 3)
                return Error{facet() + " has " + std::to_string(inFacet) + " corners instead of three"};
            soup.ends.push_back(soup.corners.size());
            inFacet = 0;
        }
    }
    if (soup.points.empty()) return Error{"it begins like an STL file in text but has no facets"};
    if (!closed || inFacet != 0)
        return Error{"it was cut short: \"endsolid\" is missing behind its " +
                     std::to_string(soup.ends.size()) + " facets"};
    return soup;
}

base::Result<PolygonSoup> parseBinary(std::string_view bytes) {
    if (bytes.size() < kHeader)
        return Error{"it is too short: it has " + std::to_string(bytes.size()) +
                     " bytes, the header alone has " + std::to_string(kHeader)};
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + kHeader - sizeof count, sizeof count);
    const std::size_t expected = kHeader + kFacet * count;
    if (count == 0 && bytes.size() < kHeader + kFacet) return Error{"it is a file without triangles"};
    if (bytes.size() < expected || bytes.size() >= expected + kFacet)
        return Error{std::string("it is binary and ") + (bytes.size() < expected ? "truncated" : "damaged") +
                     ": its header announces " + std::to_string(count) + " triangles, " +
                     std::to_string(expected) + " bytes, but it has " + std::to_string(bytes.size()) +
                     " bytes"};
    PolygonSoup soup;
    soup.points.reserve(3 * static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < count; ++i) {
        std::array<float, 12> normalAndCorners{};
        std::memcpy(normalAndCorners.data(), bytes.data() + kHeader + kFacet * i, sizeof normalAndCorners);
        for (std::size_t k = 3; k < 12; k += 3)
            appendCorner({normalAndCorners[k], normalAndCorners[k + 1], normalAndCorners[k + 2]}, soup);
        soup.ends.push_back(soup.corners.size());
    }
    return soup;
}

}  // namespace

base::Result<PolygonSoup> parseStl(std::string_view bytes) {
    std::uint32_t count = 0;
    if (bytes.size() >= kHeader) std::memcpy(&count, bytes.data() + kHeader - sizeof count, sizeof count);
    if (bytes.size() >= kHeader && bytes.size() == kHeader + kFacet * static_cast<std::size_t>(count))
        return parseBinary(bytes);
    if (beginsAsText(bytes)) return parseText(bytes);
    if (isText(bytes)) return Error{"it is a text but not an STL file: it does not begin with \"solid\""};
    return parseBinary(bytes);
}

}  // namespace trapwright::geometry
