#!/usr/bin/env bash
# Tries jobs under a real Slurm on virtual nodes of this machine: what is lost when something fails, and whether the
# study is the same as without Slurm, bit for bit.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)

usage() {
    cat << 'USAGE'
Usage: packaging/slurm/try_slurm.sh [--keep DIR] [--only WORD] [PROGRAM]

Starts Slurm with three virtual nodes (packaging/slurm/one_machine.sh: as root, installs what is missing), learns small
studies with packaging/slurm/trapwright.sbatch, ends jobs, ranks and the controller in the middle, and prints a table.
Takes about seven minutes. Exit code 1 if a row is not as it should be.

  --keep DIR    works in DIR, and leaves studies and logs there
  --only WORD   only the rows with WORD in their name
  PROGRAM       the program with support for MPI (default: build/release/app/trapwright/trapwright)
  -h, --help    this text
USAGE
}

fail() {
    printf 'try_slurm.sh: %s\n' "$@" >&2
    exit 1
}

program=
work=
only=
while (($# > 0)); do
    case "$1" in
        -h | --help)
            usage
            exit 0
            ;;
        --keep)
            (($# > 1)) || fail "--keep needs a folder, as in --keep /var/tmp/slurm"
            mkdir -p "$2"
            work=$(realpath "$2")
            shift
            ;;
        --only)
            (($# > 1)) || fail "--only needs a word, as in --only rank"
            only=$2
            shift
            ;;
        -*) fail "unknown option '$1'. See packaging/slurm/try_slurm.sh --help." ;;
        *)
            [[ -z $program ]] || fail "one program only. See packaging/slurm/try_slurm.sh --help."
            program=$1
            ;;
    esac
    shift
done
program=$(realpath "${program:-$root/build/release/app/trapwright/trapwright}")
[[ -x $program ]] || fail "there is no $program. Build it first, or name another."

# Of a job, or of another rank, that this may run in.
unset "${!SLURM_@}" "${!OMPI_@}" "${!PMIX_@}"
export TRAPWRIGHT=$program
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

cleanUp() {
    "$here/one_machine.sh" stop "$work/slurm" || true
    $kept || rm -rf "$work"
}
kept=true
if [[ -z $work ]]; then
    kept=false
    work=$(mktemp -d)
fi
trap cleanUp EXIT
trap 'exit 130' INT TERM HUP
cd "$work"
rm -f ./*.trap ./*.trap.* ./*.out

# What every study is made of; the generations are to be in the order of seconds.
making=(--preset cuboid --population 12 --trials 10 --engine native)

# waitFor SECONDS COMMAND...
waitFor() {
    local end=$((SECONDS + $1))
    shift
    until "$@"; do
        ((SECONDS < end)) || return 1
        sleep 0.2
    done
}
# field JOB NAME: of what Slurm knows of the job. The controller may be away.
field() {
    timeout 10 scontrol --oneliner show job "$1" 2> /dev/null | grep -o " $2=[^ ]*" | head -n 1 | cut -d = -f 2
}
hasState() { [[ " ${*:2} " == *" $(field "$1" JobState) "* ]]; }
hasEnded() { hasState "$1" COMPLETED FAILED CANCELLED TIMEOUT NODE_FAIL OUT_OF_MEMORY; }
# The lines of complete generations in a job's output.
listGenerations() { grep -s -o -E '^ +[0-9]+ +[0-9.]+ ' "$1" | awk '{ print $1 }' || true; }
hasGenerations() { (($(listGenerations "$1" | wc -l) >= $2)); }

submit() {
    job=$(sbatch --parsable --output="$name.out" "$@")
}
# killRank VARIABLE NUMBER: the rank that has this in its environment, as a crash would.
killRank() {
    local file pid=
    # shellcheck disable=SC2013
    for file in $(grep -l -z -s -x "$1=$2" /proc/[0-9]*/environ); do
        if grep -q -z -s -x "SLURM_JOB_ID=$job" "$file" && grep -q -s '^trapwright' "${file%environ}comm"; then
            pid=$(cut -d / -f 3 <<< "$file")
        fi
    done
    [[ -n $pid ]] || pid=none
    kill -KILL "$pid" 2> /dev/null || wrong "rank $2 was not found"
}

nothingRuns() { [[ -z $(timeout 10 squeue --noheader --states=RUNNING,COMPLETING) ]]; }

rows=()
failed=0
problem=
# Keeps the first reason why a row is not as it should be.
wrong() { [[ -n $problem ]] || problem=$1; }
expectState() { [[ $(field "$job" JobState) == "$1" ]] || wrong "the job is $(field "$job" JobState), not $1"; }
expectRestarts() { (($(field "$job" Restarts) == $1)) || wrong "$(field "$job" Restarts) restarts, not $1"; }
expectLine() { grep -q -E -- "$1" "$name.out" || wrong "no '$1' in $name.out"; }
endsWithin() {
    waitFor "$1" hasEnded "$job" || wrong "the job did not end in $1 s"
}

