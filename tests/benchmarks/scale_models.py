"""Models of any size for measurements: bumpy spheres, many nodes of one sphere, and a scene of many
draws, materials and lights. Each is made once and kept in the given folder.

  scale_models.py FOLDER sphere TRIANGLES [NODES]
  scale_models.py FOLDER scene DRAWS MATERIALS LIGHTS TRIANGLES

prints the path; TRIANGLES is the number in one sphere."""
import array
import json
import math
import os
import struct
import sys


def write_glb(path, document, chunk):
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunk += b"\0" * (-len(chunk) % 4)
    with open(path + ".part", "wb") as file:
        file.write(struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(chunk)))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", len(chunk), b"BIN\0") + chunk)
    os.replace(path + ".part", path)


def sphere(triangles):
    """The bytes of positions, normals and 32-bit indices of a UV sphere of approximately that many
    triangles, with the radius 1 + 0.05 sin(12 longitude) sin(9 latitude)."""
    rows = max(2, round(math.sqrt(triangles / 4)))
    columns = 2 * rows
    positions, normals = array.array("f"), array.array("f")
    for i in range(rows + 1):
        v = math.pi * i / rows
        sv, cv = math.sin(v), math.cos(v)
        s9, c9 = math.sin(9 * v), 9 * math.cos(9 * v)
        for j in range(columns + 1):
            u = 2 * math.pi * j / columns
            su, cu, s12 = math.sin(u), math.cos(u), math.sin(12 * u)
            r = 1 + 0.05 * s12 * s9
            ru, rv = 0.6 * math.cos(12 * u) * s9, 0.05 * s12 * c9
            x, y, z = sv * cu, cv, sv * su
            positions.extend((r * x, r * y, r * z))
            # The direction of dP/du x dP/dv; sin(v) is divided out of dP/du.
            a, b = rv, ru / max(sv, 1e-6)
            n = (r * x - a * cv * cu + b * su, r * y + a * sv, r * z - a * cv * su - b * cu)
            length = math.sqrt(n[0] ** 2 + n[1] ** 2 + n[2] ** 2)
            normals.extend((n[0] / length, n[1] / length, n[2] / length))
    indices = array.array("I")
    for i in range(rows):
        for j in range(columns):
            k = i * (columns + 1) + j
            m = k + columns + 1
            if i > 0:
                indices.extend((k, k + 1, m))
            if i < rows - 1:
                indices.extend((k + 1, m + 1, m))
    return positions, normals, indices


def document_of(positions, normals, indices, nodes):
    sizes = [4 * len(positions), 4 * len(normals), 4 * len(indices)]
    vertices = len(positions) // 3
    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.5, 0.3, 1]}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2,
                                    "material": 0}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": vertices, "type": "VEC3",
             "min": [-1.05] * 3, "max": [1.05] * 3},
            {"bufferView": 1, "componentType": 5126, "count": vertices, "type": "VEC3"},
            {"bufferView": 2, "componentType": 5125, "count": len(indices), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": sum(sizes[:i]), "byteLength": sizes[i]}
                        for i in range(3)],
        "buffers": [{"byteLength": sum(sizes)}],
    }


def sphere_model(folder, triangles, nodes=1):
    """The path of a model with `nodes` nodes, each a sphere of `triangles` triangles."""
    path = os.path.join(folder, f"sphere-{triangles}-{nodes}.glb")
    if os.path.exists(path):
        return path
    parts = sphere(triangles)
    side = math.ceil(nodes ** (1 / 3) - 1e-9)
    places = [{"mesh": 0, "translation": [3 * (i % side), 3 * (i // side % side),
                                          3 * (i // side ** 2)]} for i in range(nodes)]
    write_glb(path, document_of(*parts, places if nodes > 1 else [{"mesh": 0}]),
              b"".join(part.tobytes() for part in parts))
    return path


def scene_model(folder, draws, materials, lights, triangles):
    """The path of a model of `draws` spheres in a square, each of `triangles` triangles, which
    cycle through `materials` materials, under directional, point and spot lights."""
    path = os.path.join(folder, f"scene-{draws}-{materials}-{lights}-{triangles}.glb")
    if os.path.exists(path):
        return path
    parts = sphere(triangles)
    side = math.ceil(math.sqrt(draws))
    middle = 1.5 * (side - 1)
    nodes = [{"mesh": i % materials, "translation": [3 * (i % side), 3 * (i // side), 0]}
             for i in range(draws)]
    given = []
    for i in range(lights):
        turn = i * 2.4  # radians, about the golden angle: evenly distributed
        color = [0.6 + 0.4 * math.sin(i + k) for k in range(3)]
        kind = ("directional", "point", "spot")[i % 3]
        light = {"type": kind, "color": color, "intensity": 1 if kind == "directional" else 200}
        if kind == "spot":
            light["spot"] = {"innerConeAngle": 0.2, "outerConeAngle": 0.7}
        given.append(light)
        # A light shines along -Z of its node, which is tilted by this angle.
        tilt = 0.5 * math.sin(turn)
        nodes.append({"extensions": {"KHR_lights_punctual": {"light": i}},
                      "rotation": [math.sin(tilt), 0, 0, math.cos(tilt)],
                      "translation": [middle + middle * math.cos(turn),
                                      middle + middle * math.sin(turn), 6]})
    document = document_of(*parts, nodes)
    primitive = document["meshes"][0]["primitives"][0]
    document["materials"] = [
        {"pbrMetallicRoughness": {"baseColorFactor": [i % 7 / 7, i % 11 / 11, i % 13 / 13, 1],
                                  "metallicFactor": i % 2, "roughnessFactor": 0.2 + i % 5 / 8}}
        for i in range(materials)]
    document["meshes"] = [{"primitives": [dict(primitive, material=i)]} for i in range(materials)]
    document["extensionsUsed"] = ["KHR_lights_punctual"]
    document["extensions"] = {"KHR_lights_punctual": {"lights": given}}
    write_glb(path, document, b"".join(part.tobytes() for part in parts))
    return path


def main():
    folder, kind, *counts = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    print({"sphere": sphere_model, "scene": scene_model}[kind](folder, *map(int, counts)))


if __name__ == "__main__":
    main()
