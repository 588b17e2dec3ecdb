"""The picture that moves in the browser: an anywidget that draws frames and acknowledges them."""

from functools import cached_property, partial
from pathlib import Path

import anywidget
import traitlets

from slamlab.views.live.packing import Packer, Scene
from slamlab.views.live.screen import Screen
from slamlab.views.live.scripts import script

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
    frame : callable() -> dict of header and rows, what is seen when a page opens the picture: it
        comes with the widget itself, so that it is there while the kernel does other things
    """

    _esm = script(Path(__file__).with_name("canvas.js"))
    alt = traitlets.Unicode().tag(sync=True)
    title = traitlets.Unicode().tag(sync=True)
    width = traitlets.Int(720).tag(sync=True)
    height = traitlets.Int(480).tag(sync=True)
    frame = traitlets.Callable().tag(sync=True, to_json=lambda frame, _: frame())


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
        self._make = partial(CanvasWidget, alt=alt, title=title, width=width, height=height)
        self._packer, self._opened, self._least, self._newest = Packer(), False, 0, Scene([])

    @cached_property
    def widget(self):
        """CanvasWidget; a browser gets it with the scene that was offered last before."""
        widget = self._make(frame=self._whole)
        widget.on_msg(self._hear)
        widget.comm.on_close(lambda *_: self.on_closed())
        return widget

    def offer(self, scene):
        """See :meth:`Screen.offer`; where no browser is ready a scene is only kept."""
        self._newest = scene
        if self._opened:
            super().offer(scene)

    def _put(self, scene):
        header, rows = self._frame(scene, self._packer)
        self.widget.send(header, [rows.ljust(self._least, b"\0")])

    def _whole(self):
        header, rows = self._frame(self._newest, Packer())
        return {"header": header, "rows": rows}

    def _frame(self, scene, packer):
        layers, rows = packer.pack(scene.drawables)
        header = {
            "kind": "frame",
            "number": self.sent,
            "behind": self.sent - self.drawn,
            "run": scene.run,
            "status": scene.status,
            "radius": scene.radius,
            "layers": layers,
        }
        return header, rows

    def _hear(self, _, content, buffers):
        if not isinstance(content, dict):
            return
        match content.get("kind"):
            case "ready":
                self._packer.forget()
                self._opened = True
                self._least = LOOPBACK if content.get("near") is True else 0
                self._begun()
            case "gone":
                self.on_closed()
            case "drawn" if isinstance(content.get("number"), int):
                self._acknowledge(content["number"])
            case "key" if isinstance(content.get("name"), str):
                self.on_key(content["name"])
