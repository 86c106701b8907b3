#include "core/drive/profile.h"

#include <fmt/format.h>

namespace trapwright::drive {

int Place::count() const {
    const bool isLong = type == DataType::uint32 || type == DataType::int32 || type == DataType::float32;
    return isLong ? 2 : 1;
}

std::optional<std::string> FaultCode::findFault(unsigned raw) const {
    const unsigned code = raw & mask;
    if (code == (good & mask)) return std::nullopt;
    const auto meaning = meanings.find(code);
    if (meaning != meanings.end()) return meaning->second;
    return fmt::format("code {} (hexadecimal {:X}); the drive's manual says what it means", code, code);
}

std::string_view nameOf(Table table) {
    switch (table) {
        case Table::coil:
            return "coil";
        case Table::discreteInput:
            return "discrete input";
        case Table::inputRegister:
            return "input register";
        case Table::holdingRegister:
            return "holding register";
    }
    return {};
}

}  // namespace trapwright::drive
