#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "core/drive/profile.h"

/// The names in profiles.
namespace trapwright::drive::fields {

inline constexpr std::string_view kFormat = "trapwright drive";
inline constexpr int kVersion = 1;

inline constexpr std::array<std::pair<Protocol, std::string_view>, 3> kProtocols = {
    {{Protocol::modbusTcp, "modbus-tcp"}, {Protocol::modbusRtu, "modbus-rtu"}, {Protocol::reo, "reo"}}};

inline constexpr std::array<std::pair<Table, std::string_view>, 4> kTables = {
    {{Table::coil, "coil"},
     {Table::discreteInput, "discreteInput"},
     {Table::inputRegister, "inputRegister"},
     {Table::holdingRegister, "holdingRegister"}}};

inline constexpr std::array<std::pair<DataType, std::string_view>, 6> kTypes = {
    {{DataType::bit, "bit"},
     {DataType::uint16, "uint16"},
     {DataType::int16, "int16"},
     {DataType::uint32, "uint32"},
     {DataType::int32, "int32"},
     {DataType::float32, "float32"}}};

inline constexpr std::array<std::pair<char, std::string_view>, 3> kParities = {
    {{'N', "none"}, {'E', "even"}, {'O', "odd"}}};

}  // namespace trapwright::drive::fields
