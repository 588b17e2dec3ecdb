"""Floor plans drawn at random: rooms and corridors on a lattice, and the doors between them.

A plan is two words, one letter a column and one a row: ``r`` is as wide as a room, ``c`` as a
corridor. A cell is corridor where its column or its row is, so two corridor columns that cross two
corridor rows make a loop.
"""

from dataclasses import dataclass

import numpy as np

DOOR = 1.0  # width of a door [m]
POST = 0.2  # least wall between a door and a corner [m]
ROOM, CORRIDOR = (3.2, 4.4), (1.6, 2.0)  # narrowest and widest [m]
SECOND_DOOR = 0.5  # chance of a room's second door to a corridor [1]
DOOR_BETWEEN_ROOMS = 0.25  # chance of a door in a wall between two rooms [1]


@dataclass(frozen=True)
class Floor:
    """A floor plan without furniture.

    Parameters
    ----------
    walls : (n, 4) rows x1 y1 x2 y2 [m]
    cells : dict, (column, row) to (x_min, y_min, x_max, y_max) [m]
    corridors : frozenset of cells that are corridor
    passages : dict, pair of neighbouring cells, in both orders, to (2,) the middle of the door or
        opening between them [m]
    """

    walls: np.ndarray
    cells: dict
    corridors: frozenset
    passages: dict

    def neighbours(self, cell):
        """The cells that one can walk to from a cell: list, in a fixed order."""
        return sorted(b for a, b in self.passages if a == cell)

    def open_rooms(self):
        """The rooms that have a door: list, in a fixed order."""
        return sorted({a for a, _ in self.passages} - self.corridors)


def draw_floor(columns, rows, rng, alike=False, closed=0.0):
    """Draw a floor: how wide its columns and rows are, and where its doors.

    Parameters
    ----------
    columns, rows : str of ``r`` and ``c``, one letter a column or row; at least one is ``c``
    rng : numpy.random.Generator
    alike : bool, whether all rooms have one size and their doors corresponding places
    closed : float, chance of a room to have no door; the first and the last have one [1]

    Returns
    -------
    Floor

    Raises
    ------
    ValueError : a letter that is none of the two, no corridor, fewer than two rooms
    """
    if set(columns + rows) - set("rc") or "c" not in columns + rows:
        raise ValueError(f"a plan is made of r and c, with a c at least: {columns!r}, {rows!r}")
    if columns.count("r") * rows.count("r") < 2:
        raise ValueError(f"a plan has two rooms to drive between: {columns!r}, {rows!r}")
    x, y = _edges(columns, rng, alike), _edges(rows, rng, alike)
    cells = {
        (i, j): (x[i], y[j], x[i + 1], y[j + 1])
        for i in range(len(columns))
        for j in range(len(rows))
    }
    corridors = frozenset((i, j) for i, j in cells if "c" in (columns[i], rows[j]))
    places = _places(cells, corridors, rng, alike, closed)
    passages, walls = {}, _outer_walls(x[-1], y[-1])
    for a, b in _pairs(cells):
        start, end = _shared_edge(cells, a, b)
        if (a, b) in places:
            way = (end - start) / np.hypot(*(end - start))
            middle = start + places[a, b] * (end - start)
            posts = [start, middle - way * DOOR / 2, middle + way * DOOR / 2, end]
            walls += [np.concatenate(posts[:2]), np.concatenate(posts[2:])]
            passages[a, b] = passages[b, a] = middle
        elif a in corridors and b in corridors:
            passages[a, b] = passages[b, a] = (start + end) / 2
        else:
            walls.append(np.concatenate([start, end]))
    return Floor(np.array(walls), cells, corridors, passages)


def _edges(letters, rng, alike):
    """Where the columns (or rows) begin and end [m]."""
    spans = np.array([CORRIDOR if letter == "c" else ROOM for letter in letters])
    share = rng.random() * np.ones(len(letters)) if alike else rng.random(len(letters))
    return np.concatenate([[0.0], np.cumsum(spans[:, 0] + share * (spans[:, 1] - spans[:, 0]))])


def _places(cells, corridors, rng, alike, closed):
    """Where along its wall each door stands: pair of cells to a share of the wall [1]."""
    doors, shut, rooms = [], set(), sorted(cells.keys() - corridors)
    for room in rooms:
        halls = [pair for pair in _pairs(cells) if room in pair and corridors & set(pair)]
        second, open_at_all = rng.random() < SECOND_DOOR, rng.random() >= closed
        open_at_all |= room in (rooms[0], rooms[-1])
        if alike:
            doors.append(halls[0])
        elif open_at_all:
            order = rng.permutation(len(halls))
            doors += [halls[k] for k in order[: 1 + second]]
        else:
            shut.add(room)
    if not alike:
        between = [pair for pair in _pairs(cells) if not (corridors | shut) & set(pair)]
        doors += [pair for pair in between if rng.random() < DOOR_BETWEEN_ROOMS]
    places = {}
    for a, b in doors:
        start, end = _shared_edge(cells, a, b)
        margin = (DOOR / 2 + POST) / np.hypot(*(end - start))
        places[a, b] = 0.5 if alike else rng.uniform(margin, 1 - margin)
    return places


def _pairs(cells):
    """Neighbouring cells, each pair once, the left or lower one first."""
    for i, j in sorted(cells):
        for neighbour in ((i + 1, j), (i, j + 1)):
            if neighbour in cells:
                yield (i, j), neighbour


def _shared_edge(cells, a, b):
    """The two ends of the edge that a cell shares with its right or upper neighbour [m]."""
    x1, y1, x2, y2 = cells[a]
    first = (x2, y1) if b[0] > a[0] else (x1, y2)
    return np.array(first), np.array([x2, y2])


def _outer_walls(width, height):
    corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
    return [np.array([*corners[k], *corners[(k + 1) % 4]]) for k in range(4)]
