#!/usr/bin/env bash
# Hours of the studio in minutes: memory, threads and open files while thousands of generations are learned and runs
# are started and stopped, and how quick a large study is to open and to look through.
set -euo pipefail

usage() {
    cat << 'USAGE'
Usage: tests/studies/soak.sh [learn | restart | open]...

  learn     2000 generations of a small study with the Evolve page shown
  restart   1000 starts and stops
  open      a study of 2000 generations of 200 individuals: opened, and every list scrolled through

All three without an argument; about 30 minutes on 2 cores. Each has a screen of its own, with OpenGL in software.
From the environment: GENERATIONS (2000), POPULATION (200, of the large study), STARTS (1000).
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
soak=$build/tests/ui/soak
trapwright=$build/app/trapwright/trapwright
if [[ ! -x $soak ]]; then
    echo "soak.sh: $soak is not there. Build it with packaging/build.sh release." >&2
    exit 2
fi
generations=${GENERATIONS:-2000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export LIBGL_ALWAYS_SOFTWARE=1 QT_QPA_PLATFORM=xcb XDG_RUNTIME_DIR=$work

run() {
    xvfb-run -a -s "-screen 0 1920x1080x24 +extension GLX" "$soak" "$@"
}

small() {
    "$trapwright" new "$work/$1.trap" --preset cuboid --population 10 --trials 2 --generations 1000000 --engine native > /dev/null
}

echo "Soak of the studio, $(date -u +%Y-%m-%d), $(nproc) processors"
(($# > 0)) || set -- learn restart open
for part in "$@"; do
    echo
    case "$part" in
        learn)
            small learn
            echo "$generations generations of 10 individuals, 2 trials each, in the window"
            run learn "$work/learn.trap" "$generations"
            ;;
        restart)
            small restart
            echo "Starts and stops"
            run restart "$work/restart.trap" "${STARTS:-1000}"
            ;;
        open)
            # Trials as short as can be: what is looked at is how much there is of it.
            "$trapwright" new "$work/open.trap" --preset cuboid --population "${POPULATION:-200}" --trials 1 \
                --generations "$generations" --engine native --set simulation.termination.timeLimit_s=0.1 \
                --set simulation.termination.stuckTime_s=0.1 > /dev/null
            "$trapwright" evolve "$work/open.trap" --resume | tail -n 1
            echo "A large study of $(du -h --apparent-size "$work/open.trap" | cut -f 1)"
            run open "$work/open.trap"
            run open "$work/open.trap" | head -n 1
            ;;
        *)
            echo "soak.sh: '$part' is none of learn, restart, open." >&2
            exit 2
            ;;
    esac
done
