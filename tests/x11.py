"""What the window's tests need from the X server beyond xdotool: the pixels on the screen, the
clipboard, and files dropped on a window as by a file manager (XDND version 5)."""

import ctypes
import time
from ctypes import byref, c_char_p, c_int, c_long, c_ubyte, c_uint, c_ulong, c_void_p

CLIENT_MESSAGE, SELECTION_REQUEST, SELECTION_NOTIFY = 33, 30, 31


class Image(ctypes.Structure):
    _fields_ = [("width", c_int), ("height", c_int), ("xoffset", c_int), ("format", c_int),
                ("data", c_void_p), ("byte_order", c_int), ("bitmap_unit", c_int),
                ("bitmap_bit_order", c_int), ("bitmap_pad", c_int), ("depth", c_int),
                ("bytes_per_line", c_int), ("bits_per_pixel", c_int)]


def library():
    x = ctypes.CDLL("libX11.so.6")
    for name, result, *arguments in (
            ("XOpenDisplay", c_void_p, c_char_p),
            ("XCloseDisplay", c_int, c_void_p),
            ("XDefaultRootWindow", c_ulong, c_void_p),
            ("XGetImage", ctypes.POINTER(Image), c_void_p, c_ulong, c_int, c_int, c_uint, c_uint,
             c_ulong, c_int),
            ("XDestroyImage", c_int, ctypes.POINTER(Image)),
            ("XInternAtom", c_ulong, c_void_p, c_char_p, c_int),
            ("XCreateSimpleWindow", c_ulong, c_void_p, c_ulong, c_int, c_int, c_uint, c_uint,
             c_uint, c_ulong, c_ulong),
            ("XDestroyWindow", c_int, c_void_p, c_ulong),
            ("XSetSelectionOwner", c_int, c_void_p, c_ulong, c_ulong, c_ulong),
            ("XConvertSelection", c_int, c_void_p, c_ulong, c_ulong, c_ulong, c_ulong, c_ulong),
            ("XSendEvent", c_int, c_void_p, c_ulong, c_int, c_long, c_void_p),
            ("XCheckTypedEvent", c_int, c_void_p, c_int, c_void_p),
            ("XChangeProperty", c_int, c_void_p, c_ulong, c_ulong, c_ulong, c_int, c_int, c_char_p,
             c_int),
            ("XGetWindowProperty", c_int, c_void_p, c_ulong, c_ulong, c_long, c_long, c_int,
             c_ulong, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p),
            ("XFree", c_int, c_void_p),
            ("XSync", c_int, c_void_p, c_int)):
        function = getattr(x, name)
        function.restype, function.argtypes = result, arguments
    return x


def rgb_of(raw):
    rgb = bytearray(len(raw) // 4 * 3)
    rgb[0::3], rgb[1::3], rgb[2::3] = raw[2::4], raw[1::4], raw[0::4]
    return bytes(rgb)


class Server:
    def __init__(self, display):
        self.x = library()
        self.display = self.x.XOpenDisplay(display.encode())
        assert self.display, "no X display " + display
        self.root = self.x.XDefaultRootWindow(self.display)

    def close(self):
        self.x.XCloseDisplay(self.display)

    def atom(self, name):
        return self.x.XInternAtom(self.display, name.encode(), 0)

    def set_dpi(self, dpi):
        """Sets the screen's resolution as a desktop does, in a resource of the root window."""
        text = f"Xft.dpi: {dpi}\n".encode()
        self.x.XChangeProperty(self.display, self.root, self.atom("RESOURCE_MANAGER"),
                               self.atom("STRING"), 8, 0, text, len(text))
        self.x.XSync(self.display, 0)

    def raw(self, left, top, width, height):
        """The bytes of a part of the screen as the server has them, four to a pixel, for comparing."""
        image = self.x.XGetImage(self.display, self.root, left, top, width, height, 0xFFFFFFFF, 2)
        assert image and image.contents.bits_per_pixel == 32
        size = image.contents.bytes_per_line * height
        data = ctypes.string_at(image.contents.data, size)
        self.x.XDestroyImage(image)
        return data

    def capture(self, left, top, width, height):
        """The same as RGB, rows from the top."""
        return rgb_of(self.raw(left, top, width, height))

    def _window(self):
        return self.x.XCreateSimpleWindow(self.display, self.root, 0, 0, 1, 1, 0, 0, 0)

    def _event(self, kind, patience=20):
        """The next event of a type, as an array of longs."""
        event = (c_ulong * 24)()
        end = time.monotonic() + patience
        while not self.x.XCheckTypedEvent(self.display, kind, byref(event)):
            assert time.monotonic() < end, f"no X event of type {kind}"
            time.sleep(0.005)
        return event

    def clipboard(self):
        """The text that a program has put on the clipboard."""
        window, place = self._window(), self.atom("GLINT_TEST")
        self.x.XConvertSelection(self.display, self.atom("CLIPBOARD"), self.atom("UTF8_STRING"),
                                 place, window, 0)
        notify = self._event(SELECTION_NOTIFY)
        assert notify[7], "nothing is on the clipboard"
        kind, form, count, rest = c_ulong(), c_int(), c_ulong(), c_ulong()
        data = c_void_p()
        self.x.XGetWindowProperty(self.display, window, place, 0, 1 << 20, 1, 0, byref(kind),
                                  byref(form), byref(count), byref(rest), byref(data))
        text = ctypes.string_at(data, count.value).decode()
        self.x.XFree(data)
        self.x.XDestroyWindow(self.display, window)
        return text

    def _send(self, target, message, *data):
        event = (c_ulong * 24)()
        event[0] = CLIENT_MESSAGE
        event[4], event[5], event[6] = target, self.atom(message), 32
        for i, each in enumerate(data):
            event[7 + i] = each
        self.x.XSendEvent(self.display, target, 0, 0, byref(event))
        self.x.XSync(self.display, 0)

    def drop(self, target, uris, x, y):
        """Drops files on a window as a file manager does."""
        source = self._window()
        selection, uri_list = self.atom("XdndSelection"), self.atom("text/uri-list")
        self.x.XSetSelectionOwner(self.display, selection, source, 0)
        self._send(target, "XdndEnter", source, 5 << 24, uri_list, 0, 0)
        self._send(target, "XdndPosition", source, 0, x << 16 | y, 0, self.atom("XdndActionCopy"))
        status = self._event(CLIENT_MESSAGE)
        assert status[5] == self.atom("XdndStatus") and status[8] & 1, "the drop is not accepted"
        self._send(target, "XdndDrop", source, 0, 0, 0, 0)
        request = self._event(SELECTION_REQUEST)
        requestor, wanted, place = request[5], request[7], request[8]
        text = "".join(uri + "\r\n" for uri in uris).encode()
        self.x.XChangeProperty(self.display, requestor, place, wanted, 8, 0, text, len(text))
        answer = (c_ulong * 24)()
        answer[0] = SELECTION_NOTIFY
        answer[4], answer[5], answer[6], answer[7] = requestor, selection, wanted, place
        self.x.XSendEvent(self.display, requestor, 0, 0, byref(answer))
        self.x.XSync(self.display, 0)
        assert self._event(CLIENT_MESSAGE)[5] == self.atom("XdndFinished")
        self.x.XDestroyWindow(self.display, source)
