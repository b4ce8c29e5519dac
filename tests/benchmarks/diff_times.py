#!/usr/bin/env python3
"""Times whole processes that compare pictures: glint diff, and odiff, pixelmatch and idiff if they
are installed.

  tests/benchmarks/diff_times.py BUILD [--runs N] [--node-modules FOLDER] [--pictures A B]

Makes a pair of 3840 x 2160 that differs in a rectangle of 3 % of the pixels (or takes a given
pair), a picture with different noise, and 1000 pairs of 64 x 64, of which every tenth differs. The
commands alternate, so that a noisy machine affects all equally. Prints a table of the least CPU
time (user and system, of the process and its children), the least wall time and the largest memory
of the runs. odiff's binary is run directly, without npm's wrapper script.
"""
import argparse
import glob
import json
import multiprocessing
import os
import pathlib
import random
import shutil
import struct
import subprocess
import tempfile
import time
import zlib


def write_png(path, width, height, rows):
    """RGB rows of bytes as a PNG, without filters."""
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))
    packer = zlib.compressobj(1)
    data = b"".join(packer.compress(b"\0" + bytes(row)) for row in rows) + packer.flush()
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" +
                     chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", data) + chunk(b"IEND", b""))


def grainy(width, height, seed):
    """Rows of a gradient whose low bits are noise, as in photographs."""
    source = random.Random(seed)
    grain = int.from_bytes(b"\x0f" * (3 * width), "big")
    rows = []
    for y in range(height):
        slope = bytes(min(239, (x // 3 * 200 // width + 40 * y // height)) for x in range(3 * width))
        noise = source.getrandbits(24 * width) & grain
        rows.append(bytearray((int.from_bytes(slope, "big") + noise).to_bytes(3 * width, "big")))
    return rows


def make_pair(a, b):
    width, height = 3840, 2160
    rows = grainy(width, height, 1)
    write_png(a, width, height, rows)
    side_x, side_y = 665, 374  # 3 % of the pixels
    for y in range(900, 900 + side_y):
        part = slice(3 * 1500, 3 * (1500 + side_x))
        rows[y][part] = bytes(value ^ 0x60 for value in rows[y][part])
    write_png(b, width, height, rows)
    write_png(b.with_name("c.png"), width, height, grainy(width, height, 2))


def make_folders(folder):
    for n in range(1000):
        rows = grainy(64, 64, n)
        write_png(folder / "a" / ("%04d.png" % n), 64, 64, rows)
        if n % 10 == 0:
            for row in rows[20:30]:
                row[60:90] = bytes(30)
        write_png(folder / "b" / ("%04d.png" % n), 64, 64, rows)


def apart(make, *paths):
    """Makes files in a separate process, because a program's memory includes that of its parent at
    start."""
    process = multiprocessing.Process(target=make, args=paths)
    process.start()
    process.join()
    if process.exitcode != 0:
        raise SystemExit("the pictures could not be made")


def measured(command, text=None):
    """CPU seconds, wall seconds and peak MB of a command, whatever its status."""
    begin = time.perf_counter()
    process = subprocess.Popen([str(word) for word in command],
                               stdin=subprocess.PIPE if text else subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    if text:
        process.stdin.write(text.encode())
        process.stdin.close()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode < 0 or process.returncode > 100:
        raise SystemExit("%s ended with %d" % (" ".join(map(str, command)), process.returncode))
    return (usage.ru_utime + usage.ru_stime, time.perf_counter() - begin, usage.ru_maxrss / 1024)


def one_by_one(commands):
    """The same for several commands, one after the other."""
    each = [measured(command) for command in commands]
    return (sum(e[0] for e in each), sum(e[1] for e in each), max(e[2] for e in each))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--node-modules", default="node_modules",
                        help="where npm has put odiff-bin, pixelmatch and pngjs")
    parser.add_argument("--pictures", nargs=2, metavar=("A", "B"))
    options = parser.parse_args()
    glint = os.path.join(options.build, "glint")
    modules = os.path.abspath(options.node_modules)
    odiff = (glob.glob(modules + "/@odiff/linux-*/odiff") or [shutil.which("odiff")])[0]
    pixelmatch = modules + "/pixelmatch/bin/pixelmatch"
    if not os.path.exists(pixelmatch) or not shutil.which("node"):
        pixelmatch = None
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        a, b = scratch / "a.png", scratch / "b.png"
        if options.pictures:
            a, b = options.pictures
            other = b
        else:
            apart(make_pair, a, b)
        apart(make_folders, scratch / "small")
        other, out = scratch / "c.png", scratch / "difference.png"
        names = sorted(path.name for path in (scratch / "small/a").iterdir())
        small = [(scratch / "small/a" / name, scratch / "small/b" / name) for name in names]
        asked = "".join(json.dumps({"requestId": i, "base": str(p), "compare": str(q),
                                    "output": str(scratch / "small.png"), "options": {}}) + "\n"
                        for i, (p, q) in enumerate(small))
        plain, pictured = "compare", "compare, and write the picture of the difference"
        runs = {(plain, "glint"): lambda: measured([glint, "diff", a, b]),
                (pictured, "glint"): lambda: measured(
                    [glint, "diff", a, b, "-o", out, "--difference", "absolute"]),
                ("FLIP", "glint"): lambda: measured([glint, "diff", a, b, "--metric", "flip"]),
                ("FLIP, and write its map", "glint"): lambda: measured(
                    [glint, "diff", a, b, "--metric", "flip", "-o", out]),
                ("FLIP, most pixels differing", "glint"): lambda: measured(
                    [glint, "diff", a, other, "--metric", "flip"]),
                ("1000 pairs of 64 x 64", "glint"): lambda: measured(
                    [glint, "diff", scratch / "small/a", scratch / "small/b"])}
        if odiff:
            runs[plain, "odiff"] = lambda: measured([odiff, a, b])
            runs[pictured, "odiff"] = lambda: measured([odiff, a, b, out])
            runs["1000 pairs of 64 x 64", "odiff, its server"] = lambda: measured(
                [odiff, "--server"], asked)
            runs["1000 pairs of 64 x 64", "odiff, 1000 processes"] = lambda: one_by_one(
                [odiff, p, q] for p, q in small)
        if pixelmatch:
            runs[pictured, "pixelmatch"] = lambda: measured(["node", pixelmatch, a, b, out])
        if shutil.which("idiff"):
            runs[plain, "idiff"] = lambda: measured(["idiff", a, b])
            runs[pictured, "idiff"] = lambda: measured(["idiff", "-abs", "-o", out, a, b])
        found = {what: [] for what in runs}
        for _ in range(options.runs):
            for what, run in runs.items():
                found[what].append(run())
        size = "%.1f and %.1f MB" % tuple(os.path.getsize(path) / 1e6 for path in (a, b))

    print(f"load {os.getloadavg()[0]:.1f}, {options.runs} rounds, least of each; files of {size}\n")
    print("| what | program | CPU s | wall s | peak MB | CPU to glint's |")
    print("|---|---|---|---|---|---|")
    for what, program in sorted(runs, key=lambda run: [w for w, _ in runs].index(run[0])):
        cpu, wall = (min(each[i] for each in found[what, program]) for i in (0, 1))
        peak = max(each[2] for each in found[what, program])
        glints = min(each[0] for each in found[what, "glint"])
        print(f"| {what} | {program} | {cpu:.2f} | {wall:.2f} | {peak:.0f} | {cpu / glints:.1f} |")


main()
