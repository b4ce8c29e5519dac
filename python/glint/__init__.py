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

import copy
import io
import os
import threading
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol, Union

import numpy
import numpy.typing

from . import _glint
from ._arguments import (FloatArray, argument, as_array, as_bytes, as_doubles, as_flag, as_floats,
                         as_limits, as_names, as_options, as_pairs, as_path, as_text, as_utf8)
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


class _Exportable(Protocol):
    """Objects that export themselves as glTF, such as meshes and scenes of trimesh."""

    def export(self, *, file_type: str) -> Any:
        """The bytes of a file of the given type."""


@dataclass
class Mesh:
    """Triangles given as arrays, in one material.

    positions: (n, 3), finite. indices: three for each triangle, counter-clockwise seen from its
    front, in an array of any shape; by default the positions in their order. normals: (n, 3);
    without them, faces are flat. colors: (n, 4), linear RGB and alpha in [0, 1], multiplied by the material's
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
        def rows(name: str, width: int) -> FloatArray:
            return argument(name, getattr(self, name), as_floats,
                            "real numbers in an array of the shape (n, %d)" % width)

        indices = argument("indices", [] if self.indices is None else self.indices, as_array,
                           "an array of whole numbers").ravel()
        if indices.size and (indices.dtype.kind not in "iu" or int(indices.min()) < 0
                             or int(indices.max()) > 0xFFFFFFFF):
            raise InputError("indices: give whole numbers from 0 to 4294967295")
        positions = rows("positions", 3)
        place = argument("place", numpy.eye(4) if self.place is None else self.place, as_doubles,
                         "real numbers in an array of the shape (4, 4)")
        checked: dict[str, numpy.typing.NDArray[Any]] = {"positions": positions, "place": place}
        for name, values in checked.items():
            if not (abs(values) <= numpy.finfo(numpy.float32).max).all():  # nor if NaN
                raise InputError("%s: some are not finite in single precision: give numbers from "
                                 "-3.4e38 to 3.4e38" % name)
        return _glint.Arrays(
            positions, indices.astype(numpy.uint32), rows("normals", 3), rows("colors", 4),
            rows("texcoords", 2),
            argument("texture", self.texture, as_bytes, "the bytes of a PNG, JPEG or WebP"),
            argument("name", self.name, as_utf8, "a text"),
            argument("material", self.material, lambda given: as_utf8(as_pairs(given)),
                     "parameters by name"),
            argument("two_sided", self.two_sided, as_flag, "True or False"), place)


ModelLike = Union[str, "os.PathLike[str]", bytes, Mesh, "Model", _Exportable, Iterable[Mesh]]


def _meshes(value: Any) -> list[Mesh]:
    meshes = list(value)
    if not all(isinstance(each, Mesh) for each in meshes):
        raise TypeError
    return meshes


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
            self._model = _glint.Model.load(as_path(source, "model"))
        elif isinstance(source, Mesh):
            self._model = _glint.Model.from_arrays([source._arrays()])
        elif hasattr(source, "export"):
            self._model = _glint.Model.from_memory(
                argument("model", source.export(file_type="glb"), as_bytes, "an export of bytes"))
        else:
            self._model = _glint.Model.from_arrays([each._arrays() for each in argument(
                "model", source, _meshes, "a path, the bytes of a file, a Mesh or several")])

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
    #: "normal" and "id" (height, width, 3), terms of light (height, width, 4). Copies have a dict
    #: of their own. Slices keep the layers of the whole picture.
    layers: dict[str, numpy.typing.NDArray[Any]]

    def __array_finalize__(self, other: Any) -> None:
        self.exposure = getattr(other, "exposure", 0.0)
        self.layers = dict(getattr(other, "layers", {}))

    # NumPy's own pickles and deep copies leave out what a subclass adds.
    def __reduce__(self) -> tuple[Any, ...]:
        build, arguments, state = super().__reduce__()  # type: ignore[misc]
        return build, arguments, (state, self.__dict__)

    def __setstate__(self, state: Any) -> None:
        super().__setstate__(state[0])
        self.__dict__.update(state[1])

    def __deepcopy__(self, memo: dict[int, Any] | None) -> Picture:
        other: Picture = super().__deepcopy__(memo)
        other.__dict__.update(copy.deepcopy(self.__dict__, memo))
        return other

    def codes(self) -> numpy.typing.NDArray[numpy.uint8]:
        """The picture as stored in a PNG: uint8 (height, width, 4), sRGB, straight alpha."""
        return _glint.encode(numpy.asarray(self), 2.0**self.exposure)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the picture: .png, .jpg, .webp (sRGB, exposed), .exr, .pfm (linear)."""
        name = as_path(path)
        if name.lower().endswith((b".exr", b".pfm")):
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


