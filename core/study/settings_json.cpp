#include <charconv>
#include <cmath>
#include <optional>

#include "core/base/spelling.h"
#include "core/study/json_leaves.h"
#include "core/study/setting_keys.h"
#include "core/study/settings.h"
#include "core/study/settings_fields.h"

namespace trapwright::study {

namespace {

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
        value = base::Quaternion(parts[0], parts[1], parts[2], parts[3]);
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

std::vector<SettingKey> listSettingKeys() {
    KeyCollector collector;
    const Settings settings;
    visitFields(collector, settings);
    return collector.finish();
}

}  // namespace trapwright::study
