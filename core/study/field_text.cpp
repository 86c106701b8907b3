#include "core/study/field_text.h"

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/study/settings_fields.h"

namespace trapwright::study {

namespace {

class FieldLister {
 public:
    std::vector<FieldInfo> fields;

    void text(std::string_view key, const std::string&) { add(key, FieldKind::text); }
    void number(const NumberField& field, double) {
        FieldInfo& info = add(field.key, FieldKind::number);
        info.unit = field.unit;
        info.low = field.low;
        info.high = field.high;
    }
    void count(const CountField& field, int) {
        FieldInfo& info = add(field.key, FieldKind::count);
        info.low = field.low;
        info.high = field.high;
    }
    void seed(std::string_view key, std::uint64_t) { add(key, FieldKind::seed); }
    void flag(std::string_view key, bool) { add(key, FieldKind::flag); }
    template <class Enum, std::size_t N>
    void choice(std::string_view key, Enum, const Choices<Enum, N>& choices) {
        FieldInfo& info = add(key, FieldKind::choice);
        for (const auto& [name, value] : choices)
            info.choices.emplace_back(name);
    }
    void rotation(std::string_view key, const std::optional<base::Quaternion>&) {
        add(key, FieldKind::rotation);
    }

 private:
    FieldInfo& add(std::string_view key, FieldKind kind) {
        FieldInfo& info = fields.emplace_back();
        info.key = key;
        info.kind = kind;
        return info;
    }
};

class FieldWriter {
 public:
    explicit FieldWriter(std::string_view key) : key_(key) {}
    std::optional<std::string> result;

    void text(std::string_view key, const std::string& value) { put(key, value); }
    void number(const NumberField& field, double value) {
        put(field.key, std::isfinite(value) ? fileText(value, field.unit) : std::string());
    }
    void count(const CountField& field, int value) { put(field.key, std::to_string(value)); }
    void seed(std::string_view key, std::uint64_t value) { put(key, std::to_string(value)); }
    void flag(std::string_view key, bool value) { put(key, value ? "true" : "false"); }
    template <class Enum, std::size_t N>
    void choice(std::string_view key, Enum value, const Choices<Enum, N>& choices) {
        for (const auto& [name, choice] : choices)
            if (choice == value) put(key, std::string(name));
    }
    void rotation(std::string_view key, const std::optional<base::Quaternion>& value) {
        std::string list;
        if (value) {
            for (const double x : {value->w(), value->x(), value->y(), value->z()})
                list += (list.empty() ? "" : " ") + fileText(x, FileUnit::none);
        }
        put(key, list);
    }

 private:
    void put(std::string_view key, const std::string& value) {
        if (key == key_) result = value;
    }

    std::string_view key_;
};

class FieldReader {
 public:
    FieldReader(std::string_view key, std::string_view text) : key_(key), text_(text) {}
    base::Status status = base::success();

    void text(std::string_view key, std::string& value) {
        if (key == key_) value = text_;
    }
    void number(const NumberField& field, double& value) {
        if (field.key != key_) return;
        if (const auto read = siValue(text_, field.unit)) {
            value = *read;
        } else {
            refuse("a number");
        }
    }
    void count(const CountField& field, int& value) { whole(field.key, value); }
    void seed(std::string_view key, std::uint64_t& value) { whole(key, value); }
    void flag(std::string_view key, bool& value) {
        if (key != key_) return;
        if (text_ != "true" && text_ != "false") return refuse("true or false");
        value = text_ == "true";
    }
    template <class Enum, std::size_t N>
    void choice(std::string_view key, Enum& value, const Choices<Enum, N>& choices) {
        if (key != key_) return;
        std::string names;
        for (const auto& [name, choice] : choices) {
            if (name == text_) {
                value = choice;
                return;
            }
            names += (names.empty() ? "" : " or ") + std::string(name);
        }
        refuse(names);
    }
    void rotation(std::string_view key, std::optional<base::Quaternion>& value) {
        if (key != key_) return;
        if (text_.empty()) return value.reset();
        std::array<double, 4> parts{};
        std::size_t count = 0;
        std::size_t begin = 0;
        while (begin <= text_.size()) {
            const std::size_t end = std::min(text_.find(' ', begin), text_.size());
            const auto part = siValue(text_.substr(begin, end - begin), FileUnit::none);
            if (!part || count == parts.size()) return refuse("four numbers w x y z");
            parts[count++] = *part;
            begin = end + 1;
        }
        if (count != parts.size()) return refuse("four numbers w x y z");
        value = rotationOf(parts);
    }

 private:
    template <class Integer>
    void whole(std::string_view key, Integer& value) {
        if (key != key_) return;
        Integer read{};
        const auto [end, failure] = std::from_chars(text_.data(), text_.data() + text_.size(), read);
        if (failure != std::errc() || end != text_.data() + text_.size()) return refuse("a whole number");
        value = read;
    }
    void refuse(const std::string& wanted) {
        status =
            base::Error{std::string(key_) + " is \"" + std::string(text_) + "\"; it must be " + wanted + "."};
    }

    std::string_view key_;
    std::string_view text_;
};

}  // namespace

std::vector<FieldInfo> listFields() {
    FieldLister lister;
    const Settings settings;
    visitFields(lister, settings);
    return std::move(lister.fields);
}

std::string fieldText(const Settings& settings, std::string_view key) {
    FieldWriter writer(key);
    visitFields(writer, settings);
    assert(writer.result);
    return std::move(*writer.result);
}

base::Status setField(Settings& settings, std::string_view key, std::string_view text) {
    FieldReader reader(key, text);
    visitFields(reader, settings);
    return reader.status;
}

}  // namespace trapwright::study
