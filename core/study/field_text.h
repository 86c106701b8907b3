#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/study/number_text.h"
#include "core/study/settings.h"

namespace trapwright::study {

enum class FieldKind { text, number, count, seed, flag, choice, rotation };

/// What can be known of a setting without its value.
struct FieldInfo {
    std::string key;  // as in files, "track.segmentWidth_mm"
    FieldKind kind = FieldKind::text;
    FileUnit unit = FileUnit::none;    // of a number in files and in its text
    double low = 0.0;                  // of a number or a count, in the unit of its text
    double high = 0.0;                 // likewise
    std::vector<std::string> choices;  // names, in their order
};

/// All settings, in the order of the file.
std::vector<FieldInfo> listFields();

/// A setting's value as people write it: "60", "true", "bowl". Empty for a rotation that is not set, and for
/// a number that is not finite. The key must be one of listFields().
std::string fieldText(const Settings& settings, std::string_view key);

/// Sets one setting from such a text; setField(s, key, fieldText(t, key)) copies it from t to the last bit.
/// An error, and no change, if the text is no value of its kind. Ranges are not looked at: findProblems does
/// that.
base::Status setField(Settings& settings, std::string_view key, std::string_view text);

}  // namespace trapwright::study
