#!/usr/bin/env bash
# Tries the Debian packages where nothing of Trapwright has ever been: a bare Debian root.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$root/packaging/bare_root.sh"
debs=$root/build/debs
picture=

usage() {
    cat << 'USAGE'
Usage: packaging/try_debs.sh [--debs DIR] [--picture FILE]

In a bare Debian 12 root: installs both packages with apt, uses the command line on a part that comes with them, opens
the studio on a screen of its own, opens a study with xdg-open, looks up manual pages and completions, purges the
packages, and compares the files that there are with those from before. Ends with 1 where anything of that fails.

  --debs DIR       where the packages are (default: build/debs, made by make_debs.sh if there are none)
  --picture FILE   keep a picture of the studio with the study (PNG; needs ImageMagick)
  -h, --help       this text
USAGE
}

while (($# > 0)); do
    case "$1" in
        -h | --help)
            usage
            exit 0
            ;;
        --debs | --picture)
            if (($# < 2)); then
                echo "try_debs.sh: $1 needs a path" >&2
                exit 2
            fi
            if [[ $1 == --debs ]]; then debs=$2; else picture=$2; fi
            shift
            ;;
        *)
            echo "try_debs.sh: unknown option '$1'. See packaging/try_debs.sh --help." >&2
            exit 2
            ;;
    esac
    shift
done

if ! checkBareRoot; then
    echo "try_debs.sh: the packages cannot be tried here." >&2
    exit 1
fi
compgen -G "$debs/trapwright*.deb" > /dev/null || "$root/packaging/make_debs.sh" --out "$debs"

bare=$(mktemp -d)
trap 'removeBareRoot "$bare"' EXIT

# step "WHAT" COMMAND...: with its time; the output is shown where it fails.
step() {
    local what=$1 begin=$EPOCHREALTIME log
    shift
    log=$(mktemp)
    if "$@" > "$log" 2>&1; then
        printf '%-66s %6.1f s\n' "$what" "$(awk "BEGIN { print $EPOCHREALTIME - $begin }")"
        grep '^> ' "$log" || true
        rm -f "$log"
    else
        printf 'FAILED: %s\n' "$what"
        cat "$log"
        rm -f "$log"
        exit 1
    fi
}

# A script inside the root, from standard input, that stops at the first thing that fails.
inside() {
    runInBareRoot "$bare" bash -euo pipefail -c "$(cat)" < /dev/null
}

listFiles() {
    # Not the files that apt and dpkg keep about themselves, and not those of the user.
    inside << 'INSIDE'
find / -xdev \( -path /proc -o -path /dev -o -path /sys -o -path /tmp -o -path /root -o -path /debs -o -path /run \
    -o -path /var/lib/dpkg -o -path /var/lib/apt -o -path /var/cache/apt -o -path /var/log \) -prune -o -print | sort
INSIDE
}

makeRoot() { makeBareRoot "$bare"; }

installTools() {
    inside << 'INSIDE'
apt-get --quiet update
# What a desktop has: a screen, xdg-open and what it asks for types of files, manual pages, shells.
apt-get --quiet --yes install --no-install-recommends bash-completion libfile-mimeinfo-perl man-db x11-apps xauth \
    xdg-utils xdotool xvfb zsh
INSIDE
}

download() {
    copyIntoBareRoot "$bare" "$debs"/trapwright*.deb /debs
    inside << 'INSIDE'
apt-get --quiet --yes install --no-install-recommends --download-only /debs/*.deb
INSIDE
}

installPackages() {
    inside << 'INSIDE'
apt-get --quiet --yes install --no-install-recommends /debs/*.deb
dpkg --audit
INSIDE
}

useCommandLine() {
    inside << 'INSIDE'
trapwright --version
trapwright part cuboid | tee part.txt
grep -q '4 x 8 x 12 mm' part.txt && grep -q 'Symmetry      D2' part.txt
trapwright track "$(dirname "$(dpkg -L trapwright | grep cuboid_track.json)")/cuboid_track.json" --trials 20 --engine native
trapwright new /root/tried.trap --preset cuboid
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
mpirun --oversubscribe -n 2 trapwright evolve /root/job.trap --preset cuboid --population 8 --trials 4 --generations 1 \
    --engine native 2>&1 | tee job.txt
grep -q '2 ranks on one machine' job.txt
rm /root/job.trap
echo "> $(trapwright --version), $(sed -n 's/^Size *//p' part.txt)"
INSIDE
}

readManuals() {
    inside << 'INSIDE'
commands=$(trapwright --help | sed -n '/^Commands:$/,/^$/s/^  \([a-z]*\) .*/\1/p')
[[ $(wc -w <<< "$commands") -ge 10 ]]
for page in trapwright trapwright-studio ${commands//[[:space:]]/ }; do
    case $page in trapwright*) ;; *) page=trapwright-$page ;; esac
    MANWIDTH=100 man "$page" > page.txt 2> faults.txt
    grep -q OPTIONS page.txt || { echo "man $page has no options"; exit 1; }
    [[ ! -s faults.txt ]] || { cat faults.txt; exit 1; }
done
man trapwright evolve | grep -- --resume > /dev/null
echo "> $(wc -w <<< "$commands") commands with a manual page each, and both programs"
INSIDE
}

