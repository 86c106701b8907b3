#!/usr/bin/env python3
"""Parts of about 500,000 triangles and finely curved small ones, and what importing them takes.

large_parts.py make FOLDER              writes the parts as STL files
large_parts.py time FOLDER PROGRAM...   imports each with every program in turn (trapwright of a build): processor
                                        time [s] of the program and the processes that it starts, median of three
large_parts.py stop FOLDER PROGRAM      interrupts imports (SIGINT) at several times: how long until it has ended [s]
"""
import math
import os
import pathlib
import re
import resource
import signal
import statistics
import struct
import subprocess
import sys
import time

RUNS = 3
MOMENTS = (0.3, 1.0, 2.0, 4.0)  # of an interruption [s]


def turned(profile, sides):
    """About z: rings at (radius, z), the ends closed by fans."""
    rings = []
    for radius, z in profile:
        angles = (2 * math.pi * i / sides for i in range(sides))
        rings.append([(radius * math.cos(angle), radius * math.sin(angle), z) for angle in angles])
    for low, high in zip(rings, rings[1:]):
        for i in range(sides):
            j = (i + 1) % sides
            yield low[i], low[j], high[j]
            yield low[i], high[j], high[i]
    for i in range(1, sides - 1):
        yield rings[0][0], rings[0][i + 1], rings[0][i]
        yield rings[-1][0], rings[-1][i], rings[-1][i + 1]


def grid(corner, wrap_rows, wrap_columns):
    """A surface of rows of corners, either direction closed or not."""
    rows, columns = len(corner), len(corner[0])
    for r in range(rows if wrap_rows else rows - 1):
        for c in range(columns if wrap_columns else columns - 1):
            a, b = corner[r][c], corner[r][(c + 1) % columns]
            d, e = corner[(r + 1) % rows][c], corner[(r + 1) % rows][(c + 1) % columns]
            yield a, b, e
            yield a, e, d


def sphere(sides, rows, radius=5.0):
    """Without discs: the poles are corners."""
    angles = [math.pi * i / rows for i in range(rows + 1)]
    ring = lambda t: [
        (radius * math.sin(t) * math.cos(2 * math.pi * i / sides), radius * math.sin(t) * math.sin(2 * math.pi * i / sides),
         -radius * math.cos(t)) for i in range(sides)
    ]
    rings = [ring(t) for t in angles[1:-1]]
    yield from grid(rings, False, True)
    for i in range(sides):
        yield (0.0, 0.0, -radius), rings[0][(i + 1) % sides], rings[0][i]
        yield (0.0, 0.0, radius), rings[-1][i], rings[-1][(i + 1) % sides]


def pin(sides, steps):
    """With a waist and a fillet below its head, both curved inward."""
    profile = [(2.0, 0.0)]
    for i in range(steps + 1):
        profile.append((2.0 - 0.6 * math.sin(math.pi * i / steps), 1.0 + 5.0 * i / steps))
    for i in range(steps + 1):
        angle = 0.5 * math.pi * i / steps
        profile.append((3.0 - math.cos(angle), 7.0 + math.sin(angle)))
    return turned(profile + [(4.0, 8.0), (4.0, 9.5)], sides)


def torus(around, sides, ring=10.0, radius=3.0):
    corner = []
    for i in range(around):
        angle = 2 * math.pi * i / around
        out = [ring + radius * math.cos(2 * math.pi * k / sides) for k in range(sides)]
        corner.append([(r * math.cos(angle), r * math.sin(angle), radius * math.sin(2 * math.pi * k / sides))
                       for k, r in enumerate(out)])
    # Rows go round the ring, so the outside is on the other side.
    return ((a, c, b) for a, b, c in grid(corner, True, True))


def gear(teeth, steps, layers, bore=2.0, height=3.0):
    """A spur gear with rounded teeth and a bore, cut into layers."""
    count = teeth * steps
    outline, inner = [], []
    for i in range(count):
        angle = 2 * math.pi * i / count
        wave = math.tanh(2.5 * math.sin(teeth * angle)) / math.tanh(2.5)
        outline.append(((8.0 + 0.9 * wave) * math.cos(angle), (8.0 + 0.9 * wave) * math.sin(angle)))
        inner.append((bore * math.cos(angle), bore * math.sin(angle)))
    ring = lambda points, z: [(x, y, z) for x, y in points]
    heights = [height * k / layers for k in range(layers + 1)]
    yield from grid([ring(outline, z) for z in heights], False, True)
    yield from grid([ring(inner, height), ring(inner, 0.0)], False, True)
    yield from grid([ring(outline, height), ring(inner, height)], False, True)
    yield from grid([ring(inner, 0.0), ring(outline, 0.0)], False, True)


