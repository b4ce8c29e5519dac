#!/usr/bin/env python3
"""Drives glint-viewer in a real window under Xvfb: the palette and the menu, keyboard-only use,
typed numbers, the wheel, and files that are dropped or deleted.

    viewer_hands_window_test.py GLINT GLINT_VIEWER MODELS [TEST...]
"""

import json
import math
import os
import struct
import subprocess
import sys
import time

import viewer_driver
from viewer_driver import PANEL_LEFT, ROW, SLIDER, Viewer, drag_slider, wait_for

MATERIAL = "Glazed ceramic"


def values(viewer):
    """The teapot material's entries in the saved look."""
    return viewer.save_look()[0].get("material", {}).get(MATERIAL, {})


def type_at(viewer, row, text):
    """Ctrl+clicks a slider and types a text over its value."""
    viewer.move(SLIDER[0] + 60, ROW[row])
    viewer.xdotool("keydown", "ctrl", "click", "1", "keyup", "ctrl")
    viewer.settled()
    viewer.xdotool("type", "--delay", "20", text)
    viewer.settled()


def test_the_palette_finds_and_does():
    with Viewer(TEAPOT) as viewer:
        first, _ = viewer.picture()
        viewer.key("7")
        top, _ = viewer.picture()
        assert top != first
        viewer.key("Return")
        viewer.key("ctrl+p")
        viewer.settled()
        viewer.xdotool("type", "--delay", "20", "VIEW top")
        viewer.key("Return")
        assert viewer.picture()[0] == top, "the palette did not do what the key does"
        viewer.key("ctrl+p")
        viewer.settled()
        viewer.xdotool("type", "--delay", "20", "reset the view")
        viewer.key("Escape")  # has no effect
        assert viewer.picture()[0] == top
        assert viewer.alive()


def test_the_menu_is_worked_by_keys_and_mouse():
    with Viewer(TEAPOT) as viewer:
        first, _ = viewer.picture()
        drag_slider(viewer, "diffuse", 0.4, 0.9)
        changed, _ = viewer.picture()
        closed = viewer.settled()
        viewer.key("F10")
        wait_for("the menu", lambda: viewer.capture() != closed)
        viewer.key("Right")  # Edit
        viewer.settled()
        viewer.key("Down", "Return")  # undo
        assert viewer.picture()[0] == first, "undo of the menu by keys"
        viewer.click(50, 10)  # Edit
        viewer.settled()
        viewer.click(60, 55)  # redo
        assert viewer.picture()[0] == changed, "redo of the menu by the mouse"


def test_tab_never_opens_a_text():
    with Viewer(TEAPOT) as viewer:
        viewer.key("b", "shift+a")  # B is kept, only A is shown
        drag_slider(viewer, "diffuse", 0.4, 0.9)
        a, _ = viewer.picture()
        viewer.key("Tab")  # B instead of A
        wait_for("B", lambda: viewer.crop(viewer.capture(), (1000, 700)) != a[:3000 * 700])
        viewer.key("Tab", "7", "Return", "p")
        _, look = viewer.picture()
        assert look["shading"] == "blinn-phong", look["shading"]
        assert "max-error" not in look and "camera-direction" not in look, look


def test_numbers_as_people_type_them():
    with Viewer(TEAPOT) as viewer:
        for text, value in (("0,5", 0.5), ("1/3", 1 / 3), ("2*(1+0.25)", 2.5)):
            type_at(viewer, "diffuse", text)
            viewer.key("Return")
            assert abs(values(viewer)["diffuse"] - value) < 1e-15, (text, values(viewer))
        type_at(viewer, "diffuse", "1e9")  # above the allowed maximum
        viewer.key("Return")
        shown = viewer.settled()
        at = 3 * (viewer.screen[0] * ROW["diffuse"] + SLIDER[1] - 8)
        red, green, blue = shown[at:at + 3]
        assert red > 2 * green and red > 2 * blue, (red, green, blue)
        viewer.key("Escape")
        assert values(viewer)["diffuse"] == 2.5, "a value out of range was taken"
        type_at(viewer, "exponent", "abc")
        viewer.click(400, 700)  # elsewhere: an invalid text is reported, and the old value stays
        wait_for("the message", lambda: "'abc'" in viewer.told())
        assert "exponent" not in values(viewer)


