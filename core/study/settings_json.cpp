#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/spelling.h"
#include "core/study/settings.h"
#include "core/study/settings_fields.h"

namespace trapwright::study {

namespace {

/// A value of a JSON text that is no object and no array.
struct JsonLeaf {
    enum class Kind { null, boolean, integer, real, text };
    Kind kind = Kind::null;
    std::string text;  // numbers as they were written, digit for digit; "true" or "false"; the string

    [[nodiscard]] bool isNumber() const { return kind == Kind::integer || kind == Kind::real; }
};

/// The leaves of a JSON object by path: "track.feeder", "list[2]". Numbers keep all their digits, which a
/// parsed double would not. An error says where the text is no JSON, or which key is there twice.
base::Result<std::map<std::string, JsonLeaf>> readJsonLeaves(const std::string& text);

/// The text as a JSON string, quoted. Bytes that are not UTF-8 become the replacement character.
std::string quoteJson(const std::string& text);

/// Writes fields as nested objects; a dot in a key goes one level down.
class SettingsWriter {
 public:
    void text(std::string_view key, const std::string& value) { put(key, quoteJson(value)); }
    void number(const NumberField& field, double value) {
        // JSON has no infinity and no NaN; null is refused on reading, and findProblems before that.
        put(field.key, std::isfinite(value) ? fileText(value, field.unit) : "null");
    }
    void count(const CountField& field, int value) { put(field.key, std::to_string(value)); }
    void seed(std::string_view key, std::uint64_t value) { put(key, std::to_string(value)); }
    void flag(std::string_view key, bool value) { put(key, value ? "true" : "false"); }
    template <class Enum, std::size_t N>
    void choice(std::string_view key, Enum value, const Choices<Enum, N>& choices) {
        for (const auto& [name, choice] : choices) {
            if (choice == value) put(key, quoteJson(std::string(name)));
        }
    }
    void rotation(std::string_view key, const std::optional<base::Quaternion>& value) {
        if (!value) return put(key, "null");
        std::string list;
        for (const double x : {value->w(), value->x(), value->y(), value->z()}) {
            list += (list.empty() ? "[" : ", ") + fileText(x, FileUnit::none);
        }
        put(key, list + "]");
    }

    std::string finish() {
        goTo({});
        return "{" + text_ + "\n}\n";
    }

 private:
    void put(std::string_view key, const std::string& value) {
        std::vector<std::string> levels;
        std::size_t dot = key.find('.');
        for (; dot != std::string_view::npos; dot = key.find('.')) {
            levels.emplace_back(key.substr(0, dot));
            key.remove_prefix(dot + 1);
        }
        goTo(levels);
        beginEntry(std::string(key));
        text_ += value;
    }

    /// Closes and opens objects until we are in the object of these names.
    void goTo(const std::vector<std::string>& levels) {
        std::size_t common = 0;
        while (common < levels.size() && common < open_.size() && levels[common] == open_[common])
            ++common;
        while (open_.size() > common) {
            open_.pop_back();
            text_ += "\n" + indent() + "}";
            first_ = false;
        }
        for (; common < levels.size(); ++common) {
            beginEntry(levels[common]);
            text_ += "{";
            open_.push_back(levels[common]);
            first_ = true;
        }
    }

    void beginEntry(const std::string& key) {
        text_ += (first_ ? "\n" : ",\n") + indent() + quoteJson(key) + ": ";
        first_ = false;
    }

    [[nodiscard]] std::string indent() const { return std::string(2 * (open_.size() + 1), ' '); }

    std::string text_;
    std::vector<std::string> open_;
    bool first_ = true;
};

/// Collects the keys and what can be chosen.
class KeyCollector {
 public:
    void text(std::string_view key, const std::string&) { add(key); }
    void number(const NumberField& field, double) { add(field.key); }
    void count(const CountField& field, int) { add(field.key); }
    void seed(std::string_view key, std::uint64_t) { add(key); }
    void flag(std::string_view key, bool) { add(key, {"true", "false"}); }
    template <class Enum, std::size_t N>
    void choice(std::string_view key, Enum, const Choices<Enum, N>& choices) {
        std::vector<std::string> names;
        names.reserve(N);
        for (const auto& [name, value] : choices)
            names.emplace_back(name);
        add(key, std::move(names));
    }
    void rotation(std::string_view key, const std::optional<base::Quaternion>&) { add(key); }

    std::vector<SettingKey> finish() { return std::move(keys_); }

 private:
    void add(std::string_view key, std::vector<std::string> values = {}) {
        keys_.push_back({std::string(key), std::move(values)});
    }

