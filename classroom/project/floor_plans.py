"""Random floor plans: rooms and corridors on a grid, with doors between them.

A plan consists of two words, one with a letter for each column, one with a letter for each row:
``r`` stands for the width of a room, ``c`` for the width of a corridor. A cell is part of a
corridor if its column or its row is ``c``."""

from dataclasses import dataclass

import numpy as np

DOOR = 1.0  # width of a door [m]
POST = 0.2  # least length of wall between a door and a corner [m]
ROOM, CORRIDOR = (3.2, 4.4), (1.6, 2.0)  # narrowest and widest [m]
SECOND_DOOR = 0.5  # chance of a room's second door to a corridor [1]
DOOR_BETWEEN_ROOMS = 0.25  # chance of a door in a wall between two rooms [1]


@dataclass(frozen=True)
class FloorPlan:
    """A floor plan without furniture."""

    walls: np.ndarray  # (n, 4) rows x1 y1 x2 y2 [m]
    cells: dict  # (column, row) to (x_min, y_min, x_max, y_max) [m]
    corridors: frozenset  # cells of corridors
    passages: dict  # pair of cells, in both orders, to the centre (2,) of their door [m]

    def neighbours(self, cell):
        """Return the cells that are connected to a cell, in a fixed order."""
        return sorted(b for a, b in self.passages if a == cell)

    def open_rooms(self):
        return sorted({a for a, _ in self.passages} - self.corridors)


def draw_floor_plan(columns, rows, rng, identical=False, closed=0.0):
    """Draw a floor from a plan. Raises ValueError if there is no corridor or only one room.

    identical : whether all rooms have the same size and door positions. closed : probability of
    a room without a door [1]; the first and the last room always have a door."""
    if set(columns + rows) - set("rc") or "c" not in columns + rows:
        raise ValueError(f"a plan must consist of r and at least one c, not {columns!r}, {rows!r}")
    if columns.count("r") * rows.count("r") < 2:
        raise ValueError(f"a plan needs at least two rooms, not {columns!r}, {rows!r}")
    x, y = _edges(columns, rng, identical), _edges(rows, rng, identical)
    cells = {
        (i, j): (x[i], y[j], x[i + 1], y[j + 1])
        for i in range(len(columns))
        for j in range(len(rows))
    }
    corridors = frozenset((i, j) for i, j in cells if "c" in (columns[i], rows[j]))
    positions = _door_positions(cells, corridors, rng, identical, closed)
    passages, walls = {}, _outer_walls(x[-1], y[-1])
    for a, b in _pairs(cells):
        start, end = _shared_edge(cells, a, b)
        if (a, b) in positions:
            direction = (end - start) / np.hypot(*(end - start))
            middle = start + positions[a, b] * (end - start)
            posts = [start, middle - direction * DOOR / 2, middle + direction * DOOR / 2, end]
            walls += [np.concatenate(posts[:2]), np.concatenate(posts[2:])]
            passages[a, b] = passages[b, a] = middle
        elif a in corridors and b in corridors:
            passages[a, b] = passages[b, a] = (start + end) / 2
        else:
            walls.append(np.concatenate([start, end]))
    return FloorPlan(np.array(walls), cells, corridors, passages)


def _edges(letters, rng, identical):
    spans = np.array([CORRIDOR if letter == "c" else ROOM for letter in letters])
    share = rng.random() * np.ones(len(letters)) if identical else rng.random(len(letters))
    return np.concatenate([[0.0], np.cumsum(spans[:, 0] + share * (spans[:, 1] - spans[:, 0]))])


def _door_positions(cells, corridors, rng, identical, closed):
    """Draw each door's position; the dict maps two cells to a share of their edge [1]."""
    doors, shut, rooms = [], set(), sorted(cells.keys() - corridors)
    for room in rooms:
        halls = [pair for pair in _pairs(cells) if room in pair and corridors & set(pair)]
        second, open_at_all = rng.random() < SECOND_DOOR, rng.random() >= closed
        open_at_all |= room in (rooms[0], rooms[-1])
        if identical:
            doors.append(halls[0])
        elif open_at_all:
            order = rng.permutation(len(halls))
            doors += [halls[k] for k in order[: 1 + second]]
        else:
            shut.add(room)
    if not identical:
        between = [pair for pair in _pairs(cells) if not (corridors | shut) & set(pair)]
        doors += [pair for pair in between if rng.random() < DOOR_BETWEEN_ROOMS]
    positions = {}
    for a, b in doors:
        start, end = _shared_edge(cells, a, b)
        margin = (DOOR / 2 + POST) / np.hypot(*(end - start))
        positions[a, b] = 0.5 if identical else rng.uniform(margin, 1 - margin)
    return positions


def _pairs(cells):
    """Yield each pair of neighbouring cells once, the left or lower cell first."""
    for i, j in sorted(cells):
        for neighbour in ((i + 1, j), (i, j + 1)):
            if neighbour in cells:
                yield (i, j), neighbour


def _shared_edge(cells, a, b):
    """Return the ends of the edge between a cell and its right or upper neighbour [m]."""
    x1, y1, x2, y2 = cells[a]
    first = (x2, y1) if b[0] > a[0] else (x1, y2)
    return np.array(first), np.array([x2, y2])


def _outer_walls(width, height):
    corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
    return [np.array([*corners[k], *corners[(k + 1) % 4]]) for k in range(4)]