def test_by_the_keyboard_alone():
    with Viewer(TEAPOT) as viewer:
        first, _ = viewer.picture()
        viewer.key("shift+Right", "shift+Up", "equal", "ctrl+Left", "bracketleft")
        turned, look = viewer.picture()
        assert turned != first and "camera-position" in look
        viewer.key("Return")
        assert viewer.picture()[0] == first
        # From the slider touched last, the ring moves on to the next one.
        viewer.click(int(SLIDER[0] + 0.2 * (SLIDER[1] - SLIDER[0])), ROW["exponent"])
        viewer.key("Down")
        viewer.settled()
        viewer.key("Return")
        viewer.settled()
        viewer.xdotool("type", "--delay", "20", "1/4")
        viewer.key("Return")
        assert values(viewer)["metalness"] == 0.25, values(viewer)
        before = values(viewer)
        viewer.key("Down")
        viewer.settled()
        viewer.key("Up")
        viewer.settled()
        viewer.key("BackSpace")
        assert "metalness" not in values(viewer), (before, values(viewer))
        viewer.key("Escape")  # the ring disappears, the window stays
        viewer.settled()
        viewer.key("7")
        assert viewer.picture()[0] != first and viewer.alive()


def test_the_wheel_goes_to_the_surface_and_stops_there():
    with Viewer(TEAPOT) as viewer:
        viewer.picture()
        viewer.move(480, 440)
        for _ in range(8):
            viewer.xdotool("click", "--repeat", "15", "--delay", "5", "4")
            viewer.settled()
        look, path = viewer.save_look()
        picture = viewer.render("--look", path, ending="pfm")
        size = look["resolution"]
        color = viewer_driver.pfm_pixel(picture, 480, 440 - viewer.top)
        back = 0.033104766570885055
        assert any(abs(c - back) > 1e-3 for c in color), "the surface was passed"
        distance = math.dist(look["camera-position"], look["camera-focal-point"])
        assert distance < 0.01, distance
        assert size[0] > 100


def test_a_background_click_keeps_the_selection_and_double_click_sets_the_pivot():
    with Viewer(TEAPOT) as viewer:
        viewer.picture()
        viewer.click(520, 430)
        time.sleep(0.6)
        viewer.click(520, 430, repeat=2)  # sets the pivot
        viewer.settled()
        viewer.drag(300, 300, 360, 300)
        turned = viewer.save_look()[0]
        viewer.key("Return")  # removes the pivot, too
        viewer.drag(300, 300, 360, 300)
        middle = viewer.save_look()[0]
        assert math.dist(turned["camera-focal-point"], middle["camera-focal-point"]) > 1e-3


def test_environments_and_measured_materials_are_dropped():
    with Viewer(TEAPOT) as viewer:
        viewer.picture()
        hdr = os.path.join(viewer.folder, "room.EXR")
        subprocess.run([GLINT, "environment", "sky", "-o", os.path.join(viewer.folder, "room.exr")],
                       check=True, capture_output=True)
        os.rename(os.path.join(viewer.folder, "room.exr"), hdr)
        viewer.x.drop(viewer.window, ["file://" + hdr], 400, 300)
        viewer.settled()
        assert viewer.save_look()[0]["hdri-file"].endswith("room.EXR")
        # A measured material: diffuse with a highlight (cos of the half vector)^400.
        bins = (90, 10, 12)
        channels = []
        for scale, color in ((1 / 1500, 0.5), (1.15 / 1500, 0.25), (1.66 / 1500, 0.125)):
            for h in range(bins[0]):
                angle = math.pi / 2 * ((h / bins[0]) ** 2 + ((h + 1) / bins[0]) ** 2) / 2
                value = (color + 2 * math.cos(angle) ** 400) / math.pi / scale
                channels += [value] * (bins[1] * bins[2])
        path = os.path.join(viewer.folder, "paint.binary")
        with open(path, "wb") as file:
            file.write(struct.pack("<3i", *bins) + struct.pack(f"<{len(channels)}d", *channels))
        viewer.x.drop(viewer.window, ["file://" + path], 400, 300)
        viewer.settled()
        viewer.key("p", "shift+f")  # Blinn's lobe, fitted
        viewer.settled()
        found = values(viewer)
        assert 60 < found["exponent"] < 140, found  # Blinn's is four times this
        red, green, blue = (found["diffuse"] * c for c in found["color"])
        assert abs(red - 0.5) < 0.1 and abs(green - 0.25) < 0.06 and abs(blue - 0.125) < 0.04, found


