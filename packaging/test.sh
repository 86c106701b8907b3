#!/usr/bin/env bash
# Installs, builds and runs every check and every test. Ends with ctest's summary; exits non-zero if anything failed.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
    cat << 'USAGE'
Usage: packaging/test.sh [CTEST-OPTION...]

Installs what is missing, builds the release preset, checks format, layers and clang-tidy, and runs every test. With
CI=true it also installs and configures in a bare Debian 12 (packaging/try_bare.sh), fuzzes for a minute, and runs as many
tests with sanitizers as fit in ten minutes (packaging/fuzz.sh, packaging/sanitize.sh).
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
"$root/packaging/build.sh" release

# A failed check does not keep the tests from being run: one round shows everything there is to mend.
failed=()
# clang-tidy takes an hour for everything; where nothing is remembered from before, what was changed last has to do.
for check in check_format check_layers "check_tidy --minutes 12"; do
    read -ra words <<< "$check"
    "$root/packaging/${words[0]}.sh" "${words[@]:1}" || failed+=("${words[0]}")
done
# What is installed on this machine proves nothing for others.
if [[ ${CI:-} == true ]]; then
    bare=0
    "$root/packaging/try_bare.sh" || bare=$?
    # 77: no bare system can be made here, which it has said.
    ((bare == 0 || bare == 77)) || failed+=(try_bare)

    # One sanitized tree for both, in ten minutes, building included.
    began=$SECONDS
    "$root/packaging/fuzz.sh" --seconds 60 || failed+=(fuzz)
    minutes=$((10 - (SECONDS - began + 30) / 60))
    "$root/packaging/sanitize.sh" address --minutes "$((minutes > 1 ? minutes : 1))" || failed+=(sanitize)
fi
# The tests are run last so that their summary ends the output.
cd "$root"
ctest --preset release --parallel "$(nproc)" --no-tests=error "$@" || failed+=(ctest)

if ((${#failed[@]} > 0)); then
    echo "test.sh: failed: ${failed[*]}" >&2
    exit 1
fi
