"""Runs the whole program on damaged files, whether damaged by malice or by accident.

    mutants.py GLINT MODELS [--seconds N] [--seed N] [--keep FOLDER]

Takes the models in the folder MODELS, a few made here, and those under GLINT_ASSETS (malformed/ and
models/) and GLINT_CASES if they are set. Mutates their structure (members of the JSON, counts,
offsets and types of accessors, lengths of chunks, bytes of buffers and pictures) and draws, lists
and converts them, with looks and tables mutated likewise. Fails on a crash, a hang, a sanitizer
report, an "internal error" or a status other than 0, 1 and 2, and keeps the inputs in FOLDER.
"""

import argparse
import base64
import copy
import json
import os
import pathlib
import random
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

TELLING = [0, 1, -1, 2, 3, 5, 15, 255, 256, 65535, 65536, 2**31 - 1, 2**31, 2**32 - 1, 2**32, 2**53, 2**63,
           0.5, 1e-45, 1e38, 1e39, -1e300, 5120, 5123, 5126, None, True, False, "", "a", "SCALAR", "VEC3",
           "MAT4", "data:;base64,AAAA", "../a", "\u001b[1m\n", [], {}, [[]], [0], [1e30, 0, 0], "NaN"]
KEYS = ["bufferView", "byteOffset", "byteLength", "count", "type", "componentType", "mesh", "children",
        "matrix", "translation", "indices", "POSITION", "NORMAL", "TEXCOORD_0", "material", "index", "extensions",
        "extras", "uri", "mode", "sparse", "skin", "weights", "targets", "byteStride", "source", "sampler"]
PER_RUN = 16
TIMEOUT = 120


def png(width, height, colour=(200, 100, 50, 255)):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + bytes(colour) * width for _ in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def made_model():
    """A textured triangle with a second primitive, a sparse accessor, an animation, a skin and a light."""
    binary, views = b"", []

    def view(data):
        nonlocal binary
        binary += b"\0" * (-len(binary) % 4)
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
        binary += data
        return len(views) - 1

    def floats(*values):
        return view(struct.pack(f"<{len(values)}f", *values))

    position = floats(0, 0, 0, 1, 0, 0, 0, 1, 0)
    normal = floats(0, 0, 1, 0, 0, 1, 0, 0, 1)
    uv = floats(0, 0, 1, 0, 0, 1)
    index = view(struct.pack("<3H", 0, 1, 2))
    image = view(png(6, 5))
    joints = view(bytes(12))
    weights = floats(1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0)
    times, moves = floats(0, 1), floats(0, 0, 0, 0, 1, 0)
    sparse_index, sparse_value = view(struct.pack("<H", 1)), floats(0.5, 0.5, 0)
    accessor = lambda v, kind, count, component=5126, **more: {  # noqa: E731
        "bufferView": v, "type": kind, "count": count, "componentType": component, **more}
    attributes = {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
        "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_ior"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 9, "spot": {}}]}},
        "nodes": [{"mesh": 0, "name": "a"}, {"mesh": 1, "skin": 0, "translation": [1, 0, 0]},
                  {"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [0, 0, 3],
                   "children": [3]}, {"camera": 0}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.6, "znear": 0.1}}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": 3, "material": 0,
                                    "targets": [{"POSITION": 8}]}], "weights": [0.5]},
                   {"primitives": [{"attributes": {**attributes, "JOINTS_0": 4, "WEIGHTS_0": 5}, "material": 1},
                                   {"attributes": {"POSITION": 0}, "mode": 2}]}],
        "materials": [{"name": "paint", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
                                                                  "roughnessFactor": 0.4},
                       "normalTexture": {"index": 0}, "extensions": {"KHR_materials_ior": {"ior": 1.4}}},
                      {"name": "paint", "alphaMode": "BLEND", "doubleSided": True,
                       "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 0.5]},
                       "extras": {"glint": {"exponent": 40}}}],
        "textures": [{"source": 0, "sampler": 0}], "samplers": [{"minFilter": 9987, "wrapS": 33648}],
        "images": [{"bufferView": image, "mimeType": "image/png"}],
        "skins": [{"joints": [0, 3]}],
        "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                        "samplers": [{"input": 6, "output": 7, "interpolation": "LINEAR"}]}],
        "accessors": [accessor(position, "VEC3", 3), accessor(normal, "VEC3", 3), accessor(uv, "VEC2", 3),
                      accessor(index, "SCALAR", 3, 5123), accessor(joints, "VEC4", 3, 5121),
                      accessor(weights, "VEC4", 3), accessor(times, "SCALAR", 2), accessor(moves, "VEC3", 2),
                      {"type": "VEC3", "count": 3, "componentType": 5126,
                       "sparse": {"count": 1, "indices": {"bufferView": sparse_index, "componentType": 5123},
                                  "values": {"bufferView": sparse_value}}}],
        "bufferViews": views,
    }
    return document, binary