def test_a_light_is_dragged_switched_off_and_on():
    with Viewer(TEAPOT) as viewer:
        first, look = viewer.picture()
        assert "light" not in look
        viewer.key("o")  # handles
        viewer.settled()
        # The default light at (-0.5, 0.7, 1) in eye space, on the ball around the model.
        length = math.sqrt(0.25 + 0.49 + 1)
        x, y, z = -0.5 / length, 0.7 / length, 1 / length
        angle = math.radians(15)
        depth = 1 / (0.9 * math.sin(angle)) - z
        half = look["resolution"][1] / 2
        at = [round(look["resolution"][0] / 2 + x / depth / math.tan(angle) * half),
              round(viewer.top + half - y / depth / math.tan(angle) * half)]
        viewer.drag(*at, at[0] + 160, at[1])
        viewer.key("o")
        dragged, look = viewer.picture()
        assert dragged != first and look["light"][0].startswith("camera@"), look
        assert float(look["light"][0].split("@")[1].split(",")[0]) > 0, look["light"]
        viewer.key("z")
        assert viewer.save_look()[0]["light"][0].endswith(":0,0,0")
        viewer.key("z")
        assert viewer.picture()[0] == dragged


def test_a_preset_of_ones_own_is_kept_shown_and_taken():
    with Viewer(TEAPOT) as viewer:
        first, look = viewer.picture()
        size = tuple(look["resolution"])
        viewer.key("ctrl+k")
        viewer.settled()
        viewer.key("Return")
        path = os.path.join(viewer.folder, "config/glint/materials", MATERIAL + ".json")
        wait_for("the preset's file", lambda: os.path.exists(path))
        viewer.key("m")
        metal, _ = viewer.picture()
        assert metal != first
        viewer.click(PANEL_LEFT + 30, ROW["preset"])  # the list of presets, the user's own first
        viewer.settled()
        viewer.move(PANEL_LEFT + 40, ROW["preset"] - 367)
        viewer.shows(size, first, "the picture with the preset under the pointer")
        viewer.key("Escape")
        viewer.move(20, 20)
        viewer.shows(size, metal, "the picture as it was")
        assert values(viewer)["metalness"] == 1
        viewer.click(PANEL_LEFT + 30, ROW["preset"])
        viewer.settled()
        viewer.click(PANEL_LEFT + 40, ROW["preset"] - 367)
        assert viewer.picture()[0] == first
        viewer.key("ctrl+z")
        assert viewer.picture()[0] == metal


def test_the_environment_is_turned_by_dragging():
    with Viewer(TEAPOT, "--shading", "environment") as viewer:
        first, _ = viewer.picture()
        viewer.xdotool("keydown", "shift")
        viewer.drag(400, 400, 500, 400, button=3)
        viewer.xdotool("keyup", "shift")
        turned, look = viewer.picture()
        assert turned != first and 5 < look["environment-rotation"] < 90, look
        assert "camera-position" not in look


def test_saving_asks_once_and_a_deleted_model_is_told():
    with Viewer(TEAPOT) as viewer:
        def content():
            with open(viewer.model, "rb") as file:
                return file.read()
        original = content()
        drag_slider(viewer, "specular", 0.2, 0.8)
        viewer.key("ctrl+m")
        viewer.settled()
        assert content() == original, "written without asking"
        viewer.key("Return")
        wait_for("the model to be saved", lambda: content() != original)
        once = content()
        drag_slider(viewer, "specular", 0.8, 0.3)
        viewer.key("ctrl+m")
        wait_for("the model to be saved again, unasked", lambda: content() != once)
        os.remove(viewer.model)
        wait_for("the message", lambda: "no longer exists" in viewer.told())
        assert viewer.alive()


def test_the_panel_is_made_wider():
    with Viewer(TEAPOT) as viewer:
        width = viewer.picture()[1]["resolution"][0]
        viewer.drag(PANEL_LEFT, 500, PANEL_LEFT - 150, 500)
        _, look = viewer.picture()
        assert abs(width - look["resolution"][0] - 150) < 6, look["resolution"]


def test_the_probe_says_what_b_has():
    with Viewer(TEAPOT) as viewer:
        _, look = viewer.picture()
        b = viewer.render("--look", os.path.join(viewer.folder, "teapot_1.json"), ending="pfm")
        viewer.key("b")
        drag_slider(viewer, "diffuse", 0.4, 0.9)
        path = viewer.save_look()[1]
        a = viewer.render("--look", path, ending="pfm")
        viewer.key("F7")
        for x, side in ((430, "A"), (570, "B")):
            viewer.move(x, 440)
            viewer.settled()
            viewer.key("ctrl+shift+c")

            def probed():
                try:
                    told = json.loads(viewer.x.clipboard())
                except (AssertionError, ValueError):
                    return None
                return told if told["pixel"] == [x, 440 - viewer.top] and "center" in told else None
            told = wait_for("the pixel's values", probed, 20)
            pixel = [viewer_driver.pfm_pixel(p, x, 440 - viewer.top) for p in (a, b)]
            assert told["look"] == side, told
            assert told["shown"] == list(pixel[side == "B"]), told
            assert told["A-B"] == [p - q for p, q in zip(*pixel)], told


if __name__ == "__main__":
    sys.exit(viewer_driver.run(globals()))
