#!/usr/bin/env python3
"""Complete tasks of a user in a real window under Xvfb, each from opening a model to its result:
materials, lights, comparisons, animations, models of all sizes. Those with files are in
viewer_job_files_window_test.py.

    viewer_jobs_window_test.py GLINT GLINT_VIEWER MODELS [TEST...]
"""

import json
import math
import os
import subprocess
import sys
import time

import viewer_driver
import viewer_models
from viewer_driver import PANEL_LEFT, wait_for
from viewer_job import Job

TEXTURE = 610  # the row of a material's first texture in a model with two materials


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
        job.key("m")  # gold: multiplied by the texture's colours until it is switched off
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
        job.key("z", "shift+z")  # solo
        _, look = job.picture()
        dark = [text for text in look["light"] if text.endswith(":0,0,0")]
        assert len(dark) == 2, look["light"]
        job.key("shift+z", "l")  # all on, brighter
        bright, look = job.picture()
        assert len(set((first, two, bright))) == 3
        assert not [text for text in look["light"] if text.endswith(":0,0,0")], look["light"]
        job.say("only ambient light")
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
        job.key("shift+b", "shift+a")  # swapped: A is as before
        assert job.picture()[0] == a


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
        job.check_saved("bend_1.png")
        job.key("shift+b")
        assert job.picture()[0] == bent  # B's time


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
        job.check_saved("teapot_1.png")
        job.key("q")
        assert job.left() == 0


def many_parts(path):
    folder = os.path.dirname(path)
    os.rename(viewer_models.scale_models.scene_model(folder, 160, 120, 12, 400), path)
    return path


def test_job_a_model_of_many_parts():
    with Job(many_parts, materials=120) as job:
        job.below += 25  # the height of the button that finds a material
        first, _ = job.picture()
        job.select("#37")
        job.set("specular", "2")
        job.key("Next")
        job.set("specular", "3")
        _, look = job.picture()
        assert look["material"] == {"#37": {"specular": 2}, "#38": {"specular": 3}}, look
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
    """Dragging is faster than drawing all triangles, and the picture at rest is exact."""
    def sphere(path):
        folder = os.path.dirname(path)
        os.rename(viewer_models.scale_models.sphere_model(folder, 2000000), path)
        return path
    with Job(sphere) as job:
        wait_for("the model", lambda: len(set(job.x.capture(450, 480, 60, 60))) > 20)
        first, look = job.picture()

        def cost(*options):
            """The processor time of glint render, in seconds."""
            before = os.times()
            subprocess.run([GLINT, "render", job.model, "--look", job.path("model_1.json"),
                            "--anti-aliasing", "none", "-o", job.path("{frame}.pfm"), *options],
                           check=True)
            after = os.times()
            return sum(after[2:4]) - sum(before[2:4])
        whole = (cost("--turntable", "21") - cost("--turntable", "1")) / 20
        job.move(400, 400)
        job.xdotool("mousedown", "1")

        def light():
            """Whether a frame on the screen takes well below that."""
            begin, seen, pictures, i = job.processor_seconds(), None, 0, 0
            end = time.monotonic() + 2
            while time.monotonic() < end or pictures < 5:
                i += 1
                job.move(round(400 + 60 * math.cos(i / 9)), round(400 + 60 * math.sin(i / 9)))
                shown = job.x.capture(400, 300, 200, 200)
                pictures += shown != seen
                seen = shown
            each = (job.processor_seconds() - begin) / pictures
            print(f"{1000 * each:.0f} ms of processor time for a picture in a drag, "
                  f"{1000 * whole:.0f} for a whole one without anti-aliasing")
            return each < 0.65 * whole
        wait_for("pictures of less work", light, 30)
        job.xdotool("mouseup", "1")
        turned, _ = job.picture()
        assert turned != first
        job.key("ctrl+z")
        assert job.picture()[0] == first


def test_job_a_measured_material_is_fitted():
    with Job(SPHERE) as job:
        path = viewer_models.measured(job.path("paint.binary"), (0.4, 0.2, 0.1), 1.5, 240)
        job.x.drop(job.window, ["file://" + path], 400, 300)
        job.settled()
        job.key("p")
        first, _ = job.picture()
        job.say("fit to the open measured")
        fitted, look = job.picture()
        values = list(look["material"].values())[0]
        assert 40 < values["exponent"] < 80, values  # a quarter of Blinn's
        red, green, blue = (values["diffuse"] * c for c in values["color"])
        assert max(abs(red - 0.4), abs(green - 0.2), abs(blue - 0.1)) < 0.06, values
        assert fitted != first
        job.key("ctrl+z")
        assert job.picture()[0] == first


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
            # The whole picture appears up to 0.6 s after the drag rests.
            seen.append(job.crop(job.settled(quiet=0.8), (900, 700)))
        last, look = job.picture()
        for _ in acts:
            job.key("ctrl+z")
        again, start = job.picture()
        assert again == first and not set(start) - {"glint-look", "resolution", "shading",
                                                    "highlight"} - set(look), start
        for step, shown in enumerate(seen[1:-1]):
            job.key("ctrl+shift+z")
            wait_for("step %d again" % step, lambda: job.crop(job.capture(), (900, 700)) == shown, 20)
        job.key("ctrl+shift+z")
        assert job.picture()[0] == last


if __name__ == "__main__":
    sys.exit(viewer_driver.run(globals()))
