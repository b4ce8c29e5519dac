"""The page of `glint stability --output`: what it shows for a run that passes and for one that
fails."""

import os
import pathlib
import subprocess
import tempfile

import browser as driver

GLINT = os.environ["GLINT_EXECUTABLE"]


def page(folder, *options):
    """The page of a small run; returns its path and the status."""
    run = subprocess.run([GLINT, "stability", "--rendering-backend", "osmesa", "--output", folder,
                          *options], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    assert run.returncode in (0, 1), run.stderr
    return pathlib.Path(folder) / "stability.html", run.returncode


def test_plots_and_cases(browser):
    with tempfile.TemporaryDirectory() as folder:
        path, status = page(folder, "--group", "H", "--case", "K3")
        assert status == 0
        browser.open(path)
        assert browser.requests == [path.resolve().as_uri()], browser.requests
        assert browser.evaluate("document.querySelector('#verdict').textContent") == "passes"
        assert browser.evaluate("document.querySelectorAll('#plots svg').length") == 9
        # Every curve has points, and all of them lie within its plot.
        assert browser.evaluate(
            "[...document.querySelectorAll('#plots polyline')].every(p => p.points.length > 1 &&"
            "[...p.points].every(q => q.x >= 0 && q.x <= 620 && q.y >= 0 && q.y <= 330))")
        assert browser.evaluate("document.querySelectorAll('#plots polyline').length") > 20
        # Clicking a name hides its curve and shows it again.
        hidden = ("[...document.querySelectorAll('#plots svg g')]"
                  ".filter(g => g.style.display === 'none').length")
        browser.click(".legend button")
        assert browser.evaluate(hidden) == 1
        browser.click(".legend button")
        assert browser.evaluate(hidden) == 0
        browser.hover("#plots svg")
        browser.wait_for("document.querySelector('.readout').textContent.includes('pow')")
        # The cases: filters, and the checks of one.
        assert browser.evaluate("document.querySelectorAll('#cases details').length") == 11
        browser.click("#filter")
        browser.type("alpha")
        browser.wait_for("document.querySelectorAll('#cases details').length === 1")
        browser.click("#cases summary")
        browser.wait_for("document.querySelectorAll('#cases .checks tr').length > 2")


def test_a_run_that_fails(browser):
    with tempfile.TemporaryDirectory() as folder:
        path, status = page(folder, "--case", "D4", "--highlight", "pow")
        assert status == 1
        browser.open(path)
        assert browser.evaluate("document.querySelector('#verdict').textContent") == "fails"
        assert "D4" in browser.evaluate("document.querySelector('#failures').textContent")
        browser.click("#bad")
        assert browser.evaluate("document.querySelectorAll('#cases .fail').length") >= 1


driver.run_tests(globals())
