#!/usr/bin/env python3
"""Times 20 models: glint in one process, f3d in one process for each model, alternating.

  tests/benchmarks/batch.py BUILD MODELS_FOLDER [--runs N]

The models are those of the folder, repeated until there are 20. f3d needs a running X server
(DISPLAY); without f3d only glint is timed. Also prints how many processors a list of 200 keeps
busy, and glint's peak memory over lists of 200 and 2000 pictures.
"""
import argparse
import os
import shutil
import statistics
import subprocess
import tempfile
import time


def models_in(folder):
    found = []
    for root, _, names in os.walk(folder):
        found += [os.path.join(root, n) for n in names if n.endswith((".glb", ".gltf"))]
    return sorted(found)


def wall(commands):
    start = time.perf_counter()
    for command in commands:
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return time.perf_counter() - start


def peak(command):
    """The process's peak memory (VmHWM) in MiB, polled until it ends."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    most = 0
    while process.poll() is None:
        try:
            with open(f"/proc/{process.pid}/status") as status:
                for line in status:
                    if line.startswith("VmHWM"):
                        most = max(most, int(line.split()[1]))
        except OSError:
            pass
        time.sleep(0.01)
    return most / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build")
    parser.add_argument("models")
    parser.add_argument("--runs", type=int, default=5)
    options = parser.parse_args()
    found = models_in(options.models)
    if not found:
        parser.error("no .glb or .gltf in " + options.models)
    glint = os.path.join(options.build, "glint")
    with tempfile.TemporaryDirectory() as folder:

        def listed(count):
            path = os.path.join(folder, f"list{count}")
            with open(path, "w") as lines:
                for i in range(count):
                    lines.write(os.path.abspath(found[i % len(found)]) + "\n")
            return path

        def batch(count, size):
            return [glint, "render", "--from-list", listed(count), "-o",
                    os.path.join(folder, "{n}.png"), "--resolution", size]

        jobs = {"glint": [batch(20, "1024,1024")]}
        if shutil.which("f3d") and os.environ.get("DISPLAY"):
            jobs["f3d"] = [["f3d", found[i % len(found)], "--resolution=1024,1024",
                            "--output=" + os.path.join(folder, "f3d.png")] for i in range(20)]
        times = {name: [] for name in jobs}
        for commands in jobs.values():
            wall(commands[:1])
        for _ in range(options.runs):
            for name, commands in jobs.items():
                times[name].append(wall(commands))
        print(f"load {os.getloadavg()[0]:.1f}, 20 models, {options.runs} rounds, "
              "wall s: median (minimum)")
        for name, each in times.items():
            print(f"{name:6} {statistics.median(each):7.2f} ({min(each):.2f})")
        if "f3d" in times:
            rounds = [a / b for a, b in zip(times["glint"], times["f3d"])]
            print(f"glint / f3d: {statistics.median(rounds):.3f} "
                  f"({min(rounds):.3f} to {max(rounds):.3f})")
        start, before = time.perf_counter(), os.times()
        wall([batch(200, "1024,1024")])
        after = os.times()
        spent = sum(after[i] - before[i] for i in (2, 3))  # CPU time of the children
        cores = len(os.sched_getaffinity(0))
        print(f"200 models keep {spent / (time.perf_counter() - start):.2f} of {cores} processors busy")
        for count in (200, 2000):
            print(f"peak memory over {count} pictures: {peak(batch(count, '256,256')):.0f} MiB")


main()
