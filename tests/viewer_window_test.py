#!/usr/bin/env python3
"""Drives glint-viewer in a real window under Xvfb with xdotool, as a user would: editing and files.

    viewer_window_test.py GLINT GLINT_VIEWER MODELS [TEST...]

The window's picture is read from the X server and compared, byte for byte, with what `glint render`
draws from the look that the viewer saves with Ctrl+S.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile

import viewer_driver
from viewer_driver import TWO_SIDED, Viewer, drag_slider, wait_for


def test_the_window_shows_what_glint_render_draws():
    with Viewer(TEAPOT) as viewer:
        viewer.picture()
        viewer.key("F12")
        viewer.check_saved("teapot_1.png")


def test_what_a_budget_chooses_is_what_glint_render_draws():
    # Without highlights, vertex shading is accurate enough for auto to choose a program other than
    # phong.
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
        viewer.check_saved("sphere_1.png")


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
        viewer.click(20, 40)  # the background: the selection stays
        drag_slider(viewer, "diffuse", 0.4, 0.7)
        assert list(viewer.picture()[1]["material"]) == ["Glazed ceramic"]
        viewer.key("ctrl+z")
        viewer.key("ctrl+a")
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
        viewer.settled()
        viewer.key("Return")  # asks before writing to the file
        wait_for("the model to be saved", lambda: open(viewer.model, "rb").read() != original)
        viewer.key("q")
        assert viewer.left() == 0
        # The binary chunk and everything except the material are unchanged.
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
        # Edits that the sphere has no use for are gone; the camera is unchanged.
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

        def all_kept():  # not those from the middle of the drag
            values = []
            for name in kept():
                with open(os.path.join(state, name)) as file:
                    values.append(json.load(file)["look"]["material"]["Glazed ceramic"]["diffuse"])
            return values and values[0] > 1.7
        wait_for("the edits to be kept", all_kept)
        viewer.kill()
        viewer.start()  # asks, and waits
        viewer.key("Return")  # restore
        viewer.shows((1000, 740), edited[:3000 * 740], "the edits")
        picture, look = viewer.picture()  # saved: nothing more is kept for recovery
        assert look["material"]["Glazed ceramic"]["diffuse"] > 1
        wait_for("nothing to be kept", lambda: not kept())
        viewer.key("q")
        assert viewer.left() == 0
        assert os.listdir(state) == []


def test_rests_when_nothing_changes():
    with Viewer(TEAPOT) as viewer:
        share = viewer.share_at_rest(3)
        print(f"at rest: {100 * share:.2f} % of a core")
        assert share < 0.01


def test_without_a_display_it_says_so():
    environment = {k: v for k, v in os.environ.items()
                   if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    done = subprocess.run([VIEWER, TEAPOT], env=environment, capture_output=True, text=True)
    assert done.returncode == 3, done
    assert done.stderr.count("\n") == 1 and "glint render" in done.stderr, done.stderr


if __name__ == "__main__":
    sys.exit(viewer_driver.run(globals()))
