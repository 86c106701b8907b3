#!/usr/bin/env bash
# Installs, builds and runs every check and every test. Ends with ctest's summary; exits non-zero if anything failed.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
    cat << 'USAGE'
Usage: packaging/test.sh [CTEST-OPTION...]

Installs what is missing, builds the release preset, checks format, layers and clang-tidy, and runs every test. With
CI=true it also installs and configures in a bare Debian 12 (packaging/try_bare.sh), fuzzes for a minute, and runs as many
tests with sanitizers as fit in fifteen minutes (packaging/fuzz.sh, packaging/sanitize.sh). It then aims
at 80 minutes: the tests come first, the other checks get what they leave, and what was left out is said.
Options go to ctest, for instance: packaging/test.sh -R core_track
USAGE
}

case "${1:-}" in
    -h | --help)
        usage
        exit 0
        ;;
esac

"$root/packaging/install.sh"
began=$SECONDS
"$root/packaging/build.sh" release

# Continuous integration is stopped after 90 minutes; all of this took 42 there on one day and more than that on another.
# The tests get two fifths of what the build took: where it took 45 minutes, they took 10 to 17.
tests=$(((SECONDS - began) * 2 / 5))
((tests >= 600)) || tests=600
# Prints how many minutes the other checks may take yet, at most $1.
spare() {
    local minutes=$(((80 * 60 - tests - SECONDS) / 60))
    ((minutes > 0)) || minutes=0
    [[ ${CI:-} == true ]] || minutes=$1
    echo $((minutes < $1 ? minutes : $1))
}

# A failed check does not keep the tests from being run: one round shows everything there is to mend.
failed=()
# clang-tidy takes an hour for everything; where nothing is remembered from before, what was changed last has to do.
for check in check_format check_layers "check_tidy --minutes $(($(spare 24) / 2))"; do
    read -ra words <<< "$check"
    "$root/packaging/${words[0]}.sh" "${words[@]:1}" || failed+=("${words[0]}")
done
# What is installed on this machine proves nothing for others.
if [[ ${CI:-} == true ]]; then
    bare=0
    if (($(spare 10) == 10)); then
        "$root/packaging/try_bare.sh" || bare=$?
    else
        echo "test.sh: left out for lack of time: try_bare"
    fi
    # 77: no bare system can be made here, which it has said.
    ((bare == 0 || bare == 77)) || failed+=(try_bare)

    # One sanitized tree for both, building included.
    began=$SECONDS
    minutes=$(spare 15)
    fuzz=0
    timeout "$((minutes * 60 + 1))" "$root/packaging/fuzz.sh" --seconds 60 || fuzz=$?
    minutes=$((minutes - (SECONDS - began + 30) / 60))
    if ((fuzz == 124)); then
        echo "test.sh: left out for lack of time: fuzz"
    elif ((fuzz != 0)); then
        failed+=(fuzz)
    fi
    if ((minutes > 0)); then
        "$root/packaging/sanitize.sh" address --minutes "$minutes" || failed+=(sanitize)
    else
        echo "test.sh: left out for lack of time: sanitize"
    fi
fi
# The tests are run last so that their summary ends the output.
cd "$root"
ctest --preset release --parallel "$(nproc)" --no-tests=error "$@" || failed+=(ctest)

if ((${#failed[@]} > 0)); then
    echo "test.sh: failed: ${failed[*]}" >&2
    exit 1
fi
