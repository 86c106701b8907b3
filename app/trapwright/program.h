#pragma once

namespace trapwright::app {

/// The program's name and version, as noted in study files.
inline constexpr const char* kProgram = "trapwright " TRAPWRIGHT_VERSION;

}  // namespace trapwright::app
