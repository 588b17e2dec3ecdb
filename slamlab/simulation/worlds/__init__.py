"""Worlds (ground-truth maps) of walls and circles; robots start at the origin, facing +x.

Read in this order: ``world`` (World, box, ring), ``ray_casting``, ``rooms`` and ``flats``
(predefined worlds), ``world_files`` (text files of worlds).
"""

from slamlab.simulation.worlds.flats import flat, flat_2, flat_3
from slamlab.simulation.worlds.rooms import (
    arena,
    corridor,
    polygon,
    room,
    situation_1,
    situation_2,
    table_legs,
    twins,
)
from slamlab.simulation.worlds.world import World, box, ring
from slamlab.simulation.worlds.world_files import load, parse, save, text_of

__all__ = ["WORLDS", "World", "arena", "box", "by_name", "corridor", "flat", "flat_2", "flat_3"]
__all__ += ["load", "parse", "polygon", "ring", "room", "save", "situation_1", "situation_2"]
__all__ += ["table_legs", "text_of", "twins"]

WORLDS = {
    "room": room,
    "corridor": corridor,
    "twins": twins,
    "polygon": polygon,
    "situation-1": situation_1,
    "situation-2": situation_2,
    "arena": arena,
    "table-legs": table_legs,
    "flat": flat,
    "flat-2": flat_2,
    "flat-3": flat_3,
}


def by_name(name):
    """Create a predefined World.

    name : str, a key of WORLDS. Raises ValueError.
    """
    if name not in WORLDS:
        raise ValueError(f"there is no world {name!r}; available: {', '.join(WORLDS)}")
    return WORLDS[name]()
