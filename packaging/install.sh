#!/usr/bin/env bash
# Installs with apt everything that building, running and testing Trapwright needs on Debian 12.
set -euo pipefail

packages=(
    # tools
    build-essential ccache clang-format-14 clang-tidy-14 cmake git ninja-build pkg-config
    # sanitizers and fuzzing: the compiler, their runtime, names of functions in reports
    clang-14 libclang-rt-14-dev llvm-14
    # numbers and random streams
    libboost-dev libeigen3-dev librandom123-dev
    # parts and tracks: reading, repairing, taking apart, writing
    lib3mf-dev libassimp-dev libcgal-dev libmeshoptimizer-dev
    libocct-data-exchange-dev libocct-foundation-dev libocct-modeling-algorithms-dev libocct-modeling-data-dev
    # what OpenCASCADE's and lib3mf's packages link to, but leave out of their dependencies
    libtbb-dev libzip-dev
    # simulation
    libhwy-dev libsimbody-dev
    # one job on many machines
    libopenmpi-dev openmpi-bin
    # studies and the command line
    libcli11-dev libfmt-dev libsqlite3-dev libsqlitecpp-dev libzstd-dev nlohmann-json3-dev
    # the studio: window, charts, icons, 3D scene, films
    ffmpeg fonts-dejavu-core libgl1-mesa-dri libqt6opengl6-dev libvtk9-dev qt6-base-dev qt6-charts-dev qt6-svg-dev
    # the drives of feeders: Modbus and serial ports
    qt6-serialbus-dev qt6-serialport-dev
    # tests, those with windows on a screen of their own; a Modbus device and client of somebody else
    python3-pymodbus python3-serial python3-serial-asyncio xauth xvfb
    # what reads the reports that the tests write
    poppler-utils
    # bare systems to try the first command in (try_bare.sh, try_debs.sh)
    mmdebstrap uidmap
    # what packages have beside the programs, and what looks at it: manual pages, completions, desktop metadata
    appstream bash-completion desktop-file-utils help2man zsh
)
# for making Debian packages and looking at them
debs=(file librsvg2-bin lintian)
# other simulators that tests/peers measures against, and what draws its chart
peers=(gnuplot-nox libbullet-dev libmujoco-dev libode-dev)

usage() {
    cat <<USAGE
Usage: packaging/install.sh [--debs] [--peers] [--list]

Installs, as root or through sudo, the Debian 12 packages that Trapwright is built, run and tested with.
Does nothing when all of them are there. The packages:

$(printf '%s\n' "${packages[@]}" | sort | fmt -w 100)

  --list       prints the names of the packages, one a line, and installs nothing
  --debs       also those for making Debian packages: ${debs[*]}
  --peers      also those for the comparison with other simulators (tests/peers): ${peers[*]}
  -h, --help   this text
USAGE
}

fail() {
    printf 'install.sh: %s\n' "$@" >&2
    exit 1
}

list=false
for argument in "$@"; do
    case "$argument" in
        -h | --help)
            usage
            exit 0
            ;;
        --list) list=true ;;
        --debs) packages+=("${debs[@]}") ;;
        --peers) packages+=("${peers[@]}") ;;
        *) fail "unknown option '$argument'. See packaging/install.sh --help." ;;
    esac
done

if $list; then
    printf '%s\n' "${packages[@]}"
    exit 0
fi

if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
    fail "this system has no apt. Install what packaging/install.sh --help lists with your own package manager," \
        "then: cmake --preset release && cmake --build --preset release"
fi

missing=()
for package in "${packages[@]}"; do
    state=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2> /dev/null || true)
    [[ $state == installed ]] || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
    exit 0
fi

asRoot=()
if ((EUID != 0)); then
    command -v sudo > /dev/null ||
        fail "these packages are missing and installing them needs root or sudo: ${missing[*]}"
    asRoot=(sudo)
fi
# Waiting for the lock: a fresh machine is often still busy with its own upgrades.
apt=(env DEBIAN_FRONTEND=noninteractive apt-get --quiet --yes -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3)

echo "Installing ${#missing[@]} packages and what they need: ${missing[*]}"
# An unreachable third-party source must not stop us, so what decides is whether the packages are found.
"${asRoot[@]}" "${apt[@]}" update < /dev/null ||
    echo "install.sh: apt could not refresh every package list; going on with what it has." >&2
for package in "${missing[@]}"; do
    if ! apt-cache show "$package" > /dev/null 2>&1; then
        fail "apt does not know the package '$package'." \
            "Is the network there, is this Debian 12 (bookworm), and is 'main' in /etc/apt/sources.list?"
    fi
done
if ! "${asRoot[@]}" "${apt[@]}" install --no-install-recommends "${missing[@]}" < /dev/null; then
    fail "apt could not install everything; its messages are above. Check the network and the disk's free space," \
        "then run packaging/install.sh again: it goes on where it stopped."
fi
