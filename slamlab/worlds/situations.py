"""Ready worlds: Smolec's two situations (§3.3, §4.5), after his text: he gives no measures."""

import numpy as np

from slamlab.worlds.shapes import ring
from slamlab.worlds.world import World


def situation_1():
    """Rooms off a corridor, doors opposite each other; the robot starts in the lower left room.

    Through its door it sees the door across the corridor and the far wall of the room behind.
    """
    walls = [
        ring([(-2.0, -2.0), (8.0, -2.0), (8.0, 7.5), (-2.0, 7.5)]),
        # the corridor runs along y from 2 to 3.5; a door 1 m wide leads into each of four rooms
        _with_doors((-2.0, 2.0), (8.0, 2.0), [2.0, 7.0], 1.0),
        _with_doors((-2.0, 3.5), (8.0, 3.5), [2.0, 7.0], 1.0),
        [[3.0, -2.0, 3.0, 2.0], [3.5, 3.5, 3.5, 7.5]],
    ]
    return World(np.concatenate(walls), name="situation-1")


def situation_2():
    """An irregular room with one slanted wall; the robot starts in its upper right."""
    corners = [
        *[(1.8, 1.5), (-2.6, 1.5), (-2.6, -0.4), (-5.2, -0.4)],
        *[(-5.2, -4.6), (-2.4, -4.6), (-2.4, -3.2), (-0.4, -3.2), (1.8, -1.6)],
    ]
    return World(ring(corners), name="situation-2")


def _with_doors(start, end, along, width):
    """A wall with openings: centres ``along`` it from its start, each ``width`` wide [m]."""
    start, end = np.array(start), np.array(end)
    way = (end - start) / np.hypot(*(end - start))
    posts = [start]
    for centre in along:
        posts += [start + way * (centre - width / 2), start + way * (centre + width / 2)]
    posts.append(end)
    return np.array(posts).reshape(-1, 4)
