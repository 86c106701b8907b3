#!/usr/bin/env bash
# Whether the drive comes to rest in time, or the operator is told that it may not, when the device at the other end lies,
# stalls, floods, hangs up and resets: random sequences over the real transports, one table at the end.
set -euo pipefail

usage() {
    cat << 'USAGE'
Usage: tests/studies/hostile_device.sh [window | reconnect] [TIMES]

For each of Modbus TCP, Modbus RTU and REO, the last two on pseudo-terminals:

  (nothing)   so many sequences (default: 1000) of the drive's loop
  window      so many sequences of an operator in the studio's window, the three links beside each other, each on a screen of
              its own; how late the window's events are
  reconnect   connects and disconnects so often in one process; files, threads and memory after 50 times and after all

From the environment:
    AT_ONCE   how many sequences run beside each other (40; in the window always one)
    MINUTES   after them no sequence in the window is begun any more (60)
    LOG       keeps every sequence's line in this file
USAGE
}

what=loop
case "${1:-}" in
    -h | --help)
        usage
        exit 0
        ;;
    window | reconnect)
        what=$1
        shift
        ;;
esac
sequences=${1:-1000}
at_once=${AT_ONCE:-40}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$root/build/release/tests
program=$build/app/hostile_device
window=$build/ui/hostile_window
for needed in "$program" "$window"; do
    [[ -x $needed ]] && continue
    echo "hostile_device.sh: $needed is not there. Build it with packaging/build.sh release." >&2
    exit 2
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
log=${LOG:-$work/log}
: > "$log"

# For awk: what a line says of a name, as in rest=0.34.
value='function value(name,   i, pair) {
    for (i = 3; i <= NF; ++i) {
        split($i, pair, "=")
        if (pair[1] == name) return pair[2]
    }
}'

# One link in the window, in processes of 50 sequences, one after the other. A sequence takes some seconds.
in_window() {
    local link=$1 file=$2 first last left status
    local end=$((SECONDS + 60 * ${MINUTES:-60}))
    for ((first = 1; first <= sequences; first += 50)); do
        last=$((first + 49 < sequences ? first + 49 : sequences))
        left=$((end - SECONDS))
        ((left > 0)) || break
        status=0
        XDG_RUNTIME_DIR=$work nice timeout 1500 xvfb-run -a -s "-screen 0 1920x1080x24 +extension GLX" \
            "$window" "$link" "$first" "$last" "$left" >> "$file" 2> "$work/errors-$link" || status=$?
        if ((status != 0)); then
            echo "crash $link $first-$last status=$status" >> "$file"
            tail -n 3 "$work/errors-$link" >&2
        fi
    done
}

if [[ $what == window ]]; then
    export LIBGL_ALWAYS_SOFTWARE=1 QT_QPA_PLATFORM=xcb
    echo "Hostile device in the window, $(date -u +%Y-%m-%d), $(nproc) processors, up to $sequences sequences for each link"
    for link in tcp rtu reo; do
        in_window "$link" "$work/$link" &
    done
    wait
    cat "$work/tcp" "$work/rtu" "$work/reo" > "$log"
    awk "$value"'
    $1 == "crash" { ++crashes[$2] }
    $1 == "window" {
        ++all[$2]
        if (value("late_ms") > late[$2]) late[$2] = value("late_ms")
        if (value("started") != 1) next
        ++started[$2]
        rested[$2] += value("intime")
        left[$2] += value("left")
        if (value("rest") > rest[$2]) rest[$2] = value("rest")
        if (value("end") > ending[$2]) ending[$2] = value("end")
    }
    END {
        print "| link | sequences | in motion | at rest in time | longest [s] | left or closed in time | longest [s] |" \
              " latest event of the window [ms] | crashes or hangs |"
        print "|---|---|---|---|---|---|---|---|---|"
        count = split("tcp rtu reo", links, " ")
        for (l = 1; l <= count; ++l) {
            link = links[l]
            printf "| %s | %d | %d | %d | %.2f | %d | %.2f | %.0f | %d |\n", link, all[link], started[link], rested[link],
                rest[link], left[link], ending[link], late[link], crashes[link]
        }
    }' "$log"
    exit 0
fi

if [[ $what == reconnect ]]; then
    echo "Connections of one process, $(date -u +%Y-%m-%d), $(nproc) processors, $sequences for each link"
    for link in tcp rtu reo; do
        # One arena: the heap's figure knows no other.
        MALLOC_ARENA_MAX=1 nice timeout 3600 "$program" reconnect "$link" "$sequences" | tee -a "$log"
    done
    exit 0
fi

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
awk "$value"'
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
