#!/usr/bin/env bash
# How quick the studio's window is while a study learns on every processor: prints the time to its first frame, how late
# events were answered in each ten seconds, and the memory it takes.
set -euo pipefail

usage() {
    cat << 'USAGE'
Usage: tests/studies/responsiveness.sh [GENERATIONS]

Learns so many generations (default: 200) of the cuboid with the Evolve page shown, on a screen of its own with OpenGL in
software. From the environment:
    OPTIONS   of the study ("--population 40 --trials 40 --engine hybrid")
USAGE
}

case "${1:-}" in
    -h | --help)
        usage
        exit 0
        ;;
esac
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$root/build/release
probe=$build/tests/ui/responsiveness
read -ra options <<< "${OPTIONS:---population 40 --trials 40 --engine hybrid}"
if [[ ! -x $probe ]]; then
    echo "responsiveness.sh: $probe is not there. Build it with packaging/build.sh release." >&2
    exit 2
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$build/app/trapwright/trapwright" new "$work/cuboid.trap" --preset cuboid --generations 100000 "${options[@]}"
echo "Responsiveness of the studio, $(date -u +%Y-%m-%d), $(nproc) processors, ${options[*]}"
LIBGL_ALWAYS_SOFTWARE=1 QT_QPA_PLATFORM=xcb xvfb-run -a -s "-screen 0 1920x1080x24 +extension GLX" \
    "$probe" "$work/cuboid.trap" "${1:-200}"
