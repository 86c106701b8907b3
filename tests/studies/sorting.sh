#!/usr/bin/env bash
# What tracks do with parts that hardly anything turns into one way: `evolve --sorting`, or `--time`, for each part, its
# best winner by fresh native trials, and that track in the reference engine. One line for each part and engine.
set -euo pipefail

usage() {
    cat << 'USAGE'
Usage: tests/studies/sorting.sh [FOLDER]

The studies are kept in FOLDER (default: ./trapwright-sorting). From the environment:
    PARTS        names or files ("wedge clip holed-bracket d-shaft housing plate")
    SEEDS        ("1")
    HOW          they are made ("--sorting"), as in "--time 10min"
    OPTIONS      of new studies, besides ("")
    TRIALS       of the reference engine (400)
    TRAPWRIGHT   the program
USAGE
}

case "${1:-}" in
    -h | --help)
        usage
        exit 0
        ;;
esac
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=${TRAPWRIGHT:-$root/build/release/app/trapwright/trapwright}
out=${1:-$PWD/trapwright-sorting}
how=${HOW:---sorting}
read -ra options <<< "$how ${OPTIONS:-}"
if [[ ! -x $program ]]; then
    echo "sorting.sh: $program is not there. Build it with packaging/build.sh release, or name one in TRAPWRIGHT." >&2
    exit 2
fi
mkdir -p "$out"

# "right finished trials" of a track's trials.
count() {
    "$program" track "$1" --part "$2" --engine "$3" --trials "$4" --seed 77 --json | python3 -c '
import json, sys
told = json.load(sys.stdin)
print(told["oriented"]["count"], told["finished"]["count"], told["trials"])'
}

printf 'Sorting, %s, %s\n' "$(date -u +%Y-%m-%d)" "${options[*]}"
printf '%-10s %4s %6s %10s %8s %9s %9s %11s\n' part seed 's' generation engine 'right %' 'finish %' 'correct %'
for part in ${PARTS:-wedge clip holed-bracket d-shaft housing plate}; do
    for seed in ${SEEDS:-1}; do
        study=$out/$(basename "$part")-seed$seed.trap
        if [[ ! -f $study ]]; then
            "$program" evolve "$study" --part "$part" --engine native --seed "$seed" "${options[@]}" > "${study%.trap}.log"
            "$program" select "$study" --engine native --winners 6 --trials 1000 > "${study%.trap}.selection"
        fi
        seconds=$(sed -nE 's/^Done: .* in ([0-9.]+) s .*/\1/p' "${study%.trap}.log")
        track=${study%.trap}.json
        "$program" export "$study" "$track" > /dev/null
        generation=$(awk '$1 == 1 { print $2; exit }' "${study%.trap}.selection")
        for engine in native simbody; do
            trials=1000
            [[ $engine == native ]] || trials=${TRIALS:-400}
            read -r right finished all <<< "$(count "$track" "$part" "$engine" "$trials")"
            printf '%-10s %4d %6.0f %10s %8s %9.1f %9.1f %11s\n' "$(basename "$part")" "$seed" "$seconds" "$generation" "$engine" \
                "$(awk "BEGIN { print 100 * $right / $all }")" "$(awk "BEGIN { print 100 * $finished / $all }")" "$right of $finished"
        done
    done
done
