#!/usr/bin/env bash
# Installs, builds and runs Trapwright's main job.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
program=$root/build/release/app/trapwright/trapwright

usage() {
    cat << 'USAGE'
Usage: packaging/run.sh [--headless] [--out DIR] [OPTION...]

Installs what is missing, builds Trapwright and designs a track for the 4 x 8 x 12 mm cuboid: learns for a few
generations, picks the best track, validates it and writes it for printing. Takes at most 5 minutes after the build.

  --headless   no window; this is what always happens without a display
  --out DIR    where the study and the track go (default: ./trapwright-cuboid)
  -h, --help   this text
Every other option is passed on to `trapwright demo`; its --help lists them.
USAGE
}

out=$PWD/trapwright-cuboid
options=()
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
"$root/packaging/build.sh" release

echo
"$program" demo --out "$out" "${options[@]}"
echo
echo "The study and the track are in $out"
echo "The program is $program"
