#!/usr/bin/env python3
"""Whole jobs of a working day in a real window under Xvfb, each from opening a model to its result: the
bytes of a picture, values in a look, a file.

    viewer_jobs_window_test.py GLINT GLINT_VIEWER MODELS [TEST...]
"""

import json
import math
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import viewer_driver
import viewer_models
from viewer_driver import PANEL_LEFT, ROW, SLIDER, Viewer, pixels_of, wait_for

LINE = 19      # pixels at scale 1, of a list
TEXTURE = 610  # the row of a material's first texture, where there are two materials


class Job(Viewer):
    """A window on a model that is made for it, with what a person does again and again."""

    def __init__(self, make, *options, materials=1, **others):
        folder = tempfile.mkdtemp(prefix="glint-job-")
        try:
            path = make(os.path.join(folder, "model.glb")) if callable(make) else make
            super().__init__(path, *options, **others)
        finally:
            shutil.rmtree(folder)
        # The list of materials has a line for all, and one for each up to five.
        self.below = LINE * (min(materials + 1, 6) - 2)

    def say(self, *words):
        """Has the palette do something."""
        for each in words:
            self.key("ctrl+p")
            self.settled()
            self.xdotool("type", "--delay", "15", each)
            self.settled()
            self.key("Return")
            self.settled()

    def select(self, material):
        self.key("ctrl+f")
        self.settled()
        self.xdotool("type", "--delay", "15", material)
        self.key("Return")
        self.settled()

    def set(self, row, text):
        """Types a value of the selected material."""
        self.move(SLIDER[0] + 60, ROW[row] + self.below)
        self.xdotool("keydown", "ctrl", "click", "1", "keyup", "ctrl")
        self.settled()
        self.xdotool("type", "--delay", "15", text)
        self.key("Return")
        self.move(20, 20)
        self.settled()

    def answer(self, text=None):
        """Enter in a dialog, with a name if one is given."""
        self.settled()
        if text is not None:
            self.key("ctrl+a")
            self.xdotool("type", "--delay", "15", text)
            self.settled()
        self.key("Return")
        self.settled()

    def path(self, name):
        return os.path.join(self.folder, name)

    def bytes_of(self, name):
        wait_for(name, lambda: os.path.exists(self.path(name)))
        with open(self.path(name), "rb") as file:
            return file.read()


def test_job_a_helmet_is_painted():
    with Job(viewer_models.helmet, materials=2) as job:
        first, _ = job.picture()
        job.click(500, 500)  # the visor
        job.settled()
        job.set("exponent", "2*100")
        job.set("specular", "0,75")
        visor, look = job.picture()
        assert visor != first
        assert look["material"] == {"Visor": {"exponent": 200, "specular": 0.75}}, look["material"]
        job.select("shell")
        job.key("m")  # gold: times the colours of the picture, until that is switched off
        tinted, look = job.picture()
        assert look["material"]["Shell"]["metalness"] == 1, look["material"]
        job.say("next preset")
        again, look = job.picture()
        assert again not in (first, visor, tinted)
        off = job.render("--look", job.save_look()[1], "--material", "Shell:color-texture=off")
        assert off != again
        job.click(PANEL_LEFT + 66, TEXTURE)
        plain, look = job.picture()
        assert look["material"]["Shell"]["color-texture"] is False, look["material"]
        assert plain == off


def test_job_lights_are_set():
    with Job(TEAPOT) as job:
        first, _ = job.picture()
        job.key("Insert", "Insert", "g")
        _, look = job.picture()
        assert len(look["light"]) == 3, look
        job.key("z")
        two, look = job.picture()
        dark = [text for text in look["light"] if text.endswith(":0,0,0")]
        assert len(dark) == 1, look["light"]
        job.key("z", "shift+z")  # it alone
        _, look = job.picture()
        dark = [text for text in look["light"] if text.endswith(":0,0,0")]
        assert len(dark) == 2, look["light"]
        job.key("shift+z", "l")  # all, brighter
        bright, look = job.picture()
        assert len(set((first, two, bright))) == 3
        assert not [text for text in look["light"] if text.endswith(":0,0,0")], look["light"]
        job.say("ambient light alone")
        assert job.save_look()[0]["no-lights"] is True
        job.key("ctrl+z", "shift+Delete")
        assert job.picture()[0] == first


