#!/usr/bin/env bash
# Whether the drive comes to rest in time, or the operator is told that it may not, when the device at the other end lies,
# stalls, floods, hangs up and resets: random sequences over the real transports, one table at the end.
set -euo pipefail

usage() {
    cat << 'USAGE'
Usage: tests/studies/hostile_device.sh [SEQUENCES]

Runs so many sequences (default: 1000) for each of Modbus TCP, Modbus RTU and REO, the last two on pseudo-terminals. From
the environment:
    AT_ONCE   how many run beside each other (40)
    LOG       keeps every sequence's line in this file
USAGE
}

case "${1:-}" in
    -h | --help)
        usage
        exit 0
        ;;
esac
sequences=${1:-1000}
at_once=${AT_ONCE:-40}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=$root/build/release/tests/ui/transports/hostile_device
if [[ ! -x $program ]]; then
    echo "hostile_device.sh: $program is not there. Build it with packaging/build.sh release." >&2
    exit 2
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
log=${LOG:-$work/log}
: > "$log"
batch=125
echo "Hostile device, $(date -u +%Y-%m-%d), $(nproc) processors, $sequences sequences for each link, $at_once at once"
for link in tcp rtu reo; do
    for ((first = 1; first <= sequences; first += batch)); do
        last=$((first + batch - 1 < sequences ? first + batch - 1 : sequences))
        # A process that does not end within five minutes hangs.
        status=0
        nice timeout 300 "$program" "$link" "$first" "$last" "$at_once" >> "$log" 2> "$work/errors" || status=$?
        if ((status != 0)); then
            echo "crash $link $first-$last status=$status" >> "$log"
            tail -n 3 "$work/errors" >&2
        fi
    done
done
awk '
function value(name,   i, pair) {
    for (i = 3; i <= NF; ++i) {
        split($i, pair, "=")
        if (pair[1] == name) return pair[2]
    }
}
$1 == "crash" { ++crashes[$2] }
$1 == "process" {
    if (value("block_ms") > block[$2]) block[$2] = value("block_ms")
    if (value("files") > files[$2]) files[$2] = value("files")
    if (value("threads") > threads[$2]) threads[$2] = value("threads")
    if (value("memory_kB") > memory[$2]) memory[$2] = value("memory_kB")
}
$1 == "sequence" {
    ++all[$2]
    if (value("started") != 1) { ++unstarted[$2]; next }
    ++stops[$2]
    times[$2, stops[$2]] = value("rest")
    rested[$2] += value("intime")
    told[$2] += value("told")
    if (value("intime") != 1 && value("told") == 1) ++otherwise[$2]
    self[$2] += value("self")
    if (value("recovered") != 1) ++lost[$2]
    if (value("end") > ending[$2]) ending[$2] = value("end")
}
END {
    print "| link | sequences | stops asked | at rest in time | median [s] | max [s] | late, but told | late and not told |" \
          " warned meanwhile | moved by itself | not found again | crashes or hangs | longest block of the event loop [ms] |" \
          " longest end of a connection [s] | descriptors left | threads left | memory grown [kB] |"
    print "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
    count = split("tcp rtu reo", links, " ")
    for (l = 1; l <= count; ++l) {
        link = links[l]
        n = stops[link]
        for (i = 1; i <= n; ++i) sorted[i] = times[link, i] + 0
        for (i = 2; i <= n; ++i) {
            x = sorted[i]
            for (j = i - 1; j > 0 && sorted[j] > x; --j) sorted[j + 1] = sorted[j]
            sorted[j + 1] = x
        }
        printf "| %s | %d | %d | %d | %.2f | %.2f | %d | %d | %d | %d | %d | %d | %.1f | %.2f | %d | %d | %d |\n", link,
            all[link], n, rested[link], sorted[int((n + 1) / 2)], sorted[n], otherwise[link],
            n - rested[link] - otherwise[link], told[link], self[link], lost[link], crashes[link], block[link],
            ending[link], files[link], threads[link], memory[link]
        if (unstarted[link] > 0) printf "(%s: %d sequences were never started)\n", link, unstarted[link]
    }
}' "$log"
