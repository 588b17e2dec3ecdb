"""Edit history (undo) of a world: its text rows, walls and circles."""

import numpy as np

from slamlab.layers import Points, Poses, Segments
from slamlab.simulation.worlds.world import World
from slamlab.simulation.worlds.world_files import WorldFileError, parse, text_of
from slamlab.views.colours import COLOURS
from slamlab.views.figures import axes
from slamlab.views.layer_drawing import draw


class WorldEditor:
    """Model of a world being edited, with undo.

    ``world`` is the last valid world, and ``text`` contains its rows; ``error`` explains the fault
    in the rows typed since then.

    Parameters
    ----------
    world : World
    scan : (World) -> (n, 2) points of a scan from the origin [m], or None
    """

    def __init__(self, world, scan=None):
        self.world, self.scan = world, scan
        self.text, self.error = text_of(world), ""
        self._undo_stack, self._edit = [], None

    def edit_text(self, text):
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
        """Move walls (n, 4) and circles (m, 3) [m]; moves of one ``edit`` are undone together.
        ValueError: a wall or circle is added, missing or impossible.
        """
        world = World(walls, circles, self.world.name)
        if (len(world.walls), len(world.circles)) != (
            len(self.world.walls),
            len(self.world.circles),
        ):
            raise ValueError("a move must not add or remove walls or circles")
        self.error = ""
        self._record_change(world, replace_numbers(self.text, world), edit)

    def undo(self):
        self.error, self._edit = "", None
        if self._undo_stack:
            self.world, self.text = self._undo_stack.pop()

    def scan_points(self):
        """Return the scanned points (n, 2) [m]."""
        points = np.empty((0, 2)) if self.scan is None else self.scan(self.world)
        return np.asarray(points, dtype=float).reshape(-1, 2)

    def figure(self):
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
    """Replace the numbers in text rows with those of a world."""
    remaining = {4: iter(world.walls.tolist()), 3: iter(world.circles.tolist())}
    lines = []
    for line in text.splitlines():
        numbers, hash_sign, comment = line.partition("#")
        fields = numbers.replace(",", " ").split()
        row = next(remaining[len(fields)]) if fields else []
        if row != [float(number) for number in fields]:
            line = " ".join(f"{value!r}" for value in row)
            line += f"  {hash_sign}{comment}" if hash_sign else ""
        lines.append(line + "\n")
    return "".join(lines)
