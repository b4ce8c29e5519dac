#!/usr/bin/env python3
"""Measures glint-viewer under Xvfb: how long from a move of a slider to the changed picture on the
screen, from a move of the camera and of an animation's time likewise, and what the window takes of a
core at rest.

    viewer_latency.py GLINT GLINT_VIEWER MODELS [MODEL.glb [ANIMATED.glb]]

A move is put into the X server at one moment (XTest); then the pixels are read again and again until
they differ. What is measured so holds everything: event, panel, drawing, read-back, upload, X.
"""

import ctypes
import os
import statistics
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


def main():
    window.GLINT, window.VIEWER, models = (os.path.abspath(path) for path in sys.argv[1:4])
    model = sys.argv[4] if len(sys.argv) > 4 else os.path.join(models, "teapot.glb")
    tester = ctypes.CDLL("libXtst.so.6")
    tester.XTestFakeMotionEvent.argtypes = [ctypes.c_void_p] + [ctypes.c_int] * 3 + [ctypes.c_ulong]
    tester.XTestFakeButtonEvent.argtypes = [ctypes.c_void_p, ctypes.c_uint, ctypes.c_int,
                                            ctypes.c_ulong]
    measure_time(tester, sys.argv[5] if len(sys.argv) > 5 else os.path.join(models, "bend.glb"))
    with window.Viewer(model) as viewer:
        row = window.ROW["diffuse"]
        left, right = window.SLIDER
        span = right - left
        body = (380, 300, 200, 200)  # of the picture
        slider = [(left + span * (0.35 + 0.3 * (i % 20) / 20 + 0.01 * (i // 20)), row)
                  for i in range(1, 60)]
        tell("slider to picture", moves(viewer, tester, (left + span * 0.35, row), slider, body))
        camera = [(400 + 4 * i, 350 + 2 * (i % 2)) for i in range(1, 60)]
        tell("camera to picture", moves(viewer, tester, (400, 350), camera, body))
        viewer.move(20, 20)
        viewer.settled(quiet=1)

        def ticks():
            with open(f"/proc/{viewer.process.pid}/stat") as file:
                fields = file.read().rsplit(")", 1)[1].split()
            return int(fields[11]) + int(fields[12])
        before = ticks()
        time.sleep(20)
        share = (ticks() - before) / os.sysconf("SC_CLK_TCK") / 20
        print(f"at rest, 20 s: {100 * share:.2f} % of a core")


if __name__ == "__main__":
    main()