complete() {
    inside << 'INSIDE'
# As an interactive shell does it: the function is loaded when it is needed.
answers=$(bash -c '
    source /usr/share/bash-completion/bash_completion
    _completion_loader trapwright || true
    COMP_WORDS=(trapwright evolve x.trap --engine n) COMP_CWORD=4 COMP_LINE="trapwright evolve x.trap --engine n" COMP_POINT=35
    _trapwright
    echo "${COMPREPLY[*]}"')
[[ $answers == native ]] || { echo "bash completes --engine n with: $answers"; exit 1; }
zsh -c 'autoload -U compinit; compinit -u; [[ $_comps[trapwright] == _trapwright && $_comps[trapwright-studio] == _trapwright-studio ]]'
INSIDE
}

# A display number that nobody outside has: the network and with it the names of X servers are shared.
display=$((2000 + $$ % 30000))

openStudio() {
    inside << INSIDE
cat > window.sh << 'SCRIPT'
set -euo pipefail
begin=\$EPOCHREALTIME
trapwright-studio &
studio=\$!
timeout 60 xdotool search --sync --onlyvisible --pid \$studio --name Trapwright > windows.txt
awk "BEGIN { printf \"> window after %.1f s\\n\", \$EPOCHREALTIME - \$begin }"
sleep 2
kill -0 \$studio
kill \$studio
wait \$studio || true
SCRIPT
LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -n $display -s "-screen 0 1280x800x24 +extension GLX" bash window.sh
INSIDE
}

openStudy() {
    inside << INSIDE
[[ \$(xdg-mime query default application/x-trapwright-study) == trapwright-studio.desktop ]]
[[ \$(xdg-mime query filetype tried.trap) == application/x-trapwright-study ]]
cp tried.trap without-extension
[[ \$(mimetype --brief --magic-only without-extension) == application/x-trapwright-study ]]
cat > open.sh << 'SCRIPT'
set -euo pipefail
export XDG_CURRENT_DESKTOP=X-Generic
xdg-open /root/tried.trap &
timeout 60 xdotool search --sync --onlyvisible --name tried > windows.txt
echo "> xdg-open shows: \$(xdotool getwindowname \$(head -n 1 windows.txt))"
sleep 5
xwd -root -silent -out /root/window.xwd
kill \$(xdotool getwindowpid \$(head -n 1 windows.txt))
SCRIPT
LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -n $((display + 1)) -s "-screen 0 1280x800x24 +extension GLX" bash open.sh
INSIDE
    if [[ -n $picture ]]; then
        runInBareRoot "$bare" cat /root/window.xwd | convert xwd:- "$picture"
    fi
}

purge() {
    inside << 'INSIDE'
apt-get --quiet --yes purge trapwright trapwright-mpi trapwright-studio
apt-get --quiet --yes autoremove --purge
! dpkg --list 'trapwright*' 2> /dev/null | grep -q '^[^ ]*  trapwright'
INSIDE
}

# Caches that belong to nobody, and the backups that are made where a library brings a user of the system.
caches='^/(etc/ld\.so\.cache|etc/(passwd|shadow|group|gshadow)-|var/cache/(ldconfig|fontconfig|man|debconf)(/.*)?)$'

compareFiles() {
    local left
    left=$(comm -13 "$1" "$2" | grep -Ev "$caches" || true)
    if [[ -n $left ]]; then
        echo "Left behind:"
        echo "$left"
        return 1
    fi
    # What stays of shared caches knows nothing of us any more.
    inside << 'INSIDE'
! grep -rls trapwright /usr /etc /var --exclude-dir={log,apt,dpkg,man}
INSIDE
    echo "> $(wc -l < "$1") files and folders before, $(wc -l < "$2") after"
}

before=$(mktemp)
after=$(mktemp)
trap 'removeBareRoot "$bare"; rm -f "$before" "$after"' EXIT

step "Made a bare root" makeRoot
step "Installed what a small desktop has" installTools
listFiles > "$before"
step "Fetched what the packages depend on" download
step "Installed the packages, without recommended ones" installPackages
step "Used the command line: part, track, new, a job of two ranks" useCommandLine
step "Read the manual pages" readManuals
step "Completed in bash and zsh" complete
step "Opened the studio" openStudio
step "Opened a study with xdg-open" openStudy
step "Purged the packages and what came with them" purge
listFiles > "$after"
step "Nothing is left behind" compareFiles "$before" "$after"
