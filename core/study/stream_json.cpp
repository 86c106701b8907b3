#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/study/stream.h"
#include "core/study/target.h"

namespace trapwright::study {

namespace {

using Json = nlohmann::json;

/// What is written is no measurement.
struct Damaged {};

/// How a study has the counts of one stream, in this order.
constexpr std::array<int StreamCounts::*, 8> kCounts = {
    &StreamCounts::offered, &StreamCounts::entered, &StreamCounts::success,   &StreamCounts::wrong,
    &StreamCounts::fellOff, &StreamCounts::jams,    &StreamCounts::uncleared, &StreamCounts::returned};
/// What programs wrote that knew no returns.
constexpr std::size_t kCountsWithoutReturns = kCounts.size() - 1;

double readNumber(const Json& json) {
    const double number = json.get<double>();
    if (!std::isfinite(number) || number < 0.0) throw Damaged();
    return number;
}

int readCount(const Json& json) {
    const auto count = json.get<std::int64_t>();
    if (count < 0 || count > std::numeric_limits<int>::max()) throw Damaged();
    return static_cast<int>(count);
}

Json toJson(const StreamCounts& counts) {
    Json list = Json::array();
    for (const auto count : kCounts)
        list.push_back(counts.*count);
    return {{"counts", list}, {"jammed", counts.jammed}};
}

StreamCounts readCounts(const Json& json) {
    StreamCounts counts;
    const Json& list = json.at("counts");
    if (list.size() != kCounts.size() && list.size() != kCountsWithoutReturns) throw Damaged();
    for (std::size_t i = 0; i < list.size(); ++i)
        counts.*kCounts[i] = readCount(list.at(i));
    if (std::int64_t{counts.success} + counts.wrong + counts.returned + counts.fellOff >
        std::numeric_limits<int>::max())
        throw Damaged();
    counts.jammed = readNumber(json.at("jammed"));
    return counts;
}

StreamResult readResult(const Json& json) {
    StreamResult result;
    result.partsPerMinute = readNumber(json.at("partsPerMinute"));
    result.duration = readNumber(json.at("duration"));
    result.transit = readNumber(json.at("transit"));
    result.spacing = readNumber(json.at("spacing"));
    result.closest = readNumber(json.at("closest"));
    for (const Json& one : json.at("streams"))
        result.streams.push_back(readCounts(one));
    // What an interval is made of.
    if (result.streams.size() < 2 || !(result.duration > 0.0)) throw Damaged();
    return result;
}

}  // namespace

std::string streamsToJson(const Streams& streams) {
    Settings settings;
    settings.stream = streams.settings;
    const Json all = Json::parse(toJson(settings));
    Json results = Json::array();
    for (const StreamResult& result : streams.results) {
        Json list = Json::array();
        for (const StreamCounts& one : result.streams)
            list.push_back(toJson(one));
        results.push_back({{"partsPerMinute", result.partsPerMinute},
                           {"duration", result.duration},
                           {"transit", result.transit},
                           {"spacing", result.spacing},
                           {"closest", result.closest},
                           {"streams", list}});
    }
    return Json{
        {"goal", Json::parse(goalToJson(streams.goal))}, {"settings", all.at("stream")}, {"results", results}}
        .dump();
}

base::Result<Streams> streamsFromJson(const std::string& text) {
    const base::Error damaged{"These are no results of streams.", base::ErrorKind::damaged};
    try {
        const Json json = Json::parse(text);
        Streams streams;
        auto goal = goalFromJson(json.at("goal").dump());
        auto settings = settingsFromJson(Json{{"stream", json.at("settings")}}.dump(), {});
        if (!goal || !settings) return damaged;
        streams.goal = std::move(*goal);
        streams.settings = settings->stream;
        for (const Json& one : json.at("results"))
            streams.results.push_back(readResult(one));
        if (streams.results.empty()) return damaged;
        return streams;
    } catch (const Json::exception&) {
        return damaged;
    } catch (const Damaged&) {
        return damaged;
    }
}

}  // namespace trapwright::study
