"""A world being edited: its rows and what they stand for, in step; changes can be undone."""

import numpy as np

from slamlab.layers import Points, Poses, Segments
from slamlab.views.figures import axes
from slamlab.views.layers import draw
from slamlab.world import World
from slamlab.worlds.files import WorldFileError, parse, text_of


class WorldEditor:
    """What :func:`edit_world` returns; ``world`` is the last one without a mistake.

    Parameters
    ----------
    world : World
    scan : (World) -> (n, 2) points in the world that a scanner at the origin sees [m], or None

    ``text`` are the rows of that world; ``wrong`` says what is wrong with rows that were typed
    since, or is empty.
    """

    def __init__(self, world, scan=None):
        self.world, self.scan = world, scan
        self.text, self.wrong = text_of(world), ""
        self._before, self._edit = [], None

    def type(self, text):
        """Take rows as they were typed.

        Parameters
        ----------
        text : str
        """
        self.wrong = ""
        if text == self.text:
            return
        try:
            world = parse(text, self.world.name)
        except WorldFileError as error:
            self.wrong = str(error)
            return
        self._keep(world, text)

    def move(self, walls, circles, edit=None):
        """Take walls and circles that were moved; of rows only their numbers change.

        Parameters
        ----------
        walls : (n, 4) as many as there are [m]
        circles : (m, 3) as many as there are [m]
        edit : what the moves of one drag have in common: they are undone together

        Raises
        ------
        ValueError : other walls or circles than there are, or impossible ones
        """
        world = World(walls, circles, self.world.name)
        if (len(world.walls), len(world.circles)) != (
            len(self.world.walls),
            len(self.world.circles),
        ):
            raise ValueError("a move neither adds nor removes walls or circles")
        self.wrong = ""
        self._keep(world, renumbered(self.text, world), edit)

    def undo(self):
        """Go back to before the last change; harmless when there was none."""
        self.wrong, self._edit = "", None
        if self._before:
            self.world, self.text = self._before.pop()

    def seen(self):
        """What the scanner sees.

        Returns
        -------
        (n, 2) [m]
        """
        points = np.empty((0, 2)) if self.scan is None else self.scan(self.world)
        return np.asarray(points, dtype=float).reshape(-1, 2)

    def figure(self):
        """The world, and what is wrong with the rows, if anything.

        Returns
        -------
        Figure
        """
        count = f"{len(self.world.walls)} walls, {len(self.world.circles)} circles"
        fig, ax = axes(f"{self.world.name}: {count}")
        draw(ax, Segments("walls", self.world.outline()))
        if self.scan is not None:
            draw(ax, Points("scan", self.seen()))
        draw(ax, Poses("robot", np.zeros(3)))
        if self.wrong:
            title = f"Not drawn: {self.wrong}"
            ax.set_title(title, color="#D55E00", wrap=True, fontsize="medium")
        return fig

    def _keep(self, world, text, edit=None):
        if edit is None or edit != self._edit:
            self._before.append((self.world, self.text))
        self.world, self.text, self._edit = world, text, edit


def renumbered(text, world):
    """Rows with the numbers of a world; lines, their order and remarks stay.

    Parameters
    ----------
    text : str, rows of a world with as many walls and circles
    world : World

    Returns
    -------
    str
    """
    left = {4: iter(world.walls.tolist()), 3: iter(world.circles.tolist())}
    lines = []
    for line in text.splitlines():
        numbers, mark, remark = line.partition("#")
        words = numbers.replace(",", " ").split()
        row = next(left[len(words)]) if words else []
        if row != [float(word) for word in words]:
            line = " ".join(f"{value!r}" for value in row)
            line += f"  {mark}{remark}" if mark else ""
        lines.append(line + "\n")
    return "".join(lines)
