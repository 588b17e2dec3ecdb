"""Canvas widget with handles (drag and drop): ends of walls and centres of circles are moved."""

from pathlib import Path

import anywidget
import numpy as np
import traitlets

from slamlab.views.colours import COLOURS
from slamlab.views.live.canvas import JUPYTER_STYLES, JUPYTER_THEME
from slamlab.views.player.library import DRAWING, script, styles

HERE = Path(__file__).parent


class Board(anywidget.AnyWidget):
    """World in the browser: points are dragged, or chosen by Tab and moved by the arrow keys.

    They snap to a grid of 0.05 m; with Shift they are free. What is moved is drawn at once and sent
    to the kernel as fast as it listens (back-pressure).

    Parameters
    ----------
    alt : str, what the picture shows, for who cannot see it
    world : dict of walls (n, 4) and circles (m, 3) as lists [m], and of edit, a number that the
        moves of one drag have in common
    scan : bytes, float32 x y of what a scanner sees [m]
    radius : float, of the robot at the origin [m]
    width, height : int [CSS pixels]; narrower where the notebook is
    """

    _esm = script(DRAWING, JUPYTER_THEME, HERE / "board.js")
    _css = styles(JUPYTER_STYLES, HERE / "board.css")
    alt = traitlets.Unicode().tag(sync=True)
    world = traitlets.Dict().tag(sync=True)
    scan = traitlets.Bytes().tag(sync=True)
    radius = traitlets.Float(0.15).tag(sync=True)
    colours = traitlets.Dict(COLOURS).tag(sync=True)
    width = traitlets.Int(520).tag(sync=True)
    height = traitlets.Int(450).tag(sync=True)


def world_message(world):
    """Message with a world (walls, circles) for the browser.

    Parameters
    ----------
    world : World

    Returns
    -------
    dict, see :class:`Board`
    """
    return {"walls": world.walls.tolist(), "circles": world.circles.tolist(), "edit": 0}


def points_bytes(points):
    """Bytes of points for the browser: float32, little-endian.

    Parameters
    ----------
    points : (n, 2) [m]

    Returns
    -------
    bytes
    """
    return np.asarray(points, dtype="<f4").tobytes()
