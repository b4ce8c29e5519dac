"""Drives a page in headless Chromium with the DevTools protocol over a pipe; standard library only.

    with Browser(width=1400, height=900) as browser:
        browser.open("report.html")                  # a path or a URL; returns when it has loaded
        browser.evaluate("document.title")           # the value; promises are awaited
        browser.wait_for("rows.length === 3")        # until true; fails after `seconds`
        browser.key("ArrowLeft"); browser.type("duck")
        browser.click("#filter"); browser.drag("#divider", 120, 0); browser.hover("canvas", 3, 4)
        browser.screenshot("page.png")
        browser.errors                               # exceptions and errors of the console, as text
        browser.requests                             # URLs that the page asked for
        browser.metrics()                            # Chromium's own counters, e.g. JSHeapUsedSize

run_tests(globals()) runs the functions test_NAME(browser) of a test file, or those named on the
command line, all in one Chromium.
"""

import json
import os
import pathlib
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback

_FLAGS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
          "--disable-background-networking", "--disable-component-update", "--disable-sync",
          "--disable-extensions", "--disable-dev-shm-usage", "--mute-audio",
          "--remote-debugging-pipe"]
_KEY_CODES = {"ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40, "Escape": 27,
              "Enter": 13, "Tab": 9, "Backspace": 8, "Home": 36, "End": 35, "PageUp": 33,
              "PageDown": 34, " ": 32}


class BrowserError(AssertionError):
    """The page or Chromium did not do what was requested."""


