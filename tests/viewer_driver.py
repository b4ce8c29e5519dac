"""A viewer in a real window under Xvfb, operated with xdotool and observed through the X server's
pixels. No wait relies on time alone, because the machine may be busy."""

import ctypes
import json
import os
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

import x11

PATIENCE = 60  # seconds; the machine may be busy


def wait_for(what, condition, patience=PATIENCE):
    end = time.monotonic() + patience
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > end:
            raise AssertionError("waited in vain for " + what)
        time.sleep(0.03)


class PngImage(ctypes.Structure):
    """Of libpng's simplified interface."""
    _fields_ = [("opaque", ctypes.c_void_p), *((name, ctypes.c_uint32) for name in (
        "version", "width", "height", "format", "flags", "colormap_entries", "failed")),
                ("message", ctypes.c_char * 64)]


def pixels_of(path):
    """The codes of a PNG, RGB, rows from the top."""
    png = ctypes.CDLL("libpng16.so.16")
    image = PngImage(version=1)
    assert png.png_image_begin_read_from_file(ctypes.byref(image), path.encode()), image.message
    image.format = 2  # RGB, as it is stored
    codes = ctypes.create_string_buffer(3 * image.width * image.height)
    assert png.png_image_finish_read(ctypes.byref(image), None, codes, 0, None), image.message
    return codes.raw


def pfm_pixel(data, x, y):
    """The colour at a position in a PFM, whose rows start at the bottom."""
    kind, size, scale, values = data.split(b"\n", 3)
    assert kind == b"PF" and float(scale) < 0
    width, height = map(int, size.split())
    return struct.unpack_from("<3f", values, 12 * (width * (height - 1 - y) + x))