# reference GENERATIONS [SEED]: the same study without Slurm.
reference() {
    local file=reference-$1-${2:-1}.trap
    if [[ ! -e $file ]]; then
        timeout 300 "$program" evolve "$file" "${making[@]}" --generations "$1" --seed "${2:-1}" > "$file.out" 2>&1 ||
            fail "$file could not be learned: see its messages." "$(tail -n 5 "$file.out")"
    fi
    "$program" dump "$file" > "$file.txt"
    echo "$file.txt"
}
same=
compare() {
    same=no
    if "$program" dump "$1" 2> /dev/null | cmp -s - "$(reference "${@:2}")"; then
        same=yes
    fi
    [[ $same == yes ]] || wrong "$1 is another study than on one machine"
}
# How many complete generations were learned again, and how many were in progress when they were dropped.
lost=
countLost() {
    local all different
    all=$(listGenerations "$1" | wc -l)
    different=$(listGenerations "$1" | sort -u | wc -l)
    lost="$((all - different)) generations"
    ((all == different)) || wrong "$((all - different)) generations were learned twice"
    if (($2 > 0)); then
        lost+=", and $2 in progress"
    fi
}
row() {
    local verdict=ok
    if [[ -n $problem ]]; then
        verdict="NOT AS IT SHOULD BE: $problem"
        failed=$((failed + 1))
    fi
    rows+=("$(printf '%-50s | %-32s | %-4s | %s' "$1" "$lost" "$same" "$verdict")")
    echo "${rows[-1]}"
    scancel --full --signal=KILL "$job" > /dev/null 2>&1 || true
    scancel "$job" > /dev/null 2>&1 || true
    # The next needs the nodes.
    waitFor 60 nothingRuns || fail "a job does not end."
}
wanted() {
    name=$1
    problem=
    lost=
    same=
    job=
    [[ $2 == *"$only"* ]]
}
batch=$here/trapwright.sbatch
three=(--nodes 3 --ntasks 4)

export SLURM_CONF=$work/slurm/slurm.conf
"$here/one_machine.sh" start "$work/slurm" > /dev/null
reference 3 > /dev/null
started=$SECONDS

what="submitted and finished"
if wanted plain "$what"; then
    submit "${three[@]}" "$batch" plain.trap "${making[@]}" --generations 3
    endsWithin 60
    expectState COMPLETED
    expectRestarts 0
    expectLine "ranks on 3 machines"
    compare plain.trap 3
    countLost plain.out 0
    row "$what"
fi

what="the same with srun --mpi=pmix"
if wanted pmix "$what"; then
    TRAPWRIGHT_LAUNCH="srun --mpi=pmix" submit "${three[@]}" "$batch" pmix.trap "${making[@]}" --generations 3
    endsWithin 60
    expectState COMPLETED
    expectLine "ranks on 3 machines"
    compare pmix.trap 3
    countLost pmix.out 0
    row "$what"
fi

# Slurm looks every 30 s: that is 10 s after the start.
what="end of its time, queued again by itself, finished"
if wanted time "$what"; then
    submit "${three[@]}" --time 1 --signal=B:USR1@20 "$batch" time.trap "${making[@]}" --generations 50
    waitFor 90 grep -q -s "its time is over" time.out || wrong "no warning in 90 s"
    scontrol update JobId="$job" TimeLimit=10
    endsWithin 150
    expectState COMPLETED
    expectRestarts 1
    expectLine "stopped|its time is over"
    compare time.trap 50
    countLost time.out 0
    row "$what"
fi

# What stands for the program does not stop at the warning, as in a generation that takes longer than what is left.
what="end of its time before the generation's"
if wanted late "$what"; then
    cat > late.sh << 'LATE'
#!/bin/sh
[ "$1" != dump ] || { echo 7; exit; }
[ "$SLURM_RESTART_COUNT" != 1 ] || exit 0
trap '' USR1
trap 'exit 130' TERM
while :; do sleep 0.2; done
LATE
    chmod +x late.sh
    TRAPWRIGHT=$work/late.sh submit --ntasks 2 --time 1 --signal=B:USR1@10 "$batch" late.trap
    endsWithin 200
    expectState COMPLETED
    expectRestarts 1
    expectLine "its time is over.*after generation 7"
    lost="0 generations, and 1 in progress"
    same=-
    row "$what"
fi

what="scontrol requeue in the middle"
if wanted requeue "$what"; then
    submit "${three[@]}" "$batch" requeue.trap "${making[@]}" --generations 16
    waitFor 60 hasGenerations requeue.out 4 || wrong "no 4 generations in 60 s"
    scontrol requeue "$job"
    endsWithin 120
    expectState COMPLETED
    expectRestarts 1
    compare requeue.trap 16
    countLost requeue.out 1
    row "$what"
