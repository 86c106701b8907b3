# Bare Debian 12 roots, for trying what somebody meets on a fresh machine. To be sourced:
#
#   source packaging/bare_root.sh
#   checkBareRoot                            # tells why none can be made here, and is false then
#   root=$(mktemp -d)
#   trap 'removeBareRoot "$root"' EXIT
#   makeBareRoot "$root" [PACKAGE...]        # half a minute; apt there has the machine's own sources
#   copyIntoBareRoot "$root" FILE... FOLDER  # the folder as it is called inside; made if it is not there
#   runInBareRoot "$root" COMMAND...         # as root inside, in /root; what it started ends with it
#
# Works as root, or as a user who may make user namespaces (mmdebstrap, uidmap and lines in /etc/subuid).
# shellcheck shell=bash disable=SC2016  # quoted text is for apt and for the shells inside

bareRootSuite=bookworm

# The machine's Debian sources, a one-line entry each. Those of others (compilers, browsers) stay outside.
listBareRootSources() {
    apt-get indextargets --format '$(ORIGIN)|$(CODENAME)|deb $(REPO_URI) $(RELEASE) $(COMPONENT)' \
        'Created-By: Packages' | sed -n "s/^Debian|${bareRootSuite}[a-z-]*|//p" | sort -u
}

# True where a bare root can be made. Otherwise says what is missing, on stderr.
checkBareRoot() {
    local lacking
    if ! command -v apt-get > /dev/null; then
        echo "a bare root needs apt, and this is no Debian." >&2
        return 1
    fi
    for lacking in mmdebstrap unshare; do
        if ! command -v "$lacking" > /dev/null; then
            echo "a bare root needs $lacking: apt-get install mmdebstrap uidmap" >&2
            return 1
        fi
    done
    if [[ -z $(listBareRootSources) ]]; then
        echo "apt knows no source of Debian $bareRootSuite: look at /etc/apt, then apt-get update." >&2
        return 1
    fi
    if ((EUID != 0)) && ! mmdebstrap --unshare-helper true > /dev/null 2>&1; then
        echo "a bare root needs root or user namespaces (uidmap, lines for $(id -un) in /etc/subuid and /etc/subgid)." >&2
        return 1
    fi
    if ! inBareRootNamespace true; then
        echo "mounting is not allowed here, not even in a namespace of its own." >&2
        return 1
    fi
}

# Runs a command where it may mount without anybody else seeing it, and whose processes end with it.
inBareRootNamespace() {
    local namespace=(unshare --mount --propagation private --pid --fork --kill-child) status code=125
    if ((EUID == 0)); then
        "${namespace[@]}" "$@"
        return
    fi
    # The helper keeps the exit status of what it ran to itself.
    status=$(mktemp)
    chmod 666 "$status"
    mmdebstrap --unshare-helper "${namespace[@]}" sh -c 'status=$1; shift; "$@"; echo $? > "$status"' \
        sh "$status" "$@" || true
    read -r code < "$status" || true
    rm -f "$status"
    return "$code"
}

# makeBareRoot FOLDER [PACKAGE...]: the smallest Debian that has apt, and these packages.
makeBareRoot() {
    local folder=$1 include options=()
    shift
    local sources
    sources=$(listBareRootSources)
    [[ $sources != *" https:"* ]] || set -- ca-certificates "$@"
    include=$(IFS=,; echo "$*")
    # How the machine reaches its sources (proxies, a snapshot's dates) holds inside as well.
    while read -r line; do
        options+=("--aptopt=$line")
    done < <(apt-config dump | grep -E '^Acquire::([a-z]+::.*(Proxy|Verify)|Check-|Retries).* "[^"]' || true)
    chmod 755 "$folder"
    # No service starts while packages are installed.
    mmdebstrap --quiet --variant=minbase ${include:+"--include=$include"} "${options[@]}" \
        --customize-hook='printf "#!/bin/sh\nexit 101\n" > "$1/usr/sbin/policy-rc.d" && chmod 755 "$1/usr/sbin/policy-rc.d"' \
        "$bareRootSuite" "$folder" - <<< "$sources"
}

# runInBareRoot FOLDER COMMAND...: standard input, output and the exit status are the command's.
runInBareRoot() {
    local folder=$1 variable environment=(
        HOME=/root USER=root LANG=C.UTF-8 TERM=dumb DEBIAN_FRONTEND=noninteractive
        PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin
    )
    shift
    for variable in http_proxy https_proxy no_proxy; do
        [[ -z ${!variable:-} ]] || environment+=("$variable=${!variable}")
    done
    inBareRootNamespace sh -c '
        folder=$1
        shift
        mount -t proc proc "$folder/proc" && mount --rbind /dev "$folder/dev" || exit 125
        # Not by exec: the command must not be process 1, which programs such as X servers send no signals to.
        cd / && /usr/sbin/chroot "$folder" sh -c "cd /root && exec \"\$@\"" sh env -i "$@"
        exit $?' \
        sh "$folder" "${environment[@]}" "$@"
}

# copyIntoBareRoot FOLDER FILE... TARGET
copyIntoBareRoot() {
    local folder=$1 target=${!#} file
    set -- "${@:2:$#-2}"
    runInBareRoot "$folder" mkdir -p "$target" < /dev/null
    for file in "$@"; do
        tar -C "$(dirname "$file")" -c "$(basename "$file")" | runInBareRoot "$folder" tar --no-same-owner -x -C "$target"
    done
}

removeBareRoot() {
    [[ -n ${1:-} && -d $1 ]] || return 0
    # Inside the namespace nothing of the machine is mounted below it, and all of its users' files can go.
    inBareRootNamespace rm -rf --one-file-system "$1" 2> /dev/null || rm -rf --one-file-system "$1"
}
