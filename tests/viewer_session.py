#!/usr/bin/env python3
"""A session at the window, for sanitizer builds: first everything that its threads do concurrently
(drawing, reading, references, recovery, saving, shaders), then random keys and mouse input.

    viewer_session.py GLINT GLINT_VIEWER MODELS [SECONDS [SEED [MODEL.glb...]]]

Fails if the window ends by itself or with a status other than 0.
"""

import os
import random
import shutil
import sys
import tempfile
import time

import viewer_driver as window

KEYS = [*"abcdefgjklmnprstuvwxyz", *("shift+" + c for c in "abjlmpwxy"), "1", "3", "5", "7", "9",
        "F2", "F3", "F4", "F5", "F6", "F7", "F8", "shift+F8", "F9", "Return", "Tab", "space", "Left",
        "Right", "Prior", "Next", "Insert", "Delete", "shift+Delete", "ctrl+l", "ctrl+z", "ctrl+z",
        "ctrl+shift+z", "ctrl+c", "ctrl+v", "ctrl+r", "period", "comma", "h", "Up", "ctrl+f",
        "Escape", "F12", "shift+F12", "ctrl+m", "ctrl+o", "ctrl+p", "F10", "Down", "Down", "Left",
        "BackSpace", "o", "i", "shift+z", "ctrl+a", "shift+f", "shift+Left", "shift+Up", "ctrl+Down",
        "equal", "minus", "bracketleft"]


def all_threads(viewer, glsl):
    for round_ in range(2):
        viewer.key("F2")
        window.drag_slider(viewer, "diffuse", 0.2, 0.8)
        viewer.drag(400, 300, 520, 340)
        viewer.key("r")  # starts a reference and cancels it
        time.sleep(0.2)
        viewer.drag(400, 300, 430, 310)
        viewer.key("d")
        time.sleep(0.5)
        viewer.key("r", "shift+a", "b")
        window.drag_slider(viewer, "specular", 0.2, 0.9)
        viewer.key("s", "Tab", "d", "Up", "e", "n", "k", "c", "c", "F7")
        for x in range(300, 700, 50):
            viewer.move(x, 400)
        viewer.key("r", "Right", "Right", "Right", "shift+b", "space")
        time.sleep(1)
        viewer.key("space", "F12", "Up", "F12")  # saves during loading
        viewer.key("shift+p")
        viewer.drag(400, 300, 420, 320)
        viewer.key("shift+p")
        os.utime(viewer.model)
        os.utime(os.path.join(glsl, "phong.glsl"))
        time.sleep(0.6)
        viewer.xdotool("windowsize", str(viewer.window), str(900 + 50 * round_), "600")
        time.sleep(0.4)
        viewer.xdotool("windowsize", str(viewer.window), str(viewer.screen[0]),
                       str(viewer.screen[1]))


def at_random(viewer, generator, seconds):
    end = time.monotonic() + seconds
    acts = []
    width, height = viewer.screen
    picture = width - viewer.panel
    while time.monotonic() < end:
        kind = generator.random()
        place = lambda left, right: (generator.randrange(left, right), generator.randrange(5, height))
        if kind < 0.5:
            acts.append(generator.choice(KEYS))
            viewer.key(acts[-1])
            if acts[-1] in ("Escape", "shift+F12", "ctrl+m", "ctrl+o", "ctrl+p"):
                viewer.key("Escape")
        elif kind < 0.75:
            x, y = place(picture, width - 1)
            acts.append(("drag", x, y))
            viewer.drag(x, y, x + generator.randrange(-80, 80), y, steps=3)
        elif kind < 0.85:
            acts.append(("click", *place(picture, width - 1)))
            viewer.click(*acts[-1][1:])
        else:
            acts.append(("camera", *place(0, picture), *place(0, picture)))
            viewer.drag(*acts[-1][1:], button=generator.choice([1, 2, 3]), steps=3)
        assert viewer.alive(), f"ended with {viewer.process.returncode} after {acts[-6:]}"
    return len(acts)


def close(viewer):
    """Quits through the window's own question, whatever is open; nothing is saved."""
    for _ in range(20):
        viewer.key("Escape")
        viewer.key("ctrl+z", "ctrl+z", "ctrl+z", "ctrl+z", "ctrl+z")
        viewer.key("q")
        time.sleep(0.5)
        if not viewer.alive():
            break
        viewer.xdotool("key", "Return")  # save the look
        time.sleep(0.5)
        viewer.xdotool("key", "Return")  # under the name offered
        time.sleep(0.5)
        if not viewer.alive():
            break
    return viewer.left(60)


def main():
    window.GLINT, window.VIEWER, models = (os.path.abspath(path) for path in sys.argv[1:4])
    seconds = float(sys.argv[4]) if len(sys.argv) > 4 else 20
    seed = int(sys.argv[5]) if len(sys.argv) > 5 else 1
    paths = sys.argv[6:] or [os.path.join(models, name)
                             for name in ("teapot.glb", "bend.glb", "lights.glb")]
    for path in paths:
        glsl = tempfile.mkdtemp(prefix="glint-glsl-")
        shutil.copy(os.path.join(os.path.dirname(models), "glsl", "phong.glsl"), glsl)
        with window.Viewer(path, "--glsl", glsl) as viewer:
            all_threads(viewer, glsl)
            acts = at_random(viewer, random.Random(seed), seconds)
            status = close(viewer)
            told = viewer.told()
        shutil.rmtree(glsl)
        print(f"{os.path.basename(path)}: {acts} acts at random, status {status}", flush=True)
        if status != 0 or "Sanitizer" in told:
            print(told)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
