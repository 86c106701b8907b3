#include "core/track/track_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/base/json_object.h"
#include "core/track/track_builder.h"

namespace trapwright::track {

namespace {

using Json = nlohmann::ordered_json;
using base::kMillimetre;

constexpr const char* kFormat = "trapwright track";
constexpr int kVersion = 1;

// Millimetres with as many digits as a double carries, without the dust of the change of unit.
double toMillimetres(double length) {
    return std::round(length / kMillimetre * 1e12) / 1e12;
}

// Likewise degrees.
double toDegrees(double angle) {
    return std::round(angle / base::kDegree * 1e12) / 1e12;
}

Json feederToJson(const FeederShape& shape) {
    Json feeder = {{"type", "linear"}};
    if (shape.type == FeederType::bowl) {
        feeder = {{"type", "bowl"},
                  {"radius", toMillimetres(shape.bowlRadius)},
                  {"conveying", shape.conveying == Conveying::clockwise ? "clockwise" : "anticlockwise"}};
    }
    if (shape.slope != 0.0) feeder["slope_deg"] = toDegrees(shape.slope);
    return feeder;
}

// Reads values out of JSON and keeps the first thing that is wrong, so that the reading code has no branches.
class Reader {
 public:
    explicit Reader(const Json& object) : object_(object) {
        if (!object.is_object()) fail("the text is not a JSON object");
    }

    double number(const Json& object, const std::string& key) {
        const Json* value = find(object, key);
        if (value == nullptr) return 0.0;
        if (!value->is_number() || !std::isfinite(value->get<double>())) {
            fail(fmt::format("\"{}\" is not a number", key));
            return 0.0;
        }
        return value->get<double>();
    }

    double numberOr(const Json& object, const std::string& key, double missing) {
        return object.is_object() && object.contains(key) ? number(object, key) : missing;
    }

    std::string text(const Json& object, const std::string& key) {
        const Json* value = find(object, key);
        if (value == nullptr) return {};
        if (!value->is_string()) {
            fail(fmt::format("\"{}\" is not a text", key));
            return {};
        }
        return value->get<std::string>();
    }

    // An array of `size` numbers; of any number of them if size is 0.
    std::vector<double> numbers(const Json& value, const std::string& name, std::size_t size) {
        const bool good =
            value.is_array() && (size == 0 || value.size() == size) &&
            std::all_of(value.begin(), value.end(), [](const Json& v) { return v.is_number(); });
        if (!good) {
            fail(fmt::format("{} is not a list of {} numbers", name, size));
            return std::vector<double>(size, 0.0);
        }
        return value.get<std::vector<double>>();
    }

    const Json* find(const Json& object, const std::string& key) {
        const auto it = object.is_object() ? object.find(key) : object.end();
        if (!object.is_object() || it == object.end()) {
            fail(fmt::format("\"{}\" is missing", key));
            return nullptr;
        }
        return &*it;
    }

    const Json* findList(const Json& object, const std::string& key) {
        const Json* value = find(object, key);
        if (value != nullptr && !value->is_array()) {
            fail(fmt::format("\"{}\" is not a list", key));
            return nullptr;
        }
        return value;
    }

    void fail(const std::string& what) {
        if (problem_.empty()) problem_ = what;
    }
    [[nodiscard]] const std::string& problem() const { return problem_; }
    [[nodiscard]] const Json& object() const { return object_; }

