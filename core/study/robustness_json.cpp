#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/study/robustness.h"
#include "core/study/target.h"

namespace trapwright::study {

namespace {

using Json = nlohmann::json;
using trial::Condition;

/// What is written is no measurement.
struct Damaged {};

std::string_view keyOf(Condition condition) {
    return trial::conditionTexts()[static_cast<std::size_t>(condition)].key;
}

Condition readCondition(const Json& json) {
    const auto key = json.get<std::string>();
    for (const trial::ConditionText& text : trial::conditionTexts())
        if (text.key == key) return text.condition;
    throw Damaged();
}

int readCount(const Json& json) {
    const auto count = json.get<std::int64_t>();
    if (count < 0 || count > std::numeric_limits<int>::max()) throw Damaged();
    return static_cast<int>(count);
}

Json toJson(const PlaceResult& result) {
    Json place;
    if (result.trials.place) {
        // By their keys: conditions may be added.
        for (const trial::ConditionText& text : trial::conditionTexts())
            place[text.key] = (*result.trials.place)[static_cast<std::size_t>(text.condition)];
    }
    const trial::Tally& tally = result.tally;
    return {{"place", place},
            {"first", result.trials.first},
            {"counts", {tally.success, tally.wrongOrientation, tally.stuck, tally.fellOff}},
            {"speed", result.speed}};
}

PlaceResult readResult(const Json& json) {
    PlaceResult result;
    if (const Json& place = json.at("place"); !place.is_null()) {
        result.trials.place = trial::kMiddle;
        for (const auto& [key, share] : place.items()) {
            const double at = share.get<double>();
            if (!(at >= 0.0 && at <= 1.0)) throw Damaged();
            (*result.trials.place)[static_cast<std::size_t>(readCondition(key))] = at;
        }
    }
    const Json& counts = json.at("counts");
    if (counts.size() != 4) throw Damaged();
    result.tally = {readCount(counts.at(0)), readCount(counts.at(1)), readCount(counts.at(2)),
                    readCount(counts.at(3))};
    const trial::Tally& tally = result.tally;
    const std::int64_t trials =
        std::int64_t{tally.success} + tally.wrongOrientation + tally.stuck + tally.fellOff;
    if (trials < 1 || trials > std::numeric_limits<int>::max()) throw Damaged();
    result.trials.first = readCount(json.at("first"));
    result.trials.count = static_cast<int>(trials);
    result.speed = json.at("speed").get<double>();
    return result;
}

Json toJson(std::span<const PlaceResult> results) {
    Json list = Json::array();
    for (const PlaceResult& result : results)
        list.push_back(toJson(result));
    return list;
}

std::vector<PlaceResult> readResults(const Json& json) {
    std::vector<PlaceResult> results;
    for (const Json& one : json) {
        results.push_back(readResult(one));
        if (!results.back().trials.place) throw Damaged();
    }
    if (results.empty()) throw Damaged();
    return results;
}

Robustness readRobustness(const Json& json) {
    Robustness robustness;
    auto goal = goalFromJson(json.at("goal").dump());
    if (!goal) throw Damaged();
    robustness.goal = std::move(*goal);
    robustness.nominal = readResult(json.at("as_set"));
    robustness.overBox = readResult(json.at("over_box"));
    for (const Json& sweep : json.at("sweeps"))
        robustness.sweeps.push_back({readCondition(sweep.at("condition")), readResults(sweep.at("points"))});
    robustness.corners = readResults(json.at("corners"));
    if (!robustness.nominal.trials.place || robustness.sweeps.empty()) throw Damaged();
    if (!json.contains("worst_pair")) return robustness;
    const Json& pair = json.at("worst_pair");
    PairMap map{readCondition(pair.at("across")), readCondition(pair.at("up")), readCount(pair.at("points")),
                readResults(pair.at("places"))};
    if (map.places.size() != static_cast<std::size_t>(map.points) * static_cast<std::size_t>(map.points))
        throw Damaged();
    robustness.worstPair = std::move(map);
    return robustness;
}

}  // namespace

std::string robustnessToJson(const Robustness& robustness) {
    Json sweeps = Json::array();
    for (const ConditionSweep& sweep : robustness.sweeps)
        sweeps.push_back({{"condition", keyOf(sweep.condition)}, {"points", toJson(sweep.points)}});
    Json json = {{"goal", Json::parse(goalToJson(robustness.goal))},
                 {"as_set", toJson(robustness.nominal)},
                 {"over_box", toJson(robustness.overBox)},
                 {"sweeps", sweeps},
                 {"corners", toJson(robustness.corners)}};
    if (const auto& pair = robustness.worstPair)
        json["worst_pair"] = {{"across", keyOf(pair->across)},
                              {"up", keyOf(pair->up)},
                              {"points", pair->points},
                              {"places", toJson(pair->places)}};
    return json.dump();
}

base::Result<Robustness> robustnessFromJson(const std::string& text) {
    const base::Error damaged{"It is no measurement of robustness."};
    try {
        return readRobustness(Json::parse(text));
    } catch (const Json::exception&) {
        return damaged;
    } catch (const Damaged&) {
        return damaged;
    }
}

}  // namespace trapwright::study
