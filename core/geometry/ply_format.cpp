#include "core/geometry/polygon_soup.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/text_words.h"

namespace trapwright::geometry {

namespace {

using base::Error;

enum class Encoding { text, littleEndian, bigEndian };
enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct ScalarName {
    std::string_view name;
    Scalar type;
};
constexpr std::array<ScalarName, 16> kScalars = {{{"char", Scalar::int8},
                                                  {"uchar", Scalar::uint8},
                                                  {"short", Scalar::int16},
                                                  {"ushort", Scalar::uint16},
                                                  {"int", Scalar::int32},
                                                  {"uint", Scalar::uint32},
                                                  {"float", Scalar::float32},
                                                  {"double", Scalar::float64},
                                                  {"int8", Scalar::int8},
                                                  {"uint8", Scalar::uint8},
                                                  {"int16", Scalar::int16},
                                                  {"uint16", Scalar::uint16},
                                                  {"int32", Scalar::int32},
                                                  {"uint32", Scalar::uint32},
                                                  {"float32", Scalar::float32},
                                                  {"float64", Scalar::float64}}};
constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};  // [bytes], in the order of Scalar

struct Property {
    std::string_view name;
    Scalar type;
    std::optional<Scalar> count;  // a list's
};

struct Element {
    std::string_view name;
    std::uint64_t count;
    std::vector<Property> properties;
};

struct Header {
    Encoding encoding = Encoding::text;
    std::vector<Element> elements;
};

std::optional<Scalar> findScalar(std::string_view name) {
    for (const ScalarName& known : kScalars)
        if (known.name == name) return known.type;
    return std::nullopt;
}

// --- header

std::optional<Error> readFormat(std::string_view words, Header& header) {
    const std::string_view name = takeWord(words);
    if (name == "ascii")
        header.encoding = Encoding::text;
    else if (name == "binary_little_endian")
        header.encoding = Encoding::littleEndian;
    else if (name == "binary_big_endian")
        header.encoding = Encoding::bigEndian;
    else
        return Error{"its format " + quoteWord(name) + " is not known"};
    return std::nullopt;
}

std::optional<Error> readElement(std::string_view words, Header& header) {
    const std::string_view name = takeWord(words);
    const std::string_view text = takeWord(words);
    std::uint64_t count = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (text.empty() || problem != std::errc() || end != text.data() + text.size())
        return Error{"its header has " + quoteWord(text) + " as the number of the element " +
                     quoteWord(name)};
    const auto same = [&](const Element& element) { return element.name == name; };
    if (std::any_of(header.elements.begin(), header.elements.end(), same))
        return Error{"its header has the element " + quoteWord(name) + " twice"};
    header.elements.push_back({name, count, {}});
    return std::nullopt;
}

std::optional<Error> readProperty(std::string_view words, Header& header) {
    if (header.elements.empty()) return Error{"its header has a property before the first element"};
    std::string_view type = takeWord(words);
    std::optional<Scalar> count;
    if (type == "list") {
        const std::string_view countType = takeWord(words);
        count = findScalar(countType);
        if (!count || *count == Scalar::float32 || *count == Scalar::float64)
            return Error{"its header has a list whose number is of the type " + quoteWord(countType)};
        type = takeWord(words);
    }
    const std::optional<Scalar> scalar = findScalar(type);
    if (!scalar) return Error{"its header has a property of the unknown type " + quoteWord(type)};
    header.elements.back().properties.push_back({takeWord(words), *scalar, count});
    return std::nullopt;
}

base::Result<Header> readHeader(TextLines& lines) {
    Header header;
    std::string_view first = lines.next().value_or("");
    if (takeWord(first) != "ply") return Error{"it does not begin with \"ply\""};
    bool known = false;
    while (std::optional<std::string_view> line = lines.next()) {
        std::string_view words = *line;
        const std::string_view keyword = takeWord(words);
        std::optional<Error> error;
        if (keyword == "end_header") {
            if (!known) return Error{"its header does not name a format"};
            return header;
        }
        if (keyword == "format") {
            known = true;
            error = readFormat(words, header);
        } else if (keyword == "element") {
            error = readElement(words, header);
        } else if (keyword == "property") {
            error = readProperty(words, header);
        } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
            return Error{"line " + std::to_string(lines.number()) + " of its header begins with " +
                         quoteWord(keyword)};
        }
        if (error) return *error;
    }
    return Error{"it was cut short: its header has no end"};
}

