#!/usr/bin/env bash
# The learning study: cuboid and cone, 40 generations of 40 individuals with 20 trials each, then selection of the
# ten highest winners by 1000 trials and validation by 1000 trials per stable pose. About half an hour on 2 cores.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=${TRAPWRIGHT:-$root/build/release/app/trapwright/trapwright}
out=${1:-$PWD/trapwright-learning}
seed=${2:-1}
if [[ ! -x $program ]]; then
    echo "learning.sh: $program is not there. Build it with packaging/build.sh release, or name one in TRAPWRIGHT." >&2
    exit 2
fi

mkdir -p "$out"
for part in cuboid cone; do
    study=$out/$part-seed$seed.trap
    echo "== $part, seed $seed, $(date -u +%Y-%m-%d) =="
    "$program" evolve "$study" --preset "$part" --population 40 --trials 20 --generations 40 --seed "$seed"
    "$program" select "$study"
    "$program" validate "$study"
    "$program" export "$study"
done
