"""Generated models and files for the window's tests."""

import json
import math
import os
import struct
import sys
import zlib

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "benchmarks"))
import scale_models  # noqa: E402


def png(width, height, pixel):
    """The bytes of a PNG; pixel(x, y) gives (r, g, b)."""
    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in pixel(x, y))
                    for y in range(height))

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def helmet(path):
    """A shell with a visor in front, each a bumpy sphere. The shell has textures for colour,
    normals and metallic-roughness; the visor has an emission texture."""
    positions, normals, indices = scale_models.sphere(10000)
    columns = 2 * max(2, round(math.sqrt(10000 / 4)))
    rows = columns // 2
    places = [v for i in range(rows + 1) for j in range(columns + 1)
              for v in (j / columns, i / rows)]
    colour = png(64, 32, lambda x, y: (200, 40, 30) if (x // 8 + y // 8) % 2 else (60, 60, 70))
    bumps = png(64, 32, lambda x, y: (128 + int(30 * math.sin(x)), 128, 250))
    rough = png(64, 32, lambda x, y: (255, 40 + 3 * x, 255 * (y // 8 % 2)))
    glow = png(32, 32, lambda x, y: (0, 0, 0) if y % 8 else (0, 90, 120))
    parts = [struct.pack(f"<{len(values)}f", *values) for values in (positions, normals, places)]
    parts += [indices.tobytes()] + [each + b"\0" * (-len(each) % 4)
                                    for each in (colour, bumps, rough, glow)]
    lengths = [len(each) for each in parts]
    vertices = len(positions) // 3
    document = {
        "asset": {"version": "2.0", "generator": "glint's tests"}, "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0, "name": "shell"},
                  {"mesh": 1, "name": "visor", "scale": [0.6, 0.4, 0.6],
                   "translation": [0, 0.1, 0.7]}],
        "materials": [
            {"name": "Shell", "extras": {"maker": "kept as it is"},
             "normalTexture": {"index": 1},
             "pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
                                      "metallicRoughnessTexture": {"index": 2}}},
            {"name": "Visor", "emissiveTexture": {"index": 3}, "emissiveFactor": [1, 1, 1],
             "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.1, 0.1, 1], "metallicFactor": 0,
                                      "roughnessFactor": 0.2}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2},
                                    "indices": 3, "material": i}]} for i in range(2)],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": vertices, "type": "VEC3",
             "min": [-1.05] * 3, "max": [1.05] * 3},
            {"bufferView": 1, "componentType": 5126, "count": vertices, "type": "VEC3"},
            {"bufferView": 2, "componentType": 5126, "count": vertices, "type": "VEC2"},
            {"bufferView": 3, "componentType": 5125, "count": len(indices), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": sum(lengths[:i]), "byteLength": lengths[i]}
                        for i in range(len(parts))],
        "buffers": [{"byteLength": sum(lengths)}],
        "images": [{"bufferView": 4 + i, "mimeType": "image/png"} for i in range(4)],
        "textures": [{"source": i} for i in range(4)],
    }
    scale_models.write_glb(path, document, b"".join(parts))
    return path


def chunks(path):
    """The JSON of a .glb and its binary chunk."""
    with open(path, "rb") as file:
        data = file.read()
    length = int.from_bytes(data[12:16], "little")
    return json.loads(data[20:20 + length]), data[20 + length:]


def measured(path, diffuse, specular, exponent, bins=(60, 10, 12)):
    """A file of a measured reflectance: a diffuse colour, and specular times a power of the cosine
    of the half vector, as in Blinn-Phong."""
    channels = []
    for scale, color in zip((1 / 1500, 1.15 / 1500, 1.66 / 1500), diffuse):
        for h in range(bins[0]):
            angle = math.pi / 2 * ((h / bins[0]) ** 2 + ((h + 1) / bins[0]) ** 2) / 2
            value = (color + specular * math.cos(angle) ** exponent) / math.pi / scale
            channels += [value] * (bins[1] * bins[2])
    with open(path, "wb") as file:
        file.write(struct.pack("<3i", *bins) + struct.pack(f"<{len(channels)}d", *channels))
    return path


def room(path, width=64, height=32):
    """An environment picture in the Radiance format: dim walls, two bright windows."""
    def texel(x, y):
        bright = 8 < y < 16 and (10 < x < 18 or 40 < x < 44)
        return (128, 120, 100, 132) if bright else (60 + x, 90, 90 + 3 * y, 127)
    with open(path, "wb") as file:
        file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
        for y in range(height):
            row = [texel(x, y) for x in range(width)]
            file.write(bytes((2, 2, width >> 8, width & 255)))
            for c in range(4):
                file.write(bytes((width,)) + bytes(each[c] for each in row))
    return path
