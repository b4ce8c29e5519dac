"""Installs glint into a folder, runs the seven image tests of the project next to this file with
it, and checks the report: run.py BUILD_FOLDER SCRATCH_FOLDER"""

import json
import pathlib
import struct
import sys
import zlib

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from steps import check, install, outside, prefix, run, scratch


def write(name, more=0):
    """A ramp of 24 x 16 pixels with one pixel brighter by `more` codes."""
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))
    rows = b"".join(b"\0" + bytes(8 * x + (more if (x, y) == (7, 5) else 0) for x in range(24))
                    for y in range(16))
    path = outside / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" +
                     chunk(b"IHDR", struct.pack(">IIBBBBB", 24, 16, 8, 0, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


install("glint")
glint = prefix / "bin/glint"
write("made/plain.png")
write("made/slight.png", 2)
write("made/planted.png", 90)
for name in ("same", "slight", "several", "shift", "unused"):
    write("baselines/%s.png" % name)
write("baselines/several_1.png", 90)
run("cmake", "-S", HERE, "-B", outside, "-G", "Ninja", "-DCMAKE_PREFIX_PATH=%s" % prefix)
said = run("ctest", "--test-dir", outside, status=8)
check("4 tests failed out of 7" in said, said)

# The report agrees with the run: results, conditions, crashes, and pictures that were not written.
folder = outside / "image-tests"
said = run(glint, "diff", "--run", folder, "--html", scratch / "report.html", "--json",
           scratch / "report.json", "--junit", scratch / "report.xml", "--markdown",
           scratch / "report.md", status=2)
check("7 pairs: 3 same, 2 differ, 2 missing, 0 without baseline, 0 unreadable" in said, said)
report = json.loads((scratch / "report.json").read_text())
pairs = {pair["name"]: pair for pair in report["pairs"]}
check(sorted(pairs) == ["crashes", "same", "several", "silent", "slight", "ui/shift", "ui_shift"],
      sorted(pairs))
check([pairs[n]["status"] for n in ("same", "slight", "several")] == [0, 0, 0], "three are same")
check(pairs["slight"]["conditions"] == ["--metric", "max", "--threshold", "0.02"],
      pairs["slight"]["conditions"])
check(pairs["slight"]["differing"] == 1, "its difference is within what is allowed")
check("several_1.png, the nearest of 2" in pairs["several"]["notes"][0], pairs["several"])
check(abs(pairs["ui/shift"]["metrics"]["max"]["value"] - 2 / 255) < 1e-6, pairs["ui/shift"])
check(abs(pairs["ui_shift"]["metrics"]["max"]["value"] - 90 / 255) < 1e-6, pairs["ui_shift"])
check("crashed (signal 11)" in pairs["crashes"]["error"], pairs["crashes"])
check("about to crash" in pairs["crashes"]["log"], "what it said is kept")
check("did not write its picture" in pairs["silent"]["error"], pairs["silent"])
unused = [pathlib.Path(path).name for path in report["unusedBaselines"]]
check(unused == ["unused.png"], unused)
check("baselines/unused.png: no test uses this baseline" in said, said)
check('tests="7" failures="2" errors="2"' in (scratch / "report.xml").read_text(), "JUnit")
check("| ui\\_shift |" in (scratch / "report.md").read_text(), (scratch / "report.md").read_text())
check((scratch / "report.html").stat().st_size > 10000, "a page")

# Accepts one by a pattern, and the other with the command that ctest printed.
said = run(glint, "diff", "--run", folder, "--update", "ui_*", status=2)
check("replaced the baseline %s/baselines/shift.png" % outside in said, said)
write("baselines/shift.png")
said = run("ctest", "--test-dir", outside, "-R", "ui_shift", GLINT_UPDATE_BASELINES="1")
check("replaced the baseline %s/baselines/shift.png" % outside in said, said)
run("ctest", "--test-dir", outside, "-R", "ui_shift")
said = run(glint, "diff", "--run", folder, "--prune", status=2)
check("removed the baseline %s/baselines/unused.png" % outside in said, said)
check(not (outside / "baselines/unused.png").exists(), "it is gone")
check((outside / "baselines/several_1.png").exists(), "the others are there")
# If a folder has anything other than pictures, those that belong to no test may be somebody's
# files.
write("baselines/drawing.png")
(outside / "baselines/notes.txt").write_text("not a folder of baselines alone")
said = run(glint, "diff", "--run", folder, "--prune", status=2)
check("removed" not in said and (outside / "baselines/drawing.png").exists(), said)

# A test that was killed, and one that has been removed from the project.
(folder / "status/same.txt").write_text("started\n")
said = run(glint, "diff", "--run", folder, status=2)
check("same: the test did not end" in said, said)
said = run(glint, "diff", "--run", outside / "made", status=2)
check("no image tests found" in said, said)
