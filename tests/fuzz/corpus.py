"""Seed inputs for the fuzzers: small files of every kind that the targets read.

    corpus.py FOLDER

makes FOLDER/png, FOLDER/gltf and so on, named like the targets in targets.h.
"""

import base64
import importlib.util
import json
import pathlib
import struct
import sys
import zlib

# 16 x 16 pixels, baseline and progressive; the WebP of that size is lossy, a lossless one has one
# pixel.
JPEGS = [
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDACAWGBwYFCAcGhwkIiAmMFA0MCwsMGJGSjpQdGZ6eHJmcG6AkLicgIiuim5woNqirr7EztDO"
    "fJri8uDI8LjKzsb/2wBDASIkJDAqMF40NF7GhHCExsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbG"
    "xsbGxsb/wAARCAAQABADASIAAhEBAxEB/8QAFgABAQEAAAAAAAAAAAAAAAAABAIF/8QAIBAAAQMEAgMAAAAAAAAAAAAAAQIDBAARIUEF"
    "MRQzYf/EABQBAQAAAAAAAAAAAAAAAAAAAAD/xAAWEQEBAQAAAAAAAAAAAAAAAAAAAVH/2gAMAwEAAhEDEQA/ACw2OsVqrcTCiKeVa4Fk"
    "g7OhUQ2OsUDkJHmSwhHqaukfTs0pNf/Z",
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDACAWGBwYFCAcGhwkIiAmMFA0MCwsMGJGSjpQdGZ6eHJmcG6AkLicgIiuim5woNqirr7EztDO"
    "fJri8uDI8LjKzsb/2wBDASIkJDAqMF40NF7GhHCExsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbGxsbG"
    "xsbGxsb/wgARCAAQABADASIAAhEBAxEB/8QAFgABAQEAAAAAAAAAAAAAAAAABAED/8QAFAEBAAAAAAAAAAAAAAAAAAAAAP/aAAwDAQAC"
    "EAMQAAAByVDn/8QAGRAAAgMBAAAAAAAAAAAAAAAAAAIBAxIR/9oACAEBAAEFAkg7hUgsbbf/xAAUEQEAAAAAAAAAAAAAAAAAAAAA/9oA"
    "CAEDAQE/AX//xAAUEQEAAAAAAAAAAAAAAAAAAAAA/9oACAECAQE/AX//xAAYEAACAwAAAAAAAAAAAAAAAAAAARARYf/aAAgBAQAGPwIu"
    "MR//xAAZEAEAAgMAAAAAAAAAAAAAAAABABAhUYH/2gAIAQEAAT8hihXynAmif//aAAwDAQACAAMAAAAQU//EABYRAAMAAAAAAAAAAAAA"
    "AAAAAAABUf/aAAgBAwEBPxBU/8QAFREBAQAAAAAAAAAAAAAAAAAAAAH/2gAIAQIBAT8Qr//EABoQAAIDAQEAAAAAAAAAAAAAAAABESFB"
    "MWH/2gAIAQEAAT8Q40RMSlCPXiONEDvp69Z//9k=",
]
WEBPS = [
    "UklGRk4AAABXRUJQVlA4IEIAAADQAQCdASoQABAABUB8JZQAAjwblpKUwAD+6fPuz7nHxshMgUqr6porLaKzy4kzBjAuvmwyt3gv"
    "wpUIqnBjPOrdoAA=",
    "UklGRhoAAABXRUJQVlA4TA0AAAAvAAAAEAcQERGIiP4HAA==",
]


