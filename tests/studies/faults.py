#!/usr/bin/env python3
"""What faults of the system and of the disk cost: every job of the command line is run while calls of the system
fail one after the other, on a disk that fills up, on one that cannot be written, with the clock set back, and is
killed at random times. Afterwards it is looked at what is left, and gone on with. Prints tables in Markdown; ends
with 1 if anything was lost, broken, or told wrongly."""
import argparse
import collections
import errno
import os
import pathlib
import random
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
FAST = ["--population", "6", "--trials", "2", "--threads", "1", "--engine", "native",
        "--set", "simulation.termination.timeLimit_s=0.2", "--set", "simulation.termination.stuckTime_s=0.1"]
EXPORTS = ["track.stl", "track.3mf", "track.step", "track.json"]
GENERATIONS = 4  # of a study when its job is done; jobs begin with BEFORE
BEFORE = 2
ROUNDS = 8  # of the feeder's notes
# What a program that was killed, or whose disk does not take even small files, may leave beside a study or a target.
LEFTOVERS = re.compile(r"(-wal|-shm|-journal|\.lock|\.new-[0-9]+-[0-9]+(-journal)?|\.new-\w{6}|\.[0-9]+-[0-9]+)$")

Ran = collections.namedtuple("Ran", "code output errors")
Job = collections.namedtuple("Job", "name arguments")


class Tried:
    """What is wrong with what a run left."""

    def __init__(self):
        self.complaints = []
        self.codes = collections.Counter()
        self.lost = collections.Counter()
        self.leftovers = collections.Counter()
        self.runs = 0
        self.hit = 0

    def complain(self, what, ran):
        text = (ran.errors or ran.output).strip()
        self.complaints.append(f"{what}: exit code {ran.code}: {text}")


def rows(path, table):
    """The rows of a table, without what differs from run to run."""
    with sqlite3.connect(f"file:{path}?mode=ro", uri=True) as database:
        database.row_factory = sqlite3.Row
        found = [dict(row) for row in database.execute(f"SELECT * FROM {table}")]
    database.close()
    for row in found:
        for name in ("seconds", "created", "time", "started"):
            row.pop(name, None)
    return found


