#!/usr/bin/env bash
# Prints the C++ files that belong to the project, one per line, relative to its root: what git tracks, or, in an
# unpacked archive, everything outside the build folders. Arguments are file name patterns (default: *.h *.inl *.cpp).
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
if (($# == 0)); then
    set -- '*.h' '*.inl' '*.cpp'
fi

if [[ -e .git ]]; then
    # safe.directory: the clone may belong to another user than the one who tests it, as in a container.
    files=$(git -c safe.directory="$root" ls-files --cached -- "$@")
else
    names=()
    for pattern in "$@"; do
        names+=(-o -name "$pattern")
    done
    files=$(find . -path './build*' -prune -o -type f \( "${names[@]:1}" \) -print | sed 's|^\./||' | LC_ALL=C sort)
fi
# A file that was just deleted is tracked until the deletion is committed.
files=$(while IFS= read -r file; do [[ ! -f $file ]] || printf '%s\n' "$file"; done <<< "$files")

# A check of no files would always pass.
if [[ -z $files ]]; then
    echo "list_sources.sh: no source files found under $root" >&2
    exit 1
fi
printf '%s\n' "$files"
