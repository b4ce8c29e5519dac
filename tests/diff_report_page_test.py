"""The report of `glint diff` for folders with planted differences, driven in Chromium."""

import json
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import time
import zlib

from browser import run_tests

GLINT = os.environ["GLINT_EXECUTABLE"]
scratch = pathlib.Path(tempfile.mkdtemp(prefix="glint-report-"))


def chunk(kind, data):
    return (struct.pack(">I", len(data)) + kind + data +
            struct.pack(">I", zlib.crc32(kind + data)))


def write_png(path, width, height, colour, text=None):
    """An RGB picture of colour(x, y), with text chunks."""
    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in colour(x, y))
                    for y in range(height))
    texts = b"".join(chunk(b"tEXt", k.encode() + b"\0" + v.encode())
                     for k, v in (text or {}).items())
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" +
                     chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) + texts +
                     chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def gradient(x, y):
    return (4 * x, 5 * y, 90)


def report(name, status, *options):
    page = scratch / (name + ".html")
    ran = subprocess.run([GLINT, "diff", scratch / name / "a", scratch / name / "b", "--html", page,
                          *options], capture_output=True, text=True)
    assert ran.returncode == status, (ran.returncode, ran.stdout, ran.stderr)
    return page


def planted():
    """Ten pairs: six equal, one with a small and one with a large difference, one without a
    baseline, one missing."""
    page = scratch / "planted.html"
    if page.exists():
        return page
    a, b = scratch / "planted/a", scratch / "planted/b"
    for n in range(6):
        for folder in (a, b):
            write_png(folder / ("same-%d.png" % n), 60, 40, gradient)
    write_png(a / "large.png", 60, 40, gradient, {"GL_RENDERER": "softpipe", "glint-look": "phong"})
    write_png(b / "large.png", 60, 40,
              lambda x, y: (255, 20, 30) if 30 <= x < 40 and 10 <= y < 30 else gradient(x, y),
              {"GL_RENDERER": "llvmpipe <15>", "glint-look": "phong"})
    write_png(a / "small.png", 60, 40, gradient)
    write_png(b / "small.png", 60, 40,
              lambda x, y: (4 * x + 3, 5 * y, 90) if (x, y) == (7, 9) else gradient(x, y))
    write_png(b / "extra.png", 60, 40, gradient)
    write_png(a / "gone.png", 60, 40, gradient)
    return report("planted", 2)


def opened(browser, page):
    browser.open(page)
    browser.wait_for("document.querySelector('#view canvas')")
    assert [u for u in browser.requests if not u.startswith(("file:", "blob:", "data:"))] == []


def names(browser):
    return browser.evaluate("[...document.querySelectorAll('#rows tr')].map(r => "
                            "r.cells[0].textContent)")


def title(browser):
    return browser.evaluate("document.querySelector('#detail h2').textContent")


def show(browser, name):
    browser.evaluate("[...document.querySelectorAll('#rows tr')].find(r => r.cells[0].textContent "
                     "=== %s).click()" % json.dumps(name))
    browser.wait_for("document.querySelector('#detail h2').textContent.startsWith(%s)" %
                     json.dumps(name + ":"))


def test_list(browser):
    opened(browser, planted())
    summary = browser.evaluate("summary.textContent")
    assert summary == ("10 pairs: 2 differs, 1 missing, 1 no baseline, 6 same; 10 shown"), summary
    # The worst come first, and the first one is shown.
    assert names(browser)[:4] == ["large.png", "small.png", "gone.png", "extra.png"]
    assert title(browser) == "large.png: differs"
    # Sorts by a click, and in reverse by another.
    browser.click("#head th:nth-child(1)")
    assert names(browser) == sorted(names(browser))
    browser.click("#head th:nth-child(1)")
    assert names(browser) == sorted(names(browser), reverse=True)
    browser.click("#head th:nth-child(3)")
    assert names(browser)[:2] == ["large.png", "small.png"]
    # Filters by name, from the keyboard, and by status.
    browser.key("/")
    browser.type("ME-4")
    assert names(browser) == ["same-4.png"]
    for _ in range(4):
        browser.key("Backspace")
    browser.key("Escape")
    assert len(names(browser)) == 10
    browser.evaluate("only.value = 'not the same'; only.onchange()")
    assert len(names(browser)) == 4
    # Keys move through the listed pairs.
    show(browser, "large.png")
    browser.key("j")
    browser.wait_for("document.querySelector('#detail h2').textContent === 'small.png: differs'")
    browser.key("ArrowUp")
    browser.wait_for("document.querySelector('#detail h2').textContent === 'large.png: differs'")


