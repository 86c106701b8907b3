#!/usr/bin/env bash
# Builds the Debian packages trapwright, trapwright-mpi and trapwright-studio.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=$root/build/debs

usage() {
    cat << 'USAGE'
Usage: packaging/make_debs.sh [--out DIR]

Installs what is missing, builds both programs without their tests, makes the Debian packages of them, has lintian look
at them, and names the files. Install them with: apt install ./trapwright*.deb

  --out DIR    where the packages go (default: build/debs)
  -h, --help   this text

DEBFULLNAME and DEBEMAIL name the maintainer, as with Debian's own tools.
USAGE
}

while (($# > 0)); do
    case "$1" in
        -h | --help)
            usage
            exit 0
            ;;
        --out)
            if (($# < 2)); then
                echo "make_debs.sh: --out needs a folder, as in --out ./debs" >&2
                exit 2
            fi
            out=$2
            shift
            ;;
        --out=*) out=${1#--out=} ;;
        *)
            echo "make_debs.sh: unknown option '$1'. See packaging/make_debs.sh --help." >&2
            exit 2
            ;;
    esac
    shift
done

"$root/packaging/install.sh" --debs
SECONDS=0
"$root/packaging/build.sh" packages
echo "Built in $SECONDS s."

SECONDS=0
mkdir -p "$out"
rm -f "$out"/trapwright*.deb
# What is not world-readable in the clone is so in the package.
umask 022
(cd "$root/build/packages" && cpack -B "$out")
rm -rf "$out/_CPack_Packages"
echo "Packed in $SECONDS s."

options=(--fail-on error --suppress-tags initial-upload-closes-no-bugs)
((EUID != 0)) || options+=(--allow-root)
# A package for the own machines needs no address that the world can reach.
[[ -n ${DEBEMAIL:-} ]] ||
    options+=(--suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog,root-in-contact,mail-address-loops-or-bounces)
lintian "${options[@]}" "$out"/trapwright*.deb
echo
for package in "$out"/trapwright*.deb; do
    printf '%s  %s bytes, %s kB installed\n' "$package" "$(stat -c %s "$package")" "$(dpkg-deb --field "$package" Installed-Size)"
    dpkg-deb --field "$package" Depends Recommends Suggests
done