def take_apart(path):
    """(document, binary) of a model, or None if there is no JSON to change."""
    data = path.read_bytes()
    try:
        if data[:4] != b"glTF":
            document, binary = json.loads(data), b""
            for each in document.get("buffers", [])[:1]:
                uri = each.pop("uri", "")
                if uri.startswith("data:"):
                    binary = base64.b64decode(uri.split(",", 1)[1] + "==")
                elif uri and (path.parent / uri).is_file():
                    binary = (path.parent / uri).read_bytes()
            return document, binary
        length = struct.unpack_from("<I", data, 12)[0]
        return json.loads(data[20 : 20 + length]), data[20 + length + 8 :]
    except (ValueError, KeyError, AttributeError, TypeError, IndexError, RecursionError, struct.error):
        return None


def places(value, found):
    """All positions in a JSON tree, as (container, key)."""
    if isinstance(value, dict):
        items = value.items()
    elif isinstance(value, list):
        items = enumerate(value[:50])
    else:
        return
    for key, each in items:
        found.append((value, key))
        places(each, found)


def change_tree(document, rng):
    found = []
    places(document, found)
    if not found:
        return
    # Half of the time, the most sensitive members: numbers of accessors and views, and references.
    if rng.random() < 0.5:
        found = [each for each in found if each[1] in KEYS] or found
    container, key = rng.choice(found)
    value = container[key]
    kind = rng.randrange(8)
    if kind == 0:
        del container[key]
    elif kind == 1 and isinstance(value, (int, float)) and not isinstance(value, bool):
        container[key] = value + rng.choice([-1, 1, 4, -4, 0.5, 1000])
    elif kind == 2 and isinstance(value, list):
        value.extend(copy.deepcopy(value) * rng.choice([1, 1, 20]))
    elif kind == 3:
        container[key] = copy.deepcopy(rng.choice(found)[0])
    elif kind == 4 and isinstance(container, dict):
        container[rng.choice(KEYS)] = copy.deepcopy(value)
    elif kind == 5 and isinstance(value, list) and value:
        rng.shuffle(value)
    elif kind == 6:
        for _ in range(rng.choice([1, 3, 70])):
            container[key] = [container[key]]
    else:
        container[key] = rng.choice(TELLING)


def change_bytes(data, rng):
    data = bytearray(data)
    for _ in range(rng.randint(1, 8)):
        if not data:
            break
        at = rng.randrange(len(data))
        kind = rng.randrange(4)
        if kind == 0:
            data[at] ^= 1 << rng.randrange(8)
        elif kind == 1:
            data[at : at + 4] = rng.choice([b"\xff\xff\xff\xff", b"\0\0\0\0", b"\0\0\x80\x7f", b"\0\0\xc0\x7f"])
        elif kind == 2:
            data[at : at + rng.randint(1, 64)] = b""
        else:
            data[at:at] = data[at : at + rng.randint(1, 64)]
    return bytes(data)


def mutant(seed, rng):
    """(bytes, extension) of a mutated model."""
    document, binary = copy.deepcopy(seed[0]), seed[1]
    for _ in range(rng.choice([1, 1, 2, 3, 6])):
        change_tree(document, rng)
    if rng.random() < 0.3:
        binary = change_bytes(binary, rng)
    if isinstance(document, dict):
        buffers = document.get("buffers")
        if not (isinstance(buffers, list) and buffers) and rng.random() < 0.95:
            document["buffers"] = [{"byteLength": len(binary)}]
    text = json.dumps(document).encode()
    if rng.random() < 0.1:
        text = change_bytes(text, rng)
    if rng.random() < 0.3:
        if isinstance(document, dict) and isinstance(document.get("buffers"), list) and document["buffers"]:
            if isinstance(document["buffers"][0], dict):
                document["buffers"][0]["uri"] = (
                    "data:application/octet-stream;base64," + base64.b64encode(binary).decode())
                text = json.dumps(document).encode()
        return text, ".gltf"
    text += b" " * (-len(text) % 4)
    lengths = [12 + 8 + len(text) + 8 + len(binary), len(text), len(binary)]
    if rng.random() < 0.15:  # the lengths of the file and of its chunks
        at = rng.randrange(3)
        lengths[at] = rng.choice([0, 1, lengths[at] - 1, lengths[at] + 1, lengths[at] * 2, 2**31, 2**32 - 1])
    data = (b"glTF" + struct.pack("<II", 2, max(lengths[0], 0) % 2**32)
            + struct.pack("<I", max(lengths[1], 0) % 2**32) + b"JSON" + text
            + struct.pack("<I", max(lengths[2], 0) % 2**32) + b"BIN\0" + binary)
    if rng.random() < 0.05:
        data = data[: rng.randrange(len(data))]
    return data, ".glb"


