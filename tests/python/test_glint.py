"""The Python package: pictures as the program makes them, layers, scenes from arrays, comparisons,
sessions, threads and processes."""

import concurrent.futures
import copy
import io
import multiprocessing
import os
import pathlib
import pickle
import re
import subprocess
import sys
import time

import numpy
import pytest

import glint

MODELS = pathlib.Path(os.environ["GLINT_SOURCE_DIR"]) / "models"
PROGRAM = os.environ["GLINT_EXECUTABLE"]
TORUS = MODELS / "torus.glb"
SQUARE = dict(positions=[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]],
              indices=[[0, 1, 2], [0, 2, 3]],
              material={"color": (0.5, 0.25, 0.125), "diffuse": 0})
FRONTAL = dict(resolution=(32, 32), no_lights=True, ambient_light=(1, 1, 1),
               background_color=(0, 0, 0),
               camera={"position": (0, 0, 4), "focal_point": (0, 0, 0), "view_angle": 40})


def test_draws_what_the_program_draws(tmp_path):
    picture = glint.render(TORUS, resolution=(80, 60), shading="blinn-phong", exposure=0.5,
                           material={"specular": 0.5, "color": "#c04020"},
                           light=["directional:1,2,3", "point:0,3,2:0.2,0.2,0.5"])
    assert picture.dtype == numpy.float32 and picture.shape == (60, 80, 4)
    subprocess.run([PROGRAM, "render", TORUS, "-o", tmp_path / "a.png", "--resolution", "80,60",
                    "--shading", "blinn-phong", "--exposure", "0.5", "--material",
                    "specular=0.5,color=#c04020", "--light", "directional:1,2,3", "--light",
                    "point:0,3,2:0.2,0.2,0.5"], check=True)
    assert glint.compare(tmp_path / "a.png", picture)
    picture.save(tmp_path / "b.png")
    assert glint.compare(tmp_path / "a.png", tmp_path / "b.png")
    picture.save(tmp_path / "c.exr")
    assert numpy.array_equal(glint.read(tmp_path / "c.exr"), picture)
    assert picture._repr_png_().startswith(b"\x89PNG")
    assert picture[:, :, 0]._repr_png_() is None


def test_models_of_all_kinds():
    expected = glint.render(TORUS, resolution=(32, 32))
    assert numpy.array_equal(glint.render(str(TORUS), resolution=(32, 32)), expected)
    assert numpy.array_equal(glint.render(TORUS.read_bytes(), resolution=(32, 32)), expected)

    class Exports:
        def export(self, file_type):
            assert file_type == "glb"
            return TORUS.read_bytes()

    assert numpy.array_equal(glint.render(Exports(), resolution=(32, 32)), expected)
    square = glint.render(glint.Mesh(**SQUARE), **FRONTAL)
    assert square[16, 16] == pytest.approx([0.5, 0.25, 0.125, 1], abs=1e-6)
    assert square[0, 0].tolist() == [0, 0, 0, 1]
    behind = numpy.eye(4)
    behind[2, 3] = -1
    two = [glint.Mesh(**SQUARE, name="front"), glint.Mesh(**SQUARE, name="behind", place=behind)]
    model = glint.Model(two)
    assert model.warnings == []
    assert model.bounds[0] == pytest.approx((0, 0, -0.5))
    named = glint.render(model, **dict(FRONTAL, material={"front": {"color": (0, 1, 0)}}))
    assert named[16, 16] == pytest.approx([0, 1, 0, 1], abs=1e-6)


def test_layers():
    picture = glint.render(glint.Mesh(**SQUARE), layers=["depth", "normal", "id"], **FRONTAL)
    assert picture.layers["depth"].shape == (32, 32)
    assert picture.layers["depth"][16, 16] == pytest.approx(4, abs=1e-5)
    assert numpy.isinf(picture.layers["depth"][0, 0])
    assert picture.layers["normal"][16, 16].tolist() == [0, 0, 1]
    assert picture.layers["id"].dtype == numpy.int32
    assert picture.layers["id"][16, 16].tolist() == [0, 0, 0]
    assert picture.layers["id"][0, 0].tolist() == [-1, -1, -1]
    every = glint.render(TORUS, layers="all", resolution=(32, 32), shading="environment")
    light = [name for name in every.layers if name not in ("depth", "normal", "id")]
    assert {"ambient", "diffuse-0", "specular-0", "reflection", "background"} <= set(light)
    # Sums of floats, each rounded; the picture's values are below 2.
    assert numpy.allclose(sum(every.layers[name] for name in light)[:, :, :3], every[:, :, :3],
                          atol=2e-6)


