#include "core/study/json_leaves.h"

#include <nlohmann/json.hpp>
#include <set>
#include <vector>

namespace trapwright::study {

namespace {

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

}  // namespace

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

}  // namespace trapwright::study
