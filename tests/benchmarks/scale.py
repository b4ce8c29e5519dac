#!/usr/bin/env python3
"""How the time of a whole process grows with its input, one dimension at a time: triangles, draws,
lights, pixels, materials and files. Also times f3d if it is installed and an X server is running.
Writes a plot for each (SVG, logarithmic axes) and prints the figures.

  tests/benchmarks/scale.py BUILD FOLDER [--only NAME] [--rounds N] [--most TRIANGLES]

FOLDER keeps the models made, and gets scale-NAME.svg. In each round all commands alternate.
"""
import argparse
import json
import math
import os
import shutil
import statistics
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import scale_models  # noqa: E402

COLOURS = ["#1f5fa8", "#c2571a", "#3c8a3c", "#7a7a7a"]


def wall(command):
    start = time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return time.perf_counter() - start


class Programs:
    def __init__(self, build, folder):
        self.glint = os.path.join(build, "glint")
        self.folder = folder
        self.f3d = shutil.which("f3d") if os.environ.get("DISPLAY") else None

    def names(self):
        return ["glint, no anti-aliasing", "glint"] + (["f3d"] if self.f3d else [])

    def commands(self, models, size=1024, extra=(), f3d=True):
        out = os.path.join(self.folder, "{model}.png")
        glint = [self.glint, "render", *models, "-o", out, "--resolution", f"{size},{size}", *extra]
        commands = {"glint, no anti-aliasing": [glint + ["--anti-aliasing", "none"]],
                    "glint": [glint]}
        if self.f3d and f3d:
            commands["f3d"] = [[self.f3d, model, "--output=" + os.path.join(self.folder, "f3d.png"),
                                f"--resolution={size},{size}"] for model in models]
        return commands


