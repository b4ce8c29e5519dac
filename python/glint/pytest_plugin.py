"""The fixture `image_baseline`, which compares pictures with baselines like glint_add_image_test().

    def test_teapot(image_baseline):
        image_baseline(glint.render("teapot.glb"), flip=0.01)

compares with baselines/test_teapot.png next to the test's file. ``pytest --glint-update-baselines``
makes and replaces baselines, ``--glint-report FILE`` writes a page of all tests. Pictures, baselines
and differences are left in the folder ``--glint-output`` (by default image-tests).
"""

from __future__ import annotations

import os
import pathlib
import re
import shutil
import subprocess
from typing import Any, Protocol

import numpy
import pytest

from . import Picture, _comparable, _glint
from ._arguments import as_limits

_SCRIPT = pathlib.Path(__file__).with_name("image_test.sh")


class ImageBaseline(Protocol):
    """The type of the fixture."""

    def __call__(self, picture: Any, name: str | None = None, *, ending: str = ".png",
                 max_pixels: str | int | None = None, options: list[str] | None = None,
                 **limits: float) -> None:
        """Fails the test unless the picture matches its baseline.

        picture: as for :func:`glint.compare`. name: of the baseline, without ending; by default the
        test's name. ending: ".exr" and ".pfm" keep linear light. limits: by metric, see
        :func:`glint.compare`; without any, the pictures must be equal. max_pixels: how many may
        exceed the tolerance, "0.1%" or a number. options: further options of `glint diff`.
        """


def pytest_addoption(parser: pytest.Parser) -> None:
    """Adds the options of the fixture."""
    group = parser.getgroup("glint", "pictures against baselines")
    group.addoption("--glint-update-baselines", action="store_true",
                    help="make baselines that are missing, and replace those that differ")
    group.addoption("--glint-report", metavar="FILE", help="write a page of all pictures")
    group.addoption("--glint-output", metavar="FOLDER", default="image-tests",
                    help="where pictures and differences are left [default: image-tests]")
    group.addoption("--glint-program", metavar="FILE", default="glint",
                    help="the program that compares [default: glint]")


def _folder(config: pytest.Config) -> pathlib.Path:
    return pathlib.Path(config.invocation_params.dir, config.getoption("--glint-output")).resolve()


def pytest_sessionstart(session: pytest.Session) -> None:
    """Deletes the list of tests of the previous run."""
    shutil.rmtree(_folder(session.config) / "tests", ignore_errors=True)


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Writes the report."""
    config = session.config
    folder = _folder(config)
    report = config.getoption("--glint-report")
    if report and (folder / "tests").is_dir():
        subprocess.run([config.getoption("--glint-program"), "diff", "--run", str(folder), "--html",
                        report], stdout=subprocess.DEVNULL, check=False)


def _file_of(name: str) -> str:
    """Maps the name of a test to a file name, one to one."""
    text = "".join(chr(b) if re.match(rb"[A-Za-z0-9_-]", bytes([b])) or (b == 46 and i) else
                   "%%%02X" % b for i, b in enumerate(name.encode()))
    return text


@pytest.fixture
def image_baseline(request: pytest.FixtureRequest) -> ImageBaseline:
    """Compares a picture with its baseline; see this module."""
    config = request.config
    path = pathlib.Path(str(request.node.path))
    own = re.sub(r"[^\w.-]+", "_", request.node.name).strip("_")

    def check(picture: Any, name: str | None = None, *, ending: str = ".png",
              max_pixels: str | int | None = None, options: list[str] | None = None,
              **limits: float) -> None:
        called = name or own
        file = _file_of(path.stem + "." + called)
        baseline = path.parent / "baselines" / (called + ending)
        folder = _folder(config)
        words = []
        for metric, limit in as_limits(limits).items():
            words += ["--metric", metric, "--threshold", repr(limit)]
        if max_pixels is not None:
            words += ["--max-pixels", str(max_pixels)]
        words += options or []
        (folder / "tests").mkdir(parents=True, exist_ok=True)
        (folder / "tests" / (file + ".txt")).write_text(
            "\n".join([path.stem + "." + called, str(baseline), ending] + words) + "\n")
        made = folder / ("made." + file + ending)
        array = _comparable(picture)
        exposure = picture.exposure if isinstance(picture, Picture) else 0.0
        if array.dtype == numpy.uint8:
            _glint.write_codes(os.fsencode(made), array)
        else:
            linear = array.astype(numpy.float32).view(Picture)
            linear.exposure = exposure
            linear.save(made)
        environment = dict(os.environ)
        if config.getoption("--glint-update-baselines"):
            environment["GLINT_UPDATE_BASELINES"] = "1"
            baseline.parent.mkdir(parents=True, exist_ok=True)
        ran = subprocess.run(
            ["sh", str(_SCRIPT), config.getoption("--glint-program"), str(baseline), str(folder), file,
             ending, path.stem + "." + called, "3", "mv", str(made),
             str(folder / "actual" / (file + ending))] + words,
            env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if ran.returncode != 0:
            said = re.sub(r"GLINT_UPDATE_BASELINES=1 ctest.*", "pytest --glint-update-baselines",
                          ran.stdout)
            pytest.fail(said.strip(), pytrace=False)

    return check