    std::vector<SettingKey> keys_;
};

/// Fills the fields whose keys are there; keeps the first thing that is wrong.
class SettingsReader {
 public:
    explicit SettingsReader(std::map<std::string, JsonLeaf> leaves) : leaves_(std::move(leaves)) {}

    void text(std::string_view key, std::string& value) {
        const auto leaf = take(key);
        if (!leaf) return;
        if (leaf->kind != JsonLeaf::Kind::text) return refuse(key, *leaf, "a text in quotes");
        value = leaf->text;
    }
    void number(const NumberField& field, double& value) {
        const auto leaf = take(field.key);
        if (!leaf) return;
        const auto read = leaf->isNumber() ? siValue(leaf->text, field.unit) : std::nullopt;
        if (!read) return refuse(field.key, *leaf, "a number");
        value = *read;
    }
    void count(const CountField& field, int& value) { whole(field.key, value); }
    void seed(std::string_view key, std::uint64_t& value) { whole(key, value); }
    void flag(std::string_view key, bool& value) {
        const auto leaf = take(key);
        if (!leaf) return;
        if (leaf->kind != JsonLeaf::Kind::boolean) return refuse(key, *leaf, "true or false");
        value = leaf->text == "true";
    }
    template <class Enum, std::size_t N>
    void choice(std::string_view key, Enum& value, const Choices<Enum, N>& choices) {
        const auto leaf = take(key);
        if (!leaf) return;
        std::string names;
        for (const auto& [name, choice] : choices) {
            if (leaf->kind == JsonLeaf::Kind::text && leaf->text == name) {
                value = choice;
                return;
            }
            names += (names.empty() ? "\"" : " or \"") + std::string(name) + "\"";
        }
        refuse(key, *leaf, names);
    }
    void rotation(std::string_view key, std::optional<base::Quaternion>& value) {
        if (const auto leaf = take(key)) {
            if (leaf->kind != JsonLeaf::Kind::null)
                return refuse(key, *leaf, "null or four numbers [w, x, y, z]");
            value.reset();
            return;
        }
        std::array<double, 4> parts{};
        std::size_t found = 0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const auto leaf = take(std::string(key) + "[" + std::to_string(i) + "]");
            const auto read = leaf && leaf->isNumber() ? siValue(leaf->text, FileUnit::none) : std::nullopt;
            if (leaf && !read) return refuse(key, *leaf, "null or four numbers [w, x, y, z]");
            if (!read) break;
            parts[i] = *read;
            ++found;
        }
        if (found == 0) return;
        if (found < parts.size())
            return fail("\"" + std::string(key) + "\" must be null or four numbers [w, x, y, z]");
        value = rotationOf(parts);
    }

    /// What was wrong, if anything.
    [[nodiscard]] std::string problem() const {
        if (!problem_.empty() || leaves_.empty()) return problem_;
        const std::string& unknown = leaves_.begin()->first;
        std::vector<std::string> names;
        for (SettingKey& known : listSettingKeys())
            names.push_back(std::move(known.key));
        return "\"" + unknown + "\" is not a setting; check its spelling, its unit and its place. " +
               base::suggestName(unknown, names);
    }

 private:
    std::optional<JsonLeaf> take(std::string_view key) {
        const auto found = leaves_.find(std::string(key));
        if (found == leaves_.end()) return std::nullopt;
        JsonLeaf leaf = std::move(found->second);
        leaves_.erase(found);
        return leaf;
    }

    template <class Integer>
    void whole(std::string_view key, Integer& value) {
        const auto leaf = take(key);
        if (!leaf) return;
        Integer read{};
        const char* end = leaf->text.data() + leaf->text.size();
        const auto [stop, error] = std::from_chars(leaf->text.data(), end, read);
        if (leaf->kind != JsonLeaf::Kind::integer || error != std::errc() || stop != end) {
            return refuse(key, *leaf,
                          "a whole number from " + std::to_string(std::numeric_limits<Integer>::min()) +
                              " to " + std::to_string(std::numeric_limits<Integer>::max()));
        }
        value = read;
    }

    void refuse(std::string_view key, const JsonLeaf& leaf, const std::string& expected) {
        const std::string shown = leaf.kind == JsonLeaf::Kind::text ? quoteJson(leaf.text) : leaf.text;
        fail("\"" + std::string(key) + "\" is " + shown + "; it must be " + expected);
    }

    void fail(const std::string& problem) {
        if (problem_.empty()) problem_ = problem;
    }

