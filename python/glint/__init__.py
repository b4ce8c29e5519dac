"""Draws glTF models with the classic shading models, and compares pictures.

    import glint
    picture = glint.render("teapot.glb", shading="gouraud", resolution=(640, 480))
    picture.save("teapot.png")
    assert glint.compare("baseline.png", picture, flip=0.02)

It needs neither a GPU nor a display. Errors derive from :class:`Error`: one line that says what is
wrong, where, and what to do. :class:`InputError` is raised for unusable arguments and files,
:class:`ContextError` if there is no OpenGL.

Threads: every function may be called from any thread. Only one call at a time uses OpenGL; other
calls wait, and other Python threads keep running. ``fork``: a process that has drawn with OpenGL
cannot draw in its children (:class:`ContextError`); use multiprocessing's "spawn", or the backend
"reference".
"""

from __future__ import annotations

import io
import os
import threading
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol, Union

import numpy
import numpy.typing

from . import _glint
from ._glint import ContextError, Error, InputError, __version__

__all__ = [
    "ContextError",
    "Differences",
    "Error",
    "InputError",
    "Mesh",
    "Model",
    "Picture",
    "Session",
    "__version__",
    "compare",
    "read",
    "render",
]

FloatArray = numpy.typing.NDArray[numpy.float32]


class _Exportable(Protocol):
    """Objects that export themselves as glTF, such as meshes and scenes of trimesh."""

    def export(self, *, file_type: str) -> Any:
        """The bytes of a file of the given type."""


@dataclass
class Mesh:
    """Triangles given as arrays, in one material.

    positions: (n, 3). indices: three for each triangle, counter-clockwise seen from its front, in an
    array of any shape; by default the positions in their order. normals: (n, 3); without them,
    faces are flat. colors: (n, 4), linear RGB and alpha in [0, 1], multiplied by the material's
    colour. texcoords: (n, 2), with (0, 0) at the picture's upper left corner. texture: the bytes of
    a PNG, JPEG or WebP. material: parameters by name, such as {"color": "#c04020", "exponent": 50}.
    name: of the material. two_sided: back faces are drawn too. place: (4, 4), the matrix from these
    positions to world space.
    """

    positions: numpy.typing.ArrayLike
    indices: numpy.typing.ArrayLike | None = None
    normals: numpy.typing.ArrayLike | None = None
    colors: numpy.typing.ArrayLike | None = None
    texcoords: numpy.typing.ArrayLike | None = None
    texture: bytes = b""
    material: Mapping[str, Any] = field(default_factory=dict)
    name: str = ""
    two_sided: bool = False
    place: numpy.typing.ArrayLike | None = None

    def _arrays(self) -> _glint.Arrays:
        def floats(values: numpy.typing.ArrayLike | None) -> FloatArray:
            return numpy.asarray([] if values is None else values, numpy.float32)

        indices = numpy.asarray([] if self.indices is None else self.indices).ravel()
        if indices.size and (indices.dtype.kind not in "iu" or int(indices.min()) < 0
                             or int(indices.max()) > 0xFFFFFFFF):
            raise InputError("indices: give whole numbers from 0 to 4294967295")
        place = numpy.eye(4) if self.place is None else numpy.asarray(self.place, float)
        return _glint.Arrays(
            floats(self.positions), indices.astype(numpy.uint32), floats(self.normals),
            floats(self.colors), floats(self.texcoords), bytes(self.texture), self.name,
            _pairs(self.material), self.two_sided, place)


ModelLike = Union[str, "os.PathLike[str]", bytes, Mesh, "Model", _Exportable, Iterable[Mesh]]


