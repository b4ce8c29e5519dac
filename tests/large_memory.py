"""A large model's picture takes at most 2.2 times its file's size more memory than a small one's.

    large_memory.py GLINT

With and without anti-aliasing: if the driver queues triangles faster than it draws them, it must
not hold all of them.
"""

import os
import pathlib
import subprocess
import sys
import tempfile

MODELS = pathlib.Path(__file__).parent / "benchmarks" / "scale_models.py"


def sphere(folder, triangles):
    """Made in a separate process: the memory of this one would count towards its children's."""
    return subprocess.run([sys.executable, "-B", MODELS, folder, "sphere", str(triangles)], check=True,
                          capture_output=True, text=True).stdout.strip()


def peak(command):
    """The peak memory of a run, in bytes."""
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{command}: status {os.waitstatus_to_exitcode(status)}")
    return usage.ru_maxrss * 1024


def main():
    failed = False
    with tempfile.TemporaryDirectory(prefix="glint-large-") as folder:
        small, large = (sphere(folder, count) for count in (1000, 4_000_000))
        size = os.path.getsize(large)
        for smoothing in "none", "msaa:4":
            each = [peak([sys.argv[1], "render", model, "-o", os.path.join(folder, "a.png"), "--resolution",
                          "1024,1024", "--anti-aliasing", smoothing, "--rendering-backend", "egl-software"])
                    for model in (small, large)]
            ratio = (each[1] - each[0]) / size
            print(f"{smoothing}: {each[1] / 1e6:.0f} MB, {each[0] / 1e6:.0f} of a small model: "
                  f"{ratio:.2f} times the file of {size / 1e6:.0f} MB")
            failed |= ratio > 2.2
    sys.exit(failed)


if __name__ == "__main__":
    main()
