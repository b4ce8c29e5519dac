#!/usr/bin/env python3
"""Drives glint-viewer in a real window under Xvfb with xdotool, as a person would.

    viewer_window_test.py GLINT GLINT_VIEWER MODELS [TEST...]

What the window shows is taken from the X server and compared, byte for byte, with what `glint
render` draws of the look that the viewer saves by Ctrl+S. Nothing is waited for by time alone: the
machine may be busy. Exit status 77 (skipped) if Xvfb, xdotool or ImageMagick are missing.
"""

import json
import math
import os
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

import x11

PATIENCE = 60  # seconds; the machine may be busy


def wait_for(what, condition, patience=PATIENCE):
    end = time.monotonic() + patience
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > end:
            raise AssertionError("waited in vain for " + what)
        time.sleep(0.03)


def pixels_of(png):
    return subprocess.run(["convert", png, "-depth", "8", "rgb:-"], capture_output=True,
                          check=True).stdout


def pfm_pixel(data, x, y):
    """The colour at a place of a PFM, whose rows begin at the bottom."""
    kind, size, scale, values = data.split(b"\n", 3)
    assert kind == b"PF" and float(scale) < 0
    width, height = map(int, size.split())
    return struct.unpack_from("<3f", values, 12 * (width * (height - 1 - y) + x))


class Viewer:
    """A display, a window on it, and a folder of its own with a copy of the model."""

    screen = (1400, 840)
    panel = 372  # pixels at scale 1; rows of the tab Shading below, as in viewer/panel.cpp

    def __init__(self, model, *options, screen=None, dpi=None):
        self.folder = tempfile.mkdtemp(prefix="glint-window-")
        self.model = os.path.join(self.folder, os.path.basename(model))
        shutil.copyfile(model, self.model)
        self.options = options
        self.errors = os.path.join(self.folder, "errors")
        self.screen = screen or self.screen
        width, height = self.screen
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
        display = ":" + number.decode().strip()
        self.environment = dict(os.environ, DISPLAY=display,
                                XDG_CONFIG_HOME=os.path.join(self.folder, "config"),
                                XDG_STATE_HOME=os.path.join(self.folder, "state"))
        self.x = x11.Server(display)
        if dpi:
            self.x.set_dpi(dpi)
        self.process = None
        try:
            self.start()
        except BaseException:
            self.end()
            raise

    def start(self, *options):
        self.process = subprocess.Popen(
            [VIEWER, os.path.basename(self.model), *self.options, *options], cwd=self.folder,
            env=self.environment, stderr=open(self.errors, "w"), text=True)
        self.window = int(wait_for("the window", lambda: not self.alive() or self.xdotool(
            "search", "--onlyvisible", "--name", "glint$", check=False)).split()[0])
        assert self.alive(), self.told()
        self.move(20, 20)
        self.settled(shaded=True)

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if kind:
            self.screenshot("/tmp/glint-window-failure.png")
            print("the screen is in /tmp/glint-window-failure.png", file=sys.stderr)
        self.end()

    def end(self):
        self.kill()
        self.x.close()
        self.server.send_signal(signal.SIGTERM)
        self.server.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def kill(self):
        if self.process and self.process.poll() is None:
            self.process.kill()
            self.process.wait()

    def told(self):
        """What it has written to the terminal."""
        with open(self.errors) as file:
            return file.read()

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
            time.sleep(0.05)

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
        return self.x.capture(0, 0, *self.screen)

    def settled(self, shaded=False, quiet=0.35):
        """The screen once it has not changed for a while."""
        last, since = self.capture(), time.monotonic()
        picture = (self.screen[0] - self.panel - 30, self.screen[1] - 65)

        def still():
            nonlocal last, since
            now = self.capture()
            if now != last or (shaded and len(set(self.crop(now, picture))) <= 20):
                last, since = now, time.monotonic()
            return time.monotonic() - since > quiet
        wait_for("the picture to be still", still)
        return last

    def shows(self, size, expected, what):
        """Waits until the picture is `expected`."""
        shown = []

        def same():
            shown[:] = [self.x.capture(0, 0, *size)]
            return shown[0] == expected
        try:
            wait_for(what, same, PATIENCE / 3)
        except AssertionError:
            differ = sum(a != b for a, b in zip(shown[0], expected))
            raise AssertionError(f"waited in vain for {what}: {differ} of {len(expected)} bytes differ")

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
            time.sleep(0.3)
            self.key("Return")

        def written():
            return os.path.exists(path) and os.stat(path).st_mtime_ns != before
        wait_for("the look to be saved", written)
        with open(path) as file:
            return json.load(file), path

    def render(self, *options, ending="png"):
        """What glint render draws with these options: bytes of RGB for a PNG, else the file's."""
        out = os.path.join(self.folder, "offscreen." + ending)
        subprocess.run([GLINT, "render", self.model, *options, "-o", out], check=True,
                       cwd=self.folder)
        if ending != "png":
            with open(out, "rb") as file:
                return file.read()
        return pixels_of(out)

    def picture(self):
        """The window's picture, checked against glint render of the saved look. Returns its bytes
        and the look."""
        look, path = self.save_look()
        self.move(20, 20)
        drawn = self.render("--look", path)
        assert len(set(drawn)) > 20, "the picture is one colour"
        self.shows(tuple(look["resolution"]), drawn, "the picture to be glint render's")
        return drawn, look

    def alive(self):
        return self.process.poll() is None

    def left(self, patience=PATIENCE):
        wait_for("the viewer to end", lambda: self.process.poll() is not None, patience)
        return self.process.returncode


