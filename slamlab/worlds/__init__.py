"""Ready worlds, and worlds from files. In each a robot starts at the origin, heading along +x."""

from slamlab.worlds.arena import arena, table_legs
from slamlab.worlds.files import load, parse, save, text_of
from slamlab.worlds.rooms import corridor, polygon, room, twins
from slamlab.worlds.shapes import box, ring
from slamlab.worlds.situations import situation_1, situation_2

__all__ = [
    "WORLDS",
    "arena",
    "box",
    "by_name",
    "corridor",
    "load",
    "parse",
    "polygon",
    "ring",
    "room",
    "save",
    "situation_1",
    "situation_2",
    "table_legs",
    "text_of",
    "twins",
]

WORLDS = {
    "room": room,
    "corridor": corridor,
    "twins": twins,
    "polygon": polygon,
    "situation-1": situation_1,
    "situation-2": situation_2,
    "arena": arena,
    "table-legs": table_legs,
}


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
