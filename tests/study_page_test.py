"""The page of `glint study --output`, driven as by a user: the plot, its points, the pictures
behind them, the table and the series."""

import csv
import json
import os
import pathlib
import subprocess
import tempfile
import xml.dom.minidom

from browser import run_tests

_folder = tempfile.TemporaryDirectory(prefix="glint-study-")
_out = pathlib.Path(_folder.name)
subprocess.run([os.environ["GLINT_EXECUTABLE"], "study", "--quick", "--resolution", "64,64",
                "--repetitions", "5", "--spread-limit", "1e6", "--output", str(_out), "--markdown", str(_out / "results.md")],
               check=True, stdout=subprocess.DEVNULL)
_data = json.loads((_out / "study.json").read_text())
_page = str(_out / "study.html")


def _names(model):
    return [v["name"] for v in _data["variants"] if any(e["against"] == model for e in v["errors"])]


def _event(name, kind):
    return f"document.querySelector('[data-name=\"{name}\"]').dispatchEvent(new MouseEvent('{kind}'))"


def test_shows_every_variant_of_a_model(browser):
    browser.open(_page)
    names = browser.evaluate("[...document.querySelectorAll('#front-plot .point')].map(p => p.dataset.name)")
    assert sorted(names) == sorted(_names("phong")), names
    assert browser.evaluate("document.querySelectorAll('#table tbody tr').length") == len(names)
    assert _data["gl"]["renderer"] in browser.evaluate("document.body.textContent")
    assert not browser.errors, browser.errors
    assert all(url.startswith(("file:", "data:")) for url in browser.requests), "needs other files"


def test_other_models_and_metrics_have_fronts_of_their_own(browser):
    browser.open(_page)
    browser.evaluate("$('model').selectedIndex = 2; $('model').onchange()")
    browser.evaluate("$('metric').value = 'max'; $('metric').onchange()")
    names = browser.evaluate("[...document.querySelectorAll('#front-plot .point')].map(p => p.dataset.name)")
    assert sorted(names) == sorted(_names("environment")), names
    on_front = browser.evaluate("[...document.querySelectorAll('#front-plot .name')].map(t => t.textContent)")
    front, = [f for f in _data["fronts"] if f["model"] == "environment" and f["metric"] == "max"]
    assert sorted(on_front) == sorted(front["variants"])


def test_names_a_point_under_the_pointer(browser):
    browser.open(_page)
    # Points overlap, so the event is sent to the one that is meant.
    browser.evaluate(_event("gouraud exact", "mousemove"))
    tip = browser.evaluate("$('tip').textContent")
    assert tip.startswith("gouraud exact\n") and " ms (" in tip and "RMSE" in tip, tip
    assert browser.evaluate("getComputedStyle($('tip')).display") == "block"


def test_click_shows_picture_reference_and_error(browser):
    browser.open(_page)
    browser.evaluate(_event("flat exact", "click"))
    assert browser.evaluate("document.querySelector('#detail h2').textContent") == "flat exact"
    browser.wait_for("[...document.querySelectorAll('#pictures img')].every(i => i.complete)")
    sizes = browser.evaluate("[...document.querySelectorAll('#pictures img')].map(i => i.naturalWidth)")
    assert sizes == [64, 64, 64], sizes
    # The error of flat shading is visible: the middle of its map is lighter than rounding's black.
    light = """(() => { const c = document.createElement('canvas'), i = document.querySelectorAll('#pictures img')[2];
      c.width = c.height = 64; const x = c.getContext('2d'); x.drawImage(i, 0, 0);
      const p = x.getImageData(24, 24, 16, 16).data; let sum = 0; for (let k = 0; k < p.length; k += 4) sum += p[k]; return sum / 256; })()"""
    assert browser.evaluate(light) > 100
    browser.click("[data-name='phong exact']")  # on the front, hence on top
    browser.wait_for("[...document.querySelectorAll('#pictures img')].every(i => i.complete)")
    assert browser.evaluate(light) < 60


def test_table_sorts_by_a_column(browser):
    browser.open(_page)
    column = "[...$('table').tHead.rows[0].cells].findIndex(c => c.textContent.startsWith('largest'))"
    browser.evaluate(f"$('table').tHead.rows[0].cells[{column}].click()")
    names = browser.evaluate("[...$('table').tBodies[0].rows].map(r => r.cells[0].textContent)")
    errors = {v["name"]: v["errors"] for v in _data["variants"]}
    largest = [next(e["max"] for e in errors[n] if e["against"] == "phong") for n in names]
    assert largest == sorted(largest), largest
    browser.evaluate(f"$('table').tHead.rows[0].cells[{column}].click()")
    assert browser.evaluate("$('table').tBodies[0].rows[0].cells[0].textContent") == names[-1]