    std::map<std::string, JsonLeaf> leaves_;
    std::string problem_;
};

using Kind = JsonLeaf::Kind;

/// Collects leaves while nlohmann-json reads.
class LeafCollector : public nlohmann::json_sax<nlohmann::json> {
 public:
    std::map<std::string, JsonLeaf> leaves;
    std::string failure;

    bool null() override { return add(Kind::null, "null"); }
    bool boolean(bool value) override { return add(Kind::boolean, value ? "true" : "false"); }
    bool number_integer(number_integer_t value) override { return add(Kind::integer, std::to_string(value)); }
    bool number_unsigned(number_unsigned_t value) override {
        return add(Kind::integer, std::to_string(value));
    }
    bool number_float(number_float_t /*value*/, const string_t& raw) override { return add(Kind::real, raw); }
    bool string(string_t& value) override { return add(Kind::text, value); }
    bool binary(binary_t& /*value*/) override { return false; }  // not in a JSON text

    bool start_object(std::size_t /*elements*/) override { return open(false); }
    bool end_object() override { return close(); }
    bool start_array(std::size_t /*elements*/) override { return open(true); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        const std::string& parent = stack_.back().path;
        next_ = parent.empty() ? name : parent + "." + name;
        if (seen_.insert(next_).second) return true;
        failure = "the key \"" + next_ + "\" is there twice";
        return false;
    }

    bool parse_error(std::size_t position, const std::string& lastToken,
                     const nlohmann::detail::exception& /*error*/) override {
        failure = "the text is not JSON at character " + std::to_string(position) +
                  (lastToken.empty() ? "" : ", near \"" + lastToken + "\"");
        return false;
    }

 private:
    struct Level {
        std::string path;
        bool array = false;
        int index = 0;
    };

    /// The path of the value that comes now.
    std::string place() {
        if (stack_.empty() || !stack_.back().array) return next_;
        Level& level = stack_.back();
        return level.path + "[" + std::to_string(level.index++) + "]";
    }

    bool add(Kind kind, std::string text) {
        const std::string path = place();
        if (stack_.empty()) return refuseTop();
        leaves[path] = {kind, std::move(text)};
        return true;
    }

    bool open(bool array) {
        if (stack_.empty() && array) return refuseTop();
        constexpr std::size_t kDeepest = 32;
        if (stack_.size() == kDeepest) {
            failure = "\"" + place() + "\" is nested too deeply";
            return false;
        }
        stack_.push_back({place(), array, 0});
        return true;
    }

    bool close() {
        stack_.pop_back();
        return true;
    }

    bool refuseTop() {
        failure = "the text is not a JSON object; it must begin with { and end with }";
        return false;
    }

    std::vector<Level> stack_;
    std::set<std::string> seen_;
    std::string next_;
};

base::Result<std::map<std::string, JsonLeaf>> readJsonLeaves(const std::string& text) {
    constexpr std::size_t kMostBytes = 1ULL << 20U;
    if (text.size() > kMostBytes) return base::Error{"the text is longer than 1 MiB, which no settings are"};
    LeafCollector collector;
    if (!nlohmann::json::sax_parse(text, &collector)) return base::Error{collector.failure};
    return std::move(collector.leaves);
}

std::string quoteJson(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::string toJson(const Settings& settings) {
    SettingsWriter writer;
    visitFields(writer, settings);
    return writer.finish();
}

base::Result<Settings> settingsFromJson(const std::string& text, const Settings& base) {
    auto leaves = readJsonLeaves(text);
    if (!leaves) return base::Error{"The settings cannot be read: " + leaves.error().message + "."};
    Settings settings = base;
    SettingsReader reader(std::move(leaves).value());
    visitFields(reader, settings);
    std::string problem = reader.problem();
    if (problem.empty()) return settings;
    if (problem.back() != '.' && problem.back() != '?') problem += '.';
    return base::Error{"The settings cannot be read: " + problem};
}

std::string boxToJson(const trial::OperatingBox& box) {
    Settings settings;
    settings.box = box;
    const nlohmann::json all = nlohmann::json::parse(toJson(settings));
    return nlohmann::json{{"box", all["box"]}}.dump();
}

base::Result<trial::OperatingBox> boxFromJson(const std::string& text) {
    const auto settings = settingsFromJson(text, {});
    if (!settings) return settings.error();
    return settings->box;
}

std::vector<SettingKey> listSettingKeys() {
    KeyCollector collector;
    const Settings settings;
    visitFields(collector, settings);
    return collector.finish();
}

}  // namespace trapwright::study
