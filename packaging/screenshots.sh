#!/usr/bin/env bash
# Takes a picture of every page of the studio, of the welcome and of the dialogs: light and dark, small, large, and
# small at two pixels per point, on a screen of its own.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release

usage() {
    cat << 'USAGE'
Usage: packaging/screenshots.sh [--out DIR] [--study FILE]

  --out DIR      where the pictures go (default: ./trapwright-screenshots)
  --study FILE   a study to show (default: a small one is learned first, 24 generations)
  -h, --help     this text
USAGE
}

fail() {
    printf 'screenshots.sh: %s\n' "$@" >&2
    exit 1
}

out=$PWD/trapwright-screenshots
study=
while (($# > 0)); do
    case "$1" in
        -h | --help)
            usage
            exit 0
            ;;
        --out | --study)
            (($# > 1)) || fail "$1 needs a name after it"
            if [[ $1 == --out ]]; then out=$2; else study=$2; fi
            shift
            ;;
        *) fail "unknown option '$1'. See packaging/screenshots.sh --help." ;;
    esac
    shift
done
camera=$build/tests/ui/screenshots
[[ -x $camera ]] || fail "there is no $camera; packaging/build.sh makes it."
command -v xvfb-run > /dev/null || fail "xvfb-run is not installed; packaging/install.sh does it."
mkdir -p "$out"
out=$(realpath "$out")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

learned=$work/cuboid.trap
if [[ -n $study ]]; then
    cp -- "$study" "$learned"
else
    "$build/app/trapwright/trapwright" evolve "$learned" --preset cuboid --generations 24 --population 20 --trials 20
fi
"$build/app/trapwright/trapwright" new "$work/fresh.trap" --preset cuboid

# Two folders: what of a study that learned, and of one whose settings are still free.
shoot() {
    local size=$1 scale=$2 theme=$3 name=$4
    for which in learned fresh; do
        mkdir -p "$out/$which"
        # Each picture's window may change its study, and a reader that was cut off may leave a journal beside it.
        rm -f "$work"/shown.trap*
        cp -- "$([[ $which == fresh ]] && echo "$work/fresh.trap" || echo "$learned")" "$work/shown.trap"
        QT_SCALE_FACTOR=$scale LIBGL_ALWAYS_SOFTWARE=1 QT_QPA_PLATFORM=xcb \
            xvfb-run -a -s "-screen 0 2560x1440x24 +extension GLX" \
            "$camera" "$out/$which" "$work/shown.trap" "$size" "$theme" "$name"
    done
}
for theme in light dark; do
    shoot 1280x720 1 "$theme" "1280x720-$theme"
    shoot 2560x1440 1 "$theme" "2560x1440-$theme"
    shoot 1280x720 2 "$theme" "1280x720x2-$theme"
done
echo "The pictures are in $out"
