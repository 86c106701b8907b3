#!/usr/bin/env bash
# Tries what a new user meets: a bare Debian 12, a clone, and the first command.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
    cat << 'USAGE'
Usage: packaging/try_bare.sh [--build] [--tests] [--cores N] [--keep DIR]

Makes a bare Debian 12 in a folder of its own, clones what is committed here into it, installs there what
packaging/install.sh installs, and configures: a package that the list lacks, but this machine has, shows. Needs root or
user namespaces, and the network that apt needs; leaves nothing behind.

  --build      goes on with packaging/run.sh --headless: builds the two programs and runs the demo
  --tests      also builds everything else, the tests above all
  --cores N    on so many processors (default: all)
  --keep DIR   makes the bare system in DIR and leaves it there, to look at
  -h, --help   this text

Ends with the time of every step; downloads have one of their own. Exit code 77 if no bare system can be made here.
USAGE
}

fail() {
    printf 'try_bare.sh: %s\n' "$@" >&2
    exit 1
}

build=false
tests=false
cores=$(nproc)
bare=
while (($# > 0)); do
    case "$1" in
        -h | --help)
            usage
            exit 0
            ;;
        --build) build=true ;;
        --tests) tests=true ;;
        --cores)
            [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || fail "--cores needs a number, as in --cores 2"
            cores=$((${2} < cores ? ${2} : cores))
            shift
            ;;
        --keep)
            (($# > 1)) || fail "--keep needs a folder, as in --keep /var/tmp/bare"
            [[ ! -e $2 ]] || fail "$2 is there already"
            mkdir -p "$2"
            bare=$(realpath "$2")
            shift
            ;;
        *) fail "unknown option '$1'. See packaging/try_bare.sh --help." ;;
    esac
    shift
done

# shellcheck source=packaging/bare_root.sh
source "$root/packaging/bare_root.sh"
if ! reason=$(checkBareRoot 2>&1); then
    echo "try_bare.sh: NOT TRIED, no bare system can be made here: $reason" >&2
    exit 77
fi
work=$(mktemp -d)
if [[ -z $bare ]]; then
    bare=$(mktemp -d)
    trap 'removeBareRoot "$bare"; rm -rf "$work"' EXIT
else
    trap 'rm -rf "$work"' EXIT
fi

times=()
# step "what it is" COMMAND...
step() {
    local name=$1 started=$SECONDS
    shift
    echo "== $name"
    "$@" || fail "failed: $name"
    times+=("$(printf '%5d s  %s' $((SECONDS - started)) "$name")")
}
inside() {
    runInBareRoot "$bare" sh -c "cd trapwright && exec taskset -c 0-$((cores - 1)) \"\$@\"" sh "$@" < /dev/null
}
# What is printed on the way is looked at only if something fails.
quietly() {
    "$@" > "$work/log" 2>&1 || {
        tail -n 60 "$work/log" >&2
        return 1
    }
}
download() {
    local packages
    mapfile -t packages < <(inside packaging/install.sh --list)
    quietly inside apt-get --quiet --yes update &&
        quietly inside apt-get --quiet --yes --no-install-recommends --download-only install "${packages[@]}"
}

step "bare Debian 12" makeBareRoot "$bare"
step "clone of $(git -C "$root" rev-parse --short HEAD)" git clone --quiet --depth 1 "file://$root" "$work/trapwright"
copyIntoBareRoot "$bare" "$work/trapwright" /root
step "downloads" download
step "packaging/install.sh" quietly inside packaging/install.sh
step "cmake --preset release" quietly inside cmake --preset release
if $build; then
    # From nothing: the build is timed with what a new user's machine has.
    inside rm -rf build
    step "packaging/build.sh release trapwright trapwright-studio" \
        quietly inside env CCACHE_DISABLE=1 packaging/build.sh release trapwright trapwright-studio
    step "packaging/run.sh --headless" inside packaging/run.sh --headless
    inside ls -l trapwright-cuboid
fi
if $tests; then
    step "packaging/build.sh release" quietly inside env CCACHE_DISABLE=1 packaging/build.sh release
fi
echo
echo "try_bare.sh: passed on $cores processors"
printf '%s\n' "${times[@]}"