# Centres of widgets in the tab Shading of a model with one material, scale 1.
PANEL_LEFT = 1000
TWO_SIDED = (PANEL_LEFT + 174, 193)
ROW = {"ambient": 295, "diffuse": 320, "specular": 345, "exponent": 370, "metalness": 395}
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


def test_what_a_budget_chooses_is_what_glint_render_draws():
    # Without highlight vertices come near enough, so that auto is another program than phong.
    with Viewer(SPHERE, "--max-error", "0.02", screen=(1000, 640)) as viewer:
        drawn, look = viewer.picture()
        assert look["max-error"] == 0.02
        assert look["highlight"] == "exact", "the look that is saved holds the choice"
        path = os.path.join(viewer.folder, "sphere_1.json")
        with open(path, "w") as file:
            json.dump({k: v for k, v in look.items() if k != "max-error"}, file)
        exact = viewer.render("--look", path)
        assert exact != drawn
        viewer.shows(tuple(look["resolution"]), exact, "the exact forms once the budget is gone")
        with open(path, "w") as file:
            json.dump({**look, "shading": "auto", "material": {"": {"specular": 0}}}, file)
        phong = viewer.render("--look", path, "--shading", "phong")
        automatic = viewer.render("--look", path)
        assert automatic != phong
        viewer.shows(tuple(look["resolution"]), automatic, "the program chosen")
        viewer.key("F12")
        png = os.path.join(viewer.folder, "sphere_1.png")
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


def test_a_material_is_found_by_name():
    with Viewer(os.path.join(MODELS, "chart.glb")) as viewer:
        viewer.picture()
        for name in ("e320-m1", "e5-m0.5"):
            viewer.key("ctrl+f")
            viewer.settled()
            viewer.xdotool("type", "--delay", "20", name)
            viewer.key("Return", "m")
            look = viewer.picture()[1]
            assert list(look["material"]) == [name], look["material"]
            viewer.key("ctrl+z")


def test_saved_into_the_model_and_opened_again():
    with Viewer(TEAPOT) as viewer:
        with open(viewer.model, "rb") as file:
            original = file.read()
        drag_slider(viewer, "specular", 0.2, 0.8)
        edited, look = viewer.picture()
        viewer.key("ctrl+m")
        viewer.settled()
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
        before = viewer.settled()
        viewer.key("q")
        wait_for("a question", lambda: viewer.capture() != before)
        viewer.settled()
        assert viewer.alive(), "closed without asking"
        viewer.key("Escape")
        wait_for("the question to go", lambda: viewer.capture() == before)
        assert viewer.alive(), "Escape closed the window"
        viewer.key("ctrl+z", "q")
        assert viewer.left() == 0  # nothing is unsaved any more


