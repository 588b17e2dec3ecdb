"""Ready worlds. In each a robot starts at the origin, heading along +x."""

import numpy as np

from slamlab.world import World


def ring(corners):
    """Walls round a closed polygon.

    Parameters
    ----------
    corners : (n, 2) [m], in order

    Returns
    -------
    (n, 4) rows x1 y1 x2 y2 [m]
    """
    corners = np.asarray(corners, dtype=float)
    return np.hstack([corners, np.roll(corners, -1, axis=0)])


def box(centre, size, turn=0.0):
    """The four walls of a turned rectangle.

    Parameters
    ----------
    centre : (2,) [m]
    size : (2,) length and width [m]
    turn : float [rad]

    Returns
    -------
    (4, 4) rows x1 y1 x2 y2 [m]
    """
    c, s = np.cos(turn), np.sin(turn)
    half = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * np.asarray(size) / 2
    return ring(half @ np.array([[c, s], [-s, c]]) + np.asarray(centre))


def room():
    """An irregular living room: one slanted wall, a niche, a cupboard, a table, a pillar."""
    outer = [(-1.5, -2.0), (5.5, -2.0), (5.5, 1.2), (4.0, 3.4), (1.2, 3.4), (1.2, 2.8), (-1.5, 2.8)]
    walls = [
        ring(outer),
        box((2.3, 0.9), (1.2, 0.7), np.radians(20)),
        box((-1.2, 1.6), (0.6, 1.4)),
        box((3.6, -1.75), (1.6, 0.5)),
    ]
    return World(np.concatenate(walls), [(4.4, 0.1, 0.22), (0.2, -1.5, 0.25)], "room")


def corridor():
    """A corridor 2 m wide round a rectangular block: start and end should meet.

    Niches, pillars and a cupboard stand along it: between bare walls a scan matcher cannot tell how
    far the robot went.
    """
    outer = [
        *[(-2.0, -1.0), (3.0, -1.0), (3.0, -1.4), (4.0, -1.4), (4.0, -1.0), (13.0, -1.0)],
        *[(13.0, 3.5), (13.4, 3.5), (13.4, 4.7), (13.0, 4.7), (13.0, 9.0)],
        *[(8.5, 9.0), (8.5, 9.5), (7.3, 9.5), (7.3, 9.0), (-2.0, 9.0)],
        *[(-2.0, 5.2), (-2.4, 5.2), (-2.4, 4.2), (-2.0, 4.2)],
    ]
    block = [
        *[(0.0, 1.0), (6.0, 1.0), (6.0, 1.4), (7.0, 1.4), (7.0, 1.0), (11.0, 1.0)],
        *[(11.0, 7.0), (3.5, 7.0), (3.5, 6.6), (2.3, 6.6), (2.3, 7.0), (0.0, 7.0)],
    ]
    cupboards = [box((9.3, -0.8), (1.2, 0.4)), box((11.2, 5.6), (0.4, 0.9))]
    pillars = [(1.3, 0.85, 0.15), (4.9, 8.8, 0.2), (-1.85, 1.9, 0.15)]
    return World(np.concatenate([ring(outer), ring(block), *cupboards]), pillars, "corridor")


def polygon():
    """Tuček's cardboard polygon: eight corners, a smaller box and a cylinder inside (§3.2).

    His figures give no measures: these fit his steps of 19 to 33 cm, and as with him no place sees
    every side. The origin is his first scanning place.
    """
    outer = [
        *[(-0.9, -1.5), (1.1, -1.5), (1.1, -0.3), (1.7, 0.1)],
        *[(1.7, 1.0), (0.3, 1.0), (0.1, 0.6), (-0.9, 0.6)],
    ]
    walls = np.concatenate([ring(outer), box((0.75, -0.42), (0.35, 0.25), np.radians(15))])
    return World(walls, [(-0.45, -0.75, 0.15)], "polygon")


WORLDS = {"room": room, "corridor": corridor, "polygon": polygon}


def by_name(name):
    """A ready world by its name.

    Parameters
    ----------
    name : str, a key of WORLDS

    Returns
    -------
    World

    Raises
    ------
    ValueError : there is no such world; the text lists those there are
    """
    if name not in WORLDS:
        raise ValueError(f"no world {name!r}; there are: {', '.join(WORLDS)}")
    return WORLDS[name]()
