#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"

/// Reading of JSON objects that remembers the first thing that is wrong, so that who reads has no branches.
namespace trapwright::base {

using Json = nlohmann::ordered_json;

/// The first problem of a file: where it is, what it is, and what must stand there.
struct JsonProblem {
    std::string text;

    void tell(const std::string& where, const std::string& what) {
        if (text.empty()) text = fmt::format("at \"{}\": {}", where, what);
    }
};

/// One object of the file. close() complains about keys that nobody asked for.
class JsonObject {
 public:
    JsonObject(const Json& json, std::string path, JsonProblem& problem);

    void text(const char* key, std::string& value, bool needed = false);
    void texts(const char* key, std::vector<std::string>& values);
    void flag(const char* key, bool& value);
    /// A number within [low, high]; `scale` turns the file's unit into ours.
    void number(const char* key, double& value, double low, double high, double scale = 1.0);
    void number(const char* key, std::optional<double>& value, double low, double high, double scale = 1.0);
    /// A whole number, or one in quotes as "0x1000".
    void whole(const char* key, unsigned& value, unsigned low, unsigned high);
    void whole(const char* key, int& value, int low, int high);
    template <class Value, std::size_t N>
    void choice(const char* key, Value& value,
                const std::array<std::pair<Value, std::string_view>, N>& choices, bool needed = false);

    [[nodiscard]] bool has(const char* key) const { return json_.contains(key); }
    /// The value under the key, for who reads it by himself; nothing where there is none.
    const Json* take(const char* key);
    [[nodiscard]] std::string pathOf(const std::string& key) const {
        return path_.empty() ? key : path_ + "." + key;
    }
    [[nodiscard]] JsonProblem& problem() const { return problem_; }
    [[nodiscard]] const Json& json() const { return json_; }
    void fail(const char* key, const std::string& what) { problem_.tell(pathOf(key), what); }
    /// Puts what is missing into the problem.
    void need(const char* key);
    void close();

 private:
    const Json& json_;
    std::string path_;
    JsonProblem& problem_;
    std::set<std::string> known_;
};

/// Reads a whole text. Comments are allowed. Error: which line is not JSON; a number that no double holds, as
/// 1e999; what is nested deeper than any file of ours; a text of more than 64 MiB.
Result<Json> parseJson(std::string_view text);

/// A whole number, or a text such as "0x1000".
std::optional<unsigned> toWhole(const Json& json);

template <class Value, std::size_t N>
void JsonObject::choice(const char* key, Value& value,
                        const std::array<std::pair<Value, std::string_view>, N>& choices, bool needed) {
    const Json* json = take(key);
    if (json == nullptr) {
        if (needed) need(key);
        return;
    }
    std::string names;
    for (const auto& [choice, name] : choices) {
        if (json->is_string() && json->get<std::string>() == name) {
            value = choice;
            return;
        }
        names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name);
    }
    fail(key, fmt::format("{} is none of the values that there are: {}", json->dump(), names));
}

}  // namespace trapwright::base
