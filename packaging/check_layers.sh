#!/usr/bin/env bash
# Checks what the build cannot: which folder may include which, where foreign libraries may appear, that no folders
# depend on each other in a circle.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
sources=$(packaging/list_sources.sh)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Folder, then what it may include; a prefix stands for everything below it, and the most exact line counts.
cat > "$work/layers" << 'RULES'
core/base       core/base
core/bench      core/base core/bench core/part core/stats core/study core/track core/trial core/verify
core/calibration core/base core/calibration core/stats core/trial
core/drive      core/base core/drive
core/geometry   core/base core/geometry
core/objectives core/base core/objectives core/part core/stats core/track core/trial
core/part       core/base core/geometry core/part
core/search     core/base core/search core/stats
core/stats      core/base core/stats
core/store      core/base core/calibration core/drive core/geometry core/objectives core/part core/search core/store core/study core/trial
core/study      core/base core/geometry core/objectives core/part core/search core/stats core/study core/track core/traps core/trial
core/track      core/base core/geometry core/track
core/traps      core/base core/search core/track core/traps
core/trial      core/base core/part core/track core/trial
core/verify     core/base core/calibration core/geometry core/part core/stats core/study core/track core/trial core/verify
core/workflow   core/base core/geometry core/part core/search core/store core/study core/track core/trial core/workflow
sim/cluster     core/base core/part core/track core/trial sim/cluster
sim/contact     core/base core/geometry core/part core/track core/trial sim/contact
sim/engines     core/base core/trial sim/engines sim/native sim/simbody
sim/native      core/base core/geometry core/part core/track core/trial sim/contact sim/native
sim/simbody     core/base core/geometry core/part core/track core/trial sim/contact sim/simbody
ui              core ui
ui/charts       core ui/charts ui/look
ui/feeder       core ui/charts ui/feeder ui/look ui/models ui/pages ui/scene ui/session
ui/help         core ui/help ui/look
ui/look         core/base ui/look
ui/models       core ui/look ui/models
ui/pages        core ui/charts ui/look ui/models ui/pages ui/scene ui/session
ui/scene        core ui/look ui/scene
ui/session      core ui/session
app/transports  core/base core/drive app/transports
app             core sim ui app
resources       core resources
tests           core sim ui app tests
RULES

# Library, the folders that may include it ("one": a single one, whichever it is), and its headers. None of them
# may be included by a header of ours: who includes that header would come to know the library as well.
cat > "$work/libraries" << 'RULES'
assimp       core/part      ^assimp/
OpenCASCADE  core/part      [.]hxx$
CGAL         core/geometry  ^CGAL/
SQLite       core/store     ^(SQLiteCpp/|sqlite3)
Simbody      sim/simbody    ^(Simbody[.]h|SimTK|simbody/|simmath/)
VTK          ui/scene       ^vtk
Highway      sim/native     ^hwy/
MPI          sim/cluster    ^mpi[.]h$
SerialBus    app/transports  ^(QtSerialBus|QModbus)
SerialPort   app/transports  ^(QtSerialPort|QSerialPort)
ODE          tests/peers    ^ode/
MuJoCo       tests/peers    ^mujoco/
Random123    core/base      ^Random123/
Zstandard    core/base      ^zstd
meshoptimizer core/geometry ^meshoptimizer[.]h
lib3mf       one            (^|/)(lib3mf|NMR_|Model/COM/)
RULES

# shellcheck disable=SC2086  # one argument per source: none of their names has a space
awk -v layersFile="$work/layers" -v librariesFile="$work/libraries" -v edgesFile="$work/edges" '
    function complain(message) {
        printf "%s:%d: %s\n", FILENAME, FNR, message
        complaints++
    }
    function isBelow(path, folder) { return path == folder || index(path, folder "/") == 1 }
    function folderOf(path,    parts) {
        split(path, parts, "/")
        return parts[1] "/" parts[2]
    }
    # The longest rule that covers the folder.
    function allowedFor(folder,    i, best) {
        best = ""
        for (i in allowed) if (isBelow(folder, i) && length(i) > length(best)) best = i
        return best == "" ? "" : allowed[best]
    }
    function checkOurs(target,    i, n, list, permitted) {
        permitted = allowedFor(here)
        n = split(permitted, list, " ")
        for (i = 1; i <= n; i++) {
            if (isBelow(target, list[i])) {
                if (folderOf(target) != here) print here, folderOf(target) > edgesFile
                return
            }
        }
        complain(here " must not know " target "; it may include: " permitted)
    }
    # A test may use the libraries of the folder that it tests, and a fuzz target those of all.
    function checkForeign(header,    i, tested) {
        tested = here
        if (here == "tests/core" || here == "tests/sim" || here == "tests/ui") {
            split(FILENAME, path, "/")
            tested = path[2] "/" path[3]
        }
        if (header ~ /^(Qt|Q[A-Z])/ && (isBelow(here, "core") || isBelow(here, "sim"))) {
            complain("core and sim know no Qt: " header)
        }
        for (i = 1; i <= libraries; i++) {
            if (header !~ pattern[i]) continue
            if (here == "tests/fuzz") continue
            if (home[i] == "one") home[i] = tested
            if (tested != home[i]) complain(library[i] " is known by " home[i] " alone: " header)
            if (FILENAME !~ /[.]cpp$/) complain(library[i] " belongs into .cpp files, not into a header: " header)
        }
    }
    BEGIN {
        while ((getline line < layersFile) > 0) {
            folder = line
            sub(/ .*/, "", folder)
            sub(/^[^ ]+ +/, "", line)
            allowed[folder] = line
        }
        while ((getline line < librariesFile) > 0) {
            split(line, words, " ")
            library[++libraries] = words[1]
            home[libraries] = words[2]
            pattern[libraries] = words[3]
        }
    }
    FNR == 1 { here = folderOf(FILENAME) }
    /^[ \t]*#[ \t]*include[ \t]*["<]/ {
        target = $0
        sub(/^[^"<]*["<]/, "", target)
        sub(/[">].*/, "", target)
        if (target ~ /^[.][.]?\//) {
            complain("name the file from the root of the project: " target)
        } else if (target ~ /^(core|sim|ui|app|resources|tests)\//) {
            checkOurs(target)
        } else {
            checkForeign(target)
        }
    }
    END { exit complaints > 0 }
' $sources >&2 || layersBroken=1

touch "$work/edges"
if ! { grep -v '^\(app\|tests\)/' "$work/edges" || true; } | sort -u | tsort > /dev/null 2> "$work/circle"; then
    echo "These folders depend on each other in a circle:" >&2
    sed -n 's|^tsort: \([a-z].*/.*\)|    \1|p' "$work/circle" >&2
    layersBroken=1
fi

if [[ -n ${layersBroken:-} ]]; then
    echo "check_layers: the layering of the files above is not as it must be." >&2
    exit 1
fi
echo "check_layers: $(wc -l <<< "$sources") files keep to their layers."
