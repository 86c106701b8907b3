#pragma once

#include <map>
#include <string>

#include "core/base/result.h"

namespace trapwright::study {

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

}  // namespace trapwright::study