def test_draws_the_series(browser):
    browser.open(_page)
    names = browser.evaluate("[...document.querySelectorAll('.series')].map(s => s.dataset.name)")
    assert names == ["exponent", "aliasing", "distance", "motion", "bumps", "bumps-motion", "ior", "incidence",
                     "fineness", "lights", "resolution"], names
    plots = browser.evaluate("[...document.querySelectorAll('.series')].map(s => s.querySelectorAll('svg').length)")
    assert plots == [3, 2, 3, 2, 3, 2, 3, 3, 3, 3, 2], plots
    assert not browser.evaluate("document.body.innerHTML.includes('NaN')")
    assert browser.evaluate("document.querySelectorAll('#specialisation tr').length") == 5
    # For two models, the exact lobe and two cheap ones with and without the filter; for three, the
    # exact one with more samples.
    assert browser.evaluate("document.querySelectorAll('#ways tr').length") == 1 + 2 * 9 + 5


def test_says_what_an_interrupted_study_lacks(browser):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([os.environ["GLINT_EXECUTABLE"], "study", "--quick", "--resolution", "64,64",
                        "--time-budget", "1.5", "--output", folder], check=True,
                       stdout=subprocess.DEVNULL)
        browser.open(folder + "/study.html")
        browser.wait_for("$('incomplete').textContent.startsWith('Incomplete: ended before')")
        assert not browser.errors, browser.errors


def test_makes_no_front_of_what_it_cannot_tell(browser):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([os.environ["GLINT_EXECUTABLE"], "study", "--quick", "--resolution", "64,64",
                        "--repetitions", "3", "--shading", "phong", "--spread-limit", "0", "--output", folder],
                       check=True, stdout=subprocess.DEVNULL)
        browser.open(folder + "/study.html")
        assert browser.evaluate("$('nofront').textContent").startswith("There is no front: in wall time")
        assert browser.evaluate("document.querySelectorAll('#front-plot .name').length") == 0
        assert "on the front" not in browser.evaluate("document.body.innerText")
        assert not browser.errors, browser.errors
    browser.open(_page)
    assert browser.evaluate("$('nofront').textContent") == ""


def test_tells_the_time_by_every_clock(browser):
    browser.open(_page)
    heads = browser.evaluate("[...$('table').tHead.rows[0].cells].map(c => c.textContent)")
    assert any(h.startswith("wall ms") for h in heads) and any(h.startswith("CPU ms") for h in heads), heads
    browser.evaluate(_event("phong exact", "click"))
    assert "CPU, all threads" in browser.evaluate("$('detail').textContent")


def test_marks_what_a_budget_chooses(browser):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([os.environ["GLINT_EXECUTABLE"], "study", "--quick", "--resolution", "64,64",
                        "--repetitions", "3", "--shading", "phong", "--highlight", "exact", "--max-error",
                        "0.01", "--spread-limit", "1e6", "--output", folder], check=True, stdout=subprocess.DEVNULL)
        browser.open(folder + "/study.html")
        assert browser.evaluate("document.querySelectorAll('.budget').length") == 1
        assert browser.evaluate("$('budget').hidden") is False
        name = browser.evaluate("report.variants.find(isChosen).name")
        assert name.startswith("max-error 0.01: phong "), name
        browser.evaluate(_event(name, "mousemove"))
        assert "proven bound" in browser.evaluate("$('tip').textContent")
        browser.evaluate(_event(name, "click"))
        assert "its proven bound" in browser.evaluate("document.querySelector('#detail h2').textContent")
        assert not browser.errors, browser.errors
        assert "<path" in pathlib.Path(folder, "study.svg").read_text()
    browser.open(_page)
    assert browser.evaluate("document.querySelectorAll('.budget').length") == 0
    assert browser.evaluate("$('budget').hidden") is True


def test_every_form_joins(browser):
    names = {v["name"] for v in _data["variants"]}
    for name in ("flat exact", "gouraud pow", "phong exact", "phong pow", "phong lyon:4",
                 "phong gaussian", "blinn-phong pade:16", "environment schlick",
                 "environment rational"):
        assert name in names, f"{name} is not in {sorted(names)}"
    assert _data["complete"], _data["missing"]


def test_answers_its_questions(browser):
    markdown = (_out / "results.md").read_text()
    for words in ("beat `pow`", "how far off is 4", "Gouraud enough", "Schlick ever",
                  "only what the scene needs", "What does aliasing add"):
        assert words in markdown, words
    assert "nan" not in markdown and "-inf" not in markdown


def test_plot_and_table_files_are_whole(browser):
    svg = xml.dom.minidom.parse(str(_out / "study.svg"))
    assert len(svg.getElementsByTagName("title")) == len(_names("phong"))
    rows = list(csv.DictReader((_out / "study.csv").open()))
    assert len(rows) == sum(len(v["errors"]) for v in _data["variants"])
    assert all(float(r["rmse"]) >= 0 and r["rmse_front"] in ("yes", "no", "open") for r in rows)


if __name__ == "__main__":
    run_tests(globals())