def test_job_two_looks_are_compared():
    with Job(TEAPOT) as job:
        a, look = job.picture()
        size = tuple(look["resolution"])
        job.key("b", "shift+a")
        job.set("metalness", "1")
        job.say("next program")
        b, look = job.picture()
        assert look["shading"] == "blinn-phong" and a != b
        job.key("d", "period")
        expected = bytes(min(255, 32 * abs(p - q)) for p, q in zip(a, b))
        middle = lambda whole: viewer_driver.columns(whole, size, 0, size[0])
        wait_for("the difference, 32 times", lambda: middle(
            job.crop(job.capture(), size)) == middle(expected))
        job.key("shift+b", "shift+a")  # exchanged: A is what it was
        assert job.picture()[0] == a


def test_job_a_look_is_saved_and_opened():
    with Job(viewer_models.helmet, materials=2) as job:
        job.key("shift+Left", "shift+Left", "x", "l", "7")
        job.select("visor")
        job.set("diffuse", "1/3")
        job.key("ctrl+shift+s")
        job.answer("night.json")
        look = json.loads(job.bytes_of("night.json"))
        assert look["exposure"] == 0.25 and look["material"]["Visor"]["diffuse"] == 1 / 3, look
        drawn = job.render("--look", job.path("night.json"))
        size = tuple(look["resolution"])
        job.shows(size, drawn, "the picture of the look")
        job.key("q")
        assert job.left() == 0  # nothing is unsaved
        job.start("--look", "night.json")
        job.move(20, 20)
        job.shows(size, drawn, "the picture of the look that was opened")


def test_job_materials_are_saved_into_a_model():
    with Job(viewer_models.helmet, materials=2) as job:
        original = job.bytes_of("model.glb")
        job.select("shell")
        job.set("specular", "0.9")
        job.select("visor")
        job.set("exponent", "12")
        edited, look = job.picture()
        job.key("ctrl+shift+m")
        job.answer("painted.glb")
        job.bytes_of("painted.glb")
        assert job.bytes_of("model.glb") == original
        before, behind = viewer_models.chunks(job.path("model.glb"))
        after, saved = viewer_models.chunks(job.path("painted.glb"))
        assert saved == behind, "what is no material has changed"
        glint = [material["extras"]["glint"] for material in after["materials"]]
        assert glint[0]["specular"] == 0.9 and glint[1]["exponent"] == 12, glint
        assert after["materials"][0]["extras"]["maker"] == "kept as it is"
        del before["materials"], after["materials"]
        assert before == after
        out = job.path("painted.png")
        subprocess.run([GLINT, "render", job.path("painted.glb"), "-o", out, "--resolution",
                        "%d,%d" % tuple(look["resolution"])], check=True)
        assert pixels_of(out) == edited


def test_job_an_animation_is_looked_through():
    with Job(BEND) as job:
        rest, _ = job.picture()
        job.key(*["Right"] * 12)
        bent, look = job.picture()
        assert abs(look["animation-time"] - 1.2) < 1e-9 and bent != rest
        job.key("b", "shift+a", "Left", "Left")
        _, look = job.picture()
        assert abs(look["animation-time"] - 1) < 1e-9
        job.key("F12")
        still = job.bytes_of("bend_1.png")
        with open(job.path("offscreen.png"), "rb") as file:
            assert still == file.read()
        job.key("shift+b")
        assert job.picture()[0] == bent  # B's moment


