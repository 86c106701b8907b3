#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace trapwright::part {

struct Material {
    std::string_view name;
    double density;           // [kg/m^3]
    std::string_view source;  // where the number is from, or "assumed"
};

/// The materials that can be chosen by name, in the order to list them.
std::span<const Material> listMaterials();

/// The material with this name, in any case. Empty if there is none.
std::optional<Material> findMaterial(std::string_view name);

}  // namespace trapwright::part
