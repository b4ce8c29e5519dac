"""No name is defined twice: linking the whole project into one program must not mix up definitions.

Run as `names_test.py FOLDER FILE...` with the project's folder and its libraries and objects:
prints every type that two source files define in one namespace, and every function or variable that
two objects define (inline ones, which the language requires to be identical, are left out), and
fails if there is one. First it plants one of each kind and checks that they are found.
"""

import collections
import pathlib
import re
import subprocess
import sys
import tempfile

# Comments, string and character literals, and preprocessor lines.
NOISE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|'
                   r"'(?:\\.|[^'\\])'|^\s*#[^\n]*", re.S | re.M)
OPENING = re.compile(r"(?:inline\s+)?namespace\s*([\w:]*)\s*$")
TYPE = re.compile(r"\b(?:class|struct|union|enum(?:\s+class|\s+struct)?)\s+(\w+)\s*"
                  r"(?:final\s*)?(?::(?!:)[^;{}()]*)?$")


def types(text):
    """Qualified names of the types that a text defines and that other files could see."""
    scopes, start = [], 0
    text = NOISE.sub(" ", text)
    for match in re.finditer(r"[{};]", text):
        head, start = text[start : match.start()].strip(), match.end()
        if match[0] == "{":
            opening = OPENING.search(head)
            if not opening and all(scopes):
                name = TYPE.search(head)
                if name and not re.search(r"\btemplate\s*<\s*>", head):
                    yield "::".join([*scopes, name[1]])
            scopes.append(opening[1] if opening else "")
        elif match[0] == "}" and scopes:
            scopes.pop()


def types_twice(root):
    places = collections.defaultdict(list)
    for folder in ("src", "viewer", "models"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                for name in set(types(path.read_text())):
                    places[name].append(str(path.relative_to(root)))
    return [f"{name}: {', '.join(where)}" for name, where in places.items() if len(where) > 1]


def symbols_twice(files):
    listed = subprocess.run(["nm", "--print-file-name", "--defined-only", "--extern-only", *files],
                            stdout=subprocess.PIPE, text=True, check=True)
    places = collections.defaultdict(list)
    for line in listed.stdout.splitlines():
        match = re.match(r"(.*):[0-9a-f]* ([A-Z]) (.*)", line)
        # Weak symbols (W, V, u) are inline functions and templates; each program has its own main.
        if match and match[2] in "TDBRGSC" and match[3] != "main":
            places[match[3]].append(match[1].rsplit("/", 1)[-1])
    twice = [f"{name}: {', '.join(where)}\n" for name, where in places.items() if len(where) > 1]
    return subprocess.run(["c++filt"], input="".join(twice), stdout=subprocess.PIPE, text=True,
                          check=True).stdout.splitlines()


def check_planted():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "src").mkdir()
        (root / "src/a.h").write_text("""
namespace house { class Probe; enum class Kind : int { a, b };
struct Outer { struct Inner {}; struct State; }; namespace { struct Own {}; } } // namespace house
""")
        (root / "src/b.h").write_text("""
namespace house::room { class Probe {}; struct Outer {}; }
namespace house { class Probe final : public Base<int> { int x{0}; }; struct Kind {};
namespace { struct Own {}; } struct Inner {}; template <> struct Outer<int> {};
struct Outer::State {}; }
""")
        found = types_twice(root)
        if found != ["house::Kind: src/a.h, src/b.h"]:
            sys.exit(f"planted types: found {found}")
        for name, text in {"a": "int twice() { return 1; } static int own() { return 1; } int a = own();",
                           "b": "int twice() { return 2; } inline int both() { return 1; } int b = both();",
                           "c": "static int own() { return 3; } inline int both() { return 1; }"
                                "int c = own() + both();"}.items():
            (root / f"{name}.cpp").write_text(text)
            subprocess.run(["c++", "-c", f"{name}.cpp", "-o", f"{name}.o"], cwd=root, check=True)
        found = symbols_twice([root / f"{name}.o" for name in "abc"])
        if found != ["twice(): a.o, b.o"]:
            sys.exit(f"planted functions: found {found}")


def main():
    check_planted()
    found = types_twice(pathlib.Path(sys.argv[1]).resolve()) + symbols_twice(sys.argv[2:])
    print("\n".join(found))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