class Model:
    """A model to draw, which can be kept for several pictures.

    source: the path of a .gltf or .glb file, the bytes of such a file, a :class:`Mesh` or several
    of them, or an object that exports itself as glTF (meshes and scenes of trimesh).
    """

    def __init__(self, source: ModelLike) -> None:
        if isinstance(source, Model):
            self._model: _glint.Model = source._model
        elif isinstance(source, (bytes, bytearray, memoryview)):
            self._model = _glint.Model.from_memory(bytes(source))
        elif isinstance(source, (str, os.PathLike)):
            self._model = _glint.Model.load(os.fspath(source))
        elif isinstance(source, Mesh):
            self._model = _glint.Model.from_arrays([source._arrays()])
        elif hasattr(source, "export"):
            self._model = _glint.Model.from_memory(bytes(source.export(file_type="glb")))
        else:
            self._model = _glint.Model.from_arrays([each._arrays() for each in source])

    @property
    def warnings(self) -> list[str]:
        """What was repaired or left out so far, one line each."""
        return self._model.warnings()

    @property
    def bounds(self) -> tuple[tuple[float, float, float], float]:
        """Centre and radius of the bounding sphere, in world space."""
        x, y, z, radius = self._model.bounds()
        return (x, y, z), radius


class Picture(numpy.ndarray):  # type: ignore[type-arg]
    """A picture: float32 (height, width, 4), linear light, colours premultiplied by alpha.

    It is an ordinary NumPy array, and notebooks show it as a picture.
    """

    #: Exposure in EV: codes() multiplies by 2 to this power.
    exposure: float
    #: Parts of the picture by name, if render() was asked for them: "depth" (height, width),
    #: "normal" and "id" (height, width, 3), terms of light (height, width, 4).
    layers: dict[str, numpy.typing.NDArray[Any]]

    def __array_finalize__(self, other: Any) -> None:
        self.exposure = getattr(other, "exposure", 0.0)
        self.layers = getattr(other, "layers", {})

    def codes(self) -> numpy.typing.NDArray[numpy.uint8]:
        """The picture as stored in a PNG: uint8 (height, width, 4), sRGB, straight alpha."""
        return _glint.encode(numpy.asarray(self), 2.0**self.exposure)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the picture: .png, .jpg, .webp (sRGB, exposed), .exr, .pfm (linear)."""
        name = os.fspath(path)
        if name.lower().endswith((".exr", ".pfm")):
            _glint.write(name, numpy.asarray(self))
        else:
            _glint.write_codes(name, self.codes())

    def png(self) -> bytes:
        """The bytes of the picture's PNG."""
        import tempfile

        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "picture.png")
            self.save(path)
            with io.open(path, "rb") as file:
                return file.read()

    def _repr_png_(self) -> bytes | None:
        return self.png() if self.ndim == 3 and self.shape[2] == 4 else None


def _picture(values: numpy.typing.ArrayLike, exposure: float = 0.0) -> Picture:
    picture = numpy.asarray(values, numpy.float32).view(Picture)
    picture.exposure = exposure
    picture.layers = {}
    return picture


def _text(value: Any) -> str:
    """A value as the text of an option."""
    if isinstance(value, str):
        return value
    if isinstance(value, os.PathLike):
        return str(os.fspath(value))
    if isinstance(value, (bool, numpy.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, numpy.integer)):
        return str(int(value))
    if isinstance(value, (float, numpy.floating)):
        return repr(float(value))
    if isinstance(value, (Sequence, numpy.ndarray)):
        return ",".join(_text(each) for each in value)
    raise InputError("a value of the type %s: give a text, a number, or several numbers"
                     % type(value).__name__)


def _pairs(parameters: Mapping[str, Any]) -> str:
    return ",".join("%s=%s" % (key, _text(value)) for key, value in parameters.items())


def _materials(value: Any) -> list[str]:
    if isinstance(value, str):
        return [value]
    if not isinstance(value, Mapping):
        return [_text(each) for each in value]
    own = {key: each for key, each in value.items() if not isinstance(each, Mapping)}
    texts = [_pairs(own)] if own else []
    return texts + ["%s:%s" % (name, _pairs(each)) for name, each in value.items()
                    if isinstance(each, Mapping)]


def _camera(value: Any) -> list[tuple[str, str]]:
    """Options for a camera: its index in the file, parameters by name, or a pose (4, 4) from camera
    to world, where the camera looks along its -Z, with +Y up."""
    if isinstance(value, (int, numpy.integer)):
        return [("camera-index", _text(value))]
    if isinstance(value, Mapping):
        return [("camera-" + key.replace("_", "-"), _text(each)) for key, each in value.items()]
    pose = numpy.asarray(value, float)
    if pose.shape != (4, 4):
        raise InputError("camera: give the number of one in the file, parameters by name, or a "
                         "matrix of the shape (4, 4)")
    position = pose[:3, 3]
    return [("camera-position", _text(position)),
            ("camera-focal-point", _text(position - pose[:3, 2])),
            ("camera-view-up", _text(pose[:3, 1]))]