def test_cameras():
    pose = numpy.eye(4)
    pose[:3, 3] = (0, 0, 4)
    look = dict(FRONTAL, camera=pose)
    # 32 pixels high, 40 degrees: f = 16 / tan(20 degrees).
    f = 16 / numpy.tan(numpy.radians(20))
    by_angle = glint.render(glint.Mesh(**SQUARE), **FRONTAL)
    by_lens = glint.render(glint.Mesh(**SQUARE), intrinsics=(f, f, 16, 16), **look)
    by_matrix = glint.render(glint.Mesh(**SQUARE), **look,
                             intrinsics=[[f, 0, 15.5], [0, f, 15.5], [0, 0, 1]])
    assert numpy.array_equal(by_lens, by_matrix)
    assert numpy.abs(by_angle - by_lens).max() < 1e-5
    with pytest.raises(glint.InputError, match="skew"):
        glint.render(TORUS, intrinsics=[[f, 1, 0], [0, f, 0], [0, 0, 1]])
    with pytest.raises(glint.InputError, match="camera"):
        glint.render(TORUS, camera=numpy.eye(3))


def test_compares():
    grey = numpy.full((4, 6, 3), 100, numpy.uint8)
    other = grey.copy()
    other[0, 0, 0] = 110
    assert glint.compare(grey, grey)
    found = glint.compare(grey, other, metrics=["flip"], max=0.01)
    assert not found and found.values["max"] == pytest.approx(10 / 255)
    assert "max" in str(found) and "(0, 0)" in found.worst
    assert found.map.shape == (4, 6) and found.map[0, 0] > 0
    assert glint.compare(grey, other, max=0.04)
    linear = numpy.zeros((4, 6), numpy.float64)
    assert glint.compare(linear, linear + 0.1, rmse=0.11, mean=0.2)
    assert not glint.compare(linear, linear[:3], max=1)
    with pytest.raises(glint.InputError, match="psnrr"):
        glint.compare(grey, other, psnrr=3)
    with pytest.raises(glint.InputError, match="shape"):
        glint.compare(grey.ravel(), other)
    with pytest.raises(glint.InputError, match="uint8"):
        glint.compare(grey.astype(numpy.int16), other)


def _assert_same_picture(other, picture):
    assert type(other) is glint.Picture and other.exposure == picture.exposure == 2
    assert numpy.array_equal(other, picture)
    assert numpy.array_equal(other.codes(), picture.codes())
    assert list(other.layers) == list(picture.layers) == ["depth", "id"]
    assert all(numpy.array_equal(other.layers[name], picture.layers[name]) for name in other.layers)


def _exposed():
    return glint.render(TORUS, resolution=(32, 24), exposure=2, layers=["depth", "id"])


def test_copies_and_pickles_are_the_same_picture():
    picture = _exposed()
    copies = [pickle.loads(pickle.dumps(picture, protocol))
              for protocol in range(pickle.HIGHEST_PROTOCOL + 1)]
    copies += [copy.copy(picture), copy.deepcopy(picture), picture.copy(), picture.view()]
    for other in copies:
        _assert_same_picture(other, picture)
        other.layers["mine"] = other.layers["depth"]
        assert "mine" not in picture.layers
    deep = copy.deepcopy(picture)
    deep.layers["depth"][:] = 0
    deep[:] = 0
    assert picture.layers["depth"].max() > 0 and picture.max() > 0
    # Columns and slices, which NumPy stores otherwise.
    turned = pickle.loads(pickle.dumps(picture.transpose(1, 0, 2)[::2], 5))
    assert numpy.array_equal(turned, picture.transpose(1, 0, 2)[::2]) and turned.exposure == 2
    with concurrent.futures.ProcessPoolExecutor(
            1, multiprocessing.get_context("spawn")) as processes:
        _assert_same_picture(processes.submit(_exposed).result(timeout=60), picture)


@pytest.mark.parametrize("given, said", [
    (dict(shading="pbr"), "--shading"),
    (dict(shine=3), "shine"),
    (dict(resolution=(0, 5)), "0,5"),
    (dict(material={"Nothing": {"exponent": 4}}), "Nothing"),
    (dict(layers=["shadow"]), "no layer 'shadow': there are ambient"),
    (dict(exposure=object()), "object"),
])
def test_refuses_in_one_line(given, said):
    with pytest.raises(glint.InputError, match=re.escape(said)) as caught:
        glint.render(TORUS, **dict(dict(resolution=(8, 8)), **given))
    assert "\n" not in str(caught.value)


