"""Canvas widget in the browser (anywidget, JavaScript): draws frames and acknowledges each one."""

from functools import cached_property, partial
from pathlib import Path

import anywidget
import traitlets

from slamlab.views.live.back_pressure import Screen
from slamlab.views.live.frame_packing import FramePacker, Scene, pack_frame
from slamlab.views.player.library import LIVE, script, styles

HERE = Path(__file__).parent
# for every widget that draws
JUPYTER_THEME, JUPYTER_STYLES = HERE / "jupyter_theme.js", HERE / "jupyter.css"

# Jupyter's server lets TCP hold a short message back until the one before is acknowledged, which a
# browser on the same machine does 40 ms later; a message of two of loopback's packets is not held
MIN_MESSAGE = 2 * 65536  # [bytes]


class CanvasWidget(anywidget.AnyWidget):
    """Widget with a canvas in equal scale, the browser's side; dragging pans, Ctrl and wheel zoom.

    The wheel alone scrolls the page, until the canvas was clicked.

    Parameters
    ----------
    alt : str, what the picture shows, for who cannot see it
    title : str
    width, height : int [CSS pixels]; narrower where the notebook is
    frame : callable() -> dict of header and rows, what is seen when a page opens the picture: it
        comes with the widget itself, so that it is there while the kernel does other things
    """

    _esm = script(LIVE, JUPYTER_THEME, HERE / "canvas.js")
    _css = styles(JUPYTER_STYLES)
    alt = traitlets.Unicode().tag(sync=True)
    title = traitlets.Unicode().tag(sync=True)
    width = traitlets.Int(720).tag(sync=True)
    height = traitlets.Int(480).tag(sync=True)
    frame = traitlets.Callable().tag(sync=True, to_json=lambda frame, _: frame())


class LiveCanvas(Screen):
    """Screen that draws in the browser; each frame drawn is acknowledged (back-pressure).

    A frame is a message of a header and float32 bytes (:mod:`slamlab.views.live.frame_packing`);
    the browser answers with its number. Before the browser says that it is ready nothing is sent.

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
        self._packer, self._latest_scene = FramePacker(), Scene([])
        self._browser_ready, self._min_bytes = False, 0

    @cached_property
    def widget(self):
        """CanvasWidget; a browser gets it with the scene that was offered last before."""
        widget = self._make(frame=self._full_frame)
        widget.on_msg(self._on_message)
        widget.comm.on_close(lambda *_: self.on_closed())
        return widget

    def offer(self, scene):
        """Offer a scene, see :meth:`Screen.offer`; where no browser is ready it is only kept."""
        self._latest_scene = scene
        if self._browser_ready:
            super().offer(scene)

    def _send_frame(self, scene):
        header, rows = pack_frame(scene, self._packer, self.sent, self.drawn)
        self.widget.send(header, [rows.ljust(self._min_bytes, b"\0")])

    def _full_frame(self):
        header, rows = pack_frame(self._latest_scene, FramePacker(), self.sent, self.drawn)
        return {"header": header, "rows": rows}

    def _on_message(self, _, content, buffers):
        if not isinstance(content, dict):
            return
        match content.get("kind"):
            case "ready":
                self._packer.reset()
                self._browser_ready, self.calm = True, content.get("calm") is True
                self._min_bytes = MIN_MESSAGE if content.get("near") is True else 0
                self._client_ready()
            case "gone":
                self.on_closed()
            case "drawn" if isinstance(content.get("number"), int):
                self._acknowledge(content["number"])
            case "key" if isinstance(content.get("name"), str):
                self.on_key(content["name"])