def _intrinsics(value: numpy.typing.ArrayLike) -> str:
    """The option for fx, fy, cx, cy, with the first pixel's centre at (0.5, 0.5); or for an OpenCV
    matrix (3, 3), with that centre at (0, 0)."""
    given = numpy.asarray(value, float)
    if given.shape == (3, 3):
        if given[0, 1] != 0:
            raise InputError("intrinsics: a skew of %s cannot be drawn: give 0" % given[0, 1])
        return _text([given[0, 0], given[1, 1], given[0, 2] + 0.5, given[1, 2] + 0.5])
    if given.shape != (4,):
        raise InputError("intrinsics: give fx, fy, cx, cy or a matrix of the shape (3, 3)")
    return _text(given)


def _options(look: Mapping[str, Any]) -> list[tuple[str, str]]:
    """The options of the command line for these keywords."""
    options: list[tuple[str, str]] = []
    for keyword, value in look.items():
        name = keyword.replace("_", "-")
        if value is None:
            continue
        if name == "camera":
            options += _camera(value)
        elif name == "intrinsics":
            options.append(("camera-intrinsics", _intrinsics(value)))
        elif name == "material":
            options += [(name, each) for each in _materials(value)]
        elif name == "light" and not isinstance(value, str):
            options += [(name, _text(each)) for each in value]
        else:
            options.append((name, _text(value)))
    return options


class Session:
    """An OpenGL context with its shaders and models, so that pictures after the first are fast.

    backend: auto, egl, egl-software, osmesa, or reference (double precision, without OpenGL).
    """

    def __init__(self, backend: str = "auto") -> None:
        self._session = _glint.Session(backend)

    @property
    def description(self) -> str:
        """The backend and driver, such as "osmesa: llvmpipe (LLVM 15.0.6, 256 bits)"."""
        return self._session.description()

    def render(self, model: ModelLike, *, layers: Iterable[str] | None = None,
               **look: Any) -> Picture:
        """Like :func:`render`, with this session."""
        options = _options(look)
        own = model if isinstance(model, Model) else Model(model)
        picture = _picture(self._session.draw(own._model, options),
                           float(look.get("exposure") or 0.0))
        if layers is not None:
            names = [layers] if isinstance(layers, str) else list(layers)
            for name, values in self._session.layers(own._model, options,
                                                     [] if names == ["all"] else names).items():
                if name == "depth":
                    picture.layers[name] = values[:, :, 0]
                elif name == "normal":
                    picture.layers[name] = values[:, :, :3]
                elif name == "id":
                    picture.layers[name] = values[:, :, :3].astype(numpy.int32)
                else:
                    picture.layers[name] = values
        return picture


_sessions: dict[str, Session] = {}
_sessions_lock = threading.Lock()
if hasattr(os, "register_at_fork"):
    # A lock that another thread held would stay locked in the child.
    os.register_at_fork(before=_sessions_lock.acquire, after_in_parent=_sessions_lock.release,
                        after_in_child=_sessions_lock.release)


def render(model: ModelLike, *, backend: str = "auto", layers: Iterable[str] | None = None,
           **look: Any) -> Picture:
    """Draws a model.

    model: see :class:`Model`. layers: names of parts that are also drawn, into the picture's `layers`:
    "depth", "normal", "id", "ambient", "diffuse-0", "specular-0", "reflection", "refraction",
    "emission", "background", or "all". Every option of a look (docs/options.md) is a keyword, with
    _ for -: shading="gouraud", resolution=(640, 480), light=["directional:1,2,3"],
    material={"exponent": 50} or {"Helmet": {"metalness": 1}}, no_background=True. There are two more:
    camera=: the index of a camera in the file, a pose (4, 4) from camera to world, or {"position":
    (0, 1, 4), "focal_point": (0, 0, 0)}; intrinsics=: fx, fy, cx, cy or an OpenCV matrix (3, 3).

    The process keeps one session for each backend.
    """
    with _sessions_lock:
        session = _sessions.get(backend)
    if session is None:
        opened = Session(backend)
        with _sessions_lock:
            session = _sessions.setdefault(backend, opened)
    return session.render(model, layers=layers, **look)


