#!/usr/bin/env bash
# Whether the shortcuts of learning cost success: every variant learns the same number of generations on each seed; its
# best winners are selected by fresh trials, and the selected track is validated. Prints one line for each run. A
# shortcut may be on by default only if it lowers the success of none of the seeds beyond the bounds.
set -euo pipefail

usage() {
    cat << 'USAGE'
Usage: tests/studies/shortcuts.sh [FOLDER]

The studies are kept in FOLDER (default: ./trapwright-shortcuts); a second call goes on with them. From the environment:
    VARIANTS      of plain, patience, race, both ("plain patience both"):
                  plain     all trials for everybody; stuck after 1.5 s without progress
                  patience  all trials for everybody; stuck after 0.6 s while learning
                  race      10 trials for everybody, all for the best; stuck after 1.5 s
                  both      10 trials for everybody, all for the best; stuck after 0.6 s while learning
    SEEDS         ("1 2 3")
    GENERATIONS   of every run (40)
    PART          cuboid or cone (cuboid)
    ENGINE        what learns, selects and validates (native)
    OPTIONS       of new studies ("--population 60 --trials 50")
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
out=${1:-$PWD/trapwright-shortcuts}
part=${PART:-cuboid}
engine=${ENGINE:-native}
read -ra options <<< "${OPTIONS:---population 60 --trials 50}"
if [[ ! -x $program ]]; then
    echo "shortcuts.sh: $program is not there. Build it with packaging/build.sh release, or name one in TRAPWRIGHT." >&2
    exit 2
fi
mkdir -p "$out"

# race first-round and patience of a variant
settings_of() {
    case "$1" in
        plain) echo 0 1.5 ;;
        patience) echo 0 0.6 ;;
        race) echo 10 1.5 ;;
        both) echo 10 0.6 ;;
        *)
            echo "shortcuts.sh: there is no variant '$1'. See tests/studies/shortcuts.sh --help." >&2
            exit 2
            ;;
    esac
}

# The trials of all individuals of a study, by the column of `dump` that holds them.
count_trials() { "$program" dump "$1" | awk '{ sum += $10 } END { print sum + 0 }'; }

# "share [low...high]" in percent of a JSON document's first object of that name.
bounds_of() {
    awk -v name="\"$1\":" '
        $0 ~ name { found = 1 }
        found { gsub(/[,"]/, "") }
        found && $1 == "share:" { share = $2 }
        found && $1 == "low:" { low = $2 }
        found && $1 == "high:" { high = $2 }
        found && /}/ { printf "%.1f [%.1f...%.1f]", 100 * share, 100 * low, 100 * high; exit }'
}

printf 'Shortcuts study, %s, learning by %s\n' "$(date -u +%Y-%m-%d)" "$engine"
printf '%-6s %4s %-9s %11s %9s %9s %20s %20s\n' part seed variant generations trials 'CPU s' 'selected %' 'validated %'
for seed in ${SEEDS:-1 2 3}; do
    for variant in ${VARIANTS:-plain patience both}; do
        read -r first patience <<< "$(settings_of "$variant")"
        study=$out/$part-seed$seed-$variant.trap
        log=${study%.trap}.log
        if [[ ! -f $study ]]; then
            TIMEFORMAT='cpu %U'
            { time "$program" evolve "$study" --preset "$part" --engine "$engine" --generations "${GENERATIONS:-40}" \
                --seed "$seed" --set "evolution.racingTrials=$first" --set "evolution.learningStuckTime_s=$patience" \
                "${options[@]}" > "$log"; } 2>> "$log"
        fi
        selected=$("$program" select "$study" --engine "$engine" --winners 5 --trials 500 --json | bounds_of oriented)
        validated=$("$program" validate "$study" --engine "$engine" --trials 500 --json | awk '/"total":/ { go = 1 } go' | bounds_of success)
        printf '%-6s %4s %-9s %11s %9s %9s %20s %20s\n' "$part" "$seed" "$variant" "${GENERATIONS:-40}" \
            "$(count_trials "$study")" "$(awk '$1 == "cpu" { print $2 }' "$log")" "$selected" "$validated"
    done
done
