#!/usr/bin/env bash
# What a job of ranks costs beside threads: the same generations by one process with two threads and by two ranks of one
# thread each, in turn on the same two processors; then with one rank slowed to a half by another program on its
# processor. Prints a line for each round and the medians.
set -euo pipefail

usage() {
    cat << 'USAGE'
Usage: tests/studies/cluster_efficiency.sh

Needs two processors that do nothing else. From the environment:
    ROUNDS        (5)
    OPTIONS       of the studies ("--preset cuboid --engine native --population 100 --trials 100 --generations 2")
    TRAPWRIGHT    the program
USAGE
}

case "${1:-}" in
    -h | --help)
        usage
        exit 0
        ;;
esac
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=${TRAPWRIGHT:-$root/build/release/app/trapwright/trapwright}
read -ra options <<< "${OPTIONS:---preset cuboid --engine native --population 100 --trials 100 --generations 2}"
if [[ ! -x $program ]]; then
    echo "cluster_efficiency.sh: $program is not there. Build it with packaging/build.sh release, or name one in TRAPWRIGHT." >&2
    exit 2
fi
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
work=$(mktemp -d)
trap 'rm -rf "$work"; kill "${other:-}" 2> /dev/null || true' EXIT

# Trials per second of a study learned anew by this launcher; what the job said of its messages goes to "$work/said".
rate() {
    rm -f "$work"/study.trap*
    "$@" "$program" evolve "$work/study.trap" "${options[@]}" 2> "$work/said" |
        sed -n 's/^Done: .*(\(.*\)\/s)$/\1/p'
}
median() { sort -g | awk '{ v[NR] = $1 } END { printf "%.3f\n", NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'; }

printf 'Two ranks of one thread beside two threads, %s, %s\n' "$(date -u +%Y-%m-%d)" "${options[*]}"
printf '%12s %12s %8s %14s %8s  %s\n' 'threads [/s]' 'ranks [/s]' ratio 'one slow [/s]' 'of 1.5' messages
for ((round = 0; round < ${ROUNDS:-5}; ++round)); do
    threads=$(rate env)
    ranks=$(rate mpirun -n 2 --bind-to core --map-by core)
    said=$(sed -n 's/^trapwright: \(.* tasks\)/\1/p' "$work/said")
    taskset -c 1 sha256sum /dev/zero &
    other=$!
    slow=$(rate mpirun -n 2 --bind-to core --map-by core)
    kill "$other"
    wait "$other" 2> /dev/null || true
    awk -v t="$threads" -v r="$ranks" -v s="$slow" -v said="$said" -v work="$work" 'BEGIN {
        printf "%12.1f %12.1f %8.3f %14.1f %8.3f  %s\n", t, r, r / t, s, s / t / 0.75, said
        printf "%f\n", r / t >> (work "/ratios")
        printf "%f\n", s / t / 0.75 >> (work "/slow")
    }'
done
printf 'Median of the ratios: %s; with a slow rank, of what three quarters of both give: %s\n' \
    "$(median < "$work/ratios")" "$(median < "$work/slow")"
