#!/usr/bin/env python3
"""Drives glint-viewer in a real window under Xvfb with xdotool, as a person would.

    viewer_window_test.py GLINT GLINT_VIEWER MODELS [TEST...]

What the window shows is taken from the X server (ImageMagick's import) and compared, byte for byte,
with what `glint render` draws of the look that the viewer saves by Ctrl+S. Exit status 77 (skipped)
if Xvfb, xdotool or ImageMagick are missing.
"""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

PATIENCE = 60  # seconds; the machine may be busy


def wait_for(what, condition, patience=PATIENCE):
    end = time.monotonic() + patience
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > end:
            raise AssertionError("waited in vain for " + what)
        time.sleep(0.1)


class Viewer:
    """A display, a window on it, and a folder of its own with a copy of the model."""

    screen = (1400, 840)
    panel = 372  # pixels at scale 1; rows of the tab Shading below, as in viewer/panel.cpp

    def __init__(self, model, *options, screen=None):
        self.folder = tempfile.mkdtemp(prefix="glint-window-")
        self.model = os.path.join(self.folder, os.path.basename(model))
        shutil.copyfile(model, self.model)
        self.options = options
        width, height = screen or self.screen
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24",
             "-nolisten", "tcp", "-noreset"],
            pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        number = b""
        while not number.endswith(b"\n"):  # written in pieces
            piece = os.read(read, 16)
            assert piece, "Xvfb did not start"
            number += piece
        os.close(read)
        self.environment = dict(os.environ, DISPLAY=":" + number.decode().strip())
        self.process = None
        try:
            self.start()
        except BaseException:
            self.end()
            raise

    def start(self, *options):
        self.process = subprocess.Popen(
            [VIEWER, os.path.basename(self.model), *self.options, *options], cwd=self.folder,
            env=self.environment, stderr=subprocess.PIPE, text=True)
        wait_for("the window", lambda: not self.alive() or
                 self.xdotool("search", "--name", "glint", check=False))
        assert self.alive(), self.process.stderr.read()
        self.xdotool("mousemove", "500", "790")
        self.settled(shaded=True)

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if kind:
            self.screenshot("/tmp/glint-window-failure.png")
            print("the screen is in /tmp/glint-window-failure.png", file=sys.stderr)
        self.end()

    def end(self):
        if self.process and self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.server.send_signal(signal.SIGTERM)
        self.server.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    # Hands and eyes.

    def xdotool(self, *arguments, check=True):
        done = subprocess.run(["xdotool", *arguments], env=self.environment, capture_output=True,
                              text=True)
        if check and done.returncode:
            raise AssertionError("xdotool " + " ".join(arguments) + ": " + done.stderr)
        return done.stdout.strip()

    def key(self, *keys):
        for each in keys:
            self.xdotool("key", each)
            time.sleep(0.15)

    def move(self, x, y):
        self.xdotool("mousemove", str(x), str(y))

    def click(self, x, y, repeat=1):
        self.move(x, y)
        self.xdotool("click", "--repeat", str(repeat), "--delay", "1", "1")

    def drag(self, x0, y0, x1, y1, button=1, steps=8):
        self.move(x0, y0)
        self.xdotool("mousedown", str(button))
        for i in range(1, steps + 1):
            self.move(x0 + (x1 - x0) * i // steps, y0 + (y1 - y0) * i // steps)
        self.xdotool("mouseup", str(button))

    def screenshot(self, path):
        subprocess.run(["import", "-window", "root", path], env=self.environment)

    def capture(self):
        """The bytes of the whole screen, RGB."""
        return subprocess.run(["import", "-window", "root", "-depth", "8", "rgb:-"],
                              env=self.environment, capture_output=True, check=True).stdout

    def settled(self, shaded=False):
        """The screen once it no longer changes."""
        last = [None]

        def still():
            time.sleep(0.4)
            now = self.capture()
            same = now == last[0] and (not shaded or len(set(self.crop(now, (999, 775)))) > 20)
            last[0] = now
            return same
        wait_for("the picture to be still", still)
        return last[0]

    def crop(self, screen, size, width=None):
        across = 3 * (width or self.screen[0])
        return b"".join(screen[y * across:y * across + 3 * size[0]] for y in range(size[1]))

    # What a person can ask for.

    def save_look(self):
        """Ctrl+S; the first time the name that is offered is taken."""
        path = os.path.join(self.folder, os.path.splitext(os.path.basename(self.model))[0]
                            + "_1.json")
        before = os.stat(path).st_mtime_ns if os.path.exists(path) else None
        self.key("ctrl+s")
        if before is None:
            time.sleep(0.5)
            self.key("Return")

        def written():
            return os.path.exists(path) and os.stat(path).st_mtime_ns != before
        wait_for("the look to be saved", written)
        with open(path) as file:
            return json.load(file), path

    def picture(self):
        """The window's picture, checked against glint render of the saved look. Returns its bytes
        and the look."""
        look, path = self.save_look()
        self.move(500, 790)
        size = tuple(look["resolution"])
        shown = self.crop(self.settled(), size)
        out = os.path.join(self.folder, "offscreen.png")
        subprocess.run([GLINT, "render", self.model, "--look", path, "-o", out], check=True,
                       cwd=self.folder)
        drawn = subprocess.run(["convert", out, "-depth", "8", "rgb:-"], capture_output=True,
                               check=True).stdout
        assert len(shown) == len(drawn), f"{size}: {len(shown)} and {len(drawn)} bytes"
        if shown != drawn:
            differ = sum(a != b for a, b in zip(shown, drawn))
            raise AssertionError(f"{differ} of {len(drawn)} bytes differ from glint render's")
        assert len(set(shown)) > 20, "the picture is one colour"
        return shown, look

    def alive(self):
        return self.process.poll() is None

    def left(self, patience=PATIENCE):
        wait_for("the viewer to end", lambda: self.process.poll() is not None, patience)
        return self.process.returncode


# Centres of widgets in the tab Shading of a model with one material, scale 1.
PANEL_LEFT = 1000
TWO_SIDED = (PANEL_LEFT + 174, 168)
ROW = {"ambient": 270, "diffuse": 295, "specular": 320, "exponent": 345, "metalness": 370}
SLIDER = (PANEL_LEFT + 172, PANEL_LEFT + 352)


def drag_slider(viewer, name, start, end):
    span = SLIDER[1] - SLIDER[0]
    y = ROW[name]
    viewer.drag(int(SLIDER[0] + start * span), y, int(SLIDER[0] + end * span), y)


def test_the_window_shows_what_glint_render_draws():
    with Viewer(TEAPOT) as viewer:
        viewer.picture()
        viewer.key("F12")
        png = os.path.join(viewer.folder, "teapot_1.png")
        wait_for("the screenshot", lambda: os.path.exists(png))
        with open(png, "rb") as a, open(os.path.join(viewer.folder, "offscreen.png"), "rb") as b:
            assert a.read() == b.read(), "the screenshot is another file than glint render's"


def test_a_slider_changes_the_picture_and_undo_brings_the_first_bytes_back():
    with Viewer(TEAPOT) as viewer:
        first, _ = viewer.picture()
        drag_slider(viewer, "diffuse", 0.4, 0.9)
        changed, look = viewer.picture()
        assert changed != first
        values = look["material"]["Glazed ceramic"]
        assert list(values) == ["diffuse"] and values["diffuse"] > 1, values
        drag_slider(viewer, "exponent", 0.6, 0.2)
        viewer.drag(400, 300, 520, 340)
        turned, look = viewer.picture()
        assert turned != changed and "camera-position" in look
        viewer.key("ctrl+z")
        assert "camera-position" not in viewer.picture()[1]
        viewer.key("ctrl+z", "ctrl+z", "ctrl+z", "ctrl+z")
        again, look = viewer.picture()
        assert "material" not in look, look
        assert again == first, "undo to the start is not the first picture"
        viewer.key("ctrl+shift+z", "ctrl+shift+z", "ctrl+shift+z")
        assert viewer.picture()[0] == turned, "redo is not the last picture"


def test_camera_by_mouse_and_keys():
    with Viewer(TEAPOT) as viewer:
        seen = [viewer.picture()[0]]
        for act in (lambda: viewer.drag(400, 300, 480, 260),
                    lambda: viewer.drag(400, 300, 440, 330, button=2),
                    lambda: viewer.drag(400, 300, 400, 350, button=3),
                    lambda: (viewer.move(300, 300), viewer.xdotool("click", "4")),
                    lambda: viewer.key("7"), lambda: viewer.key("5"), lambda: viewer.key("1")):
            act()
            picture, _ = viewer.picture()
            assert picture not in seen
            seen.append(picture)
        viewer.key("Return")
        assert viewer.picture()[0] == seen[0], "Enter does not bring the first view back"


def test_fast_clicks_are_all_taken():
    with Viewer(TEAPOT) as viewer:
        viewer.picture()
        viewer.click(*TWO_SIDED, repeat=7)
        assert viewer.picture()[1]["two-sided"] is True
        viewer.click(*TWO_SIDED, repeat=6)
        assert viewer.picture()[1]["two-sided"] is True
        viewer.click(*TWO_SIDED, repeat=5)
        assert viewer.picture()[1]["two-sided"] is False


def test_a_click_picks_the_material():
    with Viewer(TEAPOT) as viewer:
        viewer.click(20, 20)  # the background: all materials
        drag_slider(viewer, "diffuse", 0.4, 0.7)
        assert list(viewer.picture()[1]["material"]) == [""]
        viewer.key("ctrl+z")
        viewer.click(480, 420)
        drag_slider(viewer, "diffuse", 0.4, 0.7)
        assert list(viewer.picture()[1]["material"]) == ["Glazed ceramic"]


def test_saved_into_the_model_and_opened_again():
    with Viewer(TEAPOT) as viewer:
        with open(viewer.model, "rb") as file:
            original = file.read()
        drag_slider(viewer, "specular", 0.2, 0.8)
        edited, look = viewer.picture()
        viewer.key("ctrl+m")
        time.sleep(0.6)
        viewer.key("Return")  # asks before it writes into the file
        wait_for("the model to be saved", lambda: open(viewer.model, "rb").read() != original)
        viewer.key("q")
        assert viewer.left() == 0
        # The binary chunk and all but the material stay as they were.
        with open(viewer.model, "rb") as file:
            saved = file.read()
        length = int.from_bytes(original[12:16], "little")
        assert saved.endswith(original[20 + length:])
        os.remove(os.path.join(viewer.folder, "teapot_1.json"))
        viewer.start()
        again, look = viewer.picture()
        assert "material" not in look
        assert again == edited, "the model opened again looks different"


def test_closing_with_unsaved_edits_asks():
    with Viewer(TEAPOT) as viewer:
        drag_slider(viewer, "specular", 0.2, 0.8)
        viewer.settled()
        viewer.key("q")
        time.sleep(0.8)
        assert viewer.alive(), "closed without asking"
        viewer.key("Escape")
        time.sleep(0.8)
        assert viewer.alive(), "Escape closed the window"
        viewer.key("ctrl+z", "q")
        assert viewer.left() == 0  # nothing is unsaved any more


def test_closing_can_save_first():
    with Viewer(TEAPOT) as viewer:
        drag_slider(viewer, "specular", 0.2, 0.8)
        viewer.settled()
        viewer.key("q")
        time.sleep(0.8)
        viewer.key("Return")  # save the look
        time.sleep(0.8)
        viewer.key("Return")  # under the name offered
        assert viewer.left() == 0
        with open(os.path.join(viewer.folder, "teapot_1.json")) as file:
            assert json.load(file)["material"]["Glazed ceramic"]["specular"] > 1


def test_a_broken_file_leaves_the_old_model():
    with Viewer(TEAPOT) as viewer:
        first, _ = viewer.picture()
        broken = os.path.join(viewer.folder, "broken.glb")
        with open(broken, "wb") as file:
            file.write(b"glTF\2\0\0\0 this is no model")
        viewer.key("ctrl+o")
        time.sleep(0.6)
        viewer.key("ctrl+a")
        viewer.xdotool("type", "--delay", "20", "broken.glb")
        viewer.key("Return")
        time.sleep(1)
        assert viewer.alive()
        assert viewer.picture()[0] == first


def test_a_changed_model_is_read_again_and_edits_stay():
    with Viewer(TEAPOT) as viewer:
        drag_slider(viewer, "diffuse", 0.4, 0.7)
        first, look = viewer.picture()
        with open(viewer.model, "rb") as file:
            original = file.read()
        with open(viewer.model, "wb") as file:
            file.write(original[:1000])
        time.sleep(2)
        viewer.settled()
        assert viewer.alive()
        with open(SPHERE, "rb") as file:
            sphere = file.read()
        with open(viewer.model, "wb") as file:
            file.write(sphere)
        time.sleep(2)
        second = viewer.settled()
        assert viewer.crop(second, tuple(look["resolution"])) != first
        with open(viewer.model, "wb") as file:
            file.write(original)
        time.sleep(2)
        viewer.settled()
        assert viewer.alive()


def test_shaders_are_watched():
    glsl = tempfile.mkdtemp(prefix="glint-glsl-")
    source = os.path.join(GLSL, "phong.glsl")
    mine = os.path.join(glsl, "phong.glsl")
    shutil.copyfile(source, mine)
    with open(source) as file:
        text = file.read()
    with Viewer(TEAPOT, "--glsl", glsl) as viewer:
        first, look = viewer.picture()
        size = tuple(look["resolution"])
        with open(mine, "w") as file:
            file.write(text + "\nthis does not compile\n")
        time.sleep(2.5)
        assert viewer.crop(viewer.settled(), size) == first, "a broken shader changed the picture"
        assert viewer.alive()
        with open(mine, "w") as file:
            file.write(text)
        time.sleep(2.5)
        assert viewer.crop(viewer.settled(), size) == first
    shutil.rmtree(glsl)


def test_split_shows_both():
    with Viewer(TEAPOT) as viewer:
        a, look = viewer.picture()
        size = tuple(look["resolution"])
        viewer.key("b")  # keeps the look as B and splits
        drag_slider(viewer, "diffuse", 0.4, 0.9)
        viewer.move(500, 790)
        shown = viewer.crop(viewer.settled(), size)
        viewer.key("a")
        b, _ = viewer.picture()

        def columns(picture, first, last):
            return [picture[3 * (size[0] * y + first):3 * (size[0] * y + last)]
                    for y in range(40, size[1])]
        half = size[0] // 2
        assert columns(shown, 0, half - 3) == columns(b, 0, half - 3), "A is not at the left"
        assert columns(shown, half + 3, size[0]) == columns(a, half + 3, size[0]), \
            "B is not at the right"


def test_other_sizes_and_scales():
    for screen, options in (((900, 700), ()), ((1400, 840), ("--scale", "2"))):
        with Viewer(TEAPOT, *options, screen=screen) as viewer:
            viewer.screen = screen
            viewer.picture()


def test_rests_when_nothing_changes():
    with Viewer(TEAPOT) as viewer:
        time.sleep(1)

        def ticks():
            with open(f"/proc/{viewer.process.pid}/stat") as file:
                fields = file.read().rsplit(")", 1)[1].split()
            return int(fields[11]) + int(fields[12])
        before = ticks()
        time.sleep(6)
        share = (ticks() - before) / os.sysconf("SC_CLK_TCK") / 6
        print(f"at rest: {100 * share:.2f} % of a core")
        assert share < 0.01


def test_without_a_display_it_says_so():
    environment = {k: v for k, v in os.environ.items()
                   if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    done = subprocess.run([VIEWER, TEAPOT], env=environment, capture_output=True, text=True)
    assert done.returncode == 3, done
    assert done.stderr.count("\n") == 1 and "glint render" in done.stderr, done.stderr


def main():
    tests = {name: test for name, test in globals().items() if name.startswith("test_")}
    if any(shutil.which(tool) is None for tool in ("Xvfb", "xdotool", "import", "convert")):
        print("skipped: needs Xvfb, xdotool and ImageMagick")
        return 77
    failed = 0
    for name in sys.argv[4:] or tests:
        start = time.monotonic()
        try:
            tests[name]()
            print(f"ok    {name}  {time.monotonic() - start:.1f} s", flush=True)
        except AssertionError as error:
            failed += 1
            print(f"FAIL  {name}: {error}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    GLINT, VIEWER, MODELS = sys.argv[1:4]
    TEAPOT = os.path.join(MODELS, "teapot.glb")
    SPHERE = os.path.join(MODELS, "sphere.glb")
    GLSL = os.path.join(os.path.dirname(os.path.abspath(MODELS)), "glsl")
    sys.exit(main())