class Bench:
    """Runs jobs in a folder of their own."""

    def __init__(self, options, work):
        self.program = options.program
        self.library = options.library
        self.notes = options.notes
        self.work = work
        self.reference = work / "reference"
        self.here = work / "here"
        self.trace = work / "trace"
        self.reference.mkdir()
        self.jobs = self.make_reference()

    def make_reference(self):
        """What undisturbed runs give, and what the jobs begin with."""
        def must(*arguments):
            ran = self.run(arguments, self.reference)
            if ran.code != 0:
                sys.exit(f"faults.py: {arguments}: {ran}")

        must("evolve", "begun.trap", "--preset", "cuboid", *FAST, "--generations", str(BEFORE))
        for name in ("learned", "selected", "validated", "noted"):
            shutil.copy(self.reference / "begun.trap", self.reference / f"{name}.trap")
        jobs = [Job("new", ["new", "s.trap", "--preset", "cuboid", *without_threads(FAST)]),
                Job("evolve", ["evolve", "s.trap", "--resume", "--generations", str(GENERATIONS), "--threads", "1"]),
                Job("select", ["select", "s.trap", "--winners", "2", "--trials", "4", "--engine", "native",
                               "--threads", "1"]),
                Job("validate", ["validate", "s.trap", "--trials", "2", "--engine", "native", "--threads", "1"]),
                Job("export", ["export", "s.trap", *EXPORTS])]
        if self.notes.exists():
            jobs.append(Job("notes", [str(ROUNDS)]))
        jobs.append(Job("rescue", jobs[1].arguments))
        names = {"new": "new", "evolve": "learned", "select": "selected", "validate": "validated"}
        for job in jobs:
            if job.name in names:
                must(*[names[job.name] + ".trap" if word == "s.trap" else word for word in job.arguments])
        must("export", "begun.trap", *EXPORTS)
        return jobs

    def run(self, arguments, folder, environment=None):
        ended = subprocess.run(self.command(arguments), cwd=folder, env={**os.environ, **(environment or {})},
                               capture_output=True, text=True, timeout=120, check=False)
        return Ran(ended.returncode, ended.stdout, ended.stderr)

    def command(self, arguments):
        if arguments[0].isdigit():
            return [self.notes, self.here / "s.trap", *arguments]
        return [self.program, *arguments]

    def prepare(self, job, folder=None):
        """What the job begins with, in an empty folder."""
        folder = folder or self.here
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        self.fill(job, folder)

    def fill(self, job, folder):
        if job.name != "new":
            shutil.copy(self.reference / "begun.trap", folder / "s.trap")
        if job.name == "export":
            for name in EXPORTS:
                (folder / name).write_text(f"old {name}")

    def inject(self, **plan):
        return {"LD_PRELOAD": str(self.library), "FAULTS_FOLDER": str(self.here), "FAULTS_TRACE": str(self.trace),
                **{f"FAULTS_{key.upper()}": str(value) for key, value in plan.items()}}

    def count_calls(self, job, calls=None):
        """How many calls the job makes that can be let fail."""
        self.prepare(job)
        plan = {"calls": calls} if calls else {}
        if job.name == "rescue":
            plan.update(plan_removal(self.here))
        self.trace.unlink(missing_ok=True)
        self.run(job.arguments, self.here, self.inject(**plan))
        return len(self.trace.read_text().splitlines()) if self.trace.exists() else 0

    # What is left

    def judge(self, job, ran, tried, what, was_hit, killed=False):
        """Looks at what a run left, goes on with it, and notes what is wrong."""
        tried.runs += 1
        tried.hit += was_hit
        tried.codes["killed" if killed and ran.code < 0 else ran.code] += 1
        if not killed:
            self.judge_message(ran, tried, what)
        for name in sorted(os.listdir(self.here)):
            if LEFTOVERS.search(name):
                tried.leftovers[re.sub(r"[0-9]+-[0-9]+", "N", re.sub(r"\.new-\w{6}$", ".new-X", name))] += 1
            elif name not in ("s.trap", *EXPORTS) and not name.startswith("s-rescued"):
                tried.complain(f"{what}: {name} was left", ran)
        try:
            getattr(self, "judge_" + job.name)(job, ran, tried, what)
        except (sqlite3.Error, OSError) as problem:
            tried.complain(f"{what}: {problem}", ran)

    def judge_message(self, ran, tried, what):
        # All faults here are of the kind "cannot write".
        if ran.code not in (0, 4):
            tried.complain(f"{what}: exit code", ran)
        last = (ran.errors.strip().splitlines() or [""])[-1]
        if ran.code != 0 and not last.endswith("."):
            tried.complain(f"{what}: message", ran)

    def check_whole(self, tried, what, ran, path=None):
        with sqlite3.connect(path or self.here / "s.trap") as database:
            answer = database.execute("PRAGMA integrity_check").fetchone()[0]
        database.close()
        if answer != "ok":
            tried.complain(f"{what}: integrity_check: {answer}", ran)

    def compare(self, name, tables, tried, what, ran):
        for table in tables:
            if rows(self.here / "s.trap", table) != rows(self.reference / f"{name}.trap", table):
                tried.complain(f"{what}: {table} differs from an undisturbed run", ran)

    def again(self, job, tried, what, arguments=None):
        ran = self.run(arguments or job.arguments, self.here)
        if ran.code != 0:
            tried.complain(f"{what}: and again", ran)
        for name in os.listdir(self.here):
            if name.startswith("s.trap") and name != "s.trap" and ".new-" not in name:
                tried.complain(f"{what}: {name} was left when all went well", ran)
        return ran

    def judge_new(self, job, ran, tried, what):
        there = (self.here / "s.trap").exists()
        if there:
            self.check_whole(tried, what, ran)
            self.compare("new", ["study", "part"], tried, what, ran)
        elif ran.code == 0:
            tried.complain(f"{what}: no study", ran)
        tried.lost["the new study" if not there else "nothing"] += 1
        # A whole study that could not be opened at once is refused as a new one, and can be opened.
        if there:
            self.again(job, tried, what, ["evolve", "s.trap", "--resume", "--generations", "1", "--threads", "1"])
        else:
            self.again(job, tried, what)

    def judge_evolve(self, job, ran, tried, what):
        said = len(re.findall(r"^ {9,}[0-9]+ ", ran.output, re.MULTILINE))
        self.check_whole(tried, what, ran)
        saved = len(rows(self.here / "s.trap", "generation"))
        if saved < BEFORE + said or (ran.code == 0 and saved != GENERATIONS):
            tried.complain(f"{what}: {saved} generations, told of {said}", ran)
        tried.lost["nothing" if saved == GENERATIONS else "the generation in progress"] += 1
        self.again(job, tried, what)
        self.compare("learned", ["generation", "individual", "part", "study"], tried, what, ran)

    def judge_one_result(self, job, ran, tried, what, name, table):
        self.check_whole(tried, what, ran)
        self.compare("begun", ["generation", "individual"], tried, what, ran)
        there = len(rows(self.here / "s.trap", table)) > 0
        if ran.code == 0 and not there:
            tried.complain(f"{what}: nothing saved", ran)
        tried.lost["nothing" if there else f"the {table} in progress"] += 1
        if not there:
            self.again(job, tried, what)
        self.compare(name, [table, table + ("_entry" if table == "selection" else "_row")], tried, what, ran)

    def judge_select(self, job, ran, tried, what):
        self.judge_one_result(job, ran, tried, what, "selected", "selection")

    def judge_validate(self, job, ran, tried, what):
        self.judge_one_result(job, ran, tried, what, "validated", "validation")

    def judge_export(self, job, ran, tried, what):
        old = 0
        for name in EXPORTS:
            content = (self.here / name).read_bytes()
            whole = (self.reference / name).read_bytes()
            if name.endswith(".json"):  # names its study
                content = content.replace(b'"s, ', b'"begun, ')
            if name.endswith(".3mf"):  # names its study, packed
                same = abs(len(content) - len(whole)) < 64 and content[:4] == whole[:4]
            else:
                same = content == whole
            if content == f"old {name}".encode():
                old += 1
            elif not same:
                tried.complain(f"{what}: {name} is neither the old nor the new one", ran)
        if ran.code == 0 and old > 0:
            tried.complain(f"{what}: {old} files were not written", ran)
        tried.lost["nothing" if old == 0 else "files not written yet; the old ones stay"] += 1
        self.check_whole(tried, what, ran)
        self.again(job, tried, what)

    def judge_notes(self, job, ran, tried, what):
        said = re.findall(r"saved: ([0-9]+) lines, ([0-9]+) trials", ran.output)
        lines, trials = map(int, said[-1]) if said else (0, 0)
        self.check_whole(tried, what, ran)
        self.compare("begun", ["generation", "individual"], tried, what, ran)
        kept = [len(rows(self.here / "s.trap", table)) for table in ("drive_log", "physical_trial")]
        if kept[0] < lines or kept[1] < trials:
            tried.complain(f"{what}: told of {lines} lines and {trials} trials, kept {kept}", ran)
        numbers = [row["number"] for row in rows(self.here / "s.trap", "drive_log")]
        if numbers != list(range(1, len(numbers) + 1)):
            tried.complain(f"{what}: the log has gaps", ran)
        tried.lost["nothing" if kept[1] == ROUNDS else "the trial in progress and the log since the one before"] += 1
        self.again(job, tried, what, ["1"])

    def judge_rescue(self, job, ran, tried, what):
        copies = [self.here / name for name in os.listdir(self.here) if re.fullmatch(r"s-rescued.*\.trap", name)]
        if (self.here / "s.trap").exists():
            self.judge_evolve(job, ran, tried, what)
            return
        if ran.code != 4:
            tried.complain(f"{what}: exit code", ran)
        for copy in copies:
            self.check_whole(tried, what, ran, copy)
            copy.rename(self.here / "s.trap")
            for suffix in ("-wal", "-shm"):
                (self.here / ("s.trap" + suffix)).unlink(missing_ok=True)
            self.again(job, tried, what)
            self.compare("learned", ["generation", "individual", "part", "study"], tried, what, ran)
        tried.lost["nothing that was saved" if copies else "the deleted study, whose copy failed as well"] += 1


