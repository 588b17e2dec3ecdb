"""Routes through a floor plan: shortest paths (breadth-first search) and waypoints."""

from collections import deque

import numpy as np

BEFORE_DOOR = 0.45  # from the centre of a door to the waypoints on either side of it [m]
FROM_WALL = 0.7  # least distance of a goal in a room from the walls [m]


def shortest(floor, start, goal, without=frozenset()):
    """Find the path with the fewest doors between two cells (breadth-first search), or return [].

    without : cells to avoid."""
    before, waiting = {start: None}, deque([start])
    while waiting and goal not in before:
        cell = waiting.popleft()
        for neighbour in floor.neighbours(cell):
            if neighbour not in before and neighbour not in without:
                before[neighbour] = cell
                waiting.append(neighbour)
    path = [goal] if goal in before else []
    while path and before[path[-1]] is not None:
        path.append(before[path[-1]])
    return path[::-1]


def return_path(floor, cells):
    """Find the path back to the start of a route, through new cells if possible: a loop."""
    first, last = cells[0], cells[-1]
    # at the ends of the loop there may be no other cells
    ends = {first, last, *floor.neighbours(first), *floor.neighbours(last)}
    return shortest(floor, last, first, set(cells) - ends) or shortest(floor, last, first)


def draw_goals(floor, rng):
    """Draw a position (2,) [m] in each cell: random in a room, the centre in a corridor."""
    goals = {}
    for cell, (x1, y1, x2, y2) in sorted(floor.cells.items()):
        low, high = np.array([x1, y1]) + FROM_WALL, np.array([x2, y2]) - FROM_WALL
        position = rng.uniform(np.minimum(low, high), np.maximum(low, high))
        goals[cell] = (low + high) / 2 if cell in floor.corridors else position
    return goals


def waypoints(floor, cells, goals):
    """Return the waypoints of a route, (n, 2) [m]: centres of doors, goals in rooms.

    Straight lines between waypoints stay inside cells, which are convex, or pass through doors."""
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
    """Compute the length of a path through points (n, 2) [m]."""
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def draw_route(floor, goals, rng, metres, rooms=None, start=None, back=True):
    """Draw a route of at least ``metres`` [m] from room to room.

    rooms : None, or fewer than two, for all rooms with a door. start : None for a random room.
    back : whether the route ends at its start."""
    if rooms is None or len(rooms) < 2:
        rooms = floor.open_rooms()
    if start is None:
        start = rooms[rng.integers(len(rooms))]
    cells, unseen = [start], []
    while True:
        whole = cells + (return_path(floor, cells)[1:] if back else [])
        if length(waypoints(floor, whole, goals)) >= metres:
            return whole
        # visit all rooms once, in random order, before any room again
        unseen = unseen or [rooms[k] for k in rng.permutation(len(rooms))]
        cells = cells + shortest(floor, cells[-1], unseen.pop())[1:]
