#!/usr/bin/env bash
# Configures and builds one preset of CMakePresets.json (release unless named) into build/<preset>; all of it, or the
# targets named after the preset.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
preset=${1:-release}

# The heaviest files (geometry and STEP libraries) take about 1.5 GB each to compile.
cores=$(nproc)
byMemory=$(awk '/^MemAvailable:/ { n = int($2 / 1500000); print n < 1 ? 1 : n }' /proc/meminfo)
jobs=$((byMemory < cores ? byMemory : cores))

cd "$root"
cmake --preset "$preset"
cmake --build --preset "$preset" --parallel "$jobs" ${2:+--target "${@:2}"}
