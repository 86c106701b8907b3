#include "core/geometry/polygon_soup.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/text_words.h"

namespace trapwright::geometry {

namespace {

using base::Error;

Error makeError(std::size_t line, const std::string& what) {
    return Error{"line " + std::to_string(line) + ": " + what};
}

base::Result<base::Vec3> parsePoint(std::string_view words, std::size_t line) {
    base::Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string_view word = takeWord(words);
        if (word.empty()) return makeError(line, "a vertex has fewer than three coordinates");
        const std::optional<double> value = parseReal(word);
        if (!value) return makeError(line, "the coordinate " + quoteWord(word) + " is not a number");
        point[axis] = *value;
    }
    return point;
}

std::string_view withoutComment(std::string_view line) {
    return line.substr(0, line.find('#'));
}

// --- OBJ

/// The corners of one face; those from the start are checked when all points are known.
base::Status parseObjFace(std::string_view words, std::size_t line, PolygonSoup& soup) {
    const auto points = static_cast<long long>(soup.points.size());
    const std::size_t begin = soup.corners.size();
    while (true) {
        const std::string_view word = takeWord(words);
        if (word.empty()) break;
        const std::optional<int> number = parseWhole(word.substr(0, word.find('/')));
        if (!number || *number == 0) return makeError(line, "a face has the corner " + quoteWord(word));
        if (*number < 0 && -static_cast<long long>(*number) > points)
            return makeError(line, "a face has the corner " + quoteWord(word) + ", but only " +
                                       std::to_string(points) + " vertices are before it");
        soup.corners.push_back(*number > 0 ? *number - 1 : static_cast<int>(points + *number));
    }
    // Exporters write such faces for loose edges and points.
    if (soup.corners.size() - begin < 3)
        soup.corners.resize(begin);
    else
        soup.ends.push_back(soup.corners.size());
    return base::success();
}

// --- OFF

struct OffHeader {
    std::size_t vertices = 0;
    std::size_t faces = 0;
};

/// The next line that says something, without its comment.
std::optional<std::string_view> nextContent(TextLines& lines) {
    while (const std::optional<std::string_view> line = lines.next()) {
        std::string_view content = withoutComment(*line);
        std::string_view rest = content;
        if (!takeWord(rest).empty()) return content;
    }
    return std::nullopt;
}

base::Result<OffHeader> parseOffHeader(TextLines& lines) {
    std::optional<std::string_view> line = nextContent(lines);
    if (!line) return Error{"it has no content"};
    std::string_view words = *line;
    std::string_view rest = words;
    const std::string_view keyword = takeWord(rest);
    if (keyword.ends_with("OFF")) {
        constexpr std::array<std::string_view, 8> kKnown = {"OFF",   "COFF",   "NOFF",   "CNOFF",
                                                            "STOFF", "STCOFF", "STNOFF", "STCNOFF"};
        if (std::find(kKnown.begin(), kKnown.end(), keyword) == kKnown.end())
            return Error{"its vertices are not points in space: it begins with " + quoteWord(keyword)};
        words = rest;
        if (takeWord(rest) == "BINARY")
            return Error{"it is a binary OFF file, and only those in text are read"};
    } else if (!parseWhole(keyword)) {
        return Error{"it does not begin with \"OFF\""};
    }
    rest = words;
    if (takeWord(rest).empty()) {
        line = nextContent(lines);
        if (!line) return Error{"it was cut short: the numbers of vertices and faces are missing"};
        words = *line;
    }
    const std::optional<int> vertices = parseWhole(takeWord(words));
    const std::optional<int> faces = parseWhole(takeWord(words));
    if (!vertices || !faces || *vertices < 0 || *faces < 0)
        return makeError(lines.number(), "these are not the numbers of vertices and faces");
    const OffHeader header{static_cast<std::size_t>(*vertices), static_cast<std::size_t>(*faces)};
    // A vertex takes at least "0 0 0" and a face "0", each with an end of line.
    if (6 * header.vertices + 2 * header.faces > lines.rest().size() + 1)
        return Error{"it was cut short: it announces " + std::to_string(header.vertices) + " vertices and " +
                     std::to_string(header.faces) + " faces, more than it can hold"};
    return header;
}

base::Status parseOffFace(std::string_view words, std::size_t line, PolygonSoup& soup) {
    const std::string_view word = takeWord(words);
    const std::optional<int> count = parseWhole(word);
    if (!count || *count < 0) return makeError(line, quoteWord(word) + " is not a number of corners");
    const std::size_t begin = soup.corners.size();
    for (int i = 0; i < *count; ++i) {
        const std::string_view corner = takeWord(words);
        if (corner.empty())
            return makeError(line, "a face of " + std::to_string(*count) + " corners has only " +
                                       std::to_string(i) + ", the file is damaged or was cut short");
        const std::optional<int> number = parseWhole(corner);
        if (!number || *number < 0 || static_cast<std::size_t>(*number) >= soup.points.size())
            return makeError(line, "a face has the corner " + quoteWord(corner) + ", but the " +
                                       std::to_string(soup.points.size()) + " vertices are counted from 0");
        soup.corners.push_back(*number);
    }
    if (*count < 3)
        soup.corners.resize(begin);
    else
        soup.ends.push_back(soup.corners.size());
    return base::success();
}

}  // namespace

