#!/usr/bin/env python3
"""What learning makes of parts that nobody tuned anything for: success of the best winner in fresh trials.

any_part.py [FOLDER] [-- OPTIONS of `trapwright evolve`]

Learns every part with every seed, one thread each, as many at once as there are processors; then simulates the eight
highest winners again, 600 trials each, and prints the best one's success and how it ends: the share of each way (stable
pose and heading). Studies are kept in FOLDER (./trapwright-parts) and not learned again. From the environment:
    PARTS        ("clip wedge plate d-shaft holed-bracket housing")
    SEEDS        ("1 2 3 4 5")
    SIZE         population, trials, generations ("60 30 60")
    ENGINE       what learns and judges (native)
    TRAPWRIGHT   the program
"""
import json
import os
import pathlib
import statistics
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("TRAPWRIGHT", str(ROOT / "build/release/app/trapwright/trapwright"))
PARTS = os.environ.get("PARTS", "clip wedge plate d-shaft holed-bracket housing").split()
SEEDS = os.environ.get("SEEDS", "1 2 3 4 5").split()
POPULATION, TRIALS, GENERATIONS = os.environ.get("SIZE", "60 30 60").split()
ENGINE = os.environ.get("ENGINE", "native")
WINNERS, FRESH = "8", "600"


def ask(*arguments):
    """The JSON document that a command prints."""
    done = subprocess.run([PROGRAM, *arguments, "--json"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"any_part.py: {' '.join(arguments)}:\n{done.stderr}")
    return json.loads(done.stdout)


def learn(folder, options, part, seed):
    study = folder / f"{part}-{seed}.trap"
    if not study.exists():
        made = folder / f"{part}-{seed}-unfinished.trap"
        made.unlink(missing_ok=True)
        ask("evolve", str(made), "--part", part, "--engine", ENGINE, "--population", POPULATION, "--trials", TRIALS,
            "--generations", GENERATIONS, "--seed", seed, "--threads", "1", *options)
        made.rename(study)
    best = ask("select", str(study), "--engine", ENGINE, "--winners", WINNERS, "--trials", FRESH,
               "--threads", "1")["selection"]["entries"][0]
    track = folder / f"{part}-{seed}.json"
    ask("export", str(study), str(track), "--generation", str(best["generation"]))
    settings = ask("settings", str(study))
    drive, contact = settings["simulation"]["drive"], settings["simulation"]["contact"]
    ends = ask("track", str(track), "--part", part, "--engine", ENGINE, "--trials", FRESH, "--threads", "1",
               "--density", str(settings["part"]["density_kg_m3"]), "--half-stroke", str(drive["halfStroke_mm"]),
               "--friction", str(contact["staticFriction"]), "--restitution", str(contact["restitution"]))
    return best, ends


def main():
    arguments = sys.argv[1:]
    options = arguments[arguments.index("--") + 1:] if "--" in arguments else []
    own = arguments[: arguments.index("--")] if "--" in arguments else arguments
    if own[:1] in (["-h"], ["--help"]) or len(own) > 1:
        sys.exit(__doc__)
    folder = pathlib.Path(own[0] if own else "trapwright-parts")
    folder.mkdir(parents=True, exist_ok=True)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = {(part, seed): pool.submit(learn, folder, options, part, seed) for part in PARTS for seed in SEEDS}
        print(f"{ENGINE}, {GENERATIONS} generations of {POPULATION} with {TRIALS} trials {' '.join(options)}")
        for part in PARTS:
            results = [jobs[part, seed].result() for seed in SEEDS]
            successes = [100.0 * best["oriented"]["count"] / best["trials"] for best, _ in results]
            print(f"{part:14} median {statistics.median(successes):5.1f} %   "
                  + " ".join(f"{success:5.1f}" for success in successes))
            for seed, (_, ends) in zip(SEEDS, results):
                ways = (f"{100.0 * way['count'] / ends['trials']:.0f} % pose {way['pose']} "
                        f"{way['heading_deg']:+.0f} deg" for way in ends["ends"][:5])
                print(f"{'':14} seed {seed}: {', '.join(ways)}")


if __name__ == "__main__":
    main()
