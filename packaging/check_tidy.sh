#!/usr/bin/env bash
# Runs clang-tidy over every .cpp file, or over those named. A file that passed is not looked at again until it,
# a header of ours that it includes, its compile command, .clang-tidy or clang-tidy itself changes.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release
cache=${XDG_CACHE_HOME:-${HOME:-$root/build}/.cache}/trapwright-tidy

usage() {
    cat << 'USAGE'
Usage: packaging/check_tidy.sh [-p BUILD-FOLDER] [--minutes N] [FILE...]

Needs a configured and built folder (default: build/release), because tests include files that the build makes.
What passed is remembered in ${XDG_CACHE_HOME:-~/.cache}/trapwright-tidy. What was changed last is looked at first; with
--minutes no file is begun after so many.
USAGE
}

fail() {
    printf 'check_tidy: %s\n' "$@" >&2
    exit 1
}

files=()
minutes=
while (($# > 0)); do
    case "$1" in
        -h | --help)
            usage
            exit 0
            ;;
        -p)
            (($# > 1)) || fail "-p needs a build folder, as in -p build/peers"
            build=$(realpath -- "$2")
            shift
            ;;
        --minutes)
            [[ ${2:-} =~ ^[0-9]+$ ]] || fail "--minutes needs a whole number, as in --minutes 25"
            minutes=$2
            shift
            ;;
        -*) fail "unknown option '$1'. See packaging/check_tidy.sh --help." ;;
        *) files+=("$(realpath --relative-to="$root" -- "$1")") ;;
    esac
    shift
done

cd "$root"
command -v clang-tidy-14 > /dev/null || fail "clang-tidy-14 is not installed; packaging/install.sh does it."
[[ -f $build/compile_commands.json ]] || fail "there is no $build/compile_commands.json; packaging/build.sh makes it."
sources=$(packaging/list_sources.sh)
if ((${#files[@]} == 0)); then
    mapfile -t files < <(grep '\.cpp$' <<< "$sources")
fi
mkdir -p "$cache"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Without the precompiled headers: they are the compiler's own, and a file must name what it needs itself. Nor is it
# part of a verdict where the object goes.
database=$work/compile_commands.json
sed -E '/"command":/ s/ (-Winvalid-pch|-fpch-preprocess|-include [^ ]*cmake_pch\.hxx|-o [^ ]*\.o)//g' \
    "$build/compile_commands.json" > "$database"

# What was changed last comes first, and before it what git does not know yet.
{ git diff --name-only HEAD && git log --format= --name-only; } 2> /dev/null | awk '!seen[$0]++' > "$work/ages" || true
printf '%s\n' "${files[@]}" | awk -v ages="$work/ages" '
    BEGIN { while ((getline file < ages) > 0) age[file] = ++count }
    { print age[$0] + 0, $0 }' | sort -n -s -k 1,1 | cut -d ' ' -f 2- > "$work/files"
{ cat .clang-tidy; clang-tidy-14 --version; } > "$work/rules"
xargs -d '\n' sha256sum <<< "$sources" > "$work/hashes"
xargs -d '\n' grep -HE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' <<< "$sources" > "$work/includes" || true

# For each file: what its verdict hangs on, one item per line, in $work/<number>; "-" where nothing compiles it.
awk -v root="$root" -v work="$work" '
    function remove(text, what,    at) {
        while ((at = index(text, what)) > 0) text = substr(text, 1, at - 1) substr(text, at + length(what))
        return text
    }
    FILENAME == work "/rules" { rules = rules $0 "\n" }
    FILENAME == work "/hashes" { hash[$2] = $1 }
    FILENAME == work "/includes" {
        split($0, parts, "\"")
        from = substr($0, 1, index($0, ":") - 1)
        to = parts[2]
        included[from] = included[from] " " to
    }
    # The place of the clone is no part of the verdict: another clone of the same files may use it.
    /^ *"command":/ { command = remove($0, root) }
    /^ *"file":/ {
        split($0, parts, "\"")
        compiled[substr(parts[4], length(root) + 2)] = command
    }
    FILENAME == work "/files" {
        item = work "/item." ++count
        if (!($0 in compiled)) {
            print $0, "-"
            next
        }
        print $0, item
        printf "%s%s\n", rules, compiled[$0] > item
        split("", seen)
        split("", queue)
        seen[$0] = 1
        queue[last = 1] = $0
        for (next_ = 1; next_ <= last; next_++) {
            print queue[next_], hash[queue[next_]] > item
            n = split(included[queue[next_]], targets, " ")
            for (i = 1; i <= n; i++) {
                if ((targets[i] in hash) && !(targets[i] in seen)) {
                    seen[targets[i]] = 1
                    queue[++last] = targets[i]
                }
            }
        }
        close(item)
    }
' "$work/rules" "$work/hashes" "$work/includes" "$database" "$work/files" > "$work/items"

unbuilt=()
: > "$work/jobs"
while read -r file item; do
    if [[ $item == - ]]; then
        # The peers and the fuzz targets are built on request only; `-p build/peers` and `-p build/fuzz` look at them.
        [[ $file == tests/peers/* || $file == tests/fuzz/* ]] || unbuilt+=("$file")
        continue
    fi
    # A folder's own rules add to those of the whole tree.
    [[ ! -f ${file%/*}/.clang-tidy ]] || cat "${file%/*}/.clang-tidy" >> "$item"
    key=$(sha256sum < "$item")
    stamp=$cache/${key%% *}
    if [[ -f $stamp ]]; then
        touch "$stamp"
    else
        printf '%s\n%s\n' "$file" "$stamp" >> "$work/jobs"
    fi
done < "$work/items"
find "$cache" -type f -mtime +60 -delete

echo "check_tidy: ${#files[@]} files, $(($(wc -l < "$work/jobs") / 2)) of them new or changed"
status=0
# Each file's messages are printed at once, so that those of several processes do not run into each other.
# shellcheck disable=SC2016  # $1, $2 and $3 are for the inner shell
[[ -z $minutes ]] || export TIDY_END=$(($(date +%s) + 60 * minutes))
export TIDY_LEFT=$work/left
: > "$work/left"
xargs -r -d '\n' -n 2 -P "$(nproc)" bash -c '
    started=$SECONDS
    if [[ -n ${TIDY_END:-} ]] && (($(date +%s) >= TIDY_END)); then
        echo "$2" >> "$TIDY_LEFT"
        exit 0
    fi
    if messages=$(clang-tidy-14 --quiet -p "$1" "$2" 2>&1); then
        touch "$3"
        echo "    $2: passed, $((SECONDS - started)) s"
    else
        printf "    %s: failed\n%s\n" "$2" "$(grep -vE "^([0-9]+ (warning|error)|Error while processing|Found compiler error)" <<< "$messages")" >&2
        exit 1
    fi
' check "$work" < "$work/jobs" || status=1

if ((${#unbuilt[@]} > 0)); then
    printf 'check_tidy: no CMakeLists.txt compiles these files:\n' >&2
    printf '    %s\n' "${unbuilt[@]}" >&2
    status=1
fi
((status == 0)) || fail "clang-tidy's findings are above."
left=$(wc -l < "$work/left")
if ((left > 0)); then
    echo "check_tidy: passed, but for $left older files that were not begun within $minutes minutes."
else
    echo "check_tidy: all passed."
fi