base::Result<PolygonSoup> parseObj(std::string_view text) {
    PolygonSoup soup;
    std::vector<std::size_t> faceLines;
    bool freeForm = false;
    TextLines lines(text);
    std::string joined;
    while (std::optional<std::string_view> line = lines.next()) {
        const std::size_t number = lines.number();
        std::string_view words = withoutComment(*line);
        if (words.ends_with('\\')) {
            joined.clear();
            while (words.ends_with('\\')) {
                joined.append(words.substr(0, words.size() - 1)).push_back(' ');
                line = lines.next();
                words = line ? withoutComment(*line) : std::string_view();
            }
            joined.append(words);
            words = joined;
        }
        const std::string_view keyword = takeWord(words);
        if (keyword == "v") {
            const base::Result<base::Vec3> point = parsePoint(words, number);
            if (!point) return point.error();
            soup.points.push_back(*point);
        } else if (keyword == "f" || keyword == "fo") {
            if (const base::Status status = parseObjFace(words, number, soup); !status) return status.error();
            faceLines.resize(soup.ends.size(), number);
        } else if (keyword == "surf") {
            freeForm = true;
        }
    }
    if (soup.ends.empty() && freeForm) return Error{"it has free-form surfaces but no faces"};
    if (soup.points.empty()) return Error{"it has no vertices"};
    if (soup.ends.empty()) return Error{"it has vertices but no faces"};
    for (std::size_t i = 0; i < soup.ends.size(); ++i)
        for (const int corner : soup.polygon(i))
            if (static_cast<std::size_t>(corner) >= soup.points.size())
                return makeError(faceLines[i], "a face has the corner " + std::to_string(corner + 1LL) +
                                                   ", but the file has only " +
                                                   std::to_string(soup.points.size()) + " vertices");
    return soup;
}

base::Result<PolygonSoup> parseOff(std::string_view text) {
    TextLines lines(text);
    const base::Result<OffHeader> header = parseOffHeader(lines);
    if (!header) return header.error();
    PolygonSoup soup;
    soup.points.reserve(header->vertices);
    soup.ends.reserve(header->faces);
    for (std::size_t i = 0; i < header->vertices; ++i) {
        const std::optional<std::string_view> line = nextContent(lines);
        if (!line)
            return Error{"it was cut short: it has " + std::to_string(i) + " of " +
                         std::to_string(header->vertices) + " vertices"};
        const base::Result<base::Vec3> point = parsePoint(*line, lines.number());
        if (!point) return point.error();
        soup.points.push_back(*point);
    }
    for (std::size_t i = 0; i < header->faces; ++i) {
        const std::optional<std::string_view> line = nextContent(lines);
        if (!line)
            return Error{"it was cut short: it has " + std::to_string(i) + " of " +
                         std::to_string(header->faces) + " faces"};
        if (const base::Status status = parseOffFace(*line, lines.number(), soup); !status)
            return status.error();
    }
    return soup;
}

}  // namespace trapwright::geometry