fi

for number in 3 0; do
    what="kill -9 of rank $number, queued again by itself"
    if wanted "rank$number" "$what"; then
        submit "${three[@]}" "$batch" "$name.trap" "${making[@]}" --generations 16
        waitFor 60 hasGenerations "$name.out" 4 || wrong "no 4 generations in 60 s"
        killRank OMPI_COMM_WORLD_RANK "$number"
        endsWithin 120
        expectState COMPLETED
        expectRestarts 1
        expectLine "a rank was lost or failed"
        compare "$name.trap" 16
        countLost "$name.out" 1
        row "$what"
    fi
done

what="kill -9 of rank 3 under srun --mpi=pmix"
if wanted pmixrank "$what"; then
    TRAPWRIGHT_LAUNCH="srun --mpi=pmix" submit "${three[@]}" "$batch" pmixrank.trap "${making[@]}" --generations 16
    waitFor 60 hasGenerations pmixrank.out 4 || wrong "no 4 generations in 60 s"
    killRank PMIX_RANK 3
    endsWithin 120
    expectState COMPLETED
    expectRestarts 1
    expectLine "a rank was lost or failed"
    compare pmixrank.trap 16
    countLost pmixrank.out 1
    row "$what"
fi

what="kill -9 of the controller, started again"
if wanted controller "$what"; then
    submit "${three[@]}" "$batch" controller.trap "${making[@]}" --generations 16
    waitFor 60 hasGenerations controller.out 4 || wrong "no 4 generations in 60 s"
    "$here/one_machine.sh" controller "$work/slurm" kill
    waitFor 60 hasGenerations controller.out 8 || wrong "no 8 generations without a controller"
    "$here/one_machine.sh" controller "$work/slurm" start
    endsWithin 120
    expectState COMPLETED
    expectRestarts 0
    compare controller.trap 16
    countLost controller.out 0
    row "$what"
fi

what="scancel, and the same command again"
if wanted cancel "$what"; then
    submit "${three[@]}" "$batch" cancel.trap "${making[@]}" --generations 16
    waitFor 60 hasGenerations cancel.out 4 || wrong "no 4 generations in 60 s"
    scancel "$job"
    endsWithin 60
    expectState CANCELLED
    expectRestarts 0
    waitFor 60 nothingRuns || wrong "it is still there after 60 s"
    submit "${three[@]}" "$batch" cancel.trap "${making[@]}" --generations 16
    endsWithin 120
    expectState COMPLETED
    compare cancel.trap 16
    countLost cancel.out 1
    row "$what"
fi

what="srun with 4 single ranks by mistake: refused"
if wanted mistake "$what"; then
    code=0
    timeout 60 srun "${three[@]}" --mpi=none "$program" evolve mistake.trap "${making[@]}" --generations 3 \
        > mistake.out 2>&1 || code=$?
    ((code == 2)) || wrong "code $code, not 2"
    expectLine "know nothing of each other"
    [[ ! -e mistake.trap ]] || wrong "it made a study all the same"
    lost="no study made"
    same=-
    row "$what"
fi

what="an array of 3 seeds"
if wanted array "$what"; then
    submit --array 1-3 --ntasks 2 --output=array-%a.out "$batch" array.trap "${making[@]}" --generations 3
    for seed in 1 2 3; do
        waitFor 90 hasEnded "${job}_$seed" || wrong "number $seed did not end in 90 s"
        [[ $(field "${job}_$seed" JobState) == COMPLETED ]] || wrong "number $seed is $(field "${job}_$seed" JobState)"
        compare "array-$seed.trap" 3 "$seed"
        countLost "array-$seed.out" 0
    done
    ! cmp -s reference-3-1.trap.txt reference-3-2.trap.txt || wrong "the seeds make no difference"
    row "$what"
fi

what="the program always fails: given up after 5 restarts"
if wanted hopeless "$what"; then
    printf '#!/bin/sh\nexit 6\n' > hopeless.sh
    chmod +x hopeless.sh
    TRAPWRIGHT=$work/hopeless.sh submit --ntasks 2 "$batch" hopeless.trap "${making[@]}" --generations 3
    endsWithin 200
    expectState FAILED
    expectRestarts 5
    expectLine "given up"
    lost="no study made"
    same=-
    row "$what"
fi

((${#rows[@]} > 0)) || fail "no row has '$only' in its name."
echo
printf '%-50s | %-32s | %-4s |\n' what lost same
printf '%s\n' "${rows[@]}"
echo "try_slurm.sh: ${#rows[@]} rows, $failed not as they should be; $((SECONDS - started)) s"
((failed == 0))