TRIANGLE = numpy.array(SQUARE["positions"][:3], float)
PIXELS = numpy.zeros((4, 6), numpy.float32)


@pytest.mark.parametrize("call, said", [
    (lambda: glint.render(None), "model: None cannot be used: give a path"),
    (lambda: glint.render(5), "model: 5 cannot"),
    (lambda: glint.render([None]), "model: [None] cannot"),
    (lambda: glint.render(TRIANGLE), "model: an array of float64 of the shape (3, 3) cannot"),
    (lambda: glint.render(io.BytesIO(b"x")), "model: <_io.BytesIO"),
    (lambda: glint.render("a\0b"), "model: 'a\\x00b' cannot"),
    (lambda: glint.render("\udcff.glb"), "\\xff.glb: does not exist"),
    (lambda: glint.render("\ud800.glb"), "model: '\\ud800.glb' cannot"),
    (lambda: glint.render(TORUS, material=5), "material: 5 cannot"),
    (lambda: glint.render(TORUS, material=[{"exponent": 3}]), "material: [{'exponent': 3}] cannot"),
    (lambda: glint.render(TORUS, material={"exponent": None}), "exponent: None cannot"),
    (lambda: glint.render(TORUS, material={"\ud800": 1}), "material: '\\ud800=1' cannot"),
    (lambda: glint.render(TORUS, light=5), "light: 5 cannot"),
    (lambda: glint.render(TORUS, light=[None]), "light: [None] cannot"),
    (lambda: glint.render(TORUS, layers=5), "layers: 5 cannot"),
    (lambda: glint.render(TORUS, layers=[5]), "no layer '5'"),
    (lambda: glint.render(TORUS, layers=[None]), "layers: [None] cannot"),
    (lambda: glint.render(TORUS, camera="x"), "camera: 'x' cannot"),
    (lambda: glint.render(TORUS, camera={5: 5}), "camera: {5: 5} cannot"),
    (lambda: glint.render(TORUS, camera={"position": None}), "camera position: None cannot"),
    (lambda: glint.render(TORUS, camera=numpy.eye(4) * 1j), "camera: an array of complex128"),
    (lambda: glint.render(TORUS, intrinsics="x"), "intrinsics: 'x' cannot"),
    (lambda: glint.render(TORUS, exposure=10**5000), "exposure: a value of the type int cannot"),
    (lambda: glint.render(TORUS, hdri_file=b"x"), "hdri_file: b'x' cannot"),
    (lambda: glint.render(TORUS, backend=[None]), "backend: [None] cannot"),
    (lambda: glint.Session(5), "backend: 5 cannot be used: give auto, egl"),
    (lambda: glint.read(None), "path: None cannot"),
    (lambda: glint.render(TORUS, resolution=(8, 8)).save(None), "path: None cannot"),
    (lambda: glint.Model(glint.Mesh("abc")), "positions: 'abc' cannot"),
    (lambda: glint.Model(glint.Mesh([[0, 0, 0], [1]])), "positions: [[0, 0, 0], [1]] cannot"),
    (lambda: glint.Model(glint.Mesh(TRIANGLE * 1j)), "positions: an array of complex128"),
    (lambda: glint.Model(glint.Mesh(TRIANGLE * numpy.nan)), "positions: some are not finite"),
    (lambda: glint.Model(glint.Mesh(TRIANGLE * 1e300)), "positions: some are not finite"),
    (lambda: glint.Model(glint.Mesh(TRIANGLE, place=numpy.full((4, 4), numpy.inf))), "place: some"),
    (lambda: glint.Model(glint.Mesh(TRIANGLE, place=5j)), "place: 5j cannot"),
    (lambda: glint.Model(glint.Mesh(TRIANGLE, normals=TRIANGLE * 1j)), "normals: an array"),
    (lambda: glint.Model(glint.Mesh(TRIANGLE, [[0, 1], [2]])), "indices: [[0, 1], [2]] cannot"),
    (lambda: glint.Model(glint.Mesh(TRIANGLE, material=5)), "material: 5 cannot"),
    (lambda: glint.Model(glint.Mesh(TRIANGLE, texture=5)), "texture: 5 cannot"),
    (lambda: glint.Model(glint.Mesh(TRIANGLE, name=5)), "name: 5 cannot"),
    (lambda: glint.Model(glint.Mesh(TRIANGLE, two_sided="no")), "two_sided: 'no' cannot"),
    (lambda: glint.compare(PIXELS, None), "a picture: None cannot"),
    (lambda: glint.compare([[1], [1, 2]], PIXELS), "a picture: [[1], [1, 2]] cannot"),
    (lambda: glint.compare(PIXELS, PIXELS, flip="a"), "flip: 'a' cannot be used: give a number"),
    (lambda: glint.compare(PIXELS, PIXELS, flip=None), "flip: None cannot"),
    (lambda: glint.compare(PIXELS, PIXELS, psnr=float("nan")), "psnr: nan cannot"),
    (lambda: glint.compare(PIXELS, PIXELS, relative_rmse=-1), "relative_rmse: the limit -1.0 is"),
    (lambda: glint.compare(PIXELS, PIXELS, tolerance=float("nan")), "tolerance: nan cannot"),
    (lambda: glint.compare(PIXELS, PIXELS, metrics=5), "metrics: 5 cannot"),
    (lambda: glint.compare(PIXELS, PIXELS, ignore_alpha="no"), "ignore_alpha: 'no' cannot"),
])
@pytest.mark.filterwarnings("error")
def test_refuses_arguments_of_other_types(call, said):
    with pytest.raises(glint.InputError, match=re.escape(said)) as caught:
        call()
    assert re.fullmatch(".*(: give |there are ).*", str(caught.value))


