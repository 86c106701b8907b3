#!/usr/bin/env bash
# Installs, builds and opens the studio, or runs Trapwright's main job where there is no display.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
program=$root/build/release/app/trapwright/trapwright
studio=$root/build/release/app/studio/trapwright-studio

usage() {
    cat << 'USAGE'
Usage: packaging/run.sh [--headless] [--out DIR] [OPTION...]

Installs what is missing, builds Trapwright and opens the studio.

Without a display, or with any option, it designs a track for the 4 x 8 x 12 mm cuboid instead: learns for a few
generations, picks the best track, validates it and writes it for printing. Takes at most 5 minutes after the build.

  --headless   no window, although there is a display
  --out DIR    where the study and the track go (default: ./trapwright-cuboid)
  -h, --help   this text
Every other option is passed on to `trapwright demo`; its --help lists them.
USAGE
}

out=$PWD/trapwright-cuboid
options=()
windows=false
if (($# == 0)) && [[ -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]]; then
    windows=true
fi
while (($# > 0)); do
    case "$1" in
        -h | --help)
            usage
            exit 0
            ;;
        --headless) ;;
        --out)
            if (($# < 2)); then
                echo "run.sh: --out needs a folder, as in --out ./my-study" >&2
                exit 2
            fi
            out=$2
            shift
            ;;
        --out=*) out=${1#--out=} ;;
        *) options+=("$1") ;;
    esac
    shift
done

"$root/packaging/install.sh"
"$root/packaging/build.sh" release trapwright trapwright-studio

if $windows; then
    exec "$studio"
fi
echo
"$program" demo --out "$out" "${options[@]}"
echo
echo "The study and the track are in $out"
echo "The program is $program"