def test_closing_can_save_first():
    with Viewer(TEAPOT) as viewer:
        drag_slider(viewer, "specular", 0.2, 0.8)
        viewer.settled()
        viewer.key("q")
        viewer.settled()
        viewer.key("Return")  # save the look
        viewer.settled()
        viewer.key("Return")  # under the name offered
        assert viewer.left() == 0
        with open(os.path.join(viewer.folder, "teapot_1.json")) as file:
            assert json.load(file)["material"]["Glazed ceramic"]["specular"] > 1


def test_a_broken_file_leaves_the_old_model():
    with Viewer(TEAPOT) as viewer:
        first, look = viewer.picture()
        broken = os.path.join(viewer.folder, "broken.glb")
        with open(broken, "wb") as file:
            file.write(b"glTF\2\0\0\0 this is no model")
        viewer.key("ctrl+o")
        viewer.settled()
        viewer.key("ctrl+a")
        viewer.xdotool("type", "--delay", "20", "broken.glb")
        viewer.key("Return")
        wait_for("the message", lambda: "broken.glb" in viewer.told())
        assert viewer.told().count("\n") == 1, viewer.told()
        assert viewer.alive()
        viewer.shows(tuple(look["resolution"]), first, "the old model")


def test_files_are_dropped():
    with Viewer(TEAPOT) as viewer:
        first, look = viewer.picture()
        size = tuple(look["resolution"])
        broken = os.path.join(viewer.folder, "a broken one.glb")
        with open(broken, "wb") as file:
            file.write(b"no model")
        viewer.x.drop(viewer.window, ["file://" + broken.replace(" ", "%20")], 400, 300)
        wait_for("the message", lambda: "a broken one.glb" in viewer.told())
        assert viewer.told().count("\n") == 1, viewer.told()
        viewer.shows(size, first, "the old model")
        sphere = os.path.join(viewer.folder, "sphere.glb")
        shutil.copyfile(SPHERE, sphere)
        viewer.x.drop(viewer.window, ["file://" + sphere], 400, 300)
        viewer.model = sphere
        viewer.shows(size, viewer.render("--resolution", "%d,%d" % size), "the sphere")


def test_a_changed_model_is_read_again_and_edits_stay():
    with Viewer(TEAPOT) as viewer:
        drag_slider(viewer, "diffuse", 0.4, 0.7)
        first, look = viewer.picture()
        size = tuple(look["resolution"])
        with open(viewer.model, "rb") as file:
            original = file.read()
        with open(viewer.model, "wb") as file:
            file.write(original[:1000])
        wait_for("the message", lambda: "teapot.glb" in viewer.told())
        viewer.shows(size, first, "the model as it was")
        with open(SPHERE, "rb") as file:
            sphere = file.read()
        with open(viewer.model, "wb") as file:
            file.write(sphere)
        wait_for("the sphere", lambda: viewer.crop(viewer.capture(), size) != first)
        # What the sphere does not have is gone; the camera is as it was.
        with open(viewer.model, "wb") as file:
            file.write(original)
        viewer.shows(size, viewer.render("--resolution", "%d,%d" % size), "the teapot")
        drag_slider(viewer, "diffuse", 0.4, 0.7)
        edited, _ = viewer.picture()
        os.utime(viewer.model, ns=(1, 1))
        viewer.settled()
        viewer.shows(size, edited, "the edits after the same model was read again")


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
        line = text.count("\n") + 2
        wait_for("the message", lambda: viewer.told().count("\n") >= 1)
        assert f'"phong.glsl":{line}(' in viewer.told(), viewer.told()
        viewer.shows(size, first, "the picture of the old shader")
        changed = text.replace("vec3 shade(", "vec3 lit(") + \
            "\n#if !VERTEX_STAGE\nvec3 shade(vec4 base) { return lit(base).bgr; }\n#endif\n"
        assert changed.count("lit(") == 2
        with open(mine, "w") as file:
            file.write(changed)
        swapped = bytearray(first)
        swapped[0::3], swapped[2::3] = first[2::3], first[0::3]
        viewer.shows(size, bytes(swapped), "the picture of the changed shader")
        with open(mine, "w") as file:
            file.write(text)
        viewer.shows(size, first, "the picture of the shader as it was")
    shutil.rmtree(glsl)