def plan_removal(folder):
    """The study is deleted while its generations are saved."""
    return {"remove": folder / "s.trap", "remove_at": 30}


def without_threads(arguments):
    at = arguments.index("--threads")
    return arguments[:at] + arguments[at + 2:]


FAULTS = [("full disk (ENOSPC from there on)", {"errno": errno.ENOSPC, "stays": 1}),
          ("one failure (EIO)", {"errno": errno.EIO}),
          ("yanked disk (EIO from there on)", {"errno": errno.EIO, "stays": 1}),
          ("read-only from there on (EROFS)", {"errno": errno.EROFS, "stays": 1}),
          ("half a write, then full", {"errno": errno.ENOSPC, "stays": 1, "short": 1, "calls": "write"}),
          ("fsync fails once (EIO)", {"errno": errno.EIO, "calls": "sync"})]


def try_calls(bench, job, plan, every, begin):
    tried = Tried()
    calls = bench.count_calls(job, plan.get("calls"))
    for at in range(1 + begin % every, calls + 1, every):
        bench.prepare(job)
        whole = {**plan, "at": at}
        if job.name == "rescue":
            whole.update(plan_removal(bench.here))
        bench.trace.unlink(missing_ok=True)
        ran = bench.run(job.arguments, bench.here, bench.inject(**whole))
        reached = bench.trace.exists() and len(bench.trace.read_text().splitlines()) >= at
        lines = bench.trace.read_text().splitlines() if reached else []
        where = lines[at - 1].replace(str(bench.here) + "/", "") if reached else "not reached"
        bench.judge(job, ran, tried, f"{job.name}, {plan}, call {where}", reached)
    return tried, calls