def test_job_glass_in_an_environment():
    with Job(SPHERE) as job:
        hdr = job.path("room.hdr")
        viewer_models.room(hdr)
        job.key("p", "p")
        job.x.drop(job.window, ["file://" + hdr], 400, 300)
        job.settled()
        job.say("environment as background")
        mirror, look = job.picture()
        assert look["shading"] == "environment" and look["hdri-file"].endswith("room.hdr"), look
        job.set("diffuse", "0")
        job.set("specular", "0")
        job.set("transmission", "1")
        job.set("ior", "1.5")
        glass, look = job.picture()
        assert glass != mirror
        values = list(look["material"].values())[0]
        assert values["transmission"] == 1 and values["diffuse"] == 0, values
        job.xdotool("keydown", "shift")
        job.drag(400, 400, 500, 400, button=3)
        job.xdotool("keyup", "shift")
        turned, look = job.picture()
        assert turned != glass and look["environment-rotation"] != 0
        job.key("ctrl+z")
        assert job.picture()[0] == glass


def test_job_by_keys_alone():
    with Job(TEAPOT) as job:  # the pointer stays in a corner
        first, _ = job.picture()
        job.say("next program", "isometric view")
        job.key("F2", "Down")  # into the panel: highlight, max error, ...
        for _ in range(8):
            job.settled(quiet=0.2)
            job.key("Down")
        job.settled()
        job.key("Return")
        job.settled()
        job.xdotool("type", "--delay", "15", "1/2")
        job.key("Return")
        found = job.save_look()[0].get("material", {}).get("Glazed ceramic", {})
        assert found["diffuse"] == 0.5, found
        job.key("Escape")
        picture, look = job.picture()
        assert picture != first and any(each.startswith("camera") for each in look), look
        job.key("ctrl+shift+s")
        job.answer("keys.json")
        assert json.loads(job.bytes_of("keys.json"))["material"]["Glazed ceramic"]["diffuse"] == 0.5
        job.key("F12")
        drawn = job.bytes_of("teapot_1.png")
        with open(job.path("offscreen.png"), "rb") as file:
            assert file.read() == drawn
        job.key("q")
        assert job.left() == 0


def many_parts(path):
    folder = os.path.dirname(path)
    os.rename(viewer_models.scale_models.scene_model(folder, 160, 120, 12, 400), path)
    return path


def test_job_a_model_of_many_parts():
    with Job(many_parts, materials=120) as job:
        job.below += 25  # the button that finds a material
        first, _ = job.picture()
        job.select("#37")
        job.set("specular", "2")
        job.key("Next")
        job.set("specular", "3")
        _, look = job.picture()
        assert look["material"] == {"#37": {"specular": 2}, "#38": {"specular": 3}}, look["material"]
        job.key("ctrl+a")
        job.set("exponent", "7")
        _, look = job.picture()
        assert look["material"][""] == {"exponent": 7}, look["material"]
        assert look["material"]["#37"] == {"specular": 2}
        job.select("#90")
        job.key("i")
        outlined = job.settled()
        job.key("i")
        assert outlined != job.settled(), "no outline"
        job.key(*["ctrl+z"] * 3)
        again, look = job.picture()
        assert again == first and "material" not in look


def test_job_a_heavy_model_is_turned():
    """Faster than its triangles are drawn, and exact where the hand rests."""
    def sphere(path):
        folder = os.path.dirname(path)
        os.rename(viewer_models.scale_models.sphere_model(folder, 2000000), path)
        return path
    with Job(sphere) as job:
        first, look = job.picture()

        def cost(*options):
            """Seconds of processor time that glint render takes."""
            before = os.times()
            subprocess.run([GLINT, "render", job.model, "--look", job.path("model_1.json"),
                            "--anti-aliasing", "none", "-o", job.path("{frame}.pfm"), *options],
                           check=True)
            after = os.times()
            return sum(after[2:4]) - sum(before[2:4])
        whole = (cost("--turntable", "21") - cost("--turntable", "1")) / 20

        def ticks():
            with open(f"/proc/{job.process.pid}/stat") as file:
                fields = file.read().rsplit(")", 1)[1].split()
            return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        job.move(400, 400)
        job.xdotool("mousedown", "1")

        def light():
            """Whether a picture that is seen takes well less than that."""
            begin, seen, pictures, i = ticks(), None, 0, 0
            end = time.monotonic() + 2
            while time.monotonic() < end or pictures < 5:
                i += 1
                job.move(round(400 + 60 * math.cos(i / 9)), round(400 + 60 * math.sin(i / 9)))
                shown = job.x.capture(400, 300, 200, 200)
                pictures += shown != seen
                seen = shown
            each = (ticks() - begin) / pictures
            print(f"{1000 * each:.0f} ms of processor time for a picture in a drag, "
                  f"{1000 * whole:.0f} for a whole one without anti-aliasing")
            return each < 0.65 * whole
        wait_for("pictures of less work", light, 30)
        job.xdotool("mouseup", "1")
        turned, _ = job.picture()
        assert turned != first
        job.key("ctrl+z")
        assert job.picture()[0] == first


