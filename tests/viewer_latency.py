#!/usr/bin/env python3
"""Measures glint-viewer under Xvfb: the time from its start to the first picture, compared with a
whole `glint render` of the same; the time from moving a slider, the camera or the animation's time
to the changed picture on the screen; how many pictures per second follow a dragged camera; and the
share of a core used at rest.

    viewer_latency.py GLINT GLINT_VIEWER MODELS [MODEL.glb [ANIMATED.glb]]

A move is sent to the X server at a known time (XTest); then the pixels are polled until they
differ. So the measurement includes everything: event, panel, drawing, read-back, upload, X.
"""

import ctypes
import json
import math
import os
import statistics
import subprocess
import sys
import time

import viewer_driver as window


def until_changed(viewer, region, before, patience=20):
    end = time.perf_counter() + patience
    while time.perf_counter() < end:
        if viewer.x.capture(*region) != before:
            return time.perf_counter()
        time.sleep(0.0005)
    raise AssertionError("nothing changed")


def moves(viewer, tester, start, places, region):
    """Milliseconds from each move of a pressed pointer to a change within the region."""
    display = ctypes.c_void_p(viewer.x.display)

    def move(x, y):
        tester.XTestFakeMotionEvent(display, -1, int(x), int(y), 0)
        viewer.x.x.XSync(viewer.x.display, 0)
    move(*start)
    viewer.settled()
    tester.XTestFakeButtonEvent(display, 1, 1, 0)
    viewer.x.x.XSync(viewer.x.display, 0)
    times = []
    try:
        for i, place in enumerate(places):
            if i % 10 == 0:
                viewer.settled(quiet=0.3)  # from rest, too
            before = viewer.x.capture(*region)
            begin = time.perf_counter()
            move(*place)
            times.append((until_changed(viewer, region, before) - begin) * 1000)
            time.sleep(0.01)
    finally:
        tester.XTestFakeButtonEvent(display, 1, 0, 0)
        viewer.x.x.XSync(viewer.x.display, 0)
    return times


def tell(what, times):
    times = sorted(times)
    print(f"{what}: median {statistics.median(times):.0f} ms, 90 % within "
          f"{times[int(len(times) * 0.9)]:.0f} ms, longest {times[-1]:.0f} ms ({len(times)} moves)",
          flush=True)


def measure_time(tester, model):
    with window.Viewer(model) as viewer:
        viewer.key("F5")
        left, right = window.SLIDER
        places = [(left + 8 + 4 * (i % 36), window.TIME) for i in range(1, 60)]
        times = moves(viewer, tester, (left + 8, window.TIME), places, (300, 100, 400, 500))
        tell("animation time to picture (" + os.path.basename(model) + ")", times)


def pictures_a_second(viewer, tester, region, seconds=6):
    """Pictures per second while the camera is dragged in a circle without a pause."""
    display = ctypes.c_void_p(viewer.x.display)

    def move(angle):
        tester.XTestFakeMotionEvent(display, -1, int(480 + 80 * math.cos(angle)),
                                    int(400 + 80 * math.sin(angle)), 0)
        viewer.x.x.XSync(viewer.x.display, 0)
    move(0)
    viewer.settled()
    tester.XTestFakeButtonEvent(display, 1, 1, 0)
    try:
        begin = time.perf_counter()
        seen, changes = viewer.x.capture(*region), []
        while (now := time.perf_counter()) < begin + seconds:
            move(now - begin)
            shown = viewer.x.capture(*region)
            if shown != seen:
                changes.append(time.perf_counter())
                seen = shown
            time.sleep(0.004)
    finally:
        tester.XTestFakeButtonEvent(display, 1, 0, 0)
        viewer.x.x.XSync(viewer.x.display, 0)
    half = [t for t in changes if t > begin + seconds / 3]  # the first frames adapt the pace
    gaps = sorted(b - a for a, b in zip(half, half[1:]))
    print(f"pictures a second while the camera is dragged: {(len(half) - 1) / (half[-1] - half[0]):.1f}"
          f" (gaps: median {1000 * statistics.median(gaps):.0f} ms, longest {1000 * gaps[-1]:.0f} ms)",
          flush=True)


def measure_first(viewer, rounds=5):
    """Seconds from the start of a process to its first picture, and of glint render,
    alternating."""
    viewer.kill()
    size = (viewer.screen[0] - viewer.panel, viewer.screen[1] - 60)
    out = os.path.join(viewer.folder, "first.png")
    command = [window.GLINT, "render", viewer.model, "-o", out, "--resolution", "%d,%d" % size]
    shown, drawn = [], []
    for _ in range(rounds):
        begin = time.perf_counter()
        subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
        drawn.append(time.perf_counter() - begin)
        begin = time.perf_counter()
        process = subprocess.Popen([window.VIEWER, viewer.model], cwd=viewer.folder,
                                   env=viewer.environment, stderr=subprocess.DEVNULL)
        try:
            while len(set(viewer.x.capture(450, 440, 60, 60))) < 9:  # below the messages there
                assert time.perf_counter() - begin < 60, "no picture"
                time.sleep(0.002)
            shown.append(time.perf_counter() - begin)
        finally:
            process.kill()
            process.wait()
    print(f"first picture: median {statistics.median(shown):.2f} s after the start, glint render "
          f"{statistics.median(drawn):.2f} s ({rounds} rounds)", flush=True)


def one_material(model):
    told = subprocess.run([window.GLINT, "info", "--json", "-", model], capture_output=True, text=True,
                          check=True).stdout
    return len(json.loads(told)["materials"]) == 1


def main():
    window.GLINT, window.VIEWER, models = (os.path.abspath(path) for path in sys.argv[1:4])
    model = sys.argv[4] if len(sys.argv) > 4 else os.path.join(models, "teapot.glb")
    tester = ctypes.CDLL("libXtst.so.6")
    tester.XTestFakeMotionEvent.argtypes = [ctypes.c_void_p] + [ctypes.c_int] * 3 + [ctypes.c_ulong]
    tester.XTestFakeButtonEvent.argtypes = [ctypes.c_void_p, ctypes.c_uint, ctypes.c_int,
                                            ctypes.c_ulong]
    print(f"load {os.getloadavg()[0]:.1f}")
    measure_time(tester, sys.argv[5] if len(sys.argv) > 5 else os.path.join(models, "bend.glb"))
    with window.Viewer(model) as viewer:
        row = window.ROW["diffuse"]
        left, right = window.SLIDER
        span = right - left
        body = (380, 300, 200, 200)  # of the picture
        slider = [(left + span * (0.35 + 0.3 * (i % 20) / 20 + 0.01 * (i // 20)), row)
                  for i in range(1, 60)]
        camera = [(400 + 4 * i, 350 + 2 * (i % 2)) for i in range(1, 60)]
        tell("camera to picture", moves(viewer, tester, (400, 350), camera, body))
        pictures_a_second(viewer, tester, body)
        if one_material(model):  # the row is valid only for such a model
            viewer.key("Return")
            tell("slider to picture", moves(viewer, tester, (left + span * 0.35, row), slider, body))
        viewer.move(20, 20)
        print(f"at rest, 20 s: {100 * viewer.share_at_rest(20):.2f} % of a core", flush=True)
        measure_first(viewer)


if __name__ == "__main__":
    main()