class Runs:
    def __init__(self, glint, folder, keep):
        self.glint, self.folder, self.keep = glint, folder, keep
        self.executions, self.finds = 0, []

    def fault(self, arguments):
        """The fault of a run, or nothing."""
        self.executions += 1
        environment = dict(os.environ, ASAN_OPTIONS="allocator_may_return_null=1:detect_leaks=0",
                           UBSAN_OPTIONS="print_stacktrace=1")
        try:
            ran = subprocess.run([self.glint, *arguments], cwd=self.folder, env=environment,
                                 stdin=subprocess.DEVNULL, capture_output=True, timeout=TIMEOUT)
        except subprocess.TimeoutExpired:
            return f"more than {TIMEOUT} s"
        said = ran.stderr.decode(errors="replace")
        for sign in ("Sanitizer", "runtime error", "internal error", "Assertion"):
            if sign in said:
                return said[:4000]
        if ran.returncode not in (0, 1, 2):
            return f"status {ran.returncode}: {said[-2000:]}"
        if b"\x1b" in ran.stderr or b"\x1b" in ran.stdout:
            return "an escape sequence was printed"
        return None

    def check(self, arguments, files):
        what = self.fault(arguments)
        if not what:
            return True
        place = self.keep / f"find{len(self.finds)}"
        place.mkdir(parents=True, exist_ok=True)
        for name in files:
            shutil.copy(self.folder / name, place)
        (place / "what.txt").write_text(" ".join(arguments) + "\n\n" + what)
        self.finds.append(place)
        print(f"FOUND: {place}: {what.splitlines()[0]}", flush=True)
        return False


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("glint")
    parser.add_argument("models", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=300)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path("mutants-found"))
    given = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    folders = [given.models]
    if assets := os.environ.get("GLINT_ASSETS"):
        folders += [pathlib.Path(assets) / "malformed", pathlib.Path(assets) / "models"]
    if cases := os.environ.get("GLINT_CASES"):
        folders.append(pathlib.Path(cases))
    paths = sorted(p for folder in folders for p in folder.rglob("*.gl[bt]*")
                   if p.suffix in (".glb", ".gltf") and p.stat().st_size < 300_000)
    seeds = [made_model()] + [each for each in map(take_apart, paths) if each]
    rng = random.Random(given.seed)
    inputs = 0
    with tempfile.TemporaryDirectory(prefix="glint-mutants-") as name:
        folder = pathlib.Path(name)
        runs = Runs(os.path.abspath(given.glint), folder, given.keep.absolute())
        # Unmutated, in a folder of their own.
        for path in paths:
            inputs += 1
            runs.check(["render", str(path), "-o", "a.png", "--resolution", "24,16", "--confine",
                        "--rendering-backend", "osmesa"], [])
        runs.check(["render", "--save-look", "look.json", str(given.models / "torus.glb"), "-o", "a.png",
                    "--resolution", "24,16", "--light", "camera@1,2,3", "--material", "ior=1.4"], [])
        look = json.loads((folder / "look.json").read_text())
        end = time.monotonic() + given.seconds
        while time.monotonic() < end:
            names = []
            for i in range(PER_RUN):
                # The generated model has most features.
                data, ending = mutant(seeds[0] if rng.random() < 0.4 else rng.choice(seeds), rng)
                names.append(f"m{i}{ending}")
                (folder / names[-1]).write_bytes(data)
            inputs += PER_RUN
            (folder / "list").write_text("\n".join(names) + "\n")
            changed = copy.deepcopy(look)
            for _ in range(rng.randint(0, 2)):
                change_tree(changed, rng)
            (folder / "changed.json").write_text(json.dumps(changed))
            options = ["--resolution", "24,16", "--rendering-backend",
                       rng.choice(["osmesa", "osmesa", "osmesa", "reference"]), "--shading",
                       rng.choice(["flat", "gouraud", "phong", "environment", "auto"]),
                       *rng.choice([[], [], ["--max-error", "0.01"], ["--frames", "2"], ["--animation-time", "0.5"],
                                    ["--terms"], ["--turntable", "2"], ["--camera-index", "0"], ["--two-sided"]])]
            output = "{model}-{frame}.png" if "--frames" in options or "--turntable" in options else "{model}.png"
            whole = ["render", "--from-list", "list", "-o", output, *options]
            if runs.fault(whole):  # which of them?
                alone = [runs.check(["render", each, "-o", output, *options], [each]) for each in names]
                if all(alone):
                    runs.check(whole, ["list", *names])
            one = rng.choice(names)
            runs.check(["info", one, "--json", "-"], [one])
            runs.check(["convert", one, "out" + one[one.rfind("."):], "--material", "exponent=7,color=#123456"], [one])
            runs.check(["render", str(given.models / "torus.glb"), "-o", "a.png", "--look", "changed.json",
                        "--resolution", "24,16", "--rendering-backend", "osmesa"], ["changed.json"])
            for each in folder.glob("m*-*.png"):
                each.unlink()
        print(f"{len(paths)} files, {inputs} inputs, {runs.executions} executions, {len(runs.finds)} finds")
        sys.exit(1 if runs.finds else 0)


if __name__ == "__main__":
    main()