def read(path: str | os.PathLike[str]) -> Picture:
    """Reads a picture (PNG, EXR, PFM, HDR, JPEG, WebP, TIFF ...) as linear light."""
    return _picture(_glint.read(os.fspath(path)))


@dataclass(frozen=True)
class Differences:
    """The result of compare(); true if the pictures count as the same."""

    #: All limits hold; without any, the pictures are equal.
    same: bool
    #: The values by metric.
    values: dict[str, float]
    #: One line for each limit that is exceeded.
    failures: list[str]
    #: The pixels that differ most, one line each.
    worst: str
    #: The FLIP error of each pixel, float32 (height, width) in [0, 1]; empty unless "flip" was given.
    map: FloatArray

    def __bool__(self) -> bool:
        return self.same

    def __str__(self) -> str:
        return "same" if self.same else "; ".join(self.failures) + "\n" + self.worst


PictureLike = Union[str, "os.PathLike[str]", numpy.typing.NDArray[Any]]


def _comparable(picture: PictureLike) -> numpy.typing.NDArray[Any]:
    """The picture as an array (height, width, 4) of floats or uint8."""
    if isinstance(picture, (str, os.PathLike)):
        array: numpy.typing.NDArray[Any] = numpy.asarray(read(picture))
    else:
        array = numpy.asarray(picture)
    if array.ndim == 2:
        array = numpy.repeat(array[:, :, None], 3, axis=2)
    if array.ndim != 3 or array.shape[2] not in (3, 4):
        raise InputError("a picture of the shape %s: give (height, width, 3 or 4), or (height, "
                         "width)" % (array.shape,))
    if array.dtype != numpy.uint8 and array.dtype.kind != "f":
        raise InputError("a picture of %s: give float (linear light) or uint8 (sRGB)" % array.dtype)
    if array.shape[2] == 3:
        full = 255 if array.dtype == numpy.uint8 else 1
        alpha = numpy.full(array.shape[:2] + (1,), full, array.dtype)
        array = numpy.concatenate([array, alpha], axis=2)
    return array


def compare(a: PictureLike, b: PictureLike, *, metrics: Iterable[str] = (), tolerance: float = 0.1,
            ignore_alpha: bool = False, **limits: float) -> Differences:
    """Compares two pictures; `a` is the baseline.

    A picture is the path of a file, an array of floats (linear light, premultiplied) or of uint8
    (sRGB, straight alpha). A file and a Picture, or uint8 and float, are compared as 8-bit codes, as
    in a PNG. limits: the largest value of each metric that counts as the same (psnr, ssim: the
    smallest), with _ for -: max, mean, rmse, relative_rmse, psnr, pixels, ssim, flip, hdr_flip.
    Without any, the pictures must be equal. metrics: others to report. tolerance: that of "pixels".
    """
    rules = ([(name.replace("_", "-"), float(limit)) for name, limit in limits.items()],
             list(metrics), tolerance, ignore_alpha)

    def is_codes(picture: PictureLike) -> bool:
        if isinstance(picture, (str, os.PathLike)):
            return not os.fspath(picture).lower().endswith((".exr", ".pfm", ".hdr"))
        return picture.dtype == numpy.uint8

    if isinstance(a, (str, os.PathLike)) and isinstance(b, (str, os.PathLike)):
        return Differences(**_glint.compare_files(os.fspath(a), os.fspath(b), *rules))
    if is_codes(a) or is_codes(b):
        one, other = (_codes(each, _comparable(each)) for each in (a, b))
        return Differences(**_glint.compare_codes(one, other, *rules))
    return Differences(**_glint.compare_linear(_comparable(a).astype(numpy.float32),
                                               _comparable(b).astype(numpy.float32), *rules))


def _codes(picture: PictureLike, array: numpy.typing.NDArray[Any]) -> numpy.typing.NDArray[numpy.uint8]:
    if array.dtype == numpy.uint8:
        return array
    exposure = picture.exposure if isinstance(picture, Picture) else 0.0
    return _glint.encode(array.astype(numpy.float32), 2.0**exposure)
