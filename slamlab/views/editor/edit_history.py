"""Edit history of a world (undo): its text rows and its walls and circles, kept in step."""

import numpy as np

from slamlab.layers import Points, Poses, Segments
from slamlab.views.colours import COLOURS
from slamlab.views.figures import axes
from slamlab.views.layer_drawing import draw
from slamlab.worlds.files import WorldFileError, parse, text_of
from slamlab.worlds.world import World


class WorldEditor:
    """Model of a world being edited, with undo; ``world`` is the last one without an error.

    Parameters
    ----------
    world : World
    scan : (World) -> (n, 2) points in the world that a scanner at the origin sees [m], or None

    ``text`` are the rows of that world; ``error`` says what is wrong with rows that were typed
    since, or is empty.
    """

    def __init__(self, world, scan=None):
        self.world, self.scan = world, scan
        self.text, self.error = text_of(world), ""
        self._undo_stack, self._edit = [], None

    def edit_text(self, text):
        """Edit the text rows: parse what was typed.

        Parameters
        ----------
        text : str
        """
        self.error = ""
        if text == self.text:
            return
        try:
            world = parse(text, self.world.name)
        except WorldFileError as error:
            self.error = str(error)
            return
        self._record_change(world, text)

    def move(self, walls, circles, edit=None):
        """Move walls and circles; of the text rows only the numbers change.

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
        self.error = ""
        self._record_change(world, replace_numbers(self.text, world), edit)

    def undo(self):
        """Undo the last change; harmless when there was none."""
        self.error, self._edit = "", None
        if self._undo_stack:
            self.world, self.text = self._undo_stack.pop()

    def scan_points(self):
        """Scan points that the scanner measures in the world.

        Returns
        -------
        (n, 2) [m]
        """
        points = np.empty((0, 2)) if self.scan is None else self.scan(self.world)
        return np.asarray(points, dtype=float).reshape(-1, 2)

    def figure(self):
        """Figure of the world, with the error message of its rows, if any.

        Returns
        -------
        Figure
        """
        count = f"{len(self.world.walls)} walls, {len(self.world.circles)} circles"
        fig, ax = axes(f"{self.world.name}: {count}")
        draw(ax, Segments("walls", self.world.outline()))
        if self.scan is not None:
            draw(ax, Points("scan", self.scan_points()))
        draw(ax, Poses("robot", np.zeros(3)))
        if self.error:
            title = f"Not drawn: {self.error}"
            ax.set_title(title, color=COLOURS["naive"], wrap=True, fontsize="medium")
        return fig

    def _record_change(self, world, text, edit=None):
        if edit is None or edit != self._edit:
            self._undo_stack.append((self.world, self.text))
        self.world, self.text, self._edit = world, text, edit


def replace_numbers(text, world):
    """Replace the numbers in text rows by those of a world; lines, order and remarks stay.

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
