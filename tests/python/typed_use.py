"""Uses the package with type annotations; checked by mypy --strict."""

import pathlib

import numpy

import glint
from glint.pytest_plugin import ImageBaseline


def draw(path: pathlib.Path) -> float:
    session = glint.Session("reference")
    model = glint.Model([glint.Mesh(numpy.zeros((3, 3)), material={"exponent": 4})])
    picture: glint.Picture = session.render(model, layers=["depth"], resolution=(4, 4))
    picture.save(path)
    found: glint.Differences = glint.compare(path, picture, flip=0.1)
    depth: float = float(picture.layers["depth"].max())
    return depth + found.values["flip"] + glint.render(path).exposure


def test_picture(image_baseline: ImageBaseline) -> None:
    image_baseline(glint.render("a.glb"), flip=0.01, max_pixels="1%")
