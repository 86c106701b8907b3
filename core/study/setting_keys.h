#pragma once

#include <string>
#include <vector>

namespace trapwright::study {

/// A setting's key ("track.encoding") and the values that it can have, where they are a list of names; empty
/// for numbers, texts and rotations.
struct SettingKey {
    std::string key;
    std::vector<std::string> values;
};

/// The keys of all settings, in the order of the file (settings_json.cpp).
std::vector<SettingKey> listSettingKeys();

}  // namespace trapwright::study