 private:
    const Json& object_;
    std::string problem_;
};

FeederShape readFeeder(Reader& reader) {
    FeederShape shape;
    const Json* feeder = reader.find(reader.object(), "feeder");
    if (feeder == nullptr) return shape;
    shape.slope = reader.numberOr(*feeder, "slope_deg", 0.0) * base::kDegree;
    const std::string type = reader.text(*feeder, "type");
    if (type == "linear") return shape;
    if (type != "bowl")
        reader.fail(fmt::format("the feeder's type is \"{}\", not \"linear\" or \"bowl\"", type));
    shape.type = FeederType::bowl;
    shape.bowlRadius = reader.number(*feeder, "radius") * kMillimetre;
    const std::string conveying = reader.text(*feeder, "conveying");
    if (conveying == "anticlockwise") {
        shape.conveying = Conveying::anticlockwise;
    } else if (conveying != "clockwise") {
        reader.fail(
            fmt::format("\"conveying\" is \"{}\", not \"clockwise\" or \"anticlockwise\"", conveying));
    }
    return shape;
}

std::vector<CrossSection> readSections(Reader& reader) {
    std::vector<CrossSection> sections;
    const Json* list = reader.findList(reader.object(), "sections");
    if (list == nullptr) return sections;
    for (const Json& item : *list) {
        const std::string name = fmt::format("section {}", sections.size() + 1);
        CrossSection section{reader.number(item, "x") * kMillimetre, {}};
        const Json* points = reader.findList(item, "points");
        if (points == nullptr) break;
        for (const Json& point : *points) {
            const auto values =
                reader.numbers(point, fmt::format("point {} of {}", section.points.size() + 1, name), 2);
            section.points.emplace_back(values[0] * kMillimetre, values[1] * kMillimetre);
        }
        if (section.points.size() < 2) reader.fail(name + " has fewer than 2 points");
        if (!sections.empty() && section.points.size() != sections.front().points.size()) {
            reader.fail(name + " has not as many points as the first one");
        }
        if (!sections.empty() && !(section.x > sections.back().x)) {
            reader.fail(name + " is not beyond the one before it");
        }
        sections.push_back(std::move(section));
    }
    if (sections.size() < 2) reader.fail("\"sections\" has fewer than 2 sections");
    return sections;
}

// Everything but the solid.
TrackFile readValues(Reader& reader) {
    TrackFile file;
    Track& track = file.track;
    const Json& object = reader.object();
    if (reader.text(object, "format") != kFormat)
        reader.fail(fmt::format("\"format\" is not \"{}\"", kFormat));
    if (reader.number(object, "version") != kVersion) {
        reader.fail(fmt::format("the version is not {}, the only one that this program knows", kVersion));
    }
    if (reader.text(object, "unit") != "mm") reader.fail("\"unit\" is not \"mm\"");
    file.about = reader.text(object, "about");
    track.shape = readFeeder(reader);
    track.width = reader.number(object, "width") * kMillimetre;
    track.height = reader.number(object, "height") * kMillimetre;
    track.baseThickness = reader.number(object, "baseThickness") * kMillimetre;
    // Of tracks from before there were walls neither is told.
    track.walls = {reader.numberOr(object, "innerWall", 0.0) * kMillimetre,
                   reader.numberOr(object, "outerWall", 0.0) * kMillimetre};
    track.start = reader.number(object, "start") * kMillimetre;
    track.finish = reader.number(object, "finish") * kMillimetre;
    track.sections = readSections(reader);
    if (object.is_object() && object.contains("expectedOrientation")) {
        const auto q = reader.numbers(object["expectedOrientation"], "\"expectedOrientation\"", 4);
        const base::Quaternion rotation(q[0], q[1], q[2], q[3]);
        if (!(rotation.norm() > 0.5)) reader.fail("\"expectedOrientation\" is not a rotation (w, x, y, z)");
        file.expectedOrientation = rotation.normalized();
    }
    const double begin = reader.number(object, "begin") * kMillimetre;
    const double leadOut = reader.number(object, "leadOutSegments");
    if (!reader.problem().empty()) return file;

    if (!(begin < track.sections.front().x)) reader.fail("\"begin\" is not before the first section");
    const double trapSections = static_cast<double>(track.sections.size()) - 1.0 - leadOut;
    if (!(leadOut >= 0.0 && trapSections >= 1.0 && std::floor(leadOut) == leadOut)) {
        reader.fail("\"leadOutSegments\" leaves no section to the trap");
    }
    track.sections.insert(track.sections.begin(), CrossSection{begin, track.sections.front().points});
    track.firstTrapSection = 1;
    track.lastTrapSection = 1 + static_cast<int>(trapSections);
    if (!(track.start > begin && track.start < track.finish && track.finish <= track.end())) {
        reader.fail("\"start\" and \"finish\" do not lie on the track in this order");
    }
    if (!(track.baseThickness > 0.0)) reader.fail("\"baseThickness\" is not greater than 0");
    if (!(track.width > 0.0)) reader.fail("\"width\" is not greater than 0");
    if (!(track.height > 0.0)) reader.fail("\"height\" is not greater than 0");
    const auto fits = checkShape(track.shape, track.end() - begin, widthWithWalls(track.width, track.walls));
    if (!fits) reader.fail(fits.error().message);
    if (const auto walls = checkWalls(track.walls); !walls) reader.fail(walls.error().message);
    return file;
}

}  // namespace

std::string trackToJson(const TrackFile& file) {
    const Track& track = file.track;
    Json object = {{"format", kFormat},
                   {"version", kVersion},
                   {"unit", "mm"},
                   {"about", file.about},
                   {"feeder", feederToJson(track.shape)},
                   {"width", toMillimetres(track.width)},
                   {"height", toMillimetres(track.height)},
                   {"baseThickness", toMillimetres(track.baseThickness)},
                   {"begin", toMillimetres(track.begin())},
                   {"start", toMillimetres(track.start)},
                   {"finish", toMillimetres(track.finish)},
                   {"leadOutSegments", static_cast<int>(track.sections.size()) - 1 - track.lastTrapSection}};
    if (file.expectedOrientation) {
        const base::Quaternion& q = *file.expectedOrientation;
        object["expectedOrientation"] = std::array{q.w(), q.x(), q.y(), q.z()};
    }
    if (track.walls.inner > 0.0) object["innerWall"] = toMillimetres(track.walls.inner);
    if (track.walls.outer > 0.0) object["outerWall"] = toMillimetres(track.walls.outer);
    Json& sections = object["sections"] = Json::array();
    for (std::size_t i = 1; i < track.sections.size(); ++i) {
        Json points = Json::array();
        for (const base::Vec2& point : track.sections[i].points) {
            points.push_back(std::array{toMillimetres(point.x()), toMillimetres(point.y())});
        }
        sections.push_back({{"x", toMillimetres(track.sections[i].x)}, {"points", std::move(points)}});
    }
    return object.dump(1) + "\n";
}

base::Result<TrackFile> trackFromJson(const std::string& text) {
    const auto object = base::parseJson(text);
    if (!object) return base::Error{fmt::format("The track cannot be read: {}.", object.error().message)};
    Reader reader(*object);
    TrackFile file = readValues(reader);
    if (!reader.problem().empty())
        return base::Error{fmt::format("The track cannot be read: {}.", reader.problem())};

    addSolid(file.track);
    return file;
}

base::Result<TrackFile> readTrackFile(const std::filesystem::path& path) {
    const auto text = base::readFile(path);
    if (!text) return text.error();
    auto file = trackFromJson(*text);
    if (!file) return base::Error{fmt::format("{}: {}", path.string(), file.error().message)};
    return file;
}

base::Status writeTrackFile(const std::filesystem::path& path, const TrackFile& file) {
    return base::writeFile(path, trackToJson(file));
}

}  // namespace trapwright::track
