"""Which library may include which: the dependencies of the project, checked from its includes.

Run as `layering_test.py FOLDER` with the project's folder: prints every include that points the
wrong way, or that names a header by a path other than its own, and fails if there is one. First it
plants one of each kind in a temporary folder and checks that they are found.
"""

import pathlib
import re
import sys
import tempfile

# Each library with those it may include; their own dependencies are implied.
ARROWS = {
    "image": [],
    "shading": ["image"],
    "scene": ["shading"],
    "gltf": ["scene"],
    "gl": ["image"],
    "render": ["gl", "scene"],
    "reference": ["render"],
    "budget": ["render"],
    "study": ["budget", "reference", "models"],
    "stability": ["budget", "reference", "gltf"],
    "options": ["study", "stability", "gltf"],
    "api": ["options", "reference"],
    "cli": ["options"],
    "viewer": ["options"],
    "models": [],
}

# The reference draws without GL: from `render` it may include what determines a picture, not what
# draws it.
REFERENCE_SEES = {"decode.h", "draw_list.h", "environment_image.h", "picture_terms.h", "variant.h"}

# Only the viewer uses windows and widgets.
VIEWER_ONLY = re.compile(r"(GLFW/|imgui)")


def reachable(library):
    found = {library}
    for other in ARROWS[library]:
        found |= reachable(other)
    return found


def room_of(path, root):
    parts = path.relative_to(root).parts
    if parts[0] == "src":
        if parts[1] == "glint" and len(parts) == 3:
            return "api"  # its headers: glint/glint.h
        return parts[2] if parts[1] == "glint" else parts[1]
    return parts[0]


def faults(root):
    files = [
        path
        for folder in ("src", "viewer", "models")
        for path in sorted((root / folder).rglob("*"))
        if path.suffix in (".h", ".cpp")
    ]
    for path in files:
        room = room_of(path, root)
        if room not in ARROWS:
            yield f"{path}: its folder is no library of the layering test"
            continue
        allowed = reachable(room)
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = re.match(r'\s*#\s*include\s*([<"])([^>"]+)[>"]', line)
            if not match:
                continue
            where, name = f"{path.relative_to(root)}:{number}", match[2]
            if match[1] == "<":
                if room != "viewer" and VIEWER_ONLY.search(name):
                    yield f"{where}: only the viewer may include <{name}>"
                continue
            beside = name.split("/")[0] not in ("glint", "viewer", "models")
            target = path.parent / name if beside else root / ("src" if name.startswith("glint/") else ".") / name
            if not target.exists():
                yield f"{where}: there is no {target.relative_to(root)}"
                continue
            other = room_of(target.resolve(), root)
            if other not in allowed:
                yield f"{where}: {room} may not include {other}"
            elif room == "reference" and other == "render" and target.name not in REFERENCE_SEES:
                yield f"{where}: the reference may not include what draws with GL"


# A small project: the text of each file and, if it has a fault, the message expected.
PLANTED = {
    "src/glint/image/image.h": ("", None),
    "src/glint/scene/scene.h": ('#include "glint/image/image.h"', None),
    "src/glint/image/upward.h": ('#include "glint/scene/scene.h"', "image may not include scene"),
    "src/glint/gltf/file.cpp": ('#include "glint/scene/scene.h"\n#include "file.h"', None),
    "src/glint/gltf/file.h": ('#include "../image/image.h"', None),
    "src/glint/gl/aside.cpp": ('#  include  "glint/gltf/file.h"', "gl may not include gltf"),
    "src/glint/render/variant.h": ("", None),
    "src/glint/render/renderer.h": ('#include "glint/render/variant.h"', None),
    "src/glint/reference/a.cpp": ('#include "glint/render/variant.h"', None),
    "src/glint/reference/b.cpp": ('#include "glint/render/renderer.h"', "what draws with GL"),
    "src/glint/study/a.cpp": ("#include <imgui.h>", "only the viewer may include <imgui.h>"),
    "src/glint/attic/a.cpp": ("", "no library"),
    "src/glint/glint.h": ('#include "glint/image/image.h"', None),
    "src/glint/gltf/easy.cpp": ('#include "glint/glint.h"', "gltf may not include api"),
    "src/cli/main.cpp": ('#include "image/image.h"', "there is no src/cli/image/image.h"),
    "src/cli/window.cpp": ('#include "viewer/panel.h"', "cli may not include viewer"),
    "viewer/panel.h": ('#include <GLFW/glfw3.h>\n#include "glint/render/renderer.h"', None),
    "models/mesh.h": ("", None),
    "models/upward.h": ('#include "glint/image/image.h"', "models may not include image"),
}


def check_planted():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder).resolve()
        for name, (text, _) in PLANTED.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text + "\n")
        found = list(faults(root))
    for name, (_, words) in PLANTED.items():
        of_file = [each for each in found if name in each]
        if len(of_file) != (words is not None) or any(words not in each for each in of_file):
            sys.exit(f"planted in {name}: {words}; found: {of_file}")


def main():
    check_planted()
    root = pathlib.Path(sys.argv[1]).resolve()
    found = list(faults(root))
    print("\n".join(found))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