class Browser:
    def __init__(self, width=1400, height=900, seconds=30):
        program = shutil.which("chromium") or shutil.which("chromium-browser")
        if not program:
            raise BrowserError("no chromium: install the packages of packages.txt")
        self.seconds = seconds
        self.errors, self.requests = [], []
        self._profile = tempfile.mkdtemp(prefix="glint-browser-")
        self._last, self._pending, self._loaded = 0, b"", False
        to_read, self._to = os.pipe()
        self._from, from_write = os.pipe()
        for fd in (to_read, from_write):
            os.set_inheritable(fd, True)
        # Chromium reads commands from descriptor 3 and answers on 4.
        shell = 'exec "$@" 3<&%d 4>&%d' % (to_read, from_write)
        self._process = subprocess.Popen(
            ["bash", "-c", shell, "bash", program, *_FLAGS, "--user-data-dir=" + self._profile,
             "--window-size=%d,%d" % (width, height), "about:blank"],
            pass_fds=(to_read, from_write), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL, start_new_session=True)
        os.close(to_read)
        os.close(from_write)
        self._session = None
        try:
            target = self.send("Target.createTarget", url="about:blank")["targetId"]
            self._session = self.send("Target.attachToTarget", targetId=target,
                                      flatten=True)["sessionId"]
            for domain in ("Page", "Runtime", "Log", "Network", "Performance"):
                self.send(domain + ".enable")
            self.send("Emulation.setDeviceMetricsOverride", width=width, height=height,
                      deviceScaleFactor=1, mobile=False)
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Ends Chromium and its children."""
        if self._process is None:
            return
        try:
            self._session = None
            self.send("Browser.close")
            self._process.wait(5)
        except (BrowserError, OSError, subprocess.TimeoutExpired):
            pass
        try:
            os.killpg(self._process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self._process.wait()
        self._process = None
        os.close(self._to)
        os.close(self._from)
        shutil.rmtree(self._profile, ignore_errors=True)

    # The protocol: JSON messages terminated by a zero byte.

    def send(self, method, **parameters):
        """Sends a command of the protocol and returns its result."""
        self._last += 1
        message = {"id": self._last, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self._to, data):]
        until = time.monotonic() + self.seconds
        while True:
            answer = self._receive(until, method)
            if answer.get("id") == self._last:
                if "error" in answer:
                    raise BrowserError("%s: %s" % (method, answer["error"].get("message")))
                return answer["result"]

    def _receive(self, until, waiting_for):
        while b"\0" not in self._pending:
            left = until - time.monotonic()
            if left <= 0 or not select.select([self._from], [], [], left)[0]:
                raise BrowserError("%s: no answer in %g s" % (waiting_for, self.seconds))
            data = os.read(self._from, 1 << 20)
            if not data:
                raise BrowserError("%s: chromium has ended" % waiting_for)
            self._pending += data
        line, _, self._pending = self._pending.partition(b"\0")
        message = json.loads(line)
        self._note(message)
        return message

    def _note(self, message):
        method, parameters = message.get("method"), message.get("params", {})
        if method == "Page.loadEventFired":
            self._loaded = True
        elif method == "Network.requestWillBeSent":
            self.requests.append(parameters["request"]["url"])
        elif method == "Runtime.exceptionThrown":
            details = parameters["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Log.entryAdded" and parameters["entry"]["level"] == "error":
            self.errors.append(parameters["entry"]["text"])
        elif method == "Runtime.consoleAPICalled" and parameters["type"] == "error":
            self.errors.append(" ".join(str(a.get("value", a.get("description")))
                                        for a in parameters["args"]))

    # The page.

    def open(self, page):
        """Loads a page; clears errors and requests."""
        url = page if "://" in str(page) else pathlib.Path(page).resolve().as_uri()
        self.errors, self.requests, self._loaded = [], [], False
        result = self.send("Page.navigate", url=url)
        if result.get("errorText"):
            raise BrowserError("%s: %s" % (url, result["errorText"]))
        until = time.monotonic() + self.seconds
        while not self._loaded:
            self._receive(until, "loading " + url)

    def evaluate(self, expression):
        """The value of a JavaScript expression, as serialised to JSON; promises are awaited."""
        result = self.send("Runtime.evaluate", expression=expression, returnByValue=True,
                           awaitPromise=True, userGesture=True, replMode=True)
        if "exceptionDetails" in result:
            details = result["exceptionDetails"]
            text = details.get("exception", {}).get("description", details["text"])
            raise BrowserError("%s: %s" % (expression, text))
        return result["result"].get("value")

    def wait_for(self, expression, seconds=10):
        """Waits until an expression is truthy."""
        until = time.monotonic() + seconds
        while not self.evaluate("!!(%s)" % expression):
            if time.monotonic() > until:
                raise BrowserError("not true in %g s: %s (now %r)" %
                                   (seconds, expression, self.evaluate(expression)))
            time.sleep(0.02)

    def box(self, selector):
        """Left, top, width and height of the first element that matches a CSS selector."""
        box = self.evaluate(
            "(e => { if (!e) return null; e.scrollIntoView({block: 'nearest', inline: 'nearest'});"
            "const r = e.getBoundingClientRect(); return [r.left, r.top, r.width, r.height]; })"
            "(document.querySelector(%s))" % json.dumps(selector))
        if box is None:
            raise BrowserError("no element %s" % selector)
        return box

    def _point(self, selector, x, y):
        left, top, width, height = self.box(selector)
        return (left + (width / 2 if x is None else x), top + (height / 2 if y is None else y))

    def _mouse(self, kind, at, buttons=0, **more):
        self.send("Input.dispatchMouseEvent", type=kind, x=at[0], y=at[1], buttons=buttons,
                  button="left" if kind in ("mousePressed", "mouseReleased") or buttons else "none",
                  **more)

    def hover(self, selector, x=None, y=None):
        """Moves the mouse onto an element: to its centre, or to x, y from its upper left corner."""
        self._mouse("mouseMoved", self._point(selector, x, y))

    def click(self, selector, x=None, y=None, count=1):
        """Moves the mouse onto an element and clicks."""
        at = self._point(selector, x, y)
        self._mouse("mouseMoved", at)
        for n in range(1, count + 1):
            self._mouse("mousePressed", at, 1, clickCount=n)
            self._mouse("mouseReleased", at, 0, clickCount=n)

    def drag(self, selector, dx, dy, x=None, y=None, steps=5):
        """Drags from an element by dx, dy in steps."""
        begin = self._point(selector, x, y)
        self._mouse("mouseMoved", begin)
        self._mouse("mousePressed", begin, 1, clickCount=1)
        for step in range(1, steps + 1):
            at = (begin[0] + dx * step / steps, begin[1] + dy * step / steps)
            self._mouse("mouseMoved", at, 1)
        self._mouse("mouseReleased", at, 0, clickCount=1)

    def wheel(self, selector, delta, x=None, y=None, ctrl=False):
        """Turns the wheel over an element; a positive delta scrolls down."""
        at = self._point(selector, x, y)
        self.send("Input.dispatchMouseEvent", type="mouseWheel", x=at[0], y=at[1], deltaX=0,
                  deltaY=delta, modifiers=2 if ctrl else 0)

    def key(self, key, ctrl=False, shift=False):
        """Presses and releases a key, named as in KeyboardEvent.key."""
        modifiers = (2 if ctrl else 0) | (8 if shift else 0)
        code = _KEY_CODES.get(key, ord(key.upper()) if len(key) == 1 else 0)
        text = {"text": key} if len(key) == 1 and not ctrl else {}
        if key == "Enter":
            text = {"text": "\r"}
        self.send("Input.dispatchKeyEvent", type="keyDown" if text else "rawKeyDown", key=key,
                  windowsVirtualKeyCode=code, modifiers=modifiers, **text)
        self.send("Input.dispatchKeyEvent", type="keyUp", key=key, windowsVirtualKeyCode=code,
                  modifiers=modifiers)

    def type(self, text):
        """Types a text, key by key."""
        for letter in text:
            self.key(letter)

    def screenshot(self, path):
        """Writes a screenshot as a PNG file."""
        import base64
        data = self.send("Page.captureScreenshot", format="png")["data"]
        pathlib.Path(path).write_bytes(base64.b64decode(data))

    def metrics(self):
        """Chromium's counters of the page, by name."""
        return {m["name"]: m["value"] for m in self.send("Performance.getMetrics")["metrics"]}


def run_tests(names, width=1400, height=900):
    """Runs test functions in one Chromium; ends the process with status 1 if one fails."""
    wanted = sys.argv[1:] if len(sys.argv) > 1 else []
    tests = [n for n in names if n.startswith("test_") and (not wanted or n in wanted)]
    failed = [] if tests else ["no test of that name"]
    with Browser(width, height) as browser:
        for name in tests:
            begin = time.monotonic()
            try:
                names[name](browser)
                if browser.errors:
                    raise BrowserError("errors of the page: " + "; ".join(browser.errors))
                outcome = "ok"
            except Exception:
                traceback.print_exc()
                failed.append(name)
                outcome = "FAILED"
            print("%-60s %s %.1f s" % (name, outcome, time.monotonic() - begin), flush=True)
    if failed:
        sys.exit("failed: " + ", ".join(failed))