// --- content

/// The numbers behind the header, one after the other.
class Numbers {
 public:
    Numbers(Encoding encoding, std::string_view bytes) : encoding_(encoding), rest_(bytes) {}

    /// None at the end of the file and where a text is no number.
    std::optional<double> next(Scalar type) {
        return encoding_ == Encoding::text ? parseReal(takeWord(rest_)) : nextBinary(type);
    }

    /// Whether the rest of the file can hold this many of a type.
    [[nodiscard]] bool canHold(std::uint64_t count, std::uint64_t bytesEach) const {
        return bytesEach == 0 || count <= (rest_.size() + 1) / bytesEach;
    }

    /// The least bytes that a number takes: a digit and a blank in text.
    [[nodiscard]] std::uint64_t leastSize(Scalar type) const {
        return encoding_ == Encoding::text ? 2 : kSizes[static_cast<std::size_t>(type)];
    }

    [[nodiscard]] bool atEnd() const {
        std::string_view rest = rest_;
        return rest.empty() || (encoding_ == Encoding::text && takeWord(rest).empty());
    }

 private:
    template <class T>
    static double decode(const std::array<char, 8>& bytes) {
        T value{};
        std::memcpy(&value, bytes.data(), sizeof value);
        return static_cast<double>(value);
    }

    std::optional<double> nextBinary(Scalar type) {
        const std::size_t size = kSizes[static_cast<std::size_t>(type)];
        if (rest_.size() < size) {
            rest_ = {};
            return std::nullopt;
        }
        std::array<char, 8> bytes{};
        std::copy_n(rest_.begin(), size, bytes.begin());
        rest_.remove_prefix(size);
        if ((encoding_ == Encoding::littleEndian) != (std::endian::native == std::endian::little))
            std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
        switch (type) {
            case Scalar::int8:
                return decode<std::int8_t>(bytes);
            case Scalar::uint8:
                return decode<std::uint8_t>(bytes);
            case Scalar::int16:
                return decode<std::int16_t>(bytes);
            case Scalar::uint16:
                return decode<std::uint16_t>(bytes);
            case Scalar::int32:
                return decode<std::int32_t>(bytes);
            case Scalar::uint32:
                return decode<std::uint32_t>(bytes);
            case Scalar::float32:
                return decode<float>(bytes);
            case Scalar::float64:
                return decode<double>(bytes);
        }
        return std::nullopt;
    }

    Encoding encoding_;
    std::string_view rest_;
};

/// One entry of an element: a number for each scalar property, the numbers of each list.
class Entry {
 public:
    explicit Entry(const Element& element)
        : element_(element), values_(element.properties.size()), lists_(element.properties.size()) {}

    /// The reason why it could not be read, if so.
    std::optional<std::string> read(Numbers& numbers) {
        for (std::size_t i = 0; i < element_.properties.size(); ++i) {
            const Property& property = element_.properties[i];
            const std::optional<double> value = numbers.next(property.count.value_or(property.type));
            if (!value) return describeEnd(numbers);
            if (!property.count) {
                values_[i] = *value;
                continue;
            }
            if (!(*value >= 0.0) || *value != std::floor(*value))
                return "has a list with a number of entries that cannot be";
            if (*value > 4294967295.0 ||
                !numbers.canHold(static_cast<std::uint64_t>(*value), numbers.leastSize(property.type)))
                return "has a list of more entries than the file can hold: it is damaged or was cut short";
            lists_[i].resize(static_cast<std::size_t>(*value));
            for (double& entry : lists_[i]) {
                const std::optional<double> number = numbers.next(property.type);
                if (!number) return describeEnd(numbers);
                entry = *number;
            }
        }
        return std::nullopt;
    }

    [[nodiscard]] double value(std::size_t property) const { return values_[property]; }
    [[nodiscard]] const std::vector<double>& list(std::size_t property) const { return lists_[property]; }

 private:
    static std::string describeEnd(const Numbers& numbers) {
        return numbers.atEnd() ? "is not there: the file was cut short"
                               : "has something that is not a number, or the file was cut short";
    }

    const Element& element_;
    std::vector<double> values_;
    std::vector<std::vector<double>> lists_;
};