def test_edits_survive_a_crash():
    with Viewer(TEAPOT) as viewer:
        state = os.path.join(viewer.folder, "state", "glint", "recovery")

        def kept():
            names = os.listdir(state) if os.path.isdir(state) else []
            return [name for name in names if name.endswith(".json")]
        drag_slider(viewer, "diffuse", 0.4, 0.9)
        viewer.move(20, 20)
        edited = viewer.crop(viewer.settled(), (1000, 776))

        def all_kept():  # not as they were in the middle of the drag
            values = []
            for name in kept():
                with open(os.path.join(state, name)) as file:
                    values.append(json.load(file)["look"]["material"]["Glazed ceramic"]["diffuse"])
            return values and values[0] > 1.7
        wait_for("the edits to be kept", all_kept)
        viewer.kill()
        viewer.start()  # asks, and stands still
        viewer.key("Return")  # restore
        viewer.shows((1000, 740), edited[:3000 * 740], "the edits")
        picture, look = viewer.picture()  # saved: nothing is kept any more
        assert look["material"]["Glazed ceramic"]["diffuse"] > 1
        wait_for("nothing to be kept", lambda: not kept())
        viewer.key("q")
        assert viewer.left() == 0
        assert os.listdir(state) == []


def columns(picture, size, first, last, top=40, bottom=40):
    return [picture[3 * (size[0] * y + first):3 * (size[0] * y + last)]
            for y in range(top, size[1] - bottom)]


def test_split_and_difference():
    with Viewer(TEAPOT) as viewer:
        a, look = viewer.picture()
        size = tuple(look["resolution"])
        viewer.key("b")  # keeps the look as B and splits
        drag_slider(viewer, "diffuse", 0.4, 0.9)
        viewer.move(20, 20)
        b = viewer.render("--look", viewer.save_look()[1])
        half = size[0] // 2

        def split():
            shown = viewer.crop(viewer.capture(), size)
            return columns(shown, size, 0, half - 3) == columns(b, size, 0, half - 3) and \
                columns(shown, size, half + 3, size[0]) == columns(a, size, half + 3, size[0])
        wait_for("A at the left and B at the right", split)
        viewer.drag(half, 300, half - 200, 300)  # the divider
        viewer.move(20, 20)
        half -= 200
        wait_for("the divider to have moved", split)
        viewer.key("d")
        times = 16
        expected = bytes(min(255, times * abs(p - q)) for p, q in zip(a, b))
        wait_for("the difference", lambda: columns(
            viewer.crop(viewer.capture(), size), size, 0, size[0]) == columns(
                expected, size, 0, size[0]))
        viewer.key("Tab")
        wait_for("B in place of A", lambda: columns(
            viewer.crop(viewer.capture(), size), size, 60, size[0]) == columns(
                a, size, 60, size[0]))


def test_the_reference_stands_beside_the_picture():
    with Viewer(TEAPOT, "--highlight", "pow", screen=(900, 620)) as viewer:
        _, look = viewer.picture()
        size = tuple(look["resolution"])
        path = os.path.join(viewer.folder, "teapot_1.json")
        plain = ("--look", path, "--anti-aliasing", "none")
        a = viewer.render(*plain)
        exact = viewer.render(*plain, "--rendering-backend", "reference", "--highlight", "exact")
        assert a != exact
        viewer.key("r")
        half = size[0] // 2

        def split():
            shown = viewer.crop(viewer.capture(), size)
            return columns(shown, size, 0, half - 3) == columns(a, size, 0, half - 3) and \
                columns(shown, size, half + 3, size[0]) == columns(exact, size, half + 3, size[0])
        wait_for("the reference at the right", split)
        viewer.key("d")
        viewer.key("r")
        viewer.picture()


