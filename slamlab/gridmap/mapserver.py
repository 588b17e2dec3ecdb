"""Grids as ROS' map_server keeps them: a picture, and a few lines of YAML that say where it lies.

A free cell is 254 (white), an occupied one 0 (black), an unknown one 205; the picture's lowest row
is row 0. ``origin`` is where its lower left corner lies: x, y and yaw [m, m, rad].
"""

import json
from pathlib import Path

import numpy as np
from PIL import Image

from slamlab.gridmap.grid import FREE, OCCUPIED, OccupancyGrid
from slamlab.sources.base import SourceError
from slamlab.sources.text import read_bytes, reason

PIXELS = np.array([254, 0, 205], np.uint8)  # of the states 0, 1 and −1
KEYS = ("image", "resolution", "origin")  # without which a map lies nowhere


def save(grid, path):
    """Write a grid as ``NAME.yaml`` and, beside it, ``NAME.png``.

    Parameters
    ----------
    grid : OccupancyGrid
    path : str or Path, with or without an ending

    Returns
    -------
    Path, of the YAML file

    Raises
    ------
    SourceError : nothing has been seen yet; a file cannot be written
    """
    path = Path(path)
    path = path if path.suffix == ".yaml" else path.with_name(path.name + ".yaml")
    picture = path.with_suffix(".png")
    if not grid.states.size:
        raise SourceError(f"{path} is not written: the grid has no cell yet")
    x, y = grid.origin.tolist()
    text = (
        f"image: {json.dumps(picture.name)}\nmode: trinary\nresolution: {grid.resolution!r}\n"
        f"origin: [{x!r}, {y!r}, 0.0]\nnegate: 0\n"
        f"occupied_thresh: {OCCUPIED}\nfree_thresh: {FREE}\n"
    )
    try:
        Image.fromarray(PIXELS[grid.states[::-1]]).save(picture)
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise SourceError(f"{path} cannot be written: {reason(error)}") from None
    return path


def load(path):
    """A grid from its YAML file and the picture that this names.

    Parameters
    ----------
    path : str or Path, of the YAML file

    Returns
    -------
    OccupancyGrid, every known cell as certain as can be

    Raises
    ------
    SourceError : a file cannot be read, or what is wrong in it
    """
    path = Path(path)
    settings = _settings(path)
    try:
        with Image.open(path.parent / settings["image"]) as picture:
            grey = np.asarray(picture.convert("L"), dtype=float)[::-1]
    except OSError as error:
        raise SourceError(f"{path}: its picture cannot be read: {reason(error)}") from None
    x, y, yaw = settings["origin"]
    if yaw:
        raise SourceError(f"{path}: the map is turned by {yaw} rad, which slamlab does not read")
    p = (grey if settings["negate"] else 255 - grey) / 255
    occupied, free = p > settings["occupied_thresh"], p < settings["free_thresh"]
    try:
        grid = OccupancyGrid(settings["resolution"], (x, y))
    except ValueError as error:
        raise SourceError(f"{path}: {error}") from None
    grid.set(np.select([occupied, free], [1, 0], -1))
    return grid


def _settings(path):
    """What the YAML file says, checked."""
    found = {"negate": 0, "occupied_thresh": OCCUPIED, "free_thresh": FREE, "mode": "trinary"}
    content, _ = read_bytes(path)
    try:
        found |= _parsed(content.decode("utf-8"))
        missing = [key for key in KEYS if key not in found]
        if missing:
            raise SourceError(f"{path} is no map's YAML: it says nothing of {missing[0]}")
        if found["mode"] not in ("trinary", "scale"):
            raise SourceError(
                f"{path}: maps of mode {found['mode']} are not read, trinary ones are"
            )
        for key in ("resolution", "negate", "occupied_thresh", "free_thresh"):
            found[key] = float(found[key])
        found["origin"] = [float(number) for number in found["origin"]]
        if len(found["origin"]) != 3 or not np.isfinite(found["origin"]).all():
            raise ValueError
    except (ValueError, TypeError) as error:
        if isinstance(error, SourceError):
            raise
        raise SourceError(f"{path} is no YAML of a map: see ROS' map_server") from None
    return found


def _parsed(text):
    """Keys and values of flat YAML, which is all that map_server writes: scalars and one list."""
    found, key = {}, None
    for line in text.splitlines():
        line = line.partition(" #")[0].rstrip()
        if not line or line.startswith(("#", "---")):
            continue
        if line.lstrip().startswith("- "):  # an entry of the list that the last key began
            found[key] = [*(found.get(key) or []), _scalar(line.lstrip()[2:])]
            continue
        key, _, value = line.partition(":")
        key, value = key.strip(), value.strip()
        if value.startswith("["):
            found[key] = [_scalar(word) for word in value.strip("[]").split(",")]
        else:
            found[key] = _scalar(value)
    return found


def _scalar(word):
    """A word without its quotes; None for an empty one."""
    return word.strip().strip("'\"") or None