def try_clock(bench, job, every):
    tried = Tried()
    calls = bench.count_calls(job)
    for at in range(1, calls + 1, every):
        bench.prepare(job)
        ran = bench.run(job.arguments, bench.here, bench.inject(at=at, clock=-3600))
        bench.judge(job, ran, tried, f"{job.name}, clock back at call {at}", True)
        if ran.code != 0:
            tried.complain(f"{job.name}, clock back at call {at}", ran)
    return tried, calls


def try_kills(bench, job, kills, chance):
    tried = Tried()
    bench.prepare(job)
    begin = time.monotonic()
    bench.run(job.arguments, bench.here)
    usual = time.monotonic() - begin
    for number in range(kills):
        bench.prepare(job)
        moment = chance.uniform(0.0, 1.1 * usual)
        with open(bench.work / "out", "w+", encoding="utf-8") as out, \
                open(bench.work / "err", "w+", encoding="utf-8") as err:
            process = subprocess.Popen(bench.command(job.arguments), cwd=bench.here, stdout=out, stderr=err)
            try:
                process.wait(moment)
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
                process.wait()
            out.seek(0)
            err.seek(0)
            ran = Ran(process.returncode, out.read(), err.read())
        hit = ran.code == -signal.SIGKILL
        # A line that the kill has cut was not told.
        told = ran.output[:ran.output.rfind("\n") + 1]
        bench.judge(job, ran._replace(output=told), tried, f"{job.name}, kill {number} after {moment:.3f} s", hit, True)
    return tried, f"{usual:.2f} s"


def mount(*arguments):
    subprocess.run(["mount", *map(str, arguments)], check=True, capture_output=True)


