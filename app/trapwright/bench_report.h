#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/bench/benchmark.h"

namespace trapwright::app {

/// The benchmark's table as text: its head, and one line per scene and engine.
std::string benchHeader(const bench::Plan& plan);
std::string benchRow(const std::string& scene, const bench::Measurement& measured);

/// The same line for machines. Where the engine cannot do the scene, "problem" says why and all else is left
/// out; "shares" is null where it does not tell them.
nlohmann::ordered_json benchRowToJson(const std::string& scene, const bench::Measurement& measured);

}  // namespace trapwright::app
