"""Which library may include which: the arrows of the house, read from the includes.

Run as `layering_test.py FOLDER` on the project's folder: prints every include that points the wrong
way, or that names a header by another path than its own, and fails if there is one.
"""

import pathlib
import re
import sys

# Each library with those it may include; what those may include follows.
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
    "cli": ["options"],
    "viewer": ["options"],
    "models": [],
}

# The reference draws without GL: of `render` it may see what decides a picture, not what draws it.
REFERENCE_SEES = {"decode.h", "draw_list.h", "environment_image.h", "picture_terms.h", "variant.h"}

# Window and widgets belong to the viewer alone.
VIEWER_ONLY = re.compile(r"(GLFW/|imgui)")


def reachable(library):
    found = {library}
    for other in ARROWS[library]:
        found |= reachable(other)
    return found


def room_of(path, root):
    parts = path.relative_to(root).parts
    if parts[0] == "src":
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


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    found = list(faults(root))
    print("\n".join(found))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
