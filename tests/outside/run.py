"""Installs glint into a folder, builds the project next to this file against it, and runs its
tests, some of which are planted to fail: run.py BUILD_FOLDER SCRATCH_FOLDER"""

import json
import os
import pathlib
import re

from steps import check, install, outside, prefix, run, scratch

HERE = pathlib.Path(__file__).resolve().parent

install("glint", "dev")
check(not list(prefix.rglob("glint-viewer*")), "the viewer is a part of its own")
include = prefix / "include"
check((include / "glint/scene/scene.h").is_file(), "headers are installed")
for header in include.rglob("*.h"):
    for name in re.findall(r'#\s*include\s*[<"]((?:glint|nlohmann|CLI)/.*|tiny_gltf.*)[>"]',
                           header.read_text()):
        check((include / name).is_file(), "what %s includes is installed: %s" % (header, name))
run("cmake", "-S", HERE, "-B", outside, "-G", "Ninja", "-DCMAKE_PREFIX_PATH=%s" % prefix,
    "-DMODELS=%s" % (HERE.parent.parent / "models"), "-DHEADERS=%s" % include,
    "-DEXAMPLES=%s" % (HERE.parent.parent / "examples"))
run("cmake", "--build", outside)
tests = {t["name"]: t["command"] for t in
         json.loads(run("ctest", "--test-dir", outside, "--show-only=json-v1"))["tests"]}
os.chdir(outside)
pictures = outside / "image-tests"

# Correct tests pass.
run(*tests["gradient.same"])
run(*tests["unit.Same"])

# Planted failures are found, explained, and leave their pictures.
said = run(*tests["gradient.planted"], status=1)
check("flip 0.01" in said and "is above 0.001" in said, "the metric is told: " + said)
check("worst at 20,10" in said, "the worst pixel is told: " + said)
for name in ("actual/gradient.planted.png", "baseline/gradient.planted.png",
             "difference/gradient.planted.png"):
    check((pictures / name).stat().st_size > 0, name + " is left")
result = json.loads((pictures / "result/gradient.planted.json").read_text())
check(result["metrics"]["flip"]["mean"] > 0.01, "the result is left")
said = run(*tests["unit.Planted"], status=1)
check("flip 0.01" in said and "(20, 10): " in said and "-> " in said, "the worst pixels: " + said)
check((pictures / "difference/gradient.png").is_file(), "the difference of the matcher is left")

# Without a baseline, a candidate is left and the status is 4; the printed command makes the
# baseline.
baseline = outside / "baselines/new.png"
said = run(*tests["gradient.new"], status=4)
check("no baseline" in said and str(pictures / "actual/gradient.new.png") in said, said)
check((pictures / "actual/gradient.new.png").is_file() and not baseline.exists(), "a candidate")
said = run(*tests["gradient.new"], GLINT_UPDATE_BASELINES="1")
check("made the baseline " + str(baseline) in said, "it is said: " + said)
run(*tests["gradient.new"])
run(*tests["teapot"], status=4)
run(*tests["teapot"], GLINT_UPDATE_BASELINES="1")
run(*tests["teapot"])
check("no baseline" in run(*tests["unit.Missing"], status=1), "the matcher says so, too")
said = run(*tests["unit.Missing"], status=1, GLINT_UPDATE_BASELINES="1")
check("made the baseline made/unit.png" in said, "the matcher makes it: " + said)
run(*tests["unit.Missing"])

# In a shared library, and together with another GL loader.
check("llvmpipe" in run(*tests["embedded"]), "a shared library draws")
check("llvmpipe" in run(*tests["two_loaders"]), "two loaders in one program")

# A program that fails is not a picture that differs.
said = run(*tests["gradient.crashes"], status=2)
check("ended with status 2" in said, said)

# All tests under ctest, and one page for them.
said = run("ctest", "--test-dir", outside, status=8)
check("3 tests failed out of 14" in said, said)
check((outside / "examples/turn-2.png").stat().st_size > 1000 and
      (outside / "examples/wave.png").stat().st_size > 1000, "pictures of the examples")
run(prefix / "bin/glint", "diff", "--run", pictures, "--html", scratch / "report.html", status=2)
check((scratch / "report.html").stat().st_size > 10000, "a report")
