#!/usr/bin/env bash
# Checks that every C++ file is formatted as .clang-format says, and prints the command that mends those that are not.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
sources=$(packaging/list_sources.sh)
command -v clang-format-14 > /dev/null || {
    echo "check_format: clang-format-14 is not installed; packaging/install.sh does it." >&2
    exit 1
}

# One line per file: the tool's own messages of several processes would run into each other.
# shellcheck disable=SC2016  # $1 is for the inner shell
unformatted=$(xargs -d '\n' -n 1 -P "$(nproc)" \
    bash -c 'clang-format-14 --dry-run -Werror "$1" 2> /dev/null || printf "%s\n" "$1"' check <<< "$sources" | sort)

if [[ -n $unformatted ]]; then
    printf 'check_format: these files are not formatted as .clang-format says:\n%s\n' "$unformatted" >&2
    printf 'Mend them with: clang-format-14 -i %s\n' "${unformatted//$'\n'/ }" >&2
    exit 1
fi
echo "check_format: $(wc -l <<< "$sources") files are formatted."
