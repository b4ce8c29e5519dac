"""Manual pages, completions and docs/options.md match the programs' help, and versions agree.

manual_test.py GLINT GLINT_VIEWER PROJECT_FOLDER VERSION
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

glint, viewer, root, version = sys.argv[1:]
root = pathlib.Path(root)


def run(*words, **more):
    return subprocess.run([str(w) for w in words], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, check=True, **more)


def check(holds, what):
    if not holds:
        sys.exit("not so: " + what)


with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    command = ["--glint", glint, "--viewer", viewer]
    run(sys.executable, "-B", root / "cmake/manual.py", *command, "--folder", folder,
        "--markdown", folder / "options.md")
    check((folder / "options.md").read_text() == (root / "docs/options.md").read_text(),
          "docs/options.md is up to date: cmake/manual.py %s --markdown docs/options.md"
          % " ".join(command))

    # Every option in the help of every command is in its manual page, in the completions and in
    # docs/options.md.
    reference = (folder / "options.md").read_text()
    fish = (folder / "fish/glint.fish").read_text()
    commands = re.findall(r"^  ([a-z]+) ", run(glint, "--help").stdout.split("Commands:")[1]
                          .split("Examples:")[0], re.M)
    check(len(commands) == 9, "commands: %s" % commands)
    for command in commands:
        words = [viewer, "--help"] if command == "view" else [glint, command, "--help"]
        options = re.findall(r"^  (?:-\w,)?(--[a-z-]+)", run(*words).stdout, re.M)
        check(len(options) > 1, "options of " + command)
        page = (folder / ("man1/glint-%s.1" % command)).read_text().replace("\\-", "-")
        completed = run("bash", "-c", '. "$1"; COMP_WORDS=(glint $2 --) COMP_CWORD=2; _glint; '
                        'echo "${COMPREPLY[@]}"', "-", folder / "bash/glint", command).stdout.split()
        zsh = (folder / "zsh/_glint").read_text().split("    %s)\n" % command)[1].split(";;")[0]
        for option in options:
            for text, what in ((page, "manual"), (reference, "docs/options.md")):
                check(re.search(re.escape(option) + r"\b(?!-)", text), "%s of %s in the %s"
                      % (option, command, what))
            check(option in completed, "%s of %s in bash" % (option, command))
            check("'*%s[" % option in zsh, "%s of %s in zsh" % (option, command))
            check(re.search("%s' .*-l %s " % (command, option[2:]), fish), "%s of %s in fish"
                  % (option, command))

    def completes(*words):
        text = " ".join("'%s'" % w for w in words)
        return run("bash", "-c", '. "$1"; COMP_WORDS=(%s) COMP_CWORD=%d; _glint; echo "${COMPREPLY[@]}"'
                   % (text, len(words) - 1), "-", folder / "bash/glint", cwd=root).stdout.split()

    check(completes("glint", "ren") == ["render"], "a command")
    check(completes("glint", "render", "--shading", "g") == ["gouraud"], "a value")
    check(completes("glint", "render", "--shading", "=", "g") == ["gouraud"], "a value behind =")
    check(completes("glint", "render", "--fresnel", "=") ==
          ["exact", "textbook", "schlick", "schlick-exp2", "rational"], "all values behind =")
    check(completes("glint", "render", "models/teapot.g") == ["models/teapot.glb"], "a file")
    check(completes("glint", "help", "st") == ["study", "stability"], "help of a command")
    for shell, file in (("zsh", "zsh/_glint"), ("fish", "fish/glint.fish"), ("bash", "bash/glint")):
        if shutil.which(shell):
            run(shell, "-n", folder / file)

    for page in sorted((folder / "man1").iterdir()):
        if shutil.which("groff"):
            said = run("groff", "-ww", "-man", "-Tutf8", "-z", page, cwd=folder).stderr
            check(not said, "%s without warnings: %s" % (page.name, said))

# The version is the same everywhere.
newest = re.search(r"^## (\S+)", (root / "CHANGELOG.md").read_text(), re.M)[1]
check(newest == version, "CHANGELOG.md begins with %s, the project's version is %s" % (newest, version))
check(run(glint, "--version").stdout == "glint %s\n" % version, "glint --version is " + version)
# The source tree need not be a clone, and git need not be installed.
tags = subprocess.run(["git", "-C", str(root), "tag", "--points-at", "HEAD"], text=True, stdout=subprocess.PIPE,
                      stderr=subprocess.DEVNULL).stdout.split() if shutil.which("git") else []
check(not tags or "v" + version in tags, "the tag of this commit is v%s, not %s" % (version, tags))
