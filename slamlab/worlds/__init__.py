"""Worlds (ground-truth maps) of walls and circles, exact ray casting, ready worlds, world files.

Read in this order:

- ``world``: World, segments and circles as a range sensor sees them; ``ray_casting``: cast
- ``shapes``: boxes and rings that worlds are put together from
- ``rooms``, ``situations``, ``arena``: the ready worlds, by_name
- ``files``: worlds as text

In each ready world a robot starts at the origin, heading along +x.
"""

from slamlab.worlds.arena import arena, table_legs
from slamlab.worlds.files import load, parse, save, text_of
from slamlab.worlds.rooms import corridor, polygon, room, twins
from slamlab.worlds.shapes import box, ring
from slamlab.worlds.situations import situation_1, situation_2
from slamlab.worlds.world import World

__all__ = [
    "WORLDS",
    "World",
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
    """Look up a ready world by its name.

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
