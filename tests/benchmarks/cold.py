#!/usr/bin/env python3
"""Times whole processes that make one picture: glint, the bare lower limit, and f3d if installed.

  tests/benchmarks/cold.py BUILD MODEL [--runs N] [--backend egl|osmesa]

The commands alternate, so that a noisy machine affects all equally. Prints medians and the ratios
of each round. f3d needs a running X server (DISPLAY).
"""
import argparse
import os
import shutil
import statistics
import subprocess
import tempfile
import time


def wall(command):
    start = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return time.perf_counter() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build")
    parser.add_argument("model")
    parser.add_argument("--runs", type=int, default=15)
    parser.add_argument("--backend", default="egl")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out.png")
        glint = [os.path.join(options.build, "glint"), "render", options.model, "-o", out,
                 "--rendering-backend", options.backend]
        floor = [os.path.join(options.build, "tests/benchmarks/floor"), out,
                 "backend=" + options.backend]
        commands = {"glint, no anti-aliasing": glint + ["--anti-aliasing", "none"],
                    "glint": glint}
        if os.path.exists(floor[0]):  # part of the test build
            commands = {"floor": floor, **commands}
        if shutil.which("f3d") and os.environ.get("DISPLAY"):
            commands["f3d"] = ["f3d", options.model, "--output=" + out, "--resolution=1024,1024"]
        times = {name: [] for name in commands}
        for command in commands.values():
            wall(command)
        for _ in range(options.runs):
            for name, command in commands.items():
                times[name].append(wall(command))

    print(f"load {os.getloadavg()[0]:.1f}, {options.runs} rounds, wall ms: median (minimum)")
    for name, each in times.items():
        print(f"{name:26} {1000 * statistics.median(each):7.0f} ({1000 * min(each):.0f})")

    def ratio(a, b):
        rounds = [x / y for x, y in zip(times[a], times[b])]
        print(f"{a} / {b}: {statistics.median(rounds):.2f} ({min(rounds):.2f} to {max(rounds):.2f})")

    ratio("glint, no anti-aliasing", "floor")
    if "f3d" in times:
        ratio("glint", "f3d")


main()
