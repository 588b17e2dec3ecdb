"""Canvas widget of the world editor: drag handles at ends of walls and centres of circles."""

from pathlib import Path

from slamlab.extras import needs
from slamlab.live.canvas import JUPYTER_STYLES, JUPYTER_THEME
from slamlab.live.player.script_bundle import DRAWING, script, styles
from slamlab.views.colours import COLOURS

with needs("notebook"):
    import anywidget
    import traitlets

HERE = Path(__file__).parent


class WorldCanvas(anywidget.AnyWidget):
    """World in the browser. The world's points can be dragged, or selected with Tab and moved with
    the arrow keys. Points snap to a grid of 0.05 m, or 0.01 m with Shift. ``world`` contains walls
    (n, 4), circles (m, 3) [m] and edit, the number of the drag. ``scan``: x y [m] as float32.
    """

    _esm = script(DRAWING, JUPYTER_THEME, HERE / "world_canvas.js")
    _css = styles(JUPYTER_STYLES, HERE / "world_canvas.css")
    alt = traitlets.Unicode().tag(sync=True)
    world = traitlets.Dict().tag(sync=True)
    scan = traitlets.Bytes().tag(sync=True)
    radius = traitlets.Float(0.15).tag(sync=True)
    colours = traitlets.Dict(COLOURS).tag(sync=True)
    width = traitlets.Int(520).tag(sync=True)
    height = traitlets.Int(450).tag(sync=True)
