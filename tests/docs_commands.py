"""Runs the shell blocks of a documentation page, in order, in a copy of the clone, so that they can
be pasted as they are. docs_commands.py SOURCE BUILD PAGE

The README's first section is covered by .ci/fresh, in a bare Debian. Here, windows are closed after
some seconds, studies and sessions stop early, and builds and tests are only looked up: the tests are
run elsewhere. All else is run unchanged.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

source, build, page = (pathlib.Path(p).resolve() for p in sys.argv[1:4])

PRELUDE = r"""
glint() {
  case "$*" in
    view*) timeout 5 glint "$@" || [ $? -eq 124 ] ;;
    study*--measure-costs* | study*--half-precision*) command glint "$@" ;;
    study*) command glint "$@" --time-budget 2 ;;
    *) command glint "$@" ;;
  esac
}
python3() {
  case "$*" in
    tests/viewer_session.py*) command python3 "${@:1:4}" 10 ;;
    *) command python3 "$@" ;;
  esac
}
ctest() { command ctest "$@" -N | grep 'Total Tests: [1-9]'; }
cmake() {
  case "$*" in
    --workflow*) command cmake --list-presets=workflow | grep "\"$3\"" ;;
    --build*)
      command cmake "$@" -- -n >/dev/null || return
      # What would have been built stands in for it.
      case "$2" in -*) return ;; esac
      [ -e "$2/glint" ] && return
      mkdir -p "$2/tests"
      ln -sf "$BUILD"/glint* "$2"; ln -sf "$PWD"/build/release/tests/*_tests "$2/tests" ;;
    *) command cmake "$@" ;;
  esac
}
set -eo pipefail
"""


def blocks(text):
    """The shell blocks, except those of the README's first section."""
    text = re.sub(r"^## Start$.*?(?=^## )", "", text, flags=re.M | re.S)
    return re.findall(r"^```sh\n(.*?)^```$", text, flags=re.M | re.S)


def strays(text):
    """Commands outside of shell blocks, where nothing would run them."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)
    return re.findall(r"^    (?:glint|cmake|ctest|build/\S+) .*$", text, flags=re.M)


def main():
    text = page.read_text()
    if strays(text):
        sys.exit("%s: commands outside of ```sh: %s" % (page.name, strays(text)))
    with tempfile.TemporaryDirectory() as folder:
        clone = pathlib.Path(folder) / "clone"
        shutil.copytree(source, clone, ignore=shutil.ignore_patterns("build", ".git", "out"))
        release = clone / "build/release"
        release.mkdir(parents=True)
        for each in [*build.iterdir(), *(build / "tests").iterdir()]:
            here = release / each.relative_to(build)
            if each.name == "tests":
                here.mkdir()
            elif each.name.endswith("_tests"):
                here.write_text('#!/bin/sh\n"%s" --gtest_list_tests "$@" | grep "^  "\n' % each)
                here.chmod(0o755)
            else:
                here.symlink_to(each)
        display, number = os.pipe()
        server = subprocess.Popen(["Xvfb", "-displayfd", str(number), "-screen", "0", "1280x800x24"],
                                  pass_fds=[number], stderr=subprocess.DEVNULL)
        os.close(number)
        try:
            environment = {**os.environ, "DISPLAY": ":" + os.read(display, 16).decode().strip(),
                           "BUILD": str(build), "PATH": "%s:%s" % (release, os.environ["PATH"])}
            for block in blocks(text):
                print("--- " + block.strip().replace("\n", "\n    "), flush=True)
                ran = subprocess.run(["bash", "-c", PRELUDE + block], cwd=clone, env=environment,
                                     stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                     stderr=subprocess.STDOUT, text=True, errors="replace")
                if ran.returncode != 0:
                    sys.exit("%s\n%s: status %d" % (ran.stdout[-3000:], page.name, ran.returncode))
        finally:
            server.terminate()
            server.wait()


main()