std::optional<std::size_t> findProperty(const Element& element, std::string_view name, bool list) {
    for (std::size_t i = 0; i < element.properties.size(); ++i)
        if (element.properties[i].name == name && element.properties[i].count.has_value() == list) return i;
    return std::nullopt;
}

std::string describe(const Element& element, std::uint64_t i) {
    return quoteWord(element.name) + " " + std::to_string(i + 1) + " of " + std::to_string(element.count);
}

/// Faces before their corners are known to be there: the element that holds the points may come later.
void appendFace(const std::vector<double>& corners, PolygonSoup& soup) {
    if (corners.size() < 3) return;
    for (const double corner : corners)
        soup.corners.push_back(corner >= 0.0 && corner < 2147483647.0 && corner == std::floor(corner)
                                   ? static_cast<int>(corner)
                                   : -1);
    soup.ends.push_back(soup.corners.size());
}

/// Every corner closes a triangle with the two before it, turned every other time; -1 begins anew.
void appendStrips(const std::vector<double>& corners, PolygonSoup& soup) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i] == -1.0) begin = i + 1;
        if (i < begin + 2) continue;
        const std::size_t turned = (i - begin) % 2;
        const double a = corners[i - 2 + turned];
        const double b = corners[i - 1 - turned];
        if (a != b && b != corners[i] && a != corners[i]) appendFace({a, b, corners[i]}, soup);
    }
}

std::optional<Error> readElementContent(const Element& element, Numbers& numbers, PolygonSoup& soup) {
    std::uint64_t least = 0;
    for (const Property& property : element.properties)
        least += numbers.leastSize(property.count.value_or(property.type));
    if (least == 0) return std::nullopt;
    if (!numbers.canHold(element.count, least))
        return Error{"it was cut short: it announces " + std::to_string(element.count) + " of " +
                     quoteWord(element.name) + ", more than it can hold"};

    const bool isVertex = element.name == "vertex";
    const bool isFace = element.name == "face";
    const bool isStrip = element.name == "tristrips";
    std::array<std::size_t, 3> axes{};
    std::size_t corners = 0;
    if (isVertex) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::optional<std::size_t> found =
                findProperty(element, std::string_view("xyz").substr(axis, 1), false);
            if (!found) return Error{"its vertices have no x, y and z"};
            axes[axis] = *found;
        }
        soup.points.reserve(element.count);
    } else if (isFace || isStrip) {
        const std::optional<std::size_t> indices = findProperty(element, "vertex_indices", true);
        const std::optional<std::size_t> index = findProperty(element, "vertex_index", true);
        if (!indices && !index) return Error{"its faces have no list \"vertex_indices\""};
        corners = indices ? *indices : *index;
    }

    Entry entry(element);
    for (std::uint64_t i = 0; i < element.count; ++i) {
        if (const std::optional<std::string> problem = entry.read(numbers))
            return Error{describe(element, i) + " " + *problem};
        if (isVertex)
            soup.points.emplace_back(entry.value(axes[0]), entry.value(axes[1]), entry.value(axes[2]));
        if (isFace) appendFace(entry.list(corners), soup);
        if (isStrip) appendStrips(entry.list(corners), soup);
    }
    return std::nullopt;
}

}  // namespace

base::Result<PolygonSoup> parsePly(std::string_view bytes) {
    TextLines lines(bytes);
    const base::Result<Header> header = readHeader(lines);
    if (!header) return header.error();
    const auto isThere = [&](std::string_view name) {
        return std::any_of(header->elements.begin(), header->elements.end(),
                           [&](const Element& element) { return element.name == name && element.count > 0; });
    };
    if (!isThere("vertex")) return Error{"it has no vertices"};
    if (!isThere("face") && !isThere("tristrips")) return Error{"it has vertices but no faces"};

    PolygonSoup soup;
    Numbers numbers(header->encoding, lines.rest());
    for (const Element& element : header->elements)
        if (const std::optional<Error> error = readElementContent(element, numbers, soup)) return *error;
    for (std::size_t i = 0; i < soup.ends.size(); ++i)
        for (const int corner : soup.polygon(i))
            if (corner < 0 || static_cast<std::size_t>(corner) >= soup.points.size())
                return Error{"face " + std::to_string(i + 1) + " has a vertex that is not there"};
    return soup;
}

}  // namespace trapwright::geometry
