"""Headers that take seconds to compile, and which files may include them, directly or not.

Run as `heavy_headers_test.py FOLDER` with the project's folder: prints each source file that
includes a heavy header and is not listed here, with the chain of includes, and fails if there is
one.
"""

import fnmatch
import functools
import pathlib
import re
import sys

# The seconds that GCC 12 takes for an otherwise empty file; patterns of the allowed source files.
HEAVY = {
    # 8.8; elsewhere `namespace CLI { class App; }` is enough
    r"CLI/.*": ["src/cli/*_command.cpp", "src/cli/main.cpp", "src/cli/diff_options.cpp",
                "src/cli/render_options.cpp", "src/cli/shorthand.cpp", "src/glint/options/help.cpp",
                "src/glint/options/help_json.cpp",
                "src/glint/options/exit_status.cpp", "src/glint/options/look_options.cpp",
                "src/glint/options/read_options.cpp",
                "viewer/main.cpp"],
    # 3.3, and 5 more for reading and writing; nlohmann/json_fwd.hpp (0.9) is enough for headers
    r"nlohmann/json\.hpp": [
        "src/glint/image/json_*.cpp", "src/glint/gltf/*", "src/glint/options/*",
        "src/glint/api/arrays.cpp",
        "src/glint/budget/cost_file.cpp", "src/glint/stability/document.cpp",
        "src/glint/stability/attributes.cpp", "src/glint/stability/exponents.cpp",
        "src/glint/stability/geometry.cpp",
        "src/glint/stability/lights.cpp", "src/glint/stability/limits.cpp",
        "src/glint/stability/plots.cpp", "src/glint/stability/profile.cpp",
        "src/glint/stability/search.cpp", "src/glint/stability/suite.cpp",
        "src/glint/study/page.cpp", "src/glint/study/plot.cpp", "src/glint/study/report_json.cpp",
        "src/cli/*", "viewer/edits.cpp", "viewer/effects.cpp", "viewer/look_merge.cpp", "viewer/materials.cpp",
        "viewer/probe.cpp", "viewer/recovery.cpp", "viewer/settings.cpp", "viewer/widgets.cpp",
        "models/*", "tests/*"],
    # 2 to 5
    r"(Imf|OpenEXR/).*": ["src/glint/image/exr_*.cpp", "tests/image_formats_test.cpp"],
    r"(draco|meshoptimizer).*": ["src/glint/gltf/draco.cpp", "src/glint/gltf/meshopt.cpp",
                                 "viewer/coarse.cpp",
                                 "tests/gltf_compression_test.cpp"],
    r"boost/.*": ["tests/fresnel_test.cpp", "tests/lobe_test.cpp", "tests/srgb_test.cpp"],
    r"(gtest|gmock)/.*": ["tests/*", "src/glint/image/matchers.cpp"],
    r"tiny_gltf\.h": ["src/glint/gltf/*.cpp"],
    r"regex": ["src/glint/render/probe.cpp", "tests/composition_test.cpp"],
    r"(imgui|GLFW/).*": ["viewer/*.cpp"],
}

INCLUDE = re.compile(r'^\s*#\s*include\s+(?:<([^>]+)>|"([^"]+)")', re.M)


def sources(root):
    for folder in ("src", "viewer", "models", "tests"):
        for path in (root / folder).rglob("*"):
            if path.suffix in (".cpp", ".h") and "outside" not in path.parts:
                yield path


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    files = {path: [a or b for a, b in INCLUDE.findall(path.read_text())] for path in sources(root)}

    @functools.cache
    def found(name, beside):
        for folder in (beside, root / "src", root, root / "src/cli", root / "tests"):
            if (folder / name).resolve() in files:
                return (folder / name).resolve()
        return None

    def ways(path, seen):
        """Each heavy header that a file includes, with the first chain of includes found."""
        for name in files[path]:
            for heavy in HEAVY:
                if re.fullmatch(heavy, name):
                    yield heavy, [name]
            inner = found(name, path.parent)
            if inner and inner not in seen:
                seen.add(inner)
                for heavy, way in ways(inner, seen):
                    yield heavy, [str(inner.relative_to(root))] + way

    wrong = 0
    for path in sorted(files):
        if path.suffix != ".cpp":
            continue
        name = str(path.relative_to(root))
        told = set()
        for heavy, way in ways(path, {path}):
            if heavy in told or any(fnmatch.fnmatch(name, each) for each in HEAVY[heavy]):
                continue
            told.add(heavy)
            wrong += 1
            print("%s includes %s" % (name, ", which includes ".join(way)))
    if not files:
        sys.exit("no sources in " + str(root))
    sys.exit(1 if wrong else 0)


main()