def test_the_probe_tells_what_the_reference_has():
    with Viewer(TEAPOT) as viewer:
        _, look = viewer.picture()
        path = os.path.join(viewer.folder, "teapot_1.json")
        plain = ("--look", path, "--anti-aliasing", "none")
        center = viewer.render(*plain, ending="pfm")
        exact = viewer.render(*plain, "--rendering-backend", "reference", ending="pfm")
        viewer.key("F7")  # the tab Info
        for x, y in ((480, 420), (440, 347), (20, 30)):
            viewer.move(x, y)
            viewer.settled()
            viewer.key("ctrl+shift+c")

            def probed():
                values = json.loads(viewer.x.clipboard())
                return values if values["pixel"] == [x, y] and "center" in values else None
            try:
                values = wait_for("the pixel's values", probed, 20)
            except (AssertionError, ValueError):
                raise AssertionError("no values of the pixel on the clipboard")
            rounded = [struct.unpack("<f", struct.pack("<f", v))[0] for v in values["reference"]]
            assert rounded == list(pfm_pixel(exact, x, y)), values
            assert values["center"] == list(pfm_pixel(center, x, y)), values
            if "lights" in values:
                parts = [sum(v) for v in zip(values["ambient"], values["emission"], *(
                    light[term] for light in values["lights"] for term in ("diffuse", "specular")))]
                assert all(abs(p - q) < 1e-12 for p, q in zip(parts, values["reference"])), values
            for p, q, ulp in zip(values["center"], values["reference"], values["ulp"]):
                place = 2.0 ** (math.frexp(struct.unpack("<f", struct.pack("<f", q))[0])[1] - 24)
                assert abs(ulp - (p - q) / place) < 1e-6 * (1 + abs(ulp)), values


# Rows of other tabs at scale 1, as in the panel: where a slider of theirs stands.
TIME = 195           # tab Picture, of a model that is animated
INTENSITY = 204      # tab Lights, three lights of which a directional one is selected


def test_animation_time_by_slider_and_keys():
    with Viewer(BEND) as viewer:
        first, look = viewer.picture()
        assert "animation-time" not in look
        viewer.key("F5")  # the tab Picture
        viewer.settled()
        viewer.drag(SLIDER[0] + 8, TIME, SLIDER[0] + 90, TIME)
        bent, look = viewer.picture()
        assert 1.5 < look["animation-time"] < 2.5 and bent != first, look
        viewer.key("Right", "Right", "Right")
        later, look = viewer.picture()
        assert later != bent
        viewer.key("b")  # B keeps its moment
        kept = look["animation-time"]
        viewer.key("Left", "Left", "Left", "Left", "Left", "Left")
        a = viewer.render("--look", viewer.save_look()[1])
        size, half = tuple(look["resolution"]), look["resolution"][0] // 2

        def split():
            shown = viewer.crop(viewer.capture(), size)
            return columns(shown, size, 0, half - 3) == columns(a, size, 0, half - 3) and \
                columns(shown, size, half + 3, size[0]) == columns(later, size, half + 3, size[0])
        wait_for("A's moment at the left and B's at the right", split)
        viewer.key("shift+b")  # exchanged: A is at B's moment
        viewer.key("shift+a")
        back, look = viewer.picture()
        assert look["animation-time"] == kept and back == later
        viewer.key(*["ctrl+z"] * 13)
        again, look = viewer.picture()
        assert "animation-time" not in look and again == first


def test_an_animation_plays():
    with Viewer(BEND) as viewer:
        first, look = viewer.picture()
        viewer.key("space")
        seen = set()

        def moved():
            seen.add(viewer.x.capture(300, 100, 400, 500))
            return len(seen) > 5
        wait_for("pictures that move", moved)
        viewer.key("space")
        viewer.picture()
        viewer.key("ctrl+z")  # one step
        assert viewer.picture()[0] == first


def test_the_files_lights_become_own_ones_with_their_fall_off():
    with Viewer(LIGHTS) as viewer:
        first, look = viewer.picture()
        assert "light" not in look
        viewer.key("F3")  # the tab Lights
        viewer.settled()
        viewer.drag(SLIDER[0] + 10, INTENSITY, SLIDER[0] + 50, INTENSITY)
        brighter, look = viewer.picture()
        assert brighter != first
        kinds = [text.split(":")[0] for text in look["light"]]
        assert kinds == ["directional", "point", "spot"], look["light"]
        assert ":falloff," in look["light"][1] and look["light"][2].endswith(":falloff")
        # But for what was edited, the picture is that of the file's lights.
        info = subprocess.run([GLINT, "info", viewer.model], capture_output=True, text=True).stdout
        scale = float(info.split("multiplied by ")[1].split(")")[0])
        sun = look["light"][0].rsplit(":", 1)[0] + ":" + ",".join([repr(0.3 * scale)] * 3)
        path = os.path.join(viewer.folder, "same.json")
        with open(path, "w") as file:
            json.dump({**look, "light": [sun, *look["light"][1:]]}, file)
        assert viewer.render("--look", path) == first
        viewer.key("g", "Delete")  # the point
        two, look = viewer.picture()
        assert len(look["light"]) == 2 and two != brighter
        viewer.key("shift+Delete")
        again, look = viewer.picture()
        assert "light" not in look and again == first
        viewer.key("l")
        brighter, look = viewer.picture()
        assert brighter != first and "light-scale" in look and "light" not in look


