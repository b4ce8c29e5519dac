"""Memory does not grow with the length of a list of models.

    list_memory.py GLINT MODELS [--count N]

Draws a list of N / 10 and one of N models, made of those in MODELS in turn, and compares the peak
memory of the two runs.
"""

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile


def peak(command):
    """The peak memory of a run, in MiB, and its status."""
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    return usage.ru_maxrss / 1024, os.waitstatus_to_exitcode(status)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("glint", type=pathlib.Path)
    parser.add_argument("models", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=5000)
    given = parser.parse_args()
    models = sorted(p.absolute() for p in given.models.glob("*.gl[bt]*") if p.stat().st_size < 200_000)
    with tempfile.TemporaryDirectory(prefix="glint-list-") as name:
        folder = pathlib.Path(name)
        peaks = []
        for count in (given.count // 10, given.count):
            (folder / "list").write_text("".join(f"{models[i % len(models)]}\n" for i in range(count)))
            most, status = peak([given.glint.absolute(), "render", "--from-list", folder / "list", "-o",
                                 folder / str(count) / "{n}.png", "--resolution", "16,16", "--anti-aliasing",
                                 "none", "--rendering-backend", "osmesa"])
            drawn = len(list((folder / str(count)).glob("*.png")))
            print(f"{count} models: {most:.1f} MiB, status {status}, {drawn} pictures", flush=True)
            peaks.append(most)
            if status != 0 or drawn != count:
                sys.exit(1)
    # Which models are in memory at the same time varies by chance: some MiB. A leak of each model,
    # which takes at least some kilobytes, would be noticed.
    growth = (peaks[1] - peaks[0]) * 1024 / (given.count * 0.9)
    print(f"{growth:.2f} KiB a model")
    sys.exit(growth > 2)


if __name__ == "__main__":
    main()
