"""Interrupts batches and conversions at random moments: all files left are complete, and no others
exist.

    interrupts.py GLINT MODELS [--count N] [--seed N]

Starts `glint render --from-list` and `glint convert`, ends them after a random time with SIGINT,
SIGTERM or SIGKILL, and checks what is left: every picture has its last chunk and correct checksums,
every model can be read, and there is no other file. Finally, --resume makes the rest.
"""

import argparse
import pathlib
import random
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib


def whole_png(data):
    at = 8
    while at + 12 <= len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        if at + 12 + length > len(data):
            return False
        if zlib.crc32(data[at + 4 : at + 8 + length]) != struct.unpack_from(">I", data, at + 8 + length)[0]:
            return False
        at += 12 + length
        if kind == b"IEND":
            return at == len(data)
    return False


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("glint", type=pathlib.Path)
    parser.add_argument("models", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    glint = str(given.glint.absolute())
    rng = random.Random(given.seed)
    faults, early = [], 0
    with tempfile.TemporaryDirectory(prefix="glint-interrupts-") as name:
        folder = pathlib.Path(name)
        model = folder / "model.glb"
        shutil.copy(given.models / "torus.glb", model)
        (folder / "list").write_text("".join(f"model.glb\tout/{i}.png\n" for i in range(12)))
        render = [glint, "render", "--from-list", "list", "-o", "out/{n}.png", "--resolution", "64,64",
                  "--rendering-backend", "osmesa", "--anti-aliasing", "none"]
        convert = [glint, "convert", "model.glb", "out/new.glb", "--material", "exponent=7"]
        (folder / "out").mkdir()
        subprocess.run(convert, cwd=folder, check=True)
        converted = (folder / "out/new.glb").read_bytes()
        durations = {}
        for command in (render, convert):
            start = time.monotonic()
            subprocess.run(command, cwd=folder, check=True, capture_output=True)
            durations[command[1]] = time.monotonic() - start
        shutil.rmtree(folder / "out")
        number = -1
        while early < given.count and number < 10 * given.count:
            number += 1
            command = rng.choice([render, render, convert])
            (folder / "out").mkdir(exist_ok=True)
            process = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
            time.sleep(rng.random() * durations[command[1]] * 1.1)
            how = rng.choice([signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
            early += process.poll() is None
            process.send_signal(how)
            said = process.communicate(timeout=60)[1]
            if process.returncode not in (0, -how, 128 + how):
                faults.append(f"{number}: status {process.returncode} after {how.name}: {said[-300:]!r}")
            for path in (folder / "out").iterdir():
                data = path.read_bytes()
                good = (whole_png(data) if path.suffix == ".png" else
                        path.name == "new.glb" and data == converted)
                if not good:
                    faults.append(f"{number}: {how.name} of {command[1]} has left {path.name}, {len(data)} bytes")
            shutil.rmtree(folder / "out", ignore_errors=True)
            if model.stat().st_size != (given.models / "torus.glb").stat().st_size:
                faults.append(f"{number}: the model has changed")
        left = [path.name for path in folder.iterdir() if path.name not in ("model.glb", "list", "out")]
        if left:
            faults.append(f"left beside: {left}")
        # Interrupts and resumes until everything is there.
        for _ in range(20):
            process = subprocess.Popen([*render, "--resume"], cwd=folder, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            time.sleep(rng.random() * durations["render"])
            process.send_signal(rng.choice([signal.SIGINT, signal.SIGKILL]))
            process.wait()
        done = subprocess.run([*render, "--resume"], cwd=folder, capture_output=True)
        pictures = sorted(path.name for path in (folder / "out").iterdir())
        if done.returncode != 0 or len(pictures) != 12:
            faults.append(f"--resume ends with {done.returncode} and {pictures}")
    print("\n".join(faults[:50]))
    print(f"{early} interruptions, {number + 1 - early} more came too late, {len(faults)} faults")
    sys.exit(1 if faults or early < given.count else 0)


if __name__ == "__main__":
    main()
