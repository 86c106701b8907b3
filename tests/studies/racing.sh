#!/usr/bin/env bash
# The racing study: the same number of simulated trials with and without a race, on three seeds; then the best winners
# are selected by 1000 trials each, and the selected track is validated with fresh trials. Prints one line for each run.
# Racing may be on by default only if it lowers the success of none of the seeds beyond the bounds.
set -euo pipefail

usage() {
    cat << 'USAGE'
Usage: tests/studies/racing.sh [FOLDER]

The studies are kept in FOLDER (default: ./trapwright-racing); a second call goes on with them. From the environment:
    GENERATIONS   of the run without a race, which sets the number of trials (60)
    RACES         numbers of trials of the first round to try ("20 10")
    SEEDS         ("1 2 3")
    PART          cuboid or cone (cuboid)
    ENGINE        what learns (native); selection and validation are by simbody
    OPTIONS       more options for new studies, such as "--population 40 --trials 40"
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
out=${1:-$PWD/trapwright-racing}
generations=${GENERATIONS:-60}
races=${RACES:-20 10}
seeds=${SEEDS:-1 2 3}
part=${PART:-cuboid}
engine=${ENGINE:-native}
read -ra options <<< "${OPTIONS:-}"
if [[ ! -x $program ]]; then
    echo "racing.sh: $program is not there. Build it with packaging/build.sh release, or name one in TRAPWRIGHT." >&2
    exit 2
fi
mkdir -p "$out"

# The trials of all individuals of a study, by the column of `dump` that holds them.
count_trials() { "$program" dump "$1" | awk '{ sum += $10 } END { print sum + 0 }'; }

# evolve STUDY GENERATIONS SEED FIRST-ROUND: makes the study, or goes on with it.
evolve() {
    if [[ -f $1 ]]; then
        "$program" evolve "$1" --resume --generations "$2"
    else
        "$program" evolve "$1" --preset "$part" --engine "$engine" --generations "$2" --seed "$3" \
            --set "evolution.racingTrials=$4" "${options[@]}"
    fi >> "${1%.trap}.log"
}

# The first "share" of a JSON document's object "oriented", or of its total's "success", in percent.
share_of() { awk -v name="\"$1\":" '$0 ~ name { found = 1 } found && /"share":/ { gsub(/[^0-9.e-]/, "", $2); print 100 * $2; exit }'; }

report() {
    local study=$1 trials selected validated
    trials=$(count_trials "$study")
    selected=$("$program" select "$study" --engine simbody --winners 10 --trials 1000 --json | share_of oriented)
    validated=$("$program" validate "$study" --engine simbody --trials 1000 --json | awk '/"total":/ { go = 1 } go' | share_of success)
    printf '%-6s %4s %11s %10s %9s %10s %10s\n' "$part" "$2" "$3" "$4" "$trials" "$selected" "$validated"
}

printf 'Racing study, %s, learning by %s\n' "$(date -u +%Y-%m-%d)" "$engine"
printf '%-6s %4s %11s %10s %9s %10s %10s\n' part seed first-round generation trials selected% validated%
for seed in $seeds; do
    plain=$out/$part-seed$seed-plain.trap
    evolve "$plain" "$generations" "$seed" 0
    budget=$(count_trials "$plain")
    report "$plain" "$seed" - "$generations"
    for first in $races; do
        raced=$out/$part-seed$seed-race$first.trap
        count=$generations
        evolve "$raced" "$count" "$seed" "$first"
        while spent=$(count_trials "$raced"); ((spent < budget)); do
            # As many more as the trials of those so far allow, at least one.
            more=$(((budget - spent) * count / spent))
            count=$((count + (more > 0 ? more : 1)))
            evolve "$raced" "$count" "$seed" "$first"
        done
        report "$raced" "$seed" "$first" "$count"
    done
done