def test_slider(browser):
    opened(browser, planted())
    split = "parseFloat(divider.style.left) / parseFloat(stage.a.style.width)"
    assert abs(browser.evaluate(split) - 0.5) < 1e-6
    width = browser.evaluate("parseFloat(stage.a.style.width)")
    browser.drag("#divider", -width / 4, 0)
    assert abs(browser.evaluate(split) - 0.25) < 0.01, browser.evaluate(split)
    # B is clipped left of the slider, as its clip path shows.
    assert browser.evaluate("stage.b.style.clipPath").startswith("inset(0px 0px 0px 25"), \
        browser.evaluate("stage.b.style.clipPath")
    browser.key("ArrowRight")
    assert abs(browser.evaluate(split) - 0.27) < 0.01


def test_views(browser):
    opened(browser, planted())
    count = "document.querySelectorAll('#stage canvas').length"
    for key, mode, canvases in (("2", "blink", 2), ("3", "side by side", 3), ("4", "difference", 1),
                                ("5", "A", 1), ("6", "B", 1), ("1", "slider", 2)):
        browser.key(key)
        pressed = browser.evaluate("document.querySelector('[aria-pressed=true]').textContent")
        assert (pressed, browser.evaluate(count)) == (mode, canvases), (pressed, canvases)
    browser.click("[data-mode=blink]")
    seen = "stage.b.style.visibility"
    first = browser.evaluate(seen)
    browser.wait_for("%s !== %s" % (seen, json.dumps(first)), 5)
    browser.key(" ")
    assert browser.evaluate("document.querySelector('#stage canvas') === stage.a")
    browser.key(" ")
    assert browser.evaluate("document.querySelector('#stage canvas') === stage.b")
    # The map is dark where nothing differs and bright in the planted square.
    browser.key("4")
    dark, bright = browser.evaluate("[codes(stage.map, 2, 2, 1, 1), codes(stage.map, 35, 20, 1, 1)]")
    assert sum(dark[:3]) < 30 and sum(bright[:3]) > 300, (dark, bright)


def test_pixels(browser):
    opened(browser, planted())
    browser.key("0")
    browser.hover("#stage", 35.5, 20.5)
    text = browser.evaluate("pixel.textContent")
    assert text.startswith("35, 20   A 140 100 90 255   B 255 20 30 255"), text
    browser.key("+")
    browser.key("+")
    browser.hover("#stage", 4 * 35.5, 4 * 20.5)
    assert browser.evaluate("pixel.textContent") == text
    # Zooming with the wheel keeps the pixel under the mouse in place.
    browser.wheel("#stage", -100, 4 * 35.5, 4 * 20.5, ctrl=True)
    browser.wait_for("zoom === 5")
    browser.key("f")
    assert browser.evaluate("fitted")
    # The worst pixel, enlarged, with its values in it.
    browser.click("#worst tr")
    assert browser.evaluate("zoom") >= 40 and browser.evaluate("values.width") > 0
    drawn = browser.evaluate("codes(values, 0, 0, values.width, values.height)"
                             ".filter((v, i) => i % 4 === 3 && v > 0).length")
    assert drawn > 1000, drawn


def test_texts(browser):
    opened(browser, planted())
    rows = browser.evaluate("[...making.rows].map(r => [r.className, ...[...r.cells].map(c => "
                            "c.textContent)])")
    assert ["other", "GL_RENDERER", "softpipe", "llvmpipe <15>"] in rows, rows
    assert ["", "glint-look", "phong", "phong"] in rows, rows
    assert "compared across drivers: softpipe and llvmpipe <15>" in \
        browser.evaluate("detail.textContent")
    metrics = browser.evaluate("Object.fromEntries([...metrics.rows].map(r => [r.cells[0]."
                               "textContent, r.cells[1].textContent]))")
    assert float(metrics["flip"]) > 0.05 and metrics["pixels"] == "200", metrics
    show(browser, "gone.png")
    assert browser.evaluate("document.querySelectorAll('#stage canvas').length") == 1
    show(browser, "same-1.png")
    assert browser.evaluate("document.querySelectorAll('#stage canvas').length") == 2
    browser.screenshot(scratch / "planted.png")


def test_regions(browser):
    page = planted()
    browser.open(page.as_uri() + "?once#small.png")
    browser.wait_for("document.querySelector('#view canvas')")
    # The address names the pair and follows the selection.
    assert title(browser) == "small.png: differs"
    show(browser, "large.png")
    assert browser.evaluate("location.hash") == "#large.png"
    assert browser.evaluate("regions.caption.textContent") == "regions that differ: 1"
    browser.key("n")
    box = browser.evaluate("(e => [e.style.left, e.style.width].map(parseFloat).map(v => v / zoom))"
                           "(document.querySelector('.region.on'))")
    assert [round(v) for v in box] == [30, 10], box
    browser.key("b")
    assert browser.evaluate("document.querySelector('.region')") is None
    browser.key("b")
    # The command that accepts the picture, and its error as a number.
    commands = browser.evaluate("[...document.querySelectorAll('code')].map(c => c.textContent)")
    assert commands[-1].endswith("planted/b --update large.png"), commands
    browser.key("4")
    browser.hover("#stage", *browser.evaluate("[35.5 * zoom, 20.5 * zoom]"))
    assert 0.3 < float(browser.evaluate("pixel.textContent").split("FLIP ")[1].split()[0]) <= 1
    assert browser.evaluate("document.querySelector('#scale i').style.display") == "block"
    labels = "[...document.querySelectorAll('.label')].map(l => l.textContent)"
    browser.key("1")
    assert browser.evaluate(labels) == ["A, baseline", "B"]
    browser.key("f")
    browser.key("3")
    assert browser.evaluate(labels) == ["A, baseline", "B", "difference (FLIP)"]
    browser.key("1")


