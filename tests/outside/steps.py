"""What the tests of projects outside of this one have in common: the folders, named by the command line
as BUILD_FOLDER SCRATCH_FOLDER, commands that must end with a status, and the installed program."""

import os
import pathlib
import shutil
import subprocess
import sys

build, scratch = (pathlib.Path(p).resolve() for p in sys.argv[1:3])
prefix, outside = scratch / "prefix", scratch / "build"
shutil.rmtree(scratch, ignore_errors=True)
environment = {k: v for k, v in os.environ.items() if not k.startswith("GLINT_")}


def run(*words, status=0, **variables):
    ran = subprocess.run([str(w) for w in words], env={**environment, **variables}, text=True,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if ran.returncode != status:
        sys.exit("%s\n%s\nended with status %d, not %d" % (" ".join(map(str, words)), ran.stdout,
                                                         ran.returncode, status))
    return ran.stdout


def check(holds, what):
    if not holds:
        sys.exit("not so: %s" % (what,))


def install(*components):
    for component in components:
        run("cmake", "--install", build, "--prefix", prefix, "--component", component)