def test_out_of_memory_is_an_error_of_input():
    text = ("import glint, resource, sys\n"
            "session = glint.Session('reference')\n"
            "resource.setrlimit(resource.RLIMIT_AS, (1 << 32, 1 << 32))\n"
            "try:\n"
            "    session.render(sys.argv[1], resolution=(65535, 65535))\n"
            "except glint.InputError as error:\n"
            "    print(error)\n")
    said = subprocess.run([sys.executable, "-c", text, TORUS], check=True, timeout=60,
                          stdout=subprocess.PIPE, text=True).stdout
    assert said == "out of memory: give a smaller model or resolution\n"


def test_numbers_of_all_kinds():
    expected = glint.render(TORUS, resolution=(32, 24), material={"exponent": 3}, exposure=2)
    given = glint.render(TORUS, resolution=numpy.array([32, 24]), exposure=numpy.array(2),
                         material={"exponent": numpy.array(3, numpy.float32)})
    assert numpy.array_equal(given, expected) and given.exposure == 2
    one = glint.render(glint.Mesh(**SQUARE), **FRONTAL)
    angle = dict(FRONTAL["camera"], view_angle=numpy.array(40.0))
    assert numpy.array_equal(glint.render(glint.Mesh(**SQUARE), **dict(FRONTAL, camera=angle)), one)
    with pytest.raises(glint.InputError, match="--camera-index 0: torus has no camera"):
        glint.render(TORUS, camera=numpy.array(0))
    # PSNR and SSIM may be negative. Three of four channels differ by 2: -10 log10(3) = -4.77.
    assert glint.compare(PIXELS, PIXELS + 2, psnr=-5, ssim=-1)
    assert not glint.compare(PIXELS, PIXELS + 2, psnr=-4)
    assert glint.compare([[0.0, 0.5]], [[0.0, 0.5]], metrics="flip").values["flip"] == 0


def test_names_of_files_that_are_not_utf8(tmp_path):
    name = os.fsdecode(os.fsencode(tmp_path) + b"/\xff")
    pathlib.Path(name + ".glb").write_bytes(TORUS.read_bytes())
    picture = glint.render(name + ".glb", resolution=(16, 16))
    assert numpy.array_equal(picture, glint.render(TORUS, resolution=(16, 16)))
    picture.save(pathlib.Path(name + ".exr"))
    assert numpy.array_equal(glint.read(name + ".exr"), picture)
    assert glint.compare(name + ".exr", picture) and glint.compare(name + ".exr", name + ".exr")
    lit = glint.render(TORUS, resolution=(16, 16), shading="environment", hdri_file=name + ".exr")
    assert not numpy.array_equal(lit, picture)


