#!/usr/bin/env python3
"""What the settings of the paper's Table 1 are worth: a designed experiment at equal numbers of trials.

search_settings.py [FOLDER]

Eleven settings have two levels, Table 1's and another; twelve combinations of them (Plackett and Burman 1946) tell what
each is worth by itself, from as few runs. Every combination learns every part with every seed until TRIALS trials are
simulated, one thread each, as many at once as there are PROCESSORS; the five highest winners are simulated again, 600
trials each. Printed are the best one's success for each combination, and for each setting how much the other level
adds to the odds of a success (in halvings of failures per success: +1 is half the failures), with its standard error
from the seeds. Studies are kept in FOLDER (./trapwright-search-settings) and not learned again. From the environment:
    PARTS        presets ("cuboid cone")
    SEEDS        ("1 2 3")
    TRIALS       of every run (60000)
    ENGINE       what learns and judges (native)
    PROCESSORS   (all)
    TRAPWRIGHT   the program
"""
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("TRAPWRIGHT", str(ROOT / "build/release/app/trapwright/trapwright"))
PARTS = os.environ.get("PARTS", "cuboid cone").split()
SEEDS = os.environ.get("SEEDS", "1 2 3").split()
TRIALS = int(os.environ.get("TRIALS", "60000"))
ENGINE = os.environ.get("ENGINE", "native")
PROCESSORS = int(os.environ.get("PROCESSORS", str(os.cpu_count())))
WINNERS, FRESH = "5", 600

# Name, setting, what the other level is made of from Table 1's.
FACTORS = [
    ("8 cross sections, not 5", "track.crossSections", lambda _: 8),
    ("12 points a section, not 8", "track.pointsPerSection", lambda _: 12),
    ("shortest segment halved", "track.minSegmentLength_mm", lambda value: value / 2),
    ("longest segment half as long again", "track.maxSegmentLength_mm", lambda value: 1.5 * value),
    ("width 40 mm, not 60", "track.segmentWidth_mm", lambda _: 40),
    ("height 20 mm, not 30", "track.segmentHeight_mm", lambda _: 20),
    ("N = 30, not 100", "evolution.trialsPerEvaluation", lambda _: 30),
    ("P = 50, not 100", "evolution.populationSize", lambda _: 50),
    ("s = 3, not 6", "evolution.tournamentSize", lambda _: 3),
    ("p_sm four times as high", "evolution.staticMutation", lambda value: 4 * value),
    ("rates of each gene, not of each individual", "evolution.strategyScope", lambda _: "gene"),
]
# Plackett and Burman's generating row for twelve runs; the last run is Table 1's own.
ROW = [1, 1, 0, 1, 1, 1, 0, 0, 0, 1, 0]
DESIGN = [ROW[-shift:] + ROW[:-shift] for shift in range(11)] + [[0] * 11]


def ask(*arguments):
    """The JSON document that a command prints."""
    done = subprocess.run([PROGRAM, *arguments, "--json"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"search_settings.py: {' '.join(arguments)}:\n{done.stderr}")
    return json.loads(done.stdout)


def settings_of(folder, part):
    """Of a preset, as a new study has them."""
    study = folder / f"{part}-preset.trap"
    if not study.exists():
        ask("new", str(study), "--preset", part)
    return ask("settings", str(study))


def value_of(settings, key):
    group, name = key.split(".")
    return settings[group][name]


def learn(folder, part, preset, seed, run):
    """Successes of FRESH trials of the best winner."""
    changed = {key: other(value_of(preset, key)) for (_, key, other), level in zip(FACTORS, DESIGN[run]) if level}
    population = changed.get("evolution.populationSize", value_of(preset, "evolution.populationSize"))
    each = changed.get("evolution.trialsPerEvaluation", value_of(preset, "evolution.trialsPerEvaluation"))
    study = folder / f"{part}-{seed}-{run}.trap"
    if not study.exists():
        made = folder / f"{part}-{seed}-{run}-unfinished.trap"
        made.unlink(missing_ok=True)
        options = [word for key, value in changed.items() for word in ("--set", f"{key}={value}")]
        ask("evolve", str(made), "--preset", part, "--engine", ENGINE, "--seed", seed, "--threads", "1",
            "--generations", str(round(TRIALS / (population * each))), *options)
        made.rename(study)
    best = ask("select", str(study), "--engine", ENGINE, "--winners", WINNERS, "--trials", str(FRESH),
               "--threads", "1")["selection"]["entries"][0]
    print(f"{part} seed {seed} run {run}: {100 * best['oriented']['count'] / FRESH:.1f} %", file=sys.stderr, flush=True)
    return best["oriented"]["count"]


def odds(successes):
    return math.log2((successes + 0.5) / (FRESH - successes + 0.5))


def tell_part(part, successes):
    print(f"\n{part}, {TRIALS} trials a run, success of the best of {WINNERS} winners in {FRESH} fresh trials [%]")
    print("run  settings of the other level   " + "  ".join(f"seed {seed}" for seed in SEEDS))
    for run, levels in enumerate(DESIGN):
        other = "".join("123456789ab"[k] for k, level in enumerate(levels) if level) or "none: Table 1"
        shares = "  ".join(f"{100 * successes[seed][run] / FRESH:6.1f}" for seed in SEEDS)
        print(f"{run + 1:3}  {other:28}  {shares}")
    print("setting" + " " * 44 + "halvings of failures per success")
    for k, (name, _, _) in enumerate(FACTORS):
        effects = [statistics.mean(odds(successes[seed][run]) for run in range(12) if DESIGN[run][k])
                   - statistics.mean(odds(successes[seed][run]) for run in range(12) if not DESIGN[run][k])
                   for seed in SEEDS]
        error = statistics.stdev(effects) / math.sqrt(len(effects)) if len(effects) > 1 else math.nan
        print(f"{'123456789ab'[k]}  {name:48} {statistics.mean(effects):+5.2f} +- {error:4.2f}")


def main():
    if len(sys.argv) > 2 or sys.argv[1:2] in (["-h"], ["--help"]):
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "trapwright-search-settings")
    folder.mkdir(parents=True, exist_ok=True)
    presets = {part: settings_of(folder, part) for part in PARTS}
    with ThreadPoolExecutor(PROCESSORS) as pool:
        jobs = {(part, seed, run): pool.submit(learn, folder, part, presets[part], seed, run)
                for part in PARTS for seed in SEEDS for run in range(12)}
        for part in PARTS:
            tell_part(part, {seed: [jobs[part, seed, run].result() for run in range(12)] for seed in SEEDS})


if __name__ == "__main__":
    main()
