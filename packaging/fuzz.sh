#!/usr/bin/env bash
# Builds the fuzz targets of tests/fuzz and runs them on their corpus and on what libFuzzer makes of it.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/fuzz
corpus=$root/tests/fuzz/corpus
seconds=60
# Little of what these run through is ours, and their libraries' crashes are not for us to mend: unless they are named
# they run on their corpus alone.
foreign=(part_3mf part_glb part_gltf part_iges part_step)

usage() {
    cat << USAGE
Usage: packaging/fuzz.sh [--seconds N] [--replay] [--built] [TARGET...]

Builds the preset fuzz and runs its targets, one on each processor, for N seconds in all (default $seconds). Those that test
foreign libraries, ${foreign[*]}, run on their corpus only unless they are named. Prints a table and
exits with 1 if there was a crash, a hang of more than 20 s, or more than 2 GB in use.

  --replay    every target on its corpus only
  --built     as they were built before, without looking whether anything changed
  TARGET      a file of tests/fuzz/corpus: settings, part_step ...; "all" for all of them

What was new goes to build/fuzz/found and is used the next time, the input of a crash to build/fuzz/crashes. To see one again:
build/fuzz/tests/fuzz/fuzz_TARGET FILE
USAGE
}

fail() {
    printf 'fuzz.sh: %s\n' "$@" >&2
    exit 2
}

replay=false
built=false
named=()
while (($# > 0)); do
    case "$1" in
        -h | --help)
            usage
            exit 0
            ;;
        --seconds)
            [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || fail "--seconds needs a whole number, as in --seconds 60"
            seconds=$2
            shift
            ;;
        --replay) replay=true ;;
        --built) built=true ;;
        -*) fail "unknown option '$1'. See packaging/fuzz.sh --help." ;;
        *) named+=("$1") ;;
    esac
    shift
done

mapfile -t all < <(cd "$corpus" && printf '%s\n' *)
if [[ ${named[*]} == all ]]; then
    named=("${all[@]}")
fi
for target in "${named[@]}"; do
    [[ " ${all[*]} " == *" $target "* ]] || fail "there is no target '$target'. There are: ${all[*]}"
done
targets=("${named[@]}")
((${#targets[@]} > 0)) || targets=("${all[@]}")

$built || "$root/packaging/build.sh" fuzz "${targets[@]/#/fuzz_}"

isForeign() { [[ " ${foreign[*]} " == *" $1 "* ]]; }
fuzzed=()
for target in "${targets[@]}"; do
    if ! $replay && { ((${#named[@]} > 0)) || ! isForeign "$target"; }; then
        fuzzed+=("$target")
    fi
done
share=0
if ((${#fuzzed[@]} > 0)); then
    share=$((seconds * $(nproc) / ${#fuzzed[@]}))
    ((share > 0)) || share=1
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# shellcheck source=packaging/sanitizers/environment.sh
source "$root/packaging/sanitizers/environment.sh"
export TRAPWRIGHT_RESOURCES=$root/resources

# What is to be seen where the build folder is gone, as on a server: what happened, where, and a short input whole.
reportCrash() {
    local input
    input=$(sed -n 's/.*Test unit written to //p' "$2" | tail -n 1)
    echo "$1: $(grep -a -m 1 -E 'runtime error|SUMMARY|does not hold' "$2" || tail -n 1 "$2")"
    grep -a -m 8 -E '^ +#[0-9]+ .*/(core|tests)/' "$2" || true
    if [[ -f $input ]] && (($(stat -c %s "$input") <= 2048)); then
        echo "base64 of $(basename "$input"): $(base64 -w 0 "$input")"
    fi
}

# libFuzzer ends at a crash: it is started again for what is left of the time.
runTarget() {
    local target=$1 time=$2
    local found=$build/found/$target crashes=$build/crashes/$target log=$work/$target.log
    mkdir -p "$found" "$crashes"
    # The same inputs each time: what fails here fails there.
    local options=(-seed=1 -timeout=20 -rss_limit_mb=2048 -print_final_stats=1 "-artifact_prefix=$crashes/")
    # A part's file is longer than what libFuzzer would try by itself.
    options+=(-max_len=65536)
    local dictionary=$root/tests/fuzz/$target.dict
    [[ ! -f $dictionary ]] || options+=("-dict=$dictionary")
    local executions=0 crashed=0 start=$SECONDS code=0 left
    while :; do
        left=$((time - (SECONDS - start)))
        code=0
        if ((time == 0)); then
            "$build/tests/fuzz/fuzz_$target" "${options[@]}" -runs=0 "$corpus/$target" > "$log" 2>&1 || code=$?
        else
            "$build/tests/fuzz/fuzz_$target" "${options[@]}" "-max_total_time=$left" "$found" "$corpus/$target" \
                > "$log" 2>&1 || code=$?
        fi
        executions=$((executions + $(awk '/^stat::number_of_executed_units:/ { n = $2 } END { print n + 0 }' "$log")))
        if ((code == 0)); then
            break
        fi
        crashed=$((crashed + 1))
        cp "$log" "$crashes/log-$crashed.txt"
        # The others are often the same.
        ((crashed > 1)) || reportCrash "$target" "$log" > "$work/$target.report"
        # One that crashes at once would fill the disk.
        ((time > 0 && SECONDS - start + 1 < time && crashed < 20)) || break
    done
    echo "$target $((SECONDS - start)) $executions $(find "$found" -type f -newer "$work/begin" | wc -l) $crashed" > "$work/$target.row"
}

touch "$work/begin"
running=0
for target in "${targets[@]}"; do
    time=0
    [[ " ${fuzzed[*]} " != *" $target "* ]] || time=$share
    if ((running >= $(nproc))); then
        wait -n || true
        running=$((running - 1))
    fi
    runTarget "$target" "$time" &
    running=$((running + 1))
done
wait

printf '%-16s %8s %11s %10s %8s\n' target seconds executions 'new units' crashes
crashes=0
for target in "${targets[@]}"; do
    [[ -f $work/$target.row ]] || fail "$target was not run to its end."
    read -r name time executions new crashed < "$work/$target.row"
    printf '%-16s %8d %11d %10d %8d\n' "$name" "$time" "$executions" "$new" "$crashed"
    crashes=$((crashes + crashed))
done
if ((crashes > 0)); then
    cat "$work"/*.report >&2
    echo "fuzz.sh: $crashes crashes. Inputs and reports are in $build/crashes." >&2
    exit 1
fi
