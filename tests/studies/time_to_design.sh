#!/usr/bin/env bash
# How long learning takes until the first winner is above 99 % in 1000 fresh trials, on several seeds. Prints one line for
# each seed: the generation, wall seconds until it was saved with what was planned before it, processor seconds (of the
# run, by the share of the wall time until then), the winner's success and its bounds; then the medians.
set -euo pipefail

usage() {
    cat << 'USAGE'
Usage: tests/studies/time_to_design.sh [FOLDER]

The studies are kept in FOLDER (default: ./trapwright-time). From the environment:
    SEEDS         ("1 2 3 4 5")
    GENERATIONS   at most (60)
    PART          cuboid or cone (cuboid)
    ENGINE        what learns and judges the winners (native)
    OPTIONS       of new studies ("--population 100 --trials 100 --set evolution.racingTrials=10")
    TRAPWRIGHT    the program
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
out=${1:-$PWD/trapwright-time}
part=${PART:-cuboid}
engine=${ENGINE:-native}
read -ra options <<< "${OPTIONS:---population 100 --trials 100 --set evolution.racingTrials=10}"
if [[ ! -x $program ]]; then
    echo "time_to_design.sh: $program is not there. Build it with packaging/build.sh release, or name one in TRAPWRIGHT." >&2
    exit 2
fi
mkdir -p "$out"

# "count low high" in percent of the part's trials on the winner of a generation.
judge() {
    "$program" export "$1" "$out/winner.json" --generation "$2" > /dev/null
    "$program" track "$out/winner.json" --part "$part" --engine "$engine" --trials 1000 --seed $((1000 + $2)) \
        --restitution 0.2 --json | awk '/"oriented":/ { found = 1 } found { gsub(/[,"]/, "") }
            found && $1 == "count:" { count = $2 } found && $1 == "low:" { low = $2 }
            found && $1 == "high:" { high = $2; printf "%d %.1f %.1f", count, 100 * low, 100 * high; exit }'
}
median() { sort -g | awk '{ v[NR] = $1 } END { print NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'; }

printf 'Time to a design, %s, %s, %s, %s\n' "$(date -u +%Y-%m-%d)" "$part" "$engine" "${options[*]}"
printf '%4s %10s %8s %12s %9s %14s\n' seed generation 'wall s' 'processor s' success '95 % bounds'
: > "$out/wall"
: > "$out/processor"
for seed in ${SEEDS:-1 2 3 4 5}; do
    study=$out/$part-seed$seed.trap
    log=${study%.trap}.log
    if [[ ! -f $study ]]; then
        TIMEFORMAT='cpu %U'
        { time "$program" evolve "$study" --preset "$part" --engine "$engine" --generations "${GENERATIONS:-60}" \
            --seed "$seed" "${options[@]}" > "$log"; } 2>> "$log"
    fi
    # Generation, seconds since the start and all parts oriented as far as learning could tell.
    found=no
    while read -r generation seconds total cpu; do
        read -r count low high <<< "$(judge "$study" "$generation")"
        ((count > 990)) || continue
        found=yes
        processor=$(awk -v s="$seconds" -v t="$total" -v c="$cpu" 'BEGIN { printf "%.0f", c * s / t }')
        printf '%4d %10d %8.0f %12d %9.1f %14s\n' "$seed" "$generation" "$seconds" "$processor" \
            "$(awk -v c="$count" 'BEGIN { print c / 10 }')" "$low...$high"
        echo "$seconds" >> "$out/wall"
        echo "$processor" >> "$out/processor"
        break
    done < <(awk '$1 == "cpu" { cpu = $2 }
        /^Done:/ { for (i = 1; i < NF; i++) if ($i == "in") total = $(i + 1) }
        /^ *[0-9]+ / { sum += $NF; if (split($6, f, "/") == 2 && f[1] == f[2]) { g[++n] = $1; s[n] = sum } }
        END { for (i = 1; i <= n; i++) print g[i], s[i] + total - sum, total, cpu }' "$log")
    # A seed that found none took longer than any that did.
    if [[ $found != yes ]]; then
        printf '%4d %10s\n' "$seed" none
        echo inf | tee -a "$out/wall" >> "$out/processor"
    fi
done
printf 'median wall %s s, processor %s s\n' "$(median < "$out/wall")" "$(median < "$out/processor")"