def write_pfm(path, value):
    """8 x 6 pixels of `value`, except for 20 in the upper left corner."""
    path.parent.mkdir(parents=True, exist_ok=True)
    rows = [[value] * 24 for _ in range(6)]
    rows[5][:3] = [20.0] * 3
    path.write_bytes(b"PF\n8 6\n-1.0\n" + b"".join(struct.pack("<24f", *row) for row in rows))


def test_floats(browser):
    write_pfm(scratch / "floats/a/one.pfm", 0.25)
    write_pfm(scratch / "floats/b/one.pfm", 2.5)
    opened(browser, report("floats", 1))
    browser.key("0")
    browser.hover("#stage", 1.5, 1.5)
    assert browser.evaluate("pixel.textContent").startswith(
        "1, 1   A 0.25 0.25 0.25   B 2.5 2.5 2.5"), browser.evaluate("pixel.textContent")
    # Two stops down: 2.5 / 4 and 0.25 / 4 in linear light.
    code = lambda v: round(255 * (1.055 * v ** (1 / 2.4) - 0.055))
    assert browser.evaluate("codes(stage.b, 1, 1, 1, 1)[0]") == 255
    browser.evaluate("(e => { e.value = -2; e.oninput(); })(document.querySelector('#exposure'))")
    seen = browser.evaluate("[codes(stage.a, 1, 1, 1, 1)[0], codes(stage.b, 1, 1, 1, 1)[0]]")
    assert seen == [code(0.25 / 4), code(2.5 / 4)], seen
    browser.evaluate("[...document.querySelectorAll('#develop button')][0].click()")
    seen = browser.evaluate("[low, high, codes(stage.a, 1, 1, 1, 1)[0], "
                            "codes(stage.b, 0, 0, 1, 1)[0]]")
    assert seen == [0.25, 20, 0, 255], seen


def test_beside_and_unreadable(browser):
    a, b = scratch / "beside/a", scratch / "beside/b"
    write_png(a / "<one> & 'two'.png", 60, 40, gradient)
    write_png(b / "<one> & 'two'.png", 60, 40, lambda x, y: (9, 9, 9))
    write_png(a / "cut.png", 60, 40, gradient)
    (b / "cut.png").write_bytes((a / "cut.png").read_bytes()[:60])
    opened(browser, report("beside", 2, "--pictures-beside"))
    assert title(browser) == "<one> & 'two'.png: differs"
    assert browser.evaluate("[stage.a.width, codes(stage.b, 3, 3, 1, 1)[0]]") == [60, 9]
    # If one picture cannot be read, the other is shown.
    show(browser, "cut.png")
    assert title(browser) == "cut.png: error"
    assert browser.evaluate("[stage.a.width, stage.b]") == [60, None]
    assert "cut.png: the PNG is" in browser.evaluate("detail.textContent")


def test_thousand_pairs(browser):
    first = scratch / "thousand/a/0000.png"
    write_png(first, 24, 16, gradient)
    other = scratch / "thousand/b/0000.png"
    write_png(other, 24, 16, lambda x, y: (4 * x, 5 * y, 90 + 40 * (x > 12)))
    for n in range(1, 1000):
        os.link(first, first.with_name("%04d.png" % n))
        os.link(other if n % 10 == 0 else first, other.with_name("%04d.png" % n))
    # The worst pair is not the first.
    other.with_name("0730.png").unlink()
    write_png(other.with_name("0730.png"), 24, 16, lambda x, y: (255 - 4 * x, 0, 0))
    page = report("thousand", 1)
    begin = time.monotonic()
    opened(browser, page)
    print("1000 pairs open in %.1f s" % (time.monotonic() - begin))
    browser.wait_for("rows.children.length === 1000")
    assert sorted(names(browser)) == ["%04d.png" % n for n in range(1000)]
    # The pictures that are shown first are first in the file.
    text = page.read_text()
    assert text.index('id="a730"') < text.index('id="a0"') < text.index('id="a999"')
    assert text.count('id="a730"') == 1 and text.count('id="b730"') == 1
    # Only visible pictures are decoded.
    assert browser.evaluate("document.querySelectorAll('canvas').length") <= 4
    for n in range(5):
        browser.key("j")
    browser.wait_for("document.querySelector('#detail h2').textContent === '0040.png: differs'")
    browser.key("/")
    browser.type("77")
    assert len(names(browser)) == 19


try:
    run_tests(globals())
finally:
    if "GLINT_KEEP" not in os.environ:
        shutil.rmtree(scratch)
