"""Tours through a floor: a walk from room to room, and its waypoints."""

from collections import deque

import numpy as np

BEFORE_DOOR = 0.45  # from a door's middle to the waypoints on either side of it [m]
FROM_WALL = 0.7  # of a goal inside a room, at least [m]


def shortest(floor, start, goal, without=frozenset()):
    """Shortest way between two cells by the number of doors (breadth first).

    Parameters
    ----------
    floor : Floor
    start, goal : cells
    without : set of cells that the way keeps off

    Returns
    -------
    list of cells, empty where there is no way
    """
    before, waiting = {start: None}, deque([start])
    while waiting and goal not in before:
        cell = waiting.popleft()
        for neighbour in floor.neighbours(cell):
            if neighbour not in before and neighbour not in without:
                before[neighbour] = cell
                waiting.append(neighbour)
    way = [goal] if goal in before else []
    while way and before[way[-1]] is not None:
        way.append(before[way[-1]])
    return way[::-1]


def way_back(floor, cells):
    """The way back to where a walk began, through cells not seen before if that can be: a loop."""
    first, last = cells[0], cells[-1]
    # next to its ends the loop has no choice
    ends = {first, last, *floor.neighbours(first), *floor.neighbours(last)}
    return shortest(floor, last, first, set(cells) - ends) or shortest(floor, last, first)


def draw_goals(floor, rng):
    """A place to drive to in each cell: the middle of a corridor's, somewhere in a room.

    Parameters
    ----------
    floor : Floor
    rng : numpy.random.Generator

    Returns
    -------
    dict, cell to (2,) [m]
    """
    goals = {}
    for cell, (x1, y1, x2, y2) in sorted(floor.cells.items()):
        low, high = np.array([x1, y1]) + FROM_WALL, np.array([x2, y2]) - FROM_WALL
        place = rng.uniform(np.minimum(low, high), np.maximum(low, high))
        goals[cell] = (low + high) / 2 if cell in floor.corridors else place
    return goals


def waypoints(floor, cells, goals):
    """The waypoints of a walk: through the doors' middles, in each room by its goal.

    Straight lines between them stay inside cells, which are convex, or run through doors.

    Parameters
    ----------
    floor : Floor
    cells : list of cells, neighbours in order
    goals : dict, cell to (2,) [m]

    Returns
    -------
    (n, 2) [m]
    """
    points = [goals[cells[0]]]
    for a, b in zip(cells, [*cells[1:], None], strict=True):
        if a not in floor.corridors or b is None:
            points.append(goals[a])
        if b is not None:
            middle = floor.passages[a, b]
            across = np.subtract(b, a) * BEFORE_DOOR
            if {a, b} <= floor.corridors:
                points.append(middle)
            else:
                points += [middle - across, middle + across]
    points = np.array(points, dtype=float)
    far = np.hypot(*np.diff(points, axis=0).T) > 0.05
    return points[np.concatenate([[True], far])]


def length(points):
    """Length of a way through points (n, 2) [m]."""
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def draw_tour(floor, goals, rng, metres, rooms=None, start=None, back=True):
    """Draw a walk of at least a length: from room to room in random order, at the end back.

    Parameters
    ----------
    floor : Floor
    goals : dict, cell to (2,) [m]
    rng : numpy.random.Generator
    metres : float, length from which on no further room is visited [m]
    rooms : list of cells to visit; fewer than two, or None, for all rooms with a door
    start : cell, or None to draw a room
    back : bool, whether it ends where it began, by another way if there is one

    Returns
    -------
    list of cells
    """
    if rooms is None or len(rooms) < 2:
        rooms = floor.open_rooms()
    if start is None:
        start = rooms[rng.integers(len(rooms))]
    cells, unseen = [start], []
    while True:
        whole = cells + (way_back(floor, cells)[1:] if back else [])
        if length(waypoints(floor, whole, goals)) >= metres:
            return whole
        # all rooms once, in random order, before any is seen again
        unseen = unseen or [rooms[k] for k in rng.permutation(len(rooms))]
        cells = cells + shortest(floor, cells[-1], unseen.pop())[1:]
