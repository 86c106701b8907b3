#include "app/trapwright/json_records.h"

#include <nlohmann/json.hpp>

#include "core/stats/binomial.h"
#include "core/study/target.h"
#include "core/study/validation.h"

namespace trapwright::app {

namespace {

using Json = nlohmann::ordered_json;

Json rowToJson(const study::ValidationRow& row) {
    return {{"trials", row.tally.trials()},
            {"failures", row.tally.failures()},
            {"success", shareToJson(row.tally.success, row.tally.trials())},
            {"wrong_orientation", row.tally.wrongOrientation},
            {"stuck", row.tally.stuck},
            {"fell_off", row.tally.fellOff}};
}

Json scoreToJson(const study::EngineScore& score, int trials) {
    Json json = {{"engine", score.engine}};
    json.update(toJson(score.fitness));
    json.update({{"finished", score.finished}, {"oriented", shareToJson(score.oriented, trials)}});
    return json;
}

/// Null where success is not known.
Json successToJson(const std::optional<stats::Count>& success) {
    return success ? shareToJson(success->successes, success->trials) : Json();
}

}  // namespace

Json toJson(const base::Quaternion& rotation) {
    return Json::array({rotation.w(), rotation.x(), rotation.y(), rotation.z()});
}

Json toJson(const base::Vec3& vector, double scale) {
    return Json::array({vector.x() * scale, vector.y() * scale, vector.z() * scale});
}

Json goalToJson(const char* key, const trial::Goal& goal) {
    Json json = {{key, toJson(goal.shown())}};
    if (!goal.isOneOrientation()) json["wanted"] = Json::parse(study::goalToJson(goal));
    return json;
}

Json toJson(const objectives::Fitness& fitness) {
    Json json = {{"F", fitness.total}};
    for (const objectives::Score& score : fitness.scores)
        if (score.key != objectives::kSuccess) json[score.key] = score.value;
    return json;
}

Json toJson(const study::IndividualRecord& record) {
    Json json = toJson(record.fitness);
    json.update({{"overlaps", record.overlaps},
                 {"trials", record.trials},
                 {"finished", record.finished},
                 {"fell_off", record.fellOff},
                 {"stuck", record.stuck},
                 {"success", successToJson(record.success())}});
    return json;
}

Json toJson(const study::GenerationSummary& summary) {
    const study::GenerationStatistics& statistics = summary.statistics;
    Json json = {{"generation", summary.index},
                 {"winner", summary.winner},
                 {"success", successToJson(statistics.success)},
                 {"top_30_percent_success", statistics.topSuccess ? Json(*statistics.topSuccess) : Json()},
                 {"best", toJson(statistics.best)},
                 {"top_30_percent_mean", toJson(statistics.topMean)}};
    for (const search::NamedNumber& curve : statistics.curves)
        json[curve.key] = curve.value;
    json["seconds"] = summary.seconds;
    if (summary.mendedFrom)
        json["mended_from"] = {{"generation", summary.mendedFrom->generation},
                               {"individual", summary.mendedFrom->individual}};
    return json;
}

Json toJson(const std::vector<study::CheckRecord>& records) {
    Json list = Json::array();
    for (const study::CheckRecord& record : records) {
        const study::EngineScore& learning = record.learning;
        const study::EngineScore& reference = record.reference;
        Json difference = Json::object();
        for (const objectives::Score& score : reference.fitness.scores) {
            const objectives::Objective* objective = objectives::findObjective(score.key);
            const objectives::Score* own = objectives::findScore(learning.fitness, score.key);
            if (own != nullptr && objective != nullptr && objective->isNoisy &&
                score.key != objectives::kSuccess)
                difference[score.key] = score.value - own->value;
        }
        difference["success"] = static_cast<double>(reference.oriented - learning.oriented) / record.trials;
        list.push_back({{"generation", record.generation},
                        {"individual", record.individual},
                        {"trials", record.trials},
                        {"learning", scoreToJson(learning, record.trials)},
                        {"reference", scoreToJson(reference, record.trials)},
                        {"difference", difference}});
    }
    return list;
}

Json toJson(const study::SelectionRecord& record) {
    Json entries = Json::array();
    for (const study::SelectionEntry& entry : record.entries) {
        entries.push_back({{"generation", entry.generation},
                           {"individual", entry.individual},
                           {"fitness", toJson(entry.fitness)},
                           {"trials", entry.trials},
                           {"finished", entry.finished},
                           {"oriented", shareToJson(entry.oriented, entry.trials)}});
        if (entry.corners.trials > 0)
            entries.back()["corners"] = {
                {"trials", entry.corners.trials},
                {"oriented", shareToJson(entry.corners.successes, entry.corners.trials)}};
        entries.back().update(goalToJson("modal_orientation", entry.goal));
    }
    Json json = {{"engine", record.engine}, {"entries", entries}};
    if (record.box) json.update(Json::parse(study::boxToJson(*record.box)));
    return json;
}

Json toJson(std::span<const study::SlicedCondition> conditions) {
    Json json = Json::array();
    for (const study::SlicedCondition& sliced : conditions) {
        const trial::ConditionText& text =
            trial::conditionTexts()[static_cast<std::size_t>(sliced.condition)];
        Json slices = Json::array();
        for (const study::ConditionSlice& slice : sliced.slices)
            slices.push_back({{"low", text.shownAs * slice.low},
                              {"high", text.shownAs * slice.high},
                              {"trials", slice.tally.trials()},
                              {"success", shareToJson(slice.tally.success, slice.tally.trials())}});
        json.push_back({{"condition", text.key}, {"slices", std::move(slices)}});
    }
    return json;
}

Json toJson(const stats::WeightedRate& weighted, const char* bounds) {
    return {{"share", weighted.rate ? Json(*weighted.rate) : Json()},
            {"low", weighted.interval.low},
            {"high", weighted.interval.high},
            {"bounds", bounds}};
}

Json toJson(const study::ValidationRecord& record, const part::Part& part,
            std::span<const part::PoseGroup> groups) {
    const study::ValidationTable table = study::tabulate(record, groups);
    Json alike = Json::array();
    for (const study::ValidationGroup& group : table.groups) {
        Json json = {{"poses", numbersToJson(group.poses)}, {"weight", group.weight}};
        json.update(rowToJson(group.sum));
        alike.push_back(json);
    }
    Json rows = Json::array();
    for (const study::ValidationRow& row : record.rows) {
        Json json = {{"pose", row.pose + 1},
                     {"rotation", toJson(part.stablePoses[static_cast<std::size_t>(row.pose)].rotation)}};
        json.update(rowToJson(row));
        rows.push_back(json);
    }
    Json json = {
        {"generation", record.generation}, {"individual", record.individual}, {"engine", record.engine}};
    json.update(goalToJson("expected_orientation", record.goal));
    json.update({{"tolerance_deg", record.tolerance / base::kDegree},
                 {"groups", alike},
                 {"poses", rows},
                 {"weighted_success", toJson(table.weighted)},
                 {"correct", toJson(table.correct, "95 % Korn and Graubard")},
                 {"total", rowToJson(table.total)}});
    if (record.box) json.update(Json::parse(study::boxToJson(*record.box)));
    return json;
}

Json numbersToJson(std::span<const int> poses) {
    Json numbers = Json::array();
    for (const int pose : poses)
        numbers.push_back(pose + 1);
    return numbers;
}

Json shareToJson(int count, int trials) {
    const stats::Interval bounds = stats::calcClopperPearson(count, trials);
    return {{"count", count},
            {"share", trials > 0 ? Json(static_cast<double>(count) / trials) : Json()},
            {"low", bounds.low},
            {"high", bounds.high},
            {"bounds", "95 % Clopper-Pearson"}};
}

Json toJson(const trial::RemadeTrial& trial) {
    return {{"seed", trial.stream.seed},
            {"generation", trial.stream.generation},
            {"individual", trial.stream.individual},
            {"trial", trial.stream.trial},
            {"purpose", static_cast<int>(trial.stream.purpose)},
            {"engine", trial.engine},
            {"reason", trial.reason},
            {"stuck", trial.isStuck}};
}

}  // namespace trapwright::app
