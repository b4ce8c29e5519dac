#!/usr/bin/env python3
"""Times a further frame of a turntable with read-back: glint and VTK, alternating.

  tests/benchmarks/frame.py BUILD MODEL... [--rounds N] [--size PIXELS]

Each round runs one process of each program, with 1 and with 4 samples per pixel; the first two
frames of a process do not count. For glint, `draw` and `read` of `render --json`, with float
pixels. For VTK (its glTF importer, each actor with Phong shading and its colour texture), Render()
and a read-back of 8-bit RGB. VTK needs Debian's python3-vtk9 and an X server (DISPLAY); without
them only glint is timed.
"""
import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile

FRAMES = 10
VTK = r"""
import sys, time, vtk
model, size, samples, frames = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
renderer = vtk.vtkRenderer()
window = vtk.vtkRenderWindow()
window.SetMultiSamples(samples if samples > 1 else 0)
window.SetOffScreenRendering(1)
window.SetSize(size, size)
window.AddRenderer(renderer)
importer = vtk.vtkGLTFImporter()
importer.SetFileName(model)
importer.SetRenderWindow(window)
importer.Update()
for actor in renderer.GetActors():
    surface = actor.GetProperty()
    color = surface.GetTexture("albedoTex")
    surface.RemoveAllTextures()
    surface.SetInterpolationToPhong()
    surface.SetSpecular(0.5)
    surface.SetSpecularPower(30)
    actor.SetTexture(color)
renderer.ResetCamera()
pixels = vtk.vtkUnsignedCharArray()
for _ in range(frames):
    renderer.GetActiveCamera().Azimuth(360 / frames)
    start = time.perf_counter()
    window.Render()
    window.GetPixelData(0, 0, size - 1, size - 1, 0, pixels, 0)
    print(1000 * (time.perf_counter() - start))
"""


def glint(build, model, size, samples, folder):
    # With alpha the floats go out as they are: what is written beside drawing costs nothing.
    report = os.path.join(folder, "report.json")
    subprocess.run(
        [os.path.join(build, "glint"), "render", model, "-o", "-", "--output-format", "raw",
         "--no-background", "--turntable", str(FRAMES), "--resolution", f"{size},{size}", "--shading",
         "phong", "--json", report, "--anti-aliasing", "none" if samples == 1 else f"msaa:{samples}"],
        check=True, stdout=subprocess.DEVNULL)
    with open(report) as file:
        return [picture["ms"]["draw"] + picture["ms"]["read"] for picture in json.load(file)["pictures"]]


def vtk(model, size, samples):
    out = subprocess.run(["/usr/bin/python3", "-c", VTK, model, str(size), str(samples), str(FRAMES)],
                         check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
    return [float(line) for line in out.split()]


def has_vtk():
    return bool(os.environ.get("DISPLAY")) and shutil.which("/usr/bin/python3") and subprocess.run(
        ["/usr/bin/python3", "-c", "import vtk"], stderr=subprocess.DEVNULL).returncode == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build")
    parser.add_argument("model", nargs="+")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--size", type=int, default=1024)
    options = parser.parse_args()
    beside = has_vtk()
    print(f"ms a frame, {options.size} x {options.size}, median of {options.rounds} processes "
          f"(load {os.getloadavg()[0]:.1f})")
    with tempfile.TemporaryDirectory() as folder:
        for model in options.model:
            for samples in 1, 4:
                ours, theirs = [], []
                for _ in range(options.rounds):
                    ours.append(statistics.median(
                        glint(options.build, model, options.size, samples, folder)[2:]))
                    if beside:
                        theirs.append(statistics.median(vtk(model, options.size, samples)[2:]))
                line = f"{os.path.basename(model):24} samples {samples}  glint " \
                       f"{statistics.median(ours):6.1f}"
                if theirs:
                    each = [a / b for a, b in zip(ours, theirs)]
                    line += f"  VTK {statistics.median(theirs):6.1f}  ratio " \
                            f"{statistics.median(each):.2f} ({min(each):.2f} to {max(each):.2f})"
                print(line, flush=True)


if __name__ == "__main__":
    sys.exit(main())
