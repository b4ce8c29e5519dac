"""A window with a model made for it, and the actions that users repeat."""

import os
import shutil
import tempfile

from viewer_driver import ROW, SLIDER, Viewer, wait_for

LINE = 19  # height of a list line, pixels at scale 1


class Job(Viewer):
    def __init__(self, make, *options, materials=1, **others):
        folder = tempfile.mkdtemp(prefix="glint-job-")
        try:
            path = make(os.path.join(folder, "model.glb")) if callable(make) else make
            super().__init__(path, *options, **others)
        finally:
            shutil.rmtree(folder)
        # The list of materials has a line for all, and one for each, up to five.
        self.below = LINE * (min(materials + 1, 6) - 2)

    def say(self, *words):
        """Runs palette commands."""
        for each in words:
            self.opened(lambda: self.key("ctrl+p"))
            self.opened(lambda: self.type(each))
            self.opened(lambda: self.key("Return"))

    def select(self, material):
        self.opened(lambda: self.key("ctrl+f"))
        self.opened(lambda: self.type(material))
        self.key("Return")
        self.settled()

    def set(self, row, text):
        """Types a value for a parameter of the selected material."""
        self.move(SLIDER[0] + 60, ROW[row] + self.below)
        self.settled(quiet=0.15)  # the slider under the pointer is lit
        self.opened(lambda: self.xdotool("keydown", "ctrl", "click", "1", "keyup", "ctrl"))
        self.opened(lambda: self.type(text))
        self.key("Return")
        self.move(20, 20)
        self.settled()

    def answer(self, text=None):
        """Presses Enter in a dialog, after typing a name if one is given."""
        self.settled()
        if text is not None:
            self.key("ctrl+a")
            self.xdotool("type", "--delay", "15", text)
            self.settled()
        self.key("Return")
        self.settled()

    def path(self, name):
        return os.path.join(self.folder, name)

    def bytes_of(self, name):
        wait_for(name, lambda: os.path.exists(self.path(name)))
        with open(self.path(name), "rb") as file:
            return file.read()