def test_refuses_models(tmp_path):
    with pytest.raises(glint.InputError, match="nowhere.glb"):
        glint.render(tmp_path / "nowhere.glb")
    with pytest.raises(glint.InputError, match="the model in memory"):
        glint.render(b"no model")
    with pytest.raises(glint.InputError, match="indices"):
        glint.Model(glint.Mesh(SQUARE["positions"], [0.5, 1, 2]))
    with pytest.raises(glint.InputError, match="index 4"):
        glint.Model(glint.Mesh(SQUARE["positions"], [0, 1, 4]))
    with pytest.raises(glint.InputError, match="shape"):
        glint.Model(glint.Mesh([[0, 1], [1, 2], [2, 3]]))
    with pytest.raises(glint.InputError, match="vulkan"):
        glint.render(TORUS, backend="vulkan")
    assert issubclass(glint.InputError, glint.Error) and issubclass(glint.Error, RuntimeError)


def test_a_small_picture_is_quick():
    session = glint.Session("osmesa")
    model = glint.Model(TORUS)
    times = []
    for _ in range(10):
        begin = time.perf_counter()
        session.render(model, resolution=(64, 64), shading="blinn-phong")
        times.append(time.perf_counter() - begin)
    print("a small picture: %.1f ms" % (1000 * min(times)))
    # 20 ms on an idle machine; tests share theirs with others.
    assert min(times) < 0.02


def _draw(path):
    return glint.render(path, resolution=(32, 32)).tobytes()


def _fork_says(path):
    try:
        return _draw(path)
    except glint.ContextError as error:
        return str(error)


def test_threads_and_processes():
    expected = _draw(TORUS)
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        assert set(pool.map(_draw, [TORUS] * 20)) == {expected}
    with concurrent.futures.ProcessPoolExecutor(
            2, multiprocessing.get_context("spawn")) as processes:
        assert set(processes.map(_draw, [TORUS] * 4)) == {expected}
    with concurrent.futures.ProcessPoolExecutor(
            1, multiprocessing.get_context("fork")) as processes:
        assert "spawn" in processes.submit(_fork_says, TORUS).result(timeout=30)


def test_fork_before_the_first_picture():
    text = ("import glint, os, sys\n"
            "child = os.fork()\n"
            "glint.render(sys.argv[1], resolution=(16, 16))\n"
            "sys.exit(0 if child == 0 else os.waitpid(child, 0)[1])\n")
    subprocess.run([sys.executable, "-c", text, TORUS], check=True, timeout=60)


def test_needs_no_display():
    environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    subprocess.run([sys.executable, "-c", "import glint, sys\n"
                    "assert glint.render(sys.argv[1], resolution=(16, 16)).max() > 0", TORUS],
                   env=environment, check=True, timeout=60)


def test_docstrings():
    for name in glint.__all__:
        thing = getattr(glint, name)
        if name == "__version__":
            continue
        if name not in ("Error", "InputError", "ContextError"):
            assert thing.__doc__, name
        for member, value in vars(thing).items() if isinstance(thing, type) else ():
            if not member.startswith("_") and callable(value):
                assert value.__doc__, "%s.%s" % (name, member)
    version = subprocess.run([PROGRAM, "--version"], stdout=subprocess.PIPE, text=True, check=True)
    assert version.stdout.split()[1] == glint.__version__


IMAGE_TEST = '''
import glint
def test_torus(image_baseline):
    image_baseline(glint.render(%r, resolution=(32, 32), exposure=%s), flip=0.001)
'''


def test_the_fixture(tmp_path):
    def run(*words, exposure=0, status=0):
        (tmp_path / "test_it.py").write_text(IMAGE_TEST % (str(TORUS), exposure))
        ran = subprocess.run([sys.executable, "-B", "-m", "pytest", "-q", "-p", "no:cacheprovider",
                              "-p", "glint.pytest_plugin", "--glint-program", PROGRAM, "test_it.py",
                              *words], cwd=tmp_path, text=True, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, env=dict(os.environ, PYTEST_DISABLE_PLUGIN_AUTOLOAD="1"))
        assert ran.returncode == status, ran.stdout
        return ran.stdout

    baseline = tmp_path / "baselines/test_torus.png"
    said = run(status=1)
    assert "no baseline" in said and not baseline.exists()
    run("--glint-update-baselines")
    assert baseline.exists()
    run()
    said = run("--glint-report", "report.html", exposure=1, status=1)
    assert "flip" in said and "pytest --glint-update-baselines" in said
    assert (tmp_path / "image-tests/difference/test_it.test_torus.png").exists()
    assert "test_it.test_torus" in (tmp_path / "report.html").read_text()