def test_presets_and_plots_have_keys():
    with Viewer(TEAPOT) as viewer:
        first, look = viewer.picture()
        viewer.key("m")
        one, look = viewer.picture()
        assert one != first and look["material"]["Glazed ceramic"]["metalness"] == 1, look
        viewer.key("m")
        two, _ = viewer.picture()
        assert two not in (first, one)
        viewer.key("shift+m")
        assert viewer.picture()[0] == one
        viewer.key("ctrl+r")
        assert viewer.picture()[0] == first
        plots = []
        for _ in range(5):
            viewer.key("F8")
            viewer.move(20, 20)
            viewer.settled()
            plots.append(viewer.x.capture(PANEL_LEFT, 0, viewer.panel, viewer.screen[1]))
        assert len(set(plots)) == 5, "plots look the same"
        viewer.key("F8")
        viewer.settled()
        assert viewer.x.capture(PANEL_LEFT, 0, viewer.panel, viewer.screen[1]) == plots[0]
        assert viewer.picture()[0] == first


def test_pictures_of_other_sizes_without_background():
    with Viewer(TEAPOT, "--no-background") as viewer:
        _, path = viewer.save_look()
        viewer.key("shift+F12")
        viewer.settled()
        viewer.xdotool("type", "--delay", "20", "other.png")
        viewer.key("Tab")
        viewer.xdotool("type", "--delay", "20", "300")
        viewer.key("Tab")
        viewer.xdotool("type", "--delay", "20", "200")
        viewer.key("Return")
        other = os.path.join(viewer.folder, "other.png")
        wait_for("the picture", lambda: os.path.exists(other))
        viewer.render("--look", path, "--resolution", "300,200", "--no-background")
        with open(other, "rb") as a, open(os.path.join(viewer.folder, "offscreen.png"), "rb") as b:
            assert a.read() == b.read()


def test_other_sizes_and_scales():
    for screen, options in (((900, 700), ()), ((1400, 840), ("--scale", "2"))):
        with Viewer(TEAPOT, *options, screen=screen) as viewer:
            viewer.picture()


def test_a_fine_screen_is_seen_to_be_one():
    """At 192 dots an inch text and panel are twice as large, a pixel of the picture is a pixel."""
    with Viewer(TEAPOT, screen=(1900, 1000), dpi=192) as viewer:
        _, look = viewer.picture()
        assert abs(look["resolution"][0] - (1900 - 2 * viewer.panel)) <= 2, look["resolution"]
        # The slider of the diffuse part stands twice as far from the panel's corner.
        left, y = 1900 - 2 * (1372 - SLIDER[0]), 2 * ROW["diffuse"]
        viewer.drag(left + 120, y, left + 240, y)
        changed, look = viewer.picture()
        assert list(look["material"]["Glazed ceramic"]) == ["diffuse"], look


def test_rests_when_nothing_changes():
    with Viewer(TEAPOT) as viewer:
        viewer.settled(quiet=1)

        def ticks():
            with open(f"/proc/{viewer.process.pid}/stat") as file:
                fields = file.read().rsplit(")", 1)[1].split()
            return int(fields[11]) + int(fields[12])
        before = ticks()
        time.sleep(5)
        share = (ticks() - before) / os.sysconf("SC_CLK_TCK") / 5
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
    GLINT, VIEWER, MODELS = (os.path.abspath(path) for path in sys.argv[1:4])
    TEAPOT = os.path.join(MODELS, "teapot.glb")
    SPHERE = os.path.join(MODELS, "sphere.glb")
    BEND = os.path.join(MODELS, "bend.glb")
    LIGHTS = os.path.join(MODELS, "lights.glb")
    GLSL = os.path.join(os.path.dirname(MODELS), "glsl")
    sys.exit(main())
