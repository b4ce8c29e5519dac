"""The recipes for CI, and the tables for users of other programs, are correct for this program.

recipes_test.py GLINT GLINT_VIEWER PROJECT_FOLDER; needs PyYAML.
"""

import itertools
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import yaml

glint, viewer, root = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])


def check(holds, what):
    if not holds:
        sys.exit("not so: " + what)


def shell(script, folder, status=0, **variables):
    path = os.path.dirname(glint) + os.pathsep + os.environ["PATH"]
    ran = subprocess.run(["sh", "-e", "-c", script], cwd=folder, text=True, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, env=dict(os.environ, PATH=path, **variables))
    check(ran.returncode == status, "%s\n%s\nends with %d, not %d"
          % (script, ran.stdout, status, ran.returncode))
    return ran.stdout


with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    (folder / "models").mkdir()
    shutil.copy(root / "models/torus.glb", folder / "models")
    text = (root / "packaging/gitlab-ci.yml").read_text()
    recipe = yaml.safe_load(text)["pictures"]
    page = (root / "docs/ci.md").read_text()
    check(text[text.index("pictures:"):] in page, "docs/ci.md has packaging/gitlab-ci.yml")
    draw, compare = (line for line in recipe["script"] if line.startswith("glint "))
    shell(draw + " --resolution 64,64", folder)
    shutil.copytree(folder / "pictures", folder / "baselines")
    shell(compare, folder)
    check((folder / "report/index.html").is_file() and
          (folder / recipe["artifacts"]["reports"]["junit"]).is_file(), "GitLab's reports")

    action = yaml.safe_load((root / "packaging/action.yml").read_text())
    example = yaml.safe_load(page.split("```yaml\n")[1].split("```")[0])
    uses = example["jobs"]["pictures"]["steps"][-1]
    check(set(uses["with"]) <= set(action["inputs"]), "the example gives inputs that there are")
    check(any(draw in step.get("run", "") for step in example["jobs"]["pictures"]["steps"]),
          "both recipes draw alike")
    values = {name: each.get("default") for name, each in action["inputs"].items()}
    values.update(uses["with"])
    first, _, last = action["runs"]["steps"]
    for spoilt, status in ((False, 0), (True, 1)):
        if spoilt:
            shell(draw + " --resolution 64,64 --exposure 1", folder)
        variables = {name: re.sub(r"\$\{\{ inputs\.(\w+) \}\}", lambda m: values[m[1]], text)
                     for name, text in first["env"].items()}
        for name in ("summary", "output"):
            (folder / name).write_text("")
            variables["GITHUB_STEP_SUMMARY" if name == "summary" else "GITHUB_OUTPUT"] = str(
                folder / name)
        shell(first["run"], folder, **variables)
        check((folder / "output").read_text() == "status=%d\n" % status, "the step's status")
        check(("torus" if spoilt else "1 same") in (folder / "summary").read_text(), "the summary")
        shell(last["run"], folder, status=status, STATUS=str(status))


# The options of this program in a table's columns are in its help.
def described(program):
    return json.loads(subprocess.run([program, "--help-json"], stdout=subprocess.PIPE, check=True,
                                     text=True).stdout)


whole = described(glint)
options = {c["name"]: {n for o in c["options"] for n in o["names"]} for c in whole["commands"]}
options["view"] |= {n for o in described(viewer)["options"] for n in o["names"]}
top = {n for o in whole["options"] for n in o["names"]}


def rows(page):
    """The page's first table, without its header."""
    lines = (root / "docs" / page).read_text().splitlines()
    first = next(i for i, line in enumerate(lines) if line.startswith("|---"))
    table = itertools.takewhile(lambda line: line.startswith("|"), lines[first + 1:])
    return [[cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip("|"))] for line in table]


def named(text):
    return re.findall(r"`(--[a-z-]+)", text)


known = set().union(top, *options.values())
f3d = rows("coming-from-f3d.md")
check(len(f3d) > 60, "rows of F3D: %d" % len(f3d))
for theirs, ours, _ in f3d:
    check(named(theirs), "an option of F3D in " + theirs)
    check(ours == "-" or named(ours) or ours == "the models themselves", "an option in " + ours)
    for option in named(ours):
        check(option in known, "glint has %s, for %s" % (option, theirs))
    # The same name means the same thing.
    if ours == "-":
        for option in named(theirs):
            check(option not in options["render"], "glint has F3D's %s" % option)
if shutil.which("f3d"):
    said = subprocess.run(["f3d", "--help"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env=dict(os.environ, QT_QPA_PLATFORM="offscreen")).stdout
    told = {option for theirs, _, _ in f3d for option in named(theirs)}
    # Options that version 3 names differently from version 1.3 in Debian 12.
    former = {"--readers-list", "--dry-run", "--quiet", "--geometry-only", "--animation-index", "--hdri",
              "--depth-peeling", "--ssao", "--fxaa", "--scalars", "--bg-color", "--fullscreen"}
    for option in re.findall(r"^ .{0,6}(--[a-z-]+)", said, re.M):
        check(option in told | former, "docs/coming-from-f3d.md has " + option)
for row in rows("coming-from-odiff.md"):
    for option in named(row[2]):
        check(option in options["diff"], "glint diff has " + option)

import_text = (root / "python/glint/__init__.py").read_text()
for row in rows("coming-from-pyrender.md"):
    for keyword in re.findall(r"(\w+)=", row[1]):
        option = "--" + keyword.replace("_", "-")
        check(option in options["render"] or re.search(r"\b%s\b" % keyword, import_text),
              "Python has the keyword " + keyword)