def png(colour, depth, samples, interlaced=0):
    """9 x 7 pixels."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + bytes((i * 7) % 256 for i in range((9 * depth * samples + 7) // 8)) for _ in range(7))
    rows = bytes(2 * len(rows)) if interlaced else rows
    palette = chunk(b"PLTE", bytes(range(48))) if colour == 3 else b""
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 9, 7, depth, colour, 0, 0, interlaced))
            + palette + chunk(b"tEXt", b"glint-look\0{}") + chunk(b"IDAT", zlib.compress(rows))
            + chunk(b"IEND", b""))


def exr(compression):
    """5 x 4 float pixels, stored uncompressed, which every compression allows."""
    def attribute(name, kind, value):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(value)) + value

    box = struct.pack("<4i", 0, 0, 4, 3)
    channels = b"".join(name + b"\0" + struct.pack("<4I", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    head = (struct.pack("<II", 20000630, 2) + attribute(b"channels", b"chlist", channels)
            + attribute(b"compression", b"compression", bytes([compression]))
            + attribute(b"dataWindow", b"box2i", box) + attribute(b"displayWindow", b"box2i", box)
            + attribute(b"lineOrder", b"lineOrder", b"\0") + attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
            + attribute(b"screenWindowCenter", b"v2f", bytes(8))
            + attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1))
            + attribute(b"glint-look", b"string", b"{}") + b"\0")
    # ZIP (3) has 16 lines per chunk.
    lines = 16 if compression == 3 else 1
    starts = list(range(0, 4, lines))
    chunks, at = [], len(head) + 8 * len(starts)
    offsets = b""
    for start in starts:
        rows = struct.pack("<60f", *(i / 40 for i in range(60))) if lines > 1 else struct.pack("<15f", *range(15))
        chunks.append(struct.pack("<iI", start, len(rows)) + rows)
        offsets += struct.pack("<Q", at)
        at += len(chunks[-1])
    return head + offsets + b"".join(chunks)


def tiff(depth, kind):
    """2 x 2 grey pixels in one strip."""
    data = bytes(range(2 * 2 * depth // 8))
    entries = [(256, 2), (257, 2), (258, depth), (262, 1), (273, 8 + 2 + 12 * 9 + 4), (277, 1), (278, 2),
               (279, len(data)), (339, kind)]
    return (b"II*\0\x08\0\0\0" + struct.pack("<H", len(entries))
            + b"".join(struct.pack("<HHII", tag, 4, 1, value) for tag, value in entries) + bytes(4) + data)


def models():
    path = pathlib.Path(__file__).parent.parent / "mutants.py"
    spec = importlib.util.spec_from_file_location("mutants", path)
    mutants = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(mutants)
    document, binary = mutants.made_model()
    document["buffers"] = [{"byteLength": len(binary)}]
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    glb = (b"glTF" + struct.pack("<II", 2, 28 + len(text) + len(binary)) + struct.pack("<I", len(text)) + b"JSON"
           + text + struct.pack("<I", len(binary)) + b"BIN\0" + binary)
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(binary).decode()
    return [glb, json.dumps(document).encode()]


def corpus():
    tga = bytes([0, 0, 2]) + bytes(9) + bytes([2, 0, 2, 0, 24, 0])
    look = {"glint-look": 1, "shading": "phong", "material": {"a#1": {"ior": 1.4, "color": [0.1, 0.2, 0.3]}},
            "ambient-light": [0.1, 0.1, 0.1], "light": ["camera@1,2,3:1,0.5,0", "spot:0,1,2:3,4,5:10,20:1,1,1"],
            "environment": "studio", "camera-azimuth-angle": 10, "up": "+Y", "resolution": [64, 48],
            "anti-aliasing": "msaa:4", "exposure": 1}
    costs = {"glint-costs": 1, "gl": {"vendor": "a", "renderer": "b", "version": "c"}, "noise": 0.1,
             "highlight": {"exact": 1}, "fresnel": {"exact": [1, 2]}, "fresnel-denser-side": {}}
    return {
        "gltf": models(),
        "png": [png(0, 1, 1), png(0, 16, 1), png(2, 8, 3), png(3, 4, 1), png(4, 8, 2), png(6, 8, 4), png(6, 16, 4),
                png(6, 8, 4, 1)],
        "jpeg": [base64.b64decode(each) for each in JPEGS],
        "webp": [base64.b64decode(each) for each in WEBPS],
        "exr": [exr(0), exr(2), exr(3)],
        "hdr": [b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n-Y 2 +X 2\nabcdefghijklmnop",
                b"#?RGBE\n\n-Y 1 +X 8\n\x02\x02\x00\x08" + b"\x88\x80" * 4],
        "pfm": [b"PF\n2 2\n-1.0\n" + struct.pack("<12f", *range(12)), b"Pf\n2 2\n1.0\n" + bytes(16)],
        "tiff": [tiff(8, 1), tiff(16, 1), tiff(32, 3)],
        "simple": [b"P6 2 2 255\nabcdefghijkl", b"P5 2 2 65535\nabcdefgh",
                   b"BM" + struct.pack("<IIIIiiHHIIiiII", 70, 0, 54, 40, 2, 2, 1, 24, 0, 16, 0, 0, 0, 0) + bytes(16),
                   tga + bytes(12)],
        "look": [json.dumps(look).encode(), b'{"glint-look": 1}'],
        "material": [b"color=#c04020,exponent=200", b'"a=b"#1:ior=1.5,specular=1', b"#2:glass,transmission=0.5"],
        "light": [b"spot:0,1,2:3,4,5:10,20:1,1,1:falloff,9", b"camera@1,2,3:1,0.5,0", b"directional:1,2,3"],
        "list": [b"a.glb\nb.glb\tb.png\r\n\nc.glb", b"# no comment\n-\n"],
        "costs": [json.dumps(costs).encode()],
    }


def main():
    for target, inputs in corpus().items():
        folder = pathlib.Path(sys.argv[1]) / target
        folder.mkdir(parents=True, exist_ok=True)
        for number, data in enumerate(inputs):
            (folder / f"seed{number}").write_bytes(data)


if __name__ == "__main__":
    main()