_BACKENDS = "auto, egl, egl-software, osmesa or reference"


class Session:
    """An OpenGL context with its shaders and models, so that pictures after the first are fast.

    backend: auto, egl, egl-software, osmesa, or reference (double precision, without OpenGL).
    """

    def __init__(self, backend: str = "auto") -> None:
        self._session = _glint.Session(argument("backend", backend, as_utf8, _BACKENDS))

    @property
    def description(self) -> str:
        """The backend and driver, such as "osmesa: llvmpipe (LLVM 15.0.6, 256 bits)"."""
        return self._session.description()

    def render(self, model: ModelLike, *, layers: Iterable[str] | None = None,
               **look: Any) -> Picture:
        """Like :func:`render`, with this session."""
        options = as_options(look)
        own = model if isinstance(model, Model) else Model(model)
        names = [] if layers is None else argument("layers", layers, as_names, "a name or several")
        exposure = look.get("exposure")
        try:
            picture = _picture(self._session.draw(own._model, options),
                               0.0 if exposure is None else float(as_text(exposure)))
            parts = {} if layers is None else self._session.layers(
                own._model, options, [] if names == [b"all"] else names)
        except MemoryError as error:
            raise InputError("out of memory: give a smaller model or resolution") from error
        for name, values in parts.items():
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
    backend = argument("backend", backend, as_text, _BACKENDS)
    with _sessions_lock:
        session = _sessions.get(backend)
    if session is None:
        opened = Session(backend)
        with _sessions_lock:
            session = _sessions.setdefault(backend, opened)
    return session.render(model, layers=layers, **look)


def read(path: str | os.PathLike[str]) -> Picture:
    """Reads a picture (PNG, EXR, PFM, HDR, JPEG, WebP, TIFF ...) as linear light."""
    return _picture(_glint.read(as_path(path)))


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


def _pixels(value: Any) -> numpy.typing.NDArray[Any]:
    array = numpy.asarray(read(value) if isinstance(value, (str, os.PathLike)) else value)
    if array.dtype.kind in "OSU":  # what NumPy makes of no numbers
        raise TypeError
    return array


def _comparable(picture: PictureLike) -> numpy.typing.NDArray[Any]:
    """The picture as an array (height, width, 4) of floats or uint8."""
    array = argument("a picture", picture, _pixels, "the path of a file, or an array of float "
                     "(linear light) or uint8 (sRGB)")
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
    Without any, the pictures must be equal. A limit is a number, and from 0 for differences.
    metrics: others to report. tolerance: that of "pixels".
    """
    rules = ([(as_utf8(name), limit) for name, limit in as_limits(limits).items()],
             argument("metrics", metrics, as_names, "a name or several"),
             as_limits({"tolerance": tolerance})["tolerance"],
             argument("ignore_alpha", ignore_alpha, as_flag, "True or False"))

    def is_codes(picture: PictureLike, array: numpy.typing.NDArray[Any]) -> bool:
        if isinstance(picture, (str, os.PathLike)):
            return not as_path(picture).lower().endswith((b".exr", b".pfm", b".hdr"))
        return array.dtype == numpy.uint8

    if isinstance(a, (str, os.PathLike)) and isinstance(b, (str, os.PathLike)):
        return Differences(**_glint.compare_files(as_path(a), as_path(b), *rules))
    one, other = _comparable(a), _comparable(b)
    if is_codes(a, one) or is_codes(b, other):
        return Differences(**_glint.compare_codes(_codes(a, one), _codes(b, other), *rules))
    return Differences(**_glint.compare_linear(one.astype(numpy.float32),
                                               other.astype(numpy.float32), *rules))


def _codes(picture: PictureLike, array: numpy.typing.NDArray[Any]) -> numpy.typing.NDArray[numpy.uint8]:
    if array.dtype == numpy.uint8:
        return array
    exposure = picture.exposure if isinstance(picture, Picture) else 0.0
    return _glint.encode(array.astype(numpy.float32), 2.0**exposure)