def subdivided(triangles, parts):
    """Each triangle cut into parts * parts plane ones."""
    for a, b, c in triangles:
        at = lambda i, j: tuple(a[k] + (b[k] - a[k]) * (i / parts) + (c[k] - a[k]) * (j / parts) for k in range(3))
        for i in range(parts):
            for j in range(parts - i):
                yield at(i, j), at(i + 1, j), at(i, j + 1)
                if i + j < parts - 1:
                    yield at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)


def read_binary(path):
    data = path.read_bytes()
    for i in range(struct.unpack_from("<I", data, 80)[0]):
        numbers = struct.unpack_from("<12f", data, 84 + 50 * i)
        yield numbers[3:6], numbers[6:9], numbers[9:12]


def write_binary(path, triangles):
    body = [struct.pack("<12fH", 0.0, 0.0, 0.0, *a, *b, *c, 0) for a, b, c in triangles]
    path.write_bytes(b"large part".ljust(80) + struct.pack("<I", len(body)) + b"".join(body))


def write_text(path, triangles):
    with open(path, "w") as file:
        file.write("solid part\n")
        for triangle in triangles:
            file.write("facet normal 0 0 0\nouter loop\n")
            for corner in triangle:
                file.write("vertex %.9g %.9g %.9g\n" % corner)
            file.write("endloop\nendfacet\n")
        file.write("endsolid part\n")


def make(folder):
    folder.mkdir(parents=True, exist_ok=True)
    bracket = pathlib.Path(__file__).resolve().parents[2] / "resources/parts/bracket.stl"
    flat = list(read_binary(bracket))
    # The bracket's number of triangles times a square, nearest to 485,000.
    parts = round(math.sqrt(485000 / len(flat)))
    write_binary(folder / "sphere.stl", sphere(500, 501))
    write_text(folder / "sphere-text.stl", sphere(500, 501))
    write_binary(folder / "turned.stl", pin(640, 195))
    write_binary(folder / "gear.stl", gear(24, 166, 60))
    write_binary(folder / "bracket.stl", subdivided(flat, parts))
    write_binary(folder / "torus.stl", torus(64, 32))
    write_binary(folder / "turned-small.stl", pin(96, 24))


def count_triangles(path):
    with open(path, "rb") as file:
        head = file.read(84)
        if not head.startswith(b"solid"):
            return struct.unpack_from("<I", head, 80)[0]
    return path.read_text().count("endfacet")


def import_once(program, path):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, "part", str(path), "--units", "mm"], capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done


def time_imports(folder, programs):
    for path in sorted(folder.glob("*.stl")):
        times = {program: [] for program in programs}
        told = {}
        for _ in range(RUNS):
            for program in programs:
                seconds, told[program] = import_once(program, path)
                times[program].append(seconds)
        print(f"{path.name}, {count_triangles(path)} triangles")
        for program in programs:
            print(f"  {statistics.median(times[program]):.2f} s  {program}")
            for line in (told[program].stdout + told[program].stderr).splitlines():
                if re.search(r"simplified|pieces|error|cannot", line):
                    print("     ", line.strip())


def stop_imports(folder, program):
    for path in sorted(folder.glob("*.stl")):
        told = []
        for moment in MOMENTS:
            child = subprocess.Popen([program, "part", str(path), "--units", "mm"], stdout=subprocess.DEVNULL,
                                     stderr=subprocess.DEVNULL)
            time.sleep(moment)
            if child.poll() is not None:
                break
            asked = time.monotonic()
            os.kill(child.pid, signal.SIGINT)
            child.wait()
            told.append(f"{time.monotonic() - asked:.3f} after {moment} (exit code {child.returncode})")
        print(f"{path.name}: " + ("; ".join(told) or "done too soon"))


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "make":
        make(pathlib.Path(sys.argv[2]))
    elif len(sys.argv) > 3 and sys.argv[1] == "time":
        time_imports(pathlib.Path(sys.argv[2]), sys.argv[3:])
    elif len(sys.argv) == 4 and sys.argv[1] == "stop":
        stop_imports(pathlib.Path(sys.argv[2]), sys.argv[3])
    else:
        sys.exit(__doc__)
