#include "core/part/materials.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace trapwright::part {

namespace {

constexpr std::string_view kHandbook = "typical value of data sheets; grades differ by some percent";

constexpr std::array<Material, 12> kMaterials = {{
    {"ABS", 1040.0, kHandbook},
    {"PLA", 1240.0, kHandbook},
    {"PP", 905.0, kHandbook},
    {"PE-HD", 950.0, kHandbook},
    {"PA6", 1140.0, kHandbook},
    {"POM", 1410.0, kHandbook},
    {"PC", 1200.0, kHandbook},
    {"rubber", 1200.0, "assumed"},
    {"aluminium", 2700.0, "pure metal at 20 C; alloys 2640 to 2840"},
    {"steel", 7850.0, "EN 1991-1-1, table A.4: 77 to 78.5 kN/m^3"},
    {"stainless", 7900.0, "EN 10088-1, austenitic 1.4301"},
    {"brass", 8500.0, "EN 12164, CuZn39Pb3: 8.4 to 8.5 g/cm^3"},
}};

}  // namespace

std::span<const Material> listMaterials() {
    return kMaterials;
}

std::optional<Material> findMaterial(std::string_view name) {
    const auto equal = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
    };
    const auto found = std::find_if(kMaterials.begin(), kMaterials.end(), [&](const Material& material) {
        return std::equal(name.begin(), name.end(), material.name.begin(), material.name.end(), equal);
    });
    if (found == kMaterials.end()) return std::nullopt;
    return *found;
}

}  // namespace trapwright::part