def test_job_damaged_files():
    with Job(TEAPOT) as job:
        first, look = job.picture()
        size = tuple(look["resolution"])
        good = job.bytes_of("teapot.glb")
        told = 0
        for name, content in (("empty.glb", b""), ("text.gltf", b"a letter"),
                              ("cut.glb", good[:len(good) // 2]),
                              ("indices.glb", good[:-4000] + b"\xff" * 4000),
                              ("buffer.gltf", b'{"asset":{"version":"2.0"},"buffers":[{"byteLength"'
                                              b':8,"uri":"none.bin"}],"bufferViews":[{"buffer":0,'
                                              b'"byteLength":8}],"scenes":[{"nodes":[7]}]}'),
                              ("look.json", b'{"glint-look": 1, "exposure": "bright"}'),
                              ("noise.hdr", os.urandom(64)), ("short.binary", b"\1\0\0")):
            with open(job.path(name), "wb") as file:
                file.write(content)
            job.x.drop(job.window, ["file://" + job.path(name)], 400, 300)
            wait_for("a message about " + name, lambda: job.told().count("\n") > told or
                     name == "noise.hdr")
            job.settled()
            if name == "noise.hdr":  # becomes the environment, which phong does not read
                job.key("ctrl+z")
                told = job.told().count("\n")
                continue
            told += 1
            assert job.told().count("\n") == told and name in job.told().splitlines()[-1], job.told()
            assert job.alive()
            job.move(20, 20)
            job.shows(size, first, "the picture as it was, after " + name)
        with open(job.path("cut.glb"), "wb") as file:
            file.write(good)
        job.x.drop(job.window, ["file://" + job.path("cut.glb")], 400, 300)
        job.shows(size, first, "the file that was mended")


def test_job_killed_and_recovered():
    with Job(viewer_models.helmet, materials=2) as job:
        job.select("visor")
        job.set("diffuse", "0.7")
        job.key("Insert", "x", "shift+Up", "p")
        edited, look = job.picture()
        os.remove(job.path("model_1.json"))
        job.set("ambient", "0.25")
        drawn = job.settled()
        state = job.path("state/glint/recovery")

        def kept():
            for name in os.listdir(state) if os.path.isdir(state) else []:
                with open(os.path.join(state, name)) as file:
                    if '"ambient": 0.25' in file.read():
                        return True
            return False
        wait_for("the edits to be kept", kept)
        job.process.send_signal(signal.SIGKILL)
        job.process.wait()
        job.start()
        job.key("Return")  # restore
        size = tuple(look["resolution"])
        job.shows((size[0], size[1] - 40), job.crop(drawn, (size[0], size[1] - 40)), "the edits")
        _, again = job.picture()
        assert again["material"]["Visor"] == {"diffuse": 0.7, "ambient": 0.25}, again["material"]
        assert again["shading"] == look["shading"] and again["light"] == look["light"]
        assert again["camera-position"] == look["camera-position"]


def test_job_presets_of_ones_own():
    with Job(TEAPOT) as job:
        job.set("specular", "0.3")
        job.set("exponent", "33")
        first, _ = job.picture()
        job.key("ctrl+k")
        job.answer()
        folder = job.path("config/glint/materials")
        kept = os.path.join(folder, "Glazed ceramic.json")
        wait_for("the preset", lambda: os.path.exists(kept))
        with open(kept) as file:
            values = json.load(file)
        job.key("q")
        job.settled()
        job.key("Tab", "Return")  # close without saving
        if job.alive():
            job.kill()
        shutil.copyfile(SPHERE, job.path("sphere.glb"))
        job.model = job.path("sphere.glb")
        job.start()
        job.click(PANEL_LEFT + 30, ROW["preset"])
        job.settled()
        job.click(PANEL_LEFT + 40, ROW["preset"] - 367)
        _, look = job.picture()
        taken = list(look["material"].values())[0]
        assert taken["specular"] == 0.3 and taken["exponent"] == 33, (taken, values)


def test_job_a_measured_material_is_fitted():
    with Job(SPHERE) as job:
        path = viewer_models.measured(job.path("paint.binary"), (0.4, 0.2, 0.1), 1.5, 240)
        job.x.drop(job.window, ["file://" + path], 400, 300)
        job.settled()
        job.key("p")
        first, _ = job.picture()
        job.say("fit to the measured")
        fitted, look = job.picture()
        values = list(look["material"].values())[0]
        assert 40 < values["exponent"] < 80, values  # a quarter of Blinn's
        red, green, blue = (values["diffuse"] * c for c in values["color"])
        assert max(abs(red - 0.4), abs(green - 0.2), abs(blue - 0.1)) < 0.06, values
        assert fitted != first
        job.key("ctrl+z")
        assert job.picture()[0] == first


def test_job_pictures_are_saved():
    with Job(TEAPOT) as job:
        job.key("9", "x")
        _, look = job.picture()
        size = "%d,%d" % tuple(look["resolution"])
        job.key("F12")
        job.bytes_of("teapot_1.png")
        for name in ("big.exr", "big.jpg", "big.pfm", "big.webp"):
            job.key("shift+F12")
            job.answer(name)
            job.bytes_of(name)
            job.render("--look", job.save_look()[1], "--resolution", size,
                       ending=name.split(".")[1])
            offscreen = "offscreen." + name.split(".")[1]
            wait_for(name, lambda: job.bytes_of(name) == job.bytes_of(offscreen), 20)
        before = job.bytes_of("big.pfm")
        job.key("7", "shift+F12")
        job.answer("big.pfm")
        assert job.bytes_of("big.pfm") == before, "replaced without asking"
        job.key("Return")  # replace
        wait_for("another picture", lambda: job.bytes_of("big.pfm") != before)


def test_job_everything_is_taken_back_and_done_again():
    with Job(viewer_models.helmet, materials=2) as job:
        first, _ = job.picture()
        acts = [lambda: job.key("shift+Left"), lambda: job.key("p"), lambda: job.key("x"),
                lambda: job.key("Insert"), lambda: job.key("z"), lambda: job.key("t"),
                lambda: job.drag(400, 300, 450, 330), lambda: job.key("5"),
                lambda: (job.select("visor"), job.set("diffuse", "0.3")), lambda: job.key("m"),
                lambda: job.key("shift+y"), lambda: job.key("v"), lambda: job.key("a"),
                lambda: job.drag(400, 300, 420, 300, button=3), lambda: job.key("ctrl+r")]
        seen = [first]
        for act in acts:
            act()
            job.move(20, 20)
            seen.append(job.crop(job.settled(), (900, 700)))
        last, look = job.picture()
        for _ in acts:
            job.key("ctrl+z")
        again, start = job.picture()
        assert again == first and not set(start) - {"glint-look", "resolution", "shading",
                                                    "highlight"} - set(look), start
        for shown in seen[1:-1]:
            job.key("ctrl+shift+z")
            wait_for("the next step", lambda: job.crop(job.capture(), (900, 700)) == shown, 20)
        job.key("ctrl+shift+z")
        assert job.picture()[0] == last


if __name__ == "__main__":
    sys.exit(viewer_driver.run(globals()))
