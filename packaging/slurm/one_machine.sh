#!/usr/bin/env bash
# A Slurm cluster of virtual nodes on this one machine, to try jobs with: Debian's packages, no systemd, no cgroups.
set -euo pipefail

packages=(munge openmpi-bin slurm-client slurmctld slurmd)

usage() {
    cat << USAGE
Usage: packaging/slurm/one_machine.sh start DIR [--nodes N] [--cpus N]
       packaging/slurm/one_machine.sh controller DIR start|kill
       packaging/slurm/one_machine.sh stop DIR

Starts Slurm with virtual nodes v1, v2 ... on this machine's loopback and prints the line that makes Slurm's commands
use it. As root; installs what is missing of ${packages[*]}. What it writes is in DIR.

  --nodes N    so many nodes (default: 3)
  --cpus N     each with so many processors, whatever the machine has (default: 2)
  controller   starts Slurm's controller again, or kills it as a crash would
  stop         ends the jobs and all that was started, and leaves the logs in DIR
  -h, --help   this text

Several of these can run at once, each in a folder of its own.
USAGE
}

fail() {
    printf 'one_machine.sh: %s\n' "$@" >&2
    exit 1
}

for argument in "$@"; do
    if [[ $argument == -h || $argument == --help ]]; then
        usage
        exit 0
    fi
