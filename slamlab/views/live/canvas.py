"""The picture that moves in the browser: an anywidget that draws frames and acknowledges them."""

from pathlib import Path

import anywidget
import traitlets

from slamlab.views.live.packing import Packer
from slamlab.views.live.screen import Screen

# a widget's script is one piece; for readers it is several
SCRIPTS = ("plane.js", "panels.js", "drawing.js", "canvas.js")


# Jupyter's server lets TCP hold a short message back until the one before is acknowledged, which a
# browser on the same machine does 40 ms later; a message of two of loopback's packets is not held
LOOPBACK = 2 * 65536  # [bytes]


class CanvasWidget(anywidget.AnyWidget):
    """The browser's side: a canvas in equal scale; wheel and drag move the view.

    Parameters
    ----------
    alt : str, what the picture shows, for who cannot see it
    title : str
    width, height : int [CSS pixels]; narrower where the notebook is
    """

    _esm = "\n".join(Path(__file__).with_name(n).read_text(encoding="utf-8") for n in SCRIPTS)
    alt = traitlets.Unicode().tag(sync=True)
    title = traitlets.Unicode().tag(sync=True)
    width = traitlets.Int(720).tag(sync=True)
    height = traitlets.Int(480).tag(sync=True)


class LiveCanvas(Screen):
    """A screen that draws in the browser, told of each frame that was drawn.

    A frame is a message of a header and float32 bytes (:mod:`slamlab.views.live.packing`); the
    browser answers with its number. Before the browser says that it is ready nothing is sent.

    Parameters
    ----------
    alt : str, what the picture shows, for who cannot see it
    title : str
    size : (width, height) [CSS pixels]
    """

    keys = True

    def __init__(self, alt="", title="", size=(720, 480)):
        super().__init__(acknowledged=True)
        width, height = map(int, size)
        self.widget = CanvasWidget(alt=alt, title=title, width=width, height=height)
        self.widget.on_msg(self._hear)
        self.widget.comm.on_close(lambda *_: self.on_closed())
        self._packer, self._opened, self._least = Packer(), False, 0

    def offer(self, scene):
        """See :meth:`Screen.offer`; a scene is dropped where no browser is ready."""
        if self._opened:
            super().offer(scene)

    def _put(self, scene):
        layers, rows = self._packer.pack(scene.drawables)
        header = {
            "kind": "frame",
            "number": self.sent,
            "behind": self.sent - self.drawn,
            "run": scene.run,
            "status": scene.status,
            "radius": scene.radius,
            "layers": layers,
        }
        self.widget.send(header, [rows.ljust(self._least, b"\0")])

    def _hear(self, _, content, buffers):
        if not isinstance(content, dict):
            return
        match content.get("kind"):
            case "ready":
                self._packer.forget()
                self._opened = True
                self._least = LOOPBACK if content.get("near") is True else 0
                self._begun()
            case "drawn" if isinstance(content.get("number"), int):
                self._acknowledge(content["number"])
            case "key" if isinstance(content.get("name"), str):
                self.on_key(content["name"])