def try_small_disk(bench, job, steps):
    """A disk of its own that is really full: from no room at all to enough."""
    tried = Tried()
    for step in range(steps):
        bench.prepare(job)
        used = sum((path.stat().st_blocks * 512) for path in bench.here.iterdir())
        mount("-t", "tmpfs", "-o", f"size={used + 4096 + step * 12288}", "tmpfs", bench.here)
        try:
            bench.fill(job, bench.here)
            ran = bench.run(job.arguments, bench.here)
            mount("-o", "remount,size=64m", bench.here)
            bench.judge(job, ran, tried, f"{job.name}, disk with {4 + 12 * step} KiB left", ran.code != 0)
        finally:
            subprocess.run(["umount", bench.here], check=True)
    return tried, steps


def try_read_only(bench, job):
    tried = Tried()
    bench.prepare(job)
    mount("-t", "tmpfs", "tmpfs", bench.here)
    try:
        bench.fill(job, bench.here)
        mount("-o", "remount,ro", bench.here)
        ran = bench.run(job.arguments, bench.here)
        if ran.code != 4:
            tried.complain(f"{job.name}, read-only file system", ran)
        mount("-o", "remount,rw", bench.here)
        bench.judge(job, ran, tried, f"{job.name}, read-only file system", True)
    finally:
        subprocess.run(["umount", bench.here], check=True)
    return tried, 1


def describe(counter):
    return ", ".join(f"{key}: {count}" for key, count in sorted(counter.items(), key=lambda item: str(item[0]))) or "-"


def may_mount():
    return subprocess.run(["unshare", "-rm", "true"], capture_output=True, check=False).returncode == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    build = pathlib.Path(os.environ.get("BUILD", ROOT / "build/release"))
    parser.add_argument("--program", type=pathlib.Path, default=build / "app/trapwright/trapwright")
    parser.add_argument("--library", type=pathlib.Path, default=build / "tests/studies/libfailing_calls.so")
    parser.add_argument("--notes", type=pathlib.Path, default=build / "tests/studies/drive_notes")
    parser.add_argument("--jobs", nargs="+", help="only these of new evolve select validate export notes rescue")
    parser.add_argument("--every", type=int, default=1, help="lets only every so manieth call fail")
    parser.add_argument("--kills", type=int, default=200, help="of each job")
    parser.add_argument("--seed", type=int, default=1, help="of the moments of the kills")
    options = parser.parse_args()
    for needed in (options.program, options.library):
        if not needed.exists():
            sys.exit(f"faults.py: {needed} is not there. Build it with packaging/build.sh release.")
    if may_mount() and not os.environ.get("FAULTS_UNSHARED"):
        os.execvpe("unshare", ["unshare", "-rm", sys.executable, *sys.argv], {**os.environ, "FAULTS_UNSHARED": "1"})
    unshared = bool(os.environ.get("FAULTS_UNSHARED"))

    failures = []
    chance = random.Random(options.seed)
    print("| fault | job | calls (time) | runs | of them disturbed | lost | exit codes | left beside until the next run |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        bench = Bench(options, pathlib.Path(name))

        def tell(fault, job, tried, calls):
            print(f"| {fault} | {job.name} | {calls} | {tried.runs} | {tried.hit} | {describe(tried.lost)} | "
                  f"{describe(tried.codes)} | {describe(tried.leftovers)} |", flush=True)
            failures.extend(tried.complaints)

        for place, job in enumerate(job for job in bench.jobs if not options.jobs or job.name in options.jobs):
            for shift, (fault, plan) in enumerate(FAULTS):
                tell(fault, job, *try_calls(bench, job, plan, options.every, place + shift))
            if job.name != "rescue":
                tell("clock set back by an hour", job, *try_clock(bench, job, max(options.every, 4)))
            if unshared and job.name != "rescue":
                tell("full disk (tmpfs)", job, *try_small_disk(bench, job, 24))
                if job.name != "notes":
                    tell("read-only file system", job, *try_read_only(bench, job))
            if job.name != "rescue":
                tell("SIGKILL", job, *try_kills(bench, job, options.kills, chance))
    print(f"\n{len(failures)} complaints.")
    for complaint in failures:
        print("- " + complaint.replace("\n", " / "))
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