def many_materials(folder, count):
    """Spheres of 96 triangles, each with its own mesh and material."""
    path = os.path.join(folder, f"materials-{count}.glb")
    if os.path.exists(path):
        return path
    parts = scale_models.sphere(96)
    side = math.ceil(math.sqrt(count))
    document = scale_models.document_of(
        *parts, [{"mesh": i, "translation": [3 * (i % side), 3 * (i // side), 0]}
                 for i in range(count)])
    primitive = document["meshes"][0]["primitives"][0]
    document["materials"] = [
        {"pbrMetallicRoughness": {"baseColorFactor": [i % 7 / 7, i % 11 / 11, i % 13 / 13, 1]}}
        for i in range(count)]
    document["meshes"] = [{"primitives": [dict(primitive, material=i)]} for i in range(count)]
    scale_models.write_glb(path, document, b"".join(part.tobytes() for part in parts))
    return path


def lights_look(folder, count):
    path = os.path.join(folder, f"lights-{count}.json")
    share = f"{1 / count:.6f}"
    lights = [f"directional:{math.cos(i):.4f},{math.sin(i):.4f},0.5:{share},{share},{share}"
              for i in range(count)]
    with open(path, "w") as file:
        json.dump({"glint-look": 1, "light": lights}, file)
    return path


def series(programs, folder, most):
    """Name, axis label, and (value, commands) along the axis."""
    def triangles():
        for count in (12, 100, 1000, 10000, 100000, 1000000, 10000000):
            if count <= most:
                yield count, programs.commands([scale_models.sphere_model(folder, count)])

    def draws():
        for count in (1, 10, 100, 1000, 10000):
            yield count, programs.commands([scale_models.sphere_model(folder, 96, count)])

    def materials():
        for count in (1, 10, 100, 1000):
            yield count, programs.commands([many_materials(folder, count)])

    def lights():
        model = scale_models.sphere_model(folder, 10000)
        for count in (1, 2, 4, 8, 16, 32, 64):
            yield count, programs.commands([model], f3d=False,
                                           extra=["--look", lights_look(folder, count)])

    def pixels():
        model = scale_models.sphere_model(folder, 10000)
        for side in (64, 128, 256, 512, 1024, 2048, 4096):
            yield side * side, programs.commands([model], size=side)

    def files():
        model = scale_models.sphere_model(folder, 10000)
        for count in (1, 2, 5, 10, 20, 50):
            copies = []
            for i in range(count):
                copies.append(os.path.join(folder, f"copy-{i}.glb"))
                if not os.path.exists(copies[-1]):
                    os.link(model, copies[-1])
            yield count, programs.commands(copies)

    return {"triangles": ("triangles", triangles), "draws": ("nodes of 96 triangles", draws),
            "materials": ("materials, each a mesh of 96 triangles", materials),
            "lights": ("lights", lights), "pixels": ("pixels", pixels), "files": ("files", files)}


def plot(path, label, rows, names):
    """rows: (value, {name: seconds})."""
    width, height, left, right, top, bottom = 640, 400, 70, 45, 40, 50
    xs = [value for value, _ in rows]
    ys = [s for _, times in rows for s in times.values()]
    x0, x1 = math.log10(min(xs)), math.log10(max(xs))
    y0, y1 = math.floor(math.log10(min(ys))), math.ceil(math.log10(max(ys)))

    def x(value):
        return left + (math.log10(value) - x0) / ((x1 - x0) or 1) * (width - left - right)

    def y(seconds):
        return height - bottom - (math.log10(seconds) - y0) / (y1 - y0) * (height - top - bottom)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
           'font-family="sans-serif" font-size="12">',
           f'<rect width="{width}" height="{height}" fill="white"/>']
    for exponent in range(y0, y1 + 1):
        for digit in range(1, 10 if exponent < y1 else 2):
            at = y(digit * 10.0 ** exponent)
            out.append(f'<line x1="{left}" x2="{width - right}" y1="{at:.1f}" y2="{at:.1f}" '
                       f'stroke="{"#bbb" if digit == 1 else "#eee"}"/>')
        out.append(f'<text x="{left - 6}" y="{y(10.0 ** exponent) + 4:.1f}" '
                   f'text-anchor="end">{10.0 ** exponent:g}</text>')
    for value in xs:
        out.append(f'<text x="{x(value):.1f}" y="{height - bottom + 18}" '
                   f'text-anchor="middle">{value:,}</text>')
    out.append(f'<text x="{(left + width - right) / 2}" y="{height - 10}" '
               f'text-anchor="middle">{label}</text>')
    out.append(f'<text x="16" y="{(top + height - bottom) / 2}" text-anchor="middle" '
               f'transform="rotate(-90 16 {(top + height - bottom) / 2})">'
               'seconds, whole process</text>')
    for i, name in enumerate(names):
        points = [(x(value), y(times[name])) for value, times in rows if name in times]
        if not points:
            continue
        line = " ".join(f"{a:.1f},{b:.1f}" for a, b in points)
        out.append(f'<polyline points="{line}" fill="none" stroke="{COLOURS[i]}" '
                   'stroke-width="2"/>')
        out += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3" fill="{COLOURS[i]}"/>' for a, b in points]
        out.append(f'<text x="{left + 8 + 180 * i}" y="24" fill="{COLOURS[i]}">{name}</text>')
    with open(path, "w") as file:
        file.write("\n".join(out + ["</svg>"]) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build")
    parser.add_argument("folder")
    parser.add_argument("--only", action="append")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--most", type=int, default=10000000, help="triangles")
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    programs = Programs(options.build, options.folder)
    names = programs.names()
    for name, (label, each) in series(programs, options.folder, options.most).items():
        if options.only and name not in options.only:
            continue
        rows = []
        print(f"\n{label}: wall seconds of a process, median of {options.rounds} "
              f"(load {os.getloadavg()[0]:.1f})")
        for value, commands in each():
            times = {program: [] for program in commands}
            for _ in range(options.rounds):
                for program, runs in commands.items():
                    times[program].append(sum(wall(run) for run in runs))
            medians = {program: statistics.median(all_) for program, all_ in times.items()}
            rows.append((value, medians))
            figures = "  ".join(f"{program} {seconds:.3f}" for program, seconds in medians.items())
            if "f3d" in medians:
                figures += f"  of f3d: {medians[names[0]] / medians['f3d']:.2f}, " \
                           f"{medians['glint'] / medians['f3d']:.2f}"
            print(f"{value:>12,}  {figures}", flush=True)
        plot(os.path.join(options.folder, f"scale-{name}.svg"), label, rows, names)


if __name__ == "__main__":
    main()
