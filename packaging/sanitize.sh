#!/usr/bin/env bash
# Builds and runs the tests of core, sim, app, ui/scene and ui/session with clang's sanitizers.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# The most valuable first, by what it finds in the time that it takes: what reads foreign bytes, then threads;
# what takes many minutes (study: 15 of a processor for its drops) comes late.
folders=(core_base core_drive core_store core_stats core_search core_traps core_trial core_calibration sim core_workflow core_part
    core_track core_study core_geometry ui_session core_bench core_verify app ui_scene)

usage() {
    cat << 'USAGE'
Usage: packaging/sanitize.sh [address|thread] [--minutes N] [-R REGEX]

Builds the tests of core, sim, app, ui/scene and ui/session, folder after folder, and runs them with the sanitizers of
addresses and undefined behaviour (preset fuzz; the default) or of threads (preset tsan).

  --minutes N    begins nothing more after N minutes, building included, and says what was left out
  -R REGEX       only the tests that match
USAGE
}

fail() {
    printf 'sanitize.sh: %s\n' "$@" >&2
    exit 2
}

preset=fuzz
minutes=
regex=.
while (($# > 0)); do
    case "$1" in
        -h | --help)
            usage
            exit 0
            ;;
        address) preset=fuzz ;;
        thread) preset=tsan ;;
        --minutes)
            [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || fail "--minutes needs a whole number, as in --minutes 8"
            minutes=$2
            shift
            ;;
        -R)
            (($# > 1)) || fail "-R needs a regular expression, as in -R core_store"
            regex=$2
            shift
            ;;
        *) fail "unknown argument '$1'. See packaging/sanitize.sh --help." ;;
    esac
    shift
done

cd "$root"
end=$((SECONDS + 60 * ${minutes:-0}))
# Runs a command, and where there is a limit ends it and all that it started when time is over, with code 124.
within() {
    if [[ -z $minutes ]]; then "$@"; else timeout "$((end > SECONDS ? end - SECONDS : 1))" "$@"; fi
}

cmake --preset "$preset" > /dev/null
# shellcheck source=packaging/sanitizers/environment.sh
source "$root/packaging/sanitizers/environment.sh"

names=$(ctest --test-dir "build/$preset" -N | sed -n 's/^ *Test *#[0-9]*: //p' | grep -E -- "$regex" || true)
[[ -n $names ]] || fail "no test matches '$regex'."

# See the file.
keep=$PWD/build/$preset/keep_libraries.so
cc -shared -fPIC -o "$keep" packaging/sanitizers/keep_libraries.c

passed=()
failed=()
omitted=()
for folder in "${folders[@]}"; do
    mapfile -t tests < <(grep "^${folder}_" <<< "$names" || true)
    ((${#tests[@]} > 0)) || continue
    if [[ -n $minutes ]] && ((SECONDS >= end)); then
        omitted+=("$folder")
        continue
    fi
    # A test that is another one's program at other settings has no target of its own.
    mapfile -t targets < <(printf '%s\n' "${tests[@]}" | sed 's/_hidpi_test$/_test/' | sort -u)
    code=0
    within packaging/build.sh "$preset" "${targets[@]}" > "build/$preset/sanitize.log" 2>&1 || code=$?
    if ((code == 124)); then
        omitted+=("$folder")
        continue
    elif ((code != 0)); then
        tail -n 40 "build/$preset/sanitize.log" >&2
        failed+=("$folder (build)")
        continue
    fi
    code=0
    LD_PRELOAD=$keep within ctest --test-dir "build/$preset" --parallel "$(nproc)" --output-on-failure --no-tests=error \
        -R "^($(IFS='|' && echo "${tests[*]}"))\$" 2>&1 | tee "build/$preset/sanitize.log" || code=${PIPESTATUS[0]}
    if ((code == 0)); then
        passed+=("$folder")
    elif ((code == 124)) && ! grep -q '\*\*\*' "build/$preset/sanitize.log"; then
        omitted+=("$folder")
    else # also where time was over after a test had failed
        failed+=("$folder")
    fi
done

((${#omitted[@]} == 0)) || echo "sanitize.sh: left out, as $minutes minutes were over: ${omitted[*]}"
((${#passed[@]} == 0)) || echo "sanitize.sh: passed: ${passed[*]}"
if ((${#failed[@]} > 0)); then
    echo "sanitize.sh: failed: ${failed[*]}" >&2
    exit 1
fi
