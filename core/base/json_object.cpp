#include "core/base/json_object.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace trapwright::base {

JsonObject::JsonObject(const Json& json, std::string path, JsonProblem& problem)
    : json_(json), path_(std::move(path)), problem_(problem) {
    if (!json.is_object()) problem.tell(path_, "this is no object; write { ... }");
}

const Json* JsonObject::take(const char* key) {
    known_.insert(key);
    if (!json_.is_object()) return nullptr;
    const auto it = json_.find(key);
    return it == json_.end() ? nullptr : &*it;
}

void JsonObject::need(const char* key) {
    fail(key, "this is missing; add it");
}

void JsonObject::text(const char* key, std::string& value, bool needed) {
    const Json* json = take(key);
    if (json == nullptr) {
        if (needed) need(key);
    } else if (!json->is_string() || (needed && json->get<std::string>().empty())) {
        fail(key, fmt::format("{} is no text in quotes", json->dump()));
    } else {
        value = json->get<std::string>();
    }
}

void JsonObject::texts(const char* key, std::vector<std::string>& values) {
    const Json* json = take(key);
    if (json == nullptr) return;
    bool good = json->is_array();
    if (good) {
        for (const Json& item : *json)
            good = good && item.is_string();
    }
    if (!good) return fail(key, "this is no list of texts; write [\"...\", \"...\"]");
    values = json->get<std::vector<std::string>>();
}

void JsonObject::flag(const char* key, bool& value) {
    const Json* json = take(key);
    if (json == nullptr) return;
    if (!json->is_boolean()) return fail(key, fmt::format("{} is neither true nor false", json->dump()));
    value = json->get<bool>();
}

void JsonObject::number(const char* key, double& value, double low, double high, double scale) {
    const Json* json = take(key);
    if (json == nullptr) return;
    if (!json->is_number()) return fail(key, fmt::format("{} is no number", json->dump()));
    const double read = json->get<double>();
    if (!(read >= low && read <= high)) {
        return fail(key, fmt::format("{} is not within {} and {}", read, low, high));
    }
    value = read * scale;
}

void JsonObject::number(const char* key, std::optional<double>& value, double low, double high,
                        double scale) {
    if (take(key) == nullptr) return;
    double read = 0.0;
    number(key, read, low, high, scale);
    value = read;
}

void JsonObject::whole(const char* key, unsigned& value, unsigned low, unsigned high) {
    const Json* json = take(key);
    if (json == nullptr) return;
    const auto read = toWhole(*json);
    if (!read || *read < low || *read > high) {
        return fail(key, fmt::format("{} is no whole number within {} and {}; hexadecimal ones stand in "
                                     "quotes, as \"0x1000\"",
                                     json->dump(), low, high));
    }
    value = *read;
}

void JsonObject::whole(const char* key, int& value, int low, int high) {
    auto read = static_cast<unsigned>(value);
    whole(key, read, static_cast<unsigned>(low), static_cast<unsigned>(high));
    value = static_cast<int>(read);
}

void JsonObject::close() {
    if (!json_.is_object()) return;
    for (const auto& [key, value] : json_.items()) {
        if (known_.contains(key)) continue;
        std::string names;
        for (const std::string& name : known_)
            names += (names.empty() ? "" : ", ") + name;
        return problem_.tell(pathOf(key), "nobody knows this key; there are: " + names);
    }
}

Result<Json> parseJson(std::string_view text) {
    constexpr std::size_t kMostBytes = 64ULL << 20U;
    constexpr int kDeepest = 32;
    if (text.size() > kMostBytes) return Error{"the text is longer than 64 MiB, which no such file is"};
    // What is nested too deeply is dropped as it is read, and so is never a tree that something would walk.
    bool tooDeep = false;
    const Json::parser_callback_t keep = [&](int depth, Json::parse_event_t, Json&) {
        tooDeep = tooDeep || depth > kDeepest;
        return !tooDeep;
    };
    try {
        Json json = Json::parse(text, keep, true, true);
        if (tooDeep) return Error{fmt::format("something is nested more than {} levels deep", kDeepest)};
        return json;
    } catch (const Json::parse_error& error) {
        const std::string_view before = text.substr(0, error.byte);
        return Error{fmt::format(
            "the text is not JSON: line {} is not what must stand there. Look for a comma, a quote or a "
            "bracket in it or before it",
            1 + std::count(before.begin(), before.end(), '\n'))};
    } catch (const Json::exception& error) {
        // "[json.exception.out_of_range.406] number overflow parsing '1e999'"
        const std::string_view reason = error.what();
        return Error{fmt::format("the text cannot be used: {}", reason.substr(reason.find("] ") + 2))};
    }
}

std::optional<unsigned> toWhole(const Json& json) {
    if (json.is_number_unsigned()) {
        const auto read = json.get<std::uint64_t>();
        if (read > std::numeric_limits<unsigned>::max()) return std::nullopt;
        return static_cast<unsigned>(read);
    }
    if (!json.is_string()) return std::nullopt;
    const auto text = json.get<std::string>();
    if (!text.starts_with("0x")) return std::nullopt;
    unsigned value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + 2, end, value, 16);
    if (error != std::errc() || stop != end) return std::nullopt;
    return value;
}

}  // namespace trapwright::base