done
(($# >= 2)) || fail "what, and in which folder? See packaging/slurm/one_machine.sh --help."
action=$1
mkdir -p "$2"
dir=$(realpath "$2")
shift 2
# Slurm reads names of files up to a space or a comma.
[[ $dir =~ ^[A-Za-z0-9_./-]+$ ]] || fail "the folder's name must have only letters, digits and any of _ . / -: $dir"
((EUID == 0)) || fail "needs root: Slurm's nodes start the jobs of any user."
# Of a job that this may run in.
unset "${!SLURM_@}"
export SLURM_CONF=$dir/slurm.conf

installMissing() {
    local missing=() package state
    for package in "${packages[@]}"; do
        state=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2> /dev/null || true)
        [[ $state == installed ]] || missing+=("$package")
    done
    if ((${#missing[@]} == 0)); then
        return
    fi
    echo "Installing ${missing[*]} and what they need" >&2
    local apt=(env DEBIAN_FRONTEND=noninteractive apt-get --quiet --yes -o DPkg::Lock::Timeout=300)
    "${apt[@]}" update > "$dir/apt.log" 2>&1 < /dev/null || true
    "${apt[@]}" install --no-install-recommends "${missing[@]}" >> "$dir/apt.log" 2>&1 < /dev/null ||
        fail "apt could not install them: see $dir/apt.log."
}

# waitFor SECONDS COMMAND...
waitFor() {
    local end=$((SECONDS + $1))
    shift
    until "$@" > /dev/null 2>&1; do
        ((SECONDS < end)) || return 1
        sleep 0.2
    done
}

# A port that nobody listens on, from the given one up.
freePort() {
    local port=$1
    while [[ -n $(ss --tcp --listening --numeric --no-header "sport = :$port") ]]; do
        port=$((port + 1))
    done
    echo "$port"
}

# Debian builds Slurm with --enable-multiple-slurmd: a slurmd for each node, all on this machine, each with its port.
writeConfiguration() {
    local nodes=$1 cpus=$2 port node host
    host=$(hostname --short)
    # Another that starts at the same moment, in another folder, looks elsewhere.
    port=$(freePort $((16817 + $(cksum <<< "$dir" | cut -d ' ' -f 1) % 500 * 20)))
    cat > "$SLURM_CONF" << CONF
ClusterName=one_machine
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmctldParameters=idle_on_node_suspend
SlurmdParameters=config_overrides
SlurmUser=root
SlurmdUser=root
# The wait of a job that is queued again is as long as a credential lives: two minutes by default.
AuthType=auth/munge
AuthInfo=socket=$dir/munge.socket,cred_expire=10
StateSaveLocation=$dir/state
SlurmctldPidFile=$dir/slurmctld.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdSpoolDir=$dir/%n
# Slurm's PMIx makes a folder here that has no node in its name.
TmpFS=$dir/%n/tmp
SlurmdPidFile=$dir/slurmd-%n.pid
SlurmdLogFile=$dir/slurmd-%n.log
SlurmctldDebug=verbose
SlurmdDebug=verbose
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=2,bf_interval=2
ReturnToService=2
MpiDefault=none
MinJobAge=3600
KillWait=10
SlurmctldTimeout=60
SlurmdTimeout=60
PartitionName=all Nodes=v[1-$nodes] Default=YES MaxTime=INFINITE State=UP
CONF
    port=$((port + 1))
    for ((node = 1; node <= nodes; node++)); do
        port=$(freePort "$port")
        echo "NodeName=v$node NodeHostname=v$node NodeAddr=127.0.0.1 Port=$port CPUs=$cpus RealMemory=1000" \
            >> "$SLURM_CONF"
        port=$((port + 1))
    done
}

# The daemons have this folder in their command line. What belongs to a job has the configuration and the job's number
# in its environment; a shell that only uses Slurm has no such number.
listProcesses() {
    local pid line
    for pid in $(pgrep -x munged; pgrep -x slurmctld; pgrep -x slurmd); do
        line=$({ tr '\0' ' ' < "/proc/$pid/cmdline"; } 2> /dev/null) || continue
        [[ $line != *"$dir/"* ]] || echo "$pid"
    done
    # shellcheck disable=SC2013
    for pid in $(grep -l -z -s -F -x "SLURM_CONF=$SLURM_CONF" /proc/[0-9]*/environ | grep -o '[0-9]*'); do
        ! grep -q -z -s '^SLURM_JOB_ID=' "/proc/$pid/environ" || echo "$pid"
    done
}

startController() {
    slurmctld -f "$SLURM_CONF" "$@" < /dev/null >> "$dir/slurmctld.out" 2>&1 || return 1
    waitFor 20 scontrol ping
}

# Each node has a host name and shared memory of its own: Open MPI names what it shares by the host and the number of
# the rank on it, so that two nodes of one name would write into each other's, and crash.
startNode() {
    # shellcheck disable=SC2016
    local commands='hostname "$1"; mount -t tmpfs tmpfs /dev/shm; exec slurmd -f "$SLURM_CONF" -N "$1"'
    unshare --uts --mount sh -e -c "$commands" sh "$1" < /dev/null > "$dir/slurmd-$1.out" 2>&1 ||
        fail "node $1 did not start: see $dir/slurmd-$1.out and .log."
}

start() {
    local nodes=3 cpus=2 node
    while (($# > 0)); do
        case "$1" in
            --nodes | --cpus)
                [[ ${2:-} =~ ^[1-9][0-9]?$ ]] || fail "$1 needs a number below 100, as in $1 3"
                if [[ $1 == --nodes ]]; then nodes=$2; else cpus=$2; fi
                shift
                ;;
            *) fail "unknown option '$1'. See packaging/slurm/one_machine.sh --help." ;;
        esac
        shift
    done
    [[ -z $(listProcesses) ]] || fail "it runs already in $dir: stop it first."
    installMissing
    rm -rf "$dir"/{state,v*,munge*,*.log,*.pid,*.out}
    mkdir -p "$dir/state"
    for ((node = 1; node <= nodes; node++)); do
        mkdir -p "$dir/v$node/tmp"
    done
    writeConfiguration "$nodes" "$cpus"
    # The logs stay.
    trap 'stop > /dev/null' EXIT
    (umask 077 && head -c 1024 /dev/urandom > "$dir/munge.key")
    munged --force --key-file="$dir/munge.key" --socket="$dir/munge.socket" --pid-file="$dir/munged.pid" \
        --log-file="$dir/munged.log" --seed-file="$dir/munge.seed" --num-threads=2 > "$dir/munged.out" 2>&1
    waitFor 10 munge --socket="$dir/munge.socket" --no-input || fail "munged does not answer: see $dir/munged.log."
    startController -c || fail "the controller did not start: see $dir/slurmctld.log."
    for ((node = 1; node <= nodes; node++)); do
        startNode "v$node"
    done
    waitFor 30 nodesAreIdle "$nodes" || fail "not all nodes came up: see $dir/slurmd-*.log."
    trap - EXIT
    echo "export SLURM_CONF=$SLURM_CONF"
}

nodesAreIdle() {
    (($(sinfo --noheader --Node --states=idle --format=%N | sort -u | wc -l) == $1))
}

hasGone() { ! grep -q . "/proc/$1/cmdline" 2> /dev/null; }
allHaveGone() { [[ -z $(listProcesses) ]]; }
noJobs() { [[ -z $(timeout 5 squeue --noheader) ]]; }

killController() {
    local pid
    pid=$(cat "$dir/slurmctld.pid" 2> /dev/null) || fail "no controller was started in $dir."
    # The number may be of another process by now.
    [[ $'\n'$(listProcesses)$'\n' == *$'\n'$pid$'\n'* ]] || fail "the controller of $dir does not run."
    kill -KILL "$pid"
    # Where nobody asks how it ended something of it stays, but no command line.
    waitFor 10 hasGone "$pid"
}

stop() {
    trap - EXIT
    if timeout 5 scontrol ping > /dev/null 2>&1; then
        timeout 10 scancel --state=PENDING --user=root || true
        timeout 10 scancel --signal=KILL --full --state=RUNNING --user=root || true
        timeout 10 scancel --user=root || true
        waitFor 15 noJobs || true
    fi
    local signal pids
    for signal in TERM KILL; do
        mapfile -t pids < <(listProcesses)
        if ((${#pids[@]} == 0)); then
            break
        fi
        kill "-$signal" "${pids[@]}" 2> /dev/null || true
        waitFor 10 allHaveGone || true
    done
    mapfile -t pids < <(listProcesses)
    ((${#pids[@]} == 0)) || fail "these processes do not end: ${pids[*]}"
}

case "$action" in
    start) start "$@" ;;
    controller)
        case "${1:-}" in
            start) startController || fail "the controller did not start: see $dir/slurmctld.log." ;;
            kill) killController ;;
            *) fail "controller start, or controller kill?" ;;
        esac
        ;;
    stop) stop ;;
    *) fail "start, controller or stop, not '$action'. See packaging/slurm/one_machine.sh --help." ;;
esac
