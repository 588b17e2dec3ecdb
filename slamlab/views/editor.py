"""A world edited by its numbers: rows of walls and circles beside what they look like."""

import html

import ipywidgets
import numpy as np

from slamlab.layers import Points, Poses, Segments
from slamlab.views.figures import axes
from slamlab.views.layers import draw
from slamlab.views.widgets import explore
from slamlab.worlds.files import WorldFileError, parse, text_of


class WorldEditor:
    """What :func:`edit_world` returns; ``world`` is the last one without a mistake.

    Parameters
    ----------
    world : World
    scan : (World) -> (n, 2) points in the world that a scanner at the origin sees [m], or None
    """

    def __init__(self, world, scan=None):
        self.world, self.scan = world, scan

    def figure(self, rows):
        """The world that rows say, or the last right one and what is wrong with the rows.

        Parameters
        ----------
        rows : str

        Returns
        -------
        Figure
        """
        title = f"{self.world.name}: {{}} walls, {{}} circles"
        wrong = None
        try:
            self.world = parse(rows, self.world.name)
        except WorldFileError as error:
            wrong = str(error)
        fig, ax = axes(title.format(len(self.world.walls), len(self.world.circles)))
        draw(ax, Segments("walls", self.world.outline()))
        if self.scan is not None:
            draw(ax, Points("scan", self.scan(self.world)))
        draw(ax, Poses("robot", np.zeros(3)))
        if wrong:
            ax.set_title(f"Not drawn: {wrong}", color="#D55E00", wrap=True, fontsize="medium")
        return fig


def edit_world(world, alt, scan=None):
    """Show a world and its rows; change a number, click outside, and it is drawn anew.

    Parameters
    ----------
    world : World
    alt : str, what the first figure shows
    scan : (World) -> (n, 2) points to draw, or None

    Returns
    -------
    WorldEditor, whose ``world`` follows what is typed
    """
    editor = WorldEditor(world, scan)
    layout = ipywidgets.Layout(width="28em", height="14em")
    rows = ipywidgets.Textarea(text_of(world), layout=layout)
    rows.tooltip = html.escape("x1 y1 x2 y2: a wall; x y radius: a circle [m]")
    explore(editor.figure, alt, rows=rows)
    return editor
