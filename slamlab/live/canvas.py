"""Canvas in the browser (anywidget, JavaScript): draws frames and acknowledges each one."""

from functools import cached_property, partial
from pathlib import Path

from slamlab.extras import needs
from slamlab.live.back_pressure import Screen
from slamlab.live.frame_packing import FramePacker, Scene, pack_frame
from slamlab.live.player.script_bundle import LIVE, script, styles

with needs("notebook"):
    import anywidget
    import traitlets

HERE = Path(__file__).parent
# for every widget with a canvas
JUPYTER_THEME, JUPYTER_STYLES = HERE / "jupyter_theme.js", HERE / "jupyter.css"

# With Jupyter's server, TCP delays a short message until the last one is acknowledged, which takes
# a browser on the same machine 40 ms; a message of two loopback packets is not delayed
MIN_MESSAGE = 2 * 65536  # [bytes]


class CanvasWidget(anywidget.AnyWidget):
    """Canvas with equal scale; dragging pans it, and Ctrl with the mouse wheel zooms. A page that
    opens the canvas shows ``frame()``, which is part of the widget's state.
    """

    _esm = script(LIVE, JUPYTER_THEME, HERE / "canvas.js")
    _css = styles(JUPYTER_STYLES)
    alt = traitlets.Unicode().tag(sync=True)
    title = traitlets.Unicode().tag(sync=True)
    width = traitlets.Int(720).tag(sync=True)
    height = traitlets.Int(480).tag(sync=True)
    frame = traitlets.Callable().tag(sync=True, to_json=lambda frame, _: frame())


class LiveCanvas(Screen):
    """Screen in the browser; ``alt`` describes the picture, and ``size`` is in CSS pixels."""

    keys = True

    def __init__(self, alt="", title="", size=(720, 480)):
        super().__init__(acknowledged=True)
        width, height = map(int, size)
        self._make = partial(CanvasWidget, alt=alt, title=title, width=width, height=height)
        self._packer, self._latest_scene = FramePacker(), Scene([])
        self._browser_ready, self._min_bytes = False, 0

    @cached_property
    def widget(self):
        widget = self._make(frame=self._full_frame)
        widget.on_msg(self._on_message)
        widget.comm.on_close(lambda *_: self.on_closed())
        return widget

    def offer(self, scene):
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
