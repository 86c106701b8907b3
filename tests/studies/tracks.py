#!/usr/bin/env python3
"""What the track files that come with Trapwright (resources/tracks) do, by the engine as it is: a line of a table each.

tracks.py [NAME ...]            those named, without .json, or all: parts that leave it right, of all that are fed; and
                                of those that arrive those that are right. As set, and over the operating box.

From the environment:
    TRIALS       as set (4000)
    BOX_TRIALS   over the operating box (2000)
    ENGINE       what simulates (native)
    THREADS      (all processors)
    TRAPWRIGHT   the program (build/release/app/trapwright/trapwright)
"""
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("TRAPWRIGHT", str(ROOT / "build/release/app/trapwright/trapwright"))
TRACKS = ROOT / "resources/tracks"
TRIALS = os.environ.get("TRIALS", "4000")
BOX_TRIALS = os.environ.get("BOX_TRIALS", "2000")
COMMON = ["--engine", os.environ.get("ENGINE", "native")]
if "THREADS" in os.environ:
    COMMON += ["--threads", os.environ["THREADS"]]

CUBOID = ["--part", "cuboid"]
CONE = ["--part", "cone", "--material", "brass", "--friction", "0.35"]
BRACKET = ["--part", "bracket", "--material", "aluminium"]
PARTS = {
    "bowl_track": CUBOID,
    "bracket_gaps_ledges_box_track": BRACKET,
    "bracket_gaps_ledges_track": BRACKET,
    "bracket_ledges_track": BRACKET,
    "bracket_track": BRACKET,
    "cone_rejecting_track": CONE,
    "cone_track": CONE,
    "cuboid_box_track": CUBOID,
    "cuboid_track": CUBOID,
}


def ask(*arguments):
    """The JSON document that a command prints."""
    done = subprocess.run([PROGRAM, *arguments, "--json"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"tracks.py: {' '.join(arguments)}:\n{done.stderr}")
    return json.loads(done.stdout)


def percent(share):
    return f"{100 * share['share']:.1f} [{100 * share['low']:.1f}, {100 * share['high']:.1f}]"


def main():
    if any(name in ("-h", "--help") for name in sys.argv[1:]):
        print(__doc__.strip())
        return
    if not os.access(PROGRAM, os.X_OK):
        sys.exit(f"tracks.py: {PROGRAM} is not there. Build it with packaging/build.sh release, or name one in TRAPWRIGHT.")
    names = sys.argv[1:] or sorted(PARTS)
    for name in names:
        if name not in PARTS:
            sys.exit(f"tracks.py: there is no track {name}; there are {', '.join(sorted(PARTS))}")
    print("| track | right, as set [%] | correct of those that arrive | over the box, right [%] | correct |")
    print("|---|---|---|---|---|")
    for name in names:
        file = str(TRACKS / f"{name}.json")
        track = ask("track", file, *PARTS[name], *COMMON, "--trials", TRIALS)
        few = ["--points", "2", "--map", "2", "--trials", "10"]  # what else it tells
        box = ask("robustness", file, *PARTS[name], *COMMON, *few, "--box-trials", BOX_TRIALS)["robustness"]["over_box"]
        right = box["success"]["count"]
        print(f"| {name} | {percent(track['oriented'])} | {track['oriented']['count']} of {track['finished']['count']} | "
              f"{percent(box['success'])} | {right} of {right + box['wrong_orientation']} |", flush=True)


if __name__ == "__main__":
    main()
