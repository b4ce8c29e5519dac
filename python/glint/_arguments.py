"""Arguments as the C++ module takes them.

Every argument comes in through argument() with a function that converts it, so that what cannot be
used is refused in one line.
"""

from __future__ import annotations

import os
import reprlib
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

import numpy
import numpy.typing

from ._glint import InputError

FloatArray = numpy.typing.NDArray[numpy.float32]

_Value = TypeVar("_Value")


def _shown(value: Any) -> str:
    """A value in a few words of one line."""
    if isinstance(value, numpy.ndarray) and value.ndim:
        return "an array of %s of the shape %s" % (value.dtype, value.shape)
    try:
        return " ".join(reprlib.repr(value).split())
    except ValueError:  # an integer of thousands of digits
        return "a value of the type " + type(value).__name__


def argument(name: str, value: Any, convert: Callable[[Any], _Value], give: str) -> _Value:
    """The value converted; Python's errors of the conversion become one line.

    name: of the argument. give: what can be used, for the message.
    """
    try:
        return convert(value)
    except (ArithmeticError, AttributeError, TypeError, ValueError) as error:
        raise InputError("%s: %s cannot be used: give %s" % (name, _shown(value), give)) from error


def as_utf8(value: str) -> bytes:
    """A text for the C++ module. Bytes of a file name that are not UTF-8 stay as they are."""
    return value.encode("utf-8", "surrogateescape")


def as_file_name(value: Any) -> bytes:
    """The name of a file as the system takes it."""
    name = os.fsencode(value)
    if b"\0" in name:  # where the system would take the name to end
        raise ValueError
    return name


def as_path(value: str | os.PathLike[str], name: str = "path") -> bytes:
    """The name of a file; what is none is refused."""
    return argument(name, value, as_file_name, "the path of a file")


def as_flag(value: Any) -> bool:
    """True or false. A text, such as "false", is neither."""
    if not isinstance(value, (bool, int, numpy.bool_)):
        raise TypeError
    return bool(value)


def as_array(value: Any) -> numpy.typing.NDArray[Any]:
    """An array of anything but complex numbers, of which NumPy's conversions drop a part."""
    array = numpy.asarray(value)
    if array.dtype.kind == "c":
        raise TypeError
    return array


def as_bytes(value: Any) -> bytes:
    """The bytes of an object that has some; bytes() would also make zeros of a number."""
    return memoryview(value).tobytes()


def as_floats(value: Any) -> FloatArray:
    """Single precision, infinite beyond its range; None is an empty array."""
    with numpy.errstate(over="ignore"):
        return as_array([] if value is None else value).astype(numpy.float32)


def as_doubles(value: Any) -> numpy.typing.NDArray[numpy.float64]:
    """Double precision."""
    return as_array(value).astype(numpy.float64)


def as_text(value: Any) -> str:
    """A value as the text of an option."""
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return os.fsdecode(value)
    if isinstance(value, (bool, numpy.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, numpy.integer)):
        return str(int(value))
    if isinstance(value, (float, numpy.floating)):
        return repr(float(value))
    if isinstance(value, numpy.ndarray):
        return as_text(value.tolist())  # that of an array without dimensions is a number
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray, memoryview)):
        return ",".join(as_text(each) for each in value)
    raise TypeError


def as_option(name: str, value: Any) -> str:
    """The text of an option; what has none is refused."""
    return argument(name, value, as_text, "a text, a number, or several numbers")


def as_pairs(parameters: Mapping[str, Any]) -> str:
    """Parameters of a material by name, as one text."""
    return ",".join("%s=%s" % (key, as_option(key, value)) for key, value in parameters.items())


def as_texts(value: Any) -> list[str]:
    """One text or several."""
    return [as_text(each) for each in ([value] if isinstance(value, str) else value)]


def as_names(value: Any) -> list[bytes]:
    """One name or several."""
    return [as_utf8(each) for each in as_texts(value)]


def as_materials(value: Any) -> list[str]:
    """The texts of the option for parameters by name, of all materials or of those named."""
    if not isinstance(value, Mapping):
        return as_texts(value)
    own = {key: each for key, each in value.items() if not isinstance(each, Mapping)}
    texts = [as_pairs(own)] if own else []
    return texts + ["%s:%s" % (name, as_pairs(each)) for name, each in value.items()
                    if isinstance(each, Mapping)]


def as_camera(value: Any) -> list[tuple[str, str]]:
    """Options for a camera: its index in the file, parameters by name, or a pose (4, 4) from camera
    to world, where the camera looks along its -Z, with +Y up."""
    if isinstance(value, Mapping):
        return [("camera-" + key.replace("_", "-"), as_option("camera " + key, each))
                for key, each in value.items()]
    if isinstance(value, int) or numpy.ndim(value) == 0 and as_array(value).dtype.kind in "iu":
        return [("camera-index", as_text(value))]
    pose = as_doubles(value)
    if pose.shape != (4, 4):
        raise TypeError
    position = pose[:3, 3]
    return [("camera-position", as_text(position)),
            ("camera-focal-point", as_text(position - pose[:3, 2])),
            ("camera-view-up", as_text(pose[:3, 1]))]


def as_intrinsics(value: numpy.typing.ArrayLike) -> str:
    """The option for fx, fy, cx, cy, with the first pixel's centre at (0.5, 0.5); or for an OpenCV
    matrix (3, 3), with that centre at (0, 0)."""
    given = as_doubles(value)
    if given.shape == (3, 3):
        if given[0, 1] != 0:
            raise InputError("intrinsics: a skew of %s cannot be drawn: give 0" % given[0, 1])
        return as_text([given[0, 0], given[1, 1], given[0, 2] + 0.5, given[1, 2] + 0.5])
    if given.shape != (4,):
        raise TypeError
    return as_text(given)


def as_options(look: Mapping[str, Any]) -> list[tuple[bytes, bytes]]:
    """The options of the command line for these keywords."""
    options: list[tuple[str, str]] = []
    for keyword, value in look.items():
        name = keyword.replace("_", "-")
        if value is None:
            continue
        if name == "camera":
            options += argument(name, value, as_camera, "the number of one in the file, "
                                "parameters by name, or a matrix of the shape (4, 4)")
        elif name == "intrinsics":
            options.append(("camera-intrinsics", argument(
                name, value, as_intrinsics, "fx, fy, cx, cy or a matrix of the shape (3, 3)")))
        elif name == "material":
            options += [(name, each) for each in argument(
                name, value, as_materials, "parameters by name, or one or several texts")]
        elif name == "light":
            options += [(name, each)
                        for each in argument(name, value, as_texts, "one or several texts")]
        else:
            options.append((name, as_option(keyword, value)))
    return [(argument("a keyword", name, as_utf8, "valid Unicode"),
             argument(name, text, as_utf8, "valid Unicode")) for name, text in options]


def as_limit(value: Any) -> float:
    """A number; NaN is none, as nothing is above or below it."""
    number = float(value)
    if number != number:
        raise ValueError
    return number


def as_limits(limits: Mapping[str, Any]) -> dict[str, float]:
    """The limits by the names that metrics have in options."""
    named = {}
    for keyword, value in limits.items():
        limit = argument(keyword, value, as_limit, "a number")
        # Decibels and SSIM go below 0; a difference does not, so that nothing would be the same.
        if limit < 0 and keyword not in ("psnr", "ssim"):
            raise InputError("%s: the limit %s is below 0: give a number from 0" % (keyword, limit))
        named[keyword.replace("_", "-")] = limit
    return named
