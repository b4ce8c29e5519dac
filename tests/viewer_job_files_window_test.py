#!/usr/bin/env python3
"""Complete tasks of a user in a real window under Xvfb, like viewer_jobs_window_test.py: those with
files.

    viewer_job_files_window_test.py GLINT GLINT_VIEWER MODELS [TEST...]
"""

import json
import os
import shutil
import signal
import subprocess
import sys

import viewer_driver
import viewer_models
from viewer_driver import PANEL_LEFT, ROW, pixels_of, wait_for
from viewer_job import Job


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
            if name == "noise.hdr":  # becomes the environment, which phong does not use
                job.key("ctrl+z")
                told = job.told().count("\n")
                continue
            told += 1
            assert job.told().count("\n") == told, job.told()
            assert name in job.told().splitlines()[-1], job.told()
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


if __name__ == "__main__":
    sys.exit(viewer_driver.run(globals()))