class Viewer:
    """A display, a window on it, and a separate folder with a copy of the model."""

    screen = (1400, 840)
    top = 20     # pixels at scale 1: the menu, below which the picture begins
    panel = 372  # pixels at scale 1; rows of the tab Shading below, as in viewer/panel.cpp

    def __init__(self, model, *options, screen=None, dpi=None):
        self.folder = tempfile.mkdtemp(prefix="glint-window-")
        self.model = os.path.join(self.folder, os.path.basename(model))
        shutil.copyfile(model, self.model)
        self.options = options
        self.errors = os.path.join(self.folder, "errors")
        self.screen = screen or self.screen
        scale = float(options[options.index("--scale") + 1]) if "--scale" in options else (dpi or 96) / 96
        self.top = round(self.top * scale)
        width, height = self.screen
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24",
             "-nolisten", "tcp", "-noreset"],
            pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        number = b""
        while not number.endswith(b"\n"):  # written in pieces
            piece = os.read(read, 16)
            assert piece, "Xvfb did not start"
            number += piece
        os.close(read)
        display = ":" + number.decode().strip()
        self.environment = dict(os.environ, DISPLAY=display,
                                XDG_CONFIG_HOME=os.path.join(self.folder, "config"),
                                XDG_STATE_HOME=os.path.join(self.folder, "state"))
        self.x = x11.Server(display)
        if dpi:
            self.x.set_dpi(dpi)
        self.process = None
        try:
            self.start()
        except BaseException:
            self.end()
            raise

    def start(self, *options):
        self.process = subprocess.Popen(
            [VIEWER, os.path.basename(self.model), *self.options, *options], cwd=self.folder,
            env=self.environment, stderr=open(self.errors, "w"), text=True)
        self.window = int(wait_for("the window", lambda: not self.alive() or self.xdotool(
            "search", "--onlyvisible", "--name", "glint$", check=False)).split()[0])
        assert self.alive(), self.told()
        self.move(20, 20)
        self.settled(shaded=True)

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if kind:
            self.screenshot("/tmp/glint-window-failure.png")
            print("the screen is in /tmp/glint-window-failure.png", file=sys.stderr)
        self.end()

    def end(self):
        self.kill()
        self.x.close()
        self.server.send_signal(signal.SIGTERM)
        self.server.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def kill(self):
        if self.process and self.process.poll() is None:
            self.process.kill()
            self.process.wait()

    def told(self):
        """The terminal output so far."""
        with open(self.errors) as file:
            return file.read()

    # Input and screen.

    def xdotool(self, *arguments, check=True):
        done = subprocess.run(["xdotool", *arguments], env=self.environment, capture_output=True,
                              text=True)
        if check and done.returncode:
            raise AssertionError("xdotool " + " ".join(arguments) + ": " + done.stderr)
        return done.stdout.strip()

    def key(self, *keys):
        self.xdotool(*(word for each in keys for word in ("key", each, "sleep", "0.05")))

    def move(self, x, y):
        self.xdotool("mousemove", str(x), str(y))

    def click(self, x, y, repeat=1):
        self.xdotool("mousemove", str(x), str(y), "click", "--repeat", str(repeat), "--delay", "1", "1")

    def drag(self, x0, y0, x1, y1, button=1, steps=8):
        places = [(x0 + (x1 - x0) * i // steps, y0 + (y1 - y0) * i // steps)
                  for i in range(steps + 1)]
        moves = [["mousemove", str(x), str(y), "sleep", "0.01"] for x, y in places]
        moves.insert(1, ["mousedown", str(button), "sleep", "0.01"])
        self.xdotool(*(word for move in moves for word in move), "mouseup", str(button))

    def screenshot(self, path):
        subprocess.run(["import", "-window", "root", path], env=self.environment)

    def capture(self):
        """The bytes of the whole screen, RGB."""
        return self.x.capture(0, 0, *self.screen)

    def settled(self, shaded=False, quiet=0.35):
        """The screen once it has not changed for a while."""
        last, since = None, time.monotonic()
        picture = (self.screen[0] - self.panel - 30, self.screen[1] - 65 - self.top)

        def still():
            nonlocal last, since, shaded
            now = self.x.raw(0, 0, *self.screen)
            if shaded:
                shaded = len(set(self.crop(x11.rgb_of(now), picture))) <= 20
            if now != last or shaded:
                last, since = now, time.monotonic()
            return time.monotonic() - since > quiet
        wait_for("the picture to be still", still)
        return x11.rgb_of(last)

    def opened(self, act):
        """The screen after something that changes it: no later input may come before that."""
        shown = self.x.raw(0, 0, *self.screen)
        act()
        wait_for("the screen to change", lambda: self.x.raw(0, 0, *self.screen) != shown)
        return self.settled(quiet=0.15)

    def type(self, text):
        self.xdotool("type", "--delay", "15", text)

    def shows(self, size, expected, what):
        """Waits until the window shows the picture `expected`."""
        shown = []

        def same():
            shown[:] = [self.x.capture(0, self.top, *size)]
            return shown[0] == expected
        try:
            wait_for(what, same, PATIENCE / 3)
        except AssertionError:
            differ = sum(a != b for a, b in zip(shown[0], expected))
            raise AssertionError(f"waited in vain for {what}: {differ} of {len(expected)} bytes differ")

    def shows_halves(self, size, at, left, right):
        """Whether the picture is `left` up to the divider at a column, and `right` beyond."""
        shown = self.crop(self.capture(), size)
        return columns(shown, size, 0, at - 3) == columns(left, size, 0, at - 3) and \
            columns(shown, size, at + 3, size[0]) == columns(right, size, at + 3, size[0])

    def crop(self, screen, size, width=None):
        across = 3 * (width or self.screen[0])
        return b"".join(screen[y * across:y * across + 3 * size[0]]
                        for y in range(self.top, self.top + size[1]))

    # User actions.

    def save_look(self):
        """Ctrl+S; the first time, accepts the name that is offered."""
        path = os.path.join(self.folder, os.path.splitext(os.path.basename(self.model))[0]
                            + "_1.json")
        before = os.stat(path).st_mtime_ns if os.path.exists(path) else None
        if before is None:
            self.opened(lambda: self.key("ctrl+s"))
            self.key("Return")
        else:
            self.key("ctrl+s")

        def written():
            return os.path.exists(path) and os.stat(path).st_mtime_ns != before
        wait_for("the look to be saved", written)
        with open(path) as file:
            return json.load(file), path

    def render(self, *options, ending="png"):
        """What glint render draws with these options: RGB bytes for a PNG, otherwise the file's
        bytes."""
        out = os.path.join(self.folder, "offscreen." + ending)
        subprocess.run([GLINT, "render", self.model, *options, "-o", out], check=True,
                       cwd=self.folder)
        if ending != "png":
            with open(out, "rb") as file:
                return file.read()
        return pixels_of(out)

    def check_saved(self, name):
        """A picture that the window has saved is the file that glint render wrote last."""
        path = os.path.join(self.folder, name)
        wait_for(name, lambda: os.path.exists(path))
        with open(path, "rb") as a, open(os.path.join(self.folder, "offscreen.png"), "rb") as b:
            assert a.read() == b.read(), name + " is another file than glint render's"

    def picture(self):
        """Checks the window's picture against glint render of the saved look. Returns its bytes and
        the look."""
        look, path = self.save_look()
        self.move(20, 20)
        drawn = self.render("--look", path)
        assert len(set(drawn)) > 20, "the picture is one colour"
        self.shows(tuple(look["resolution"]), drawn, "the picture to be glint render's")
        return drawn, look

    def processor_seconds(self):
        """What its threads have taken, to 0.01 s."""
        with open(f"/proc/{self.process.pid}/stat") as file:
            fields = file.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def share_at_rest(self, seconds):
        """Of a core, while nothing changes."""
        self.settled(quiet=1)
        before = self.processor_seconds()
        time.sleep(seconds)
        return (self.processor_seconds() - before) / seconds

    def alive(self):
        return self.process.poll() is None

    def left(self, patience=PATIENCE):
        wait_for("the viewer to end", lambda: self.process.poll() is not None, patience)
        return self.process.returncode


# Centres of widgets in the tab Shading of a model with one material, scale 1.
PANEL_LEFT = 1000
TWO_SIDED = (PANEL_LEFT + 174, 238)
ROW = {"ambient": 340, "diffuse": 365, "specular": 390, "exponent": 415, "metalness": 440, "ior": 465,
       "transmission": 490, "preset": 541}
SLIDER = (PANEL_LEFT + 172, PANEL_LEFT + 352)


# Rows in other tabs at scale 1, as in the panel: the height of a slider there.
TIME = 240           # tab Picture, for an animated model
INTENSITY = 249      # tab Lights, for three lights of which a directional one is selected


def drag_slider(viewer, name, start, end):
    span = SLIDER[1] - SLIDER[0]
    y = ROW[name]
    viewer.drag(int(SLIDER[0] + start * span), y, int(SLIDER[0] + end * span), y)


def columns(picture, size, first, last, top=40, bottom=40):
    return [picture[3 * (size[0] * y + first):3 * (size[0] * y + last)]
            for y in range(top, size[1] - bottom)]


def run(tests):
    """Runs the functions test_... in a module's globals, given GLINT GLINT_VIEWER MODELS [TEST...]
    on the command line: all, or those named. Returns the exit status: 77 (skipped) if Xvfb, xdotool
    or ImageMagick is missing."""
    global GLINT, VIEWER
    GLINT, VIEWER, models = (os.path.abspath(path) for path in sys.argv[1:4])
    tests.update(GLINT=GLINT, VIEWER=VIEWER, MODELS=models,
                 GLSL=os.path.join(os.path.dirname(models), "glsl"),
                 TEAPOT=os.path.join(models, "teapot.glb"),
                 SPHERE=os.path.join(models, "sphere.glb"),
                 BEND=os.path.join(models, "bend.glb"),
                 LIGHTS=os.path.join(models, "lights.glb"))
    known = [name for name in tests if name.startswith("test_")]
    if any(shutil.which(tool) is None for tool in ("Xvfb", "xdotool", "import")):
        print("skipped: needs Xvfb, xdotool and ImageMagick")
        return 77
    failed = 0
    for name in sys.argv[4:] or known:
        start = time.monotonic()
        try:
            tests[name]()
            print(f"ok    {name}  {time.monotonic() - start:.1f} s", flush=True)
        except AssertionError as error:
            failed += 1
            print(f"FAIL  {name}: {error}", flush=True)
    return 1 if failed else 0
