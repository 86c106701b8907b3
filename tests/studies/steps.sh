#!/usr/bin/env bash
# How much what trials say hangs on the step of simulated time: the same starts at several steps, on a level track,
# on hills and on learned tracks. Prints for each step the shares in % that finish, fall off and end oriented, and
# the mean simulated time. [s]
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=${1:-$root/build/release/app/trapwright/trapwright}
trials=${TRIALS:-2000}
read -ra steps <<< "${STEPS:-0.05 0.1 0.2 0.3 0.4}"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# The learned track with other heights: all level, and up to 0.8 mm up or down.
python3 - "$root/resources/tracks/cuboid_track.json" "$folder" << 'PYTHON'
import json
import random
import sys

random.seed(3)
for name, height in (("flat", 0.0), ("hills", 0.8)):
    with open(sys.argv[1]) as file:
        track = json.load(file)
    for number, section in enumerate(track["sections"]):
        points = section["points"]
        inner = 0 < number < len(track["sections"]) - 1
        for i, point in enumerate(points):
            point[0] = -30 + 60 * i / (len(points) - 1)
            point[1] = 15.0 + (random.uniform(-height, height) if inner else 0.0)
    with open(f"{sys.argv[2]}/{name}.json", "w") as file:
        json.dump(track, file)
PYTHON

run() {
    local name=$1 track=$2 part=$3 restitution=$4
    printf '%-26s' "$name"
    for step in "${steps[@]}"; do
        "$program" track "$track" --part "$part" --engine native --trials "$trials" --restitution "$restitution" \
            --step "$step" --json 2> /dev/null | python3 -c '
import json
import sys

got = json.load(sys.stdin)
shares = "".join("{:6.1f}".format(100 * got[key]["share"]) for key in ("finished", "fell_off", "oriented"))
print("{} {:.3f}".format(shares, got["mean_simulated_s"]), end=" |")'
    done
    echo
}

printf '%-26s' "step [ms]"
printf '%24s |' "${steps[@]}"
echo
run "cone level, e = 0.2" "$folder/flat.json" cone 0.2
run "cone level, e = 0" "$folder/flat.json" cone 0
run "cone hills, e = 0.2" "$folder/hills.json" cone 0.2
run "cuboid level, e = 0.2" "$folder/flat.json" cuboid 0.2
run "cuboid hills, e = 0.2" "$folder/hills.json" cuboid 0.2
run "cuboid learned, e = 0.2" "$root/resources/tracks/cuboid_track.json" cuboid 0.2
run "bracket learned, e = 0.2" "$root/resources/tracks/cuboid_track.json" bracket 0.2
