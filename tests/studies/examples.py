#!/usr/bin/env python3
"""The studies that come with Trapwright (resources/studies): made from learned ones, and validated again.

examples.py keep NAME STUDY     puts a copy of a learned and validated study among them, without the single trials of
                                its generations and selections, which make most of its size and can be simulated, and
                                without all but its last selection and validation
examples.py again [NAME ...]    validates each, or those named, as it was published, and compares every row; prints
                                resources/docs/results.md's table, and ends with 1 where a row differs
examples.py renew [NAME ...]    the same, and puts what comes out now in place of what was published: after engines were
                                changed on purpose

From the environment: TRAPWRIGHT, the program (build/release/app/trapwright/trapwright).
"""
import json
import os
import pathlib
import shutil
import sqlite3
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("TRAPWRIGHT", str(ROOT / "build/release/app/trapwright/trapwright"))
STUDIES = ROOT / "resources/studies"
COUNTS = ("trials", "success", "wrong_orientation", "stuck", "fell_off")


def fail(message):
    sys.exit(f"examples.py: {message}")


def ask(*arguments):
    """The JSON document that a command prints."""
    done = subprocess.run([PROGRAM, *map(str, arguments), "--json"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        fail(f"{' '.join(map(str, arguments))}:\n{done.stderr}")
    return json.loads(done.stdout)


def read_published(study):
    """(engine, tolerance [deg], expected orientation, generation, individual, rows by pose) of the last validation."""
    with sqlite3.connect(f"file:{study}?mode=ro", uri=True) as database:
        database.row_factory = sqlite3.Row
        last = database.execute("SELECT * FROM validation ORDER BY number DESC LIMIT 1").fetchone()
        if last is None:
            fail(f"{study} has no validation. Run: trapwright validate {study}")
        rows = database.execute("SELECT * FROM validation_row WHERE validation = ? ORDER BY pose", (last["number"],))
        return dict(last), [dict(row) for row in rows]


def keep(name, study):
    study = pathlib.Path(study)
    if not study.is_file():
        fail(f"{study} is not there")
    last, _ = read_published(study)
    STUDIES.mkdir(exist_ok=True)
    target = STUDIES / f"{name}.trap"
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / "copy.trap"
        with sqlite3.connect(f"file:{study}?mode=ro", uri=True) as source:
            source.execute("VACUUM INTO ?", (str(copy),))
        database = sqlite3.connect(copy, isolation_level=None)
        database.execute("DELETE FROM outcomes WHERE run <> 'validation'")
        selected = database.execute("SELECT MAX(number) FROM selection").fetchone()[0]
        for table, number, kept in (("validation", "number", last["number"]),
                                    ("validation_row", "validation", last["number"]),
                                    ("outcomes", "number", last["number"]), ("selection", "number", selected),
                                    ("selection_entry", "selection", selected),
                                    ("selection_score", "selection", selected)):
            database.execute(f"DELETE FROM {table} WHERE {number} <> ?", (kept,))
            database.execute(f"UPDATE {table} SET {number} = 0")
        database.execute("VACUUM")
        database.close()
        shutil.move(copy, target)
    print(f"{target}: {target.stat().st_size / 1024:.0f} KiB")


def describe(study):
    """How it was learned."""
    settings = ask("settings", study)
    evolution = settings["evolution"]
    with sqlite3.connect(f"file:{study}?mode=ro", uri=True) as database:
        generations, trials = database.execute(
            "SELECT COUNT(DISTINCT generation), SUM(trials) FROM individual").fetchone()
    planned = evolution["plannedTraps"] if evolution["firstGeneration"] == "planned" else 0
    return {"traps": settings["track"]["traps"], "shape": settings["track"]["feeder"],
            "seed": evolution["seed"], "generations": generations, "population": evolution["populationSize"],
            "each": evolution["trialsPerEvaluation"], "trials": trials, "planned": planned}


def percent(share):
    if share["share"] is None:
        return "-"
    return f"{100 * share['share']:.1f} [{100 * share['low']:.1f}, {100 * share['high']:.1f}]"


def validate_again(name, renew=False):
    """Whether each row is as it was published; prints a line of the table. `renew`: publishes what comes out."""
    published = STUDIES / f"{name}.trap"
    if not published.is_file():
        fail(f"{published} is not there")
    last, rows = read_published(published)
    with tempfile.TemporaryDirectory() as folder:
        study = pathlib.Path(folder) / f"{name}.trap"
        shutil.copy(published, study)
        done = ask("validate", study, "--generation", last["generation"], "--individual", last["individual"],
                   "--engine", last["engine"], "--trials", rows[0]["trials"],
                   "--tolerance", repr(last["tolerance"] * 180 / 3.141592653589793))["validation"]
        how = describe(study)
        if renew:
            keep(name, study)
    same = True
    for row, now in zip(rows, done["poses"], strict=True):
        before = [row["trials"], row["trials"] - row["failures"], *(row[key] for key in COUNTS[2:])]
        after = [now["trials"], now["success"]["count"], *(now[key] for key in COUNTS[2:])]
        if before != after:
            same = False
            print(f"{name}, pose {now['pose']}: {dict(zip(COUNTS, before))} was published, "
                  f"{dict(zip(COUNTS, after))} comes out now", file=sys.stderr)
    total = done["total"]
    learned = f"{how['generations']} x {how['population']} x {how['each']}"
    if how["planned"]:
        learned = f"{how['planned']} traps planned; {learned}"
    print(f"| {name} | {how['shape']}; {how['traps']} | {how['seed']} | {learned} | {total['trials']} | "
          f"{percent(total['success'])} | {percent(done['weighted_success'])} | "
          f"{percent(done['correct'])} | {'yes' if same else 'NO'} |", flush=True)
    return same


def main():
    arguments = sys.argv[1:]
    if arguments in (["-h"], ["--help"]):
        print(__doc__.strip())
    elif len(arguments) == 3 and arguments[0] == "keep":
        keep(*arguments[1:])
    elif arguments and arguments[0] in ("again", "renew"):
        renew = arguments[0] == "renew"
        names = arguments[1:] or sorted(path.stem for path in STUDIES.glob("*.trap"))
        print("| example | track | seed | generations x population x trials | trials of the validation | success, all alike [%] "
              "| success, weighted [%] | correct, weighted [%] | again the same |\n|---|---|---|---|---|---|---|---|---|")
        if not all([validate_again(name, renew) for name in names]) and not renew:
            sys.exit(1)
    else:
        sys.exit(__doc__.strip())


if __name__ == "__main__":
    main()
