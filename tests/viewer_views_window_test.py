#!/usr/bin/env python3
"""Drives glint-viewer in a real window under Xvfb: comparisons, the probe, animations, lights,
presets, plots and sizes.

    viewer_views_window_test.py GLINT GLINT_VIEWER MODELS [TEST...]

The window's picture is read from the X server and compared, byte for byte, with what `glint render`
draws from the look that the viewer saves with Ctrl+S.
"""

import json
import math
import os
import struct
import subprocess
import sys

import viewer_driver
from viewer_driver import (INTENSITY, PANEL_LEFT, ROW, SLIDER, TIME, Viewer, columns, drag_slider,
                           pfm_pixel, wait_for)


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
            return viewer.shows_halves(size, half, b, a)
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
        wait_for("B instead of A", lambda: columns(
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
            return viewer.shows_halves(size, half, a, exact)
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
            viewer.move(x, y + viewer.top)
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
        viewer.key("b")  # B keeps its time
        kept = look["animation-time"]
        viewer.key("Left", "Left", "Left", "Left", "Left", "Left")
        a = viewer.render("--look", viewer.save_look()[1])
        size, half = tuple(look["resolution"]), look["resolution"][0] // 2

        def split():
            return viewer.shows_halves(size, half, a, later)
        wait_for("A's moment at the left and B's at the right", split)
        viewer.key("shift+b")  # swapped: A is at B's time
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
        viewer.key("ctrl+z")  # undoes one step
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
        # Except for the edit, the picture is that of the file's lights.
        info = subprocess.run([GLINT, "info", viewer.model], capture_output=True, text=True).stdout
        scale = float(info.split("multiplied by ")[1].split(")")[0])
        sun = look["light"][0].rsplit(":", 1)[0] + ":" + ",".join([repr(0.3 * scale)] * 3)
        path = os.path.join(viewer.folder, "same.json")
        with open(path, "w") as file:
            json.dump({**look, "light": [sun, *look["light"][1:]]}, file)
        assert viewer.render("--look", path) == first
        viewer.key("g", "Delete")  # removes the point light
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
        for _ in range(6):
            viewer.key("F8")
            viewer.move(20, 20)
            viewer.settled()
            plots.append(viewer.x.capture(PANEL_LEFT, 0, viewer.panel, viewer.screen[1]))
        assert len(set(plots)) == 6, "plots look the same"
        viewer.key("F8")
        viewer.settled()
        assert viewer.x.capture(PANEL_LEFT, 0, viewer.panel, viewer.screen[1]) == plots[0]
        assert viewer.picture()[0] == first


def test_the_lobe_in_space_is_turned_and_its_light_moved():
    with Viewer(TEAPOT) as viewer:
        first, _ = viewer.picture()
        viewer.key("F8", "F8")
        viewer.move(20, 20)
        viewer.settled()
        plot = (PANEL_LEFT + 10, 590, 340, 150)
        seen = [viewer.x.capture(*plot)]
        blue = [seen[0][i:i + 3] for i in range(0, len(seen[0]), 3)
                if seen[0][i + 2] > 2 * seen[0][i] and seen[0][i + 2] > 120]
        assert len(blue) > 500, "there is no surface"
        for act in (lambda: viewer.drag(PANEL_LEFT + 180, 700, PANEL_LEFT + 240, 670),
                    lambda: viewer.drag(PANEL_LEFT + 126, 573, PANEL_LEFT + 250, 573),
                    lambda: viewer.drag(PANEL_LEFT + 206, 759, PANEL_LEFT + 40, 759)):
            act()
            viewer.move(20, 20)
            viewer.settled()
            now = viewer.x.capture(*plot)
            assert now not in seen
            seen.append(now)
        again, look = viewer.picture()
        assert again == first and "material" not in look and "light" not in look


def test_the_list_of_materials_shows_balls():
    with Viewer(TEAPOT) as viewer:
        viewer.picture()
        ball = (PANEL_LEFT + 18, 281, 12, 12)

        def mean():
            shown = viewer.x.capture(*ball)
            return [sum(shown[c::3]) / len(shown) * 3 for c in range(3)]
        red, green, blue = mean()
        assert green > 1.5 * red and blue > 1.5 * red, (red, green, blue)  # the teapot's turquoise
        viewer.key("m")  # gold
        viewer.move(20, 20)
        viewer.settled()
        red, green, blue = mean()
        assert red > green > 2 * blue, (red, green, blue)


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
        viewer.render("--look", path, "--resolution", "300,200", "--no-background")
        viewer.check_saved("other.png")


def test_other_sizes_and_scales():
    for screen, options in (((900, 700), ()), ((1400, 840), ("--scale", "2"))):
        with Viewer(TEAPOT, *options, screen=screen) as viewer:
            viewer.picture()


def test_a_fine_screen_is_seen_to_be_one():
    """At 192 dpi, text and panel are twice as large, but a pixel of the picture is still one
    pixel."""
    with Viewer(TEAPOT, screen=(1900, 1000), dpi=192) as viewer:
        _, look = viewer.picture()
        assert abs(look["resolution"][0] - (1900 - 2 * viewer.panel)) <= 2, look["resolution"]
        # The slider of the diffuse part is twice as far from the panel's corner.
        left, y = 1900 - 2 * (1372 - SLIDER[0]), 2 * ROW["diffuse"]
        viewer.drag(left + 120, y, left + 240, y)
        changed, look = viewer.picture()
        assert list(look["material"]["Glazed ceramic"]) == ["diffuse"], look


if __name__ == "__main__":
    sys.exit(viewer_driver.run(globals()))
