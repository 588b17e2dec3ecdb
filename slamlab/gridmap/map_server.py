"""ROS map_server files of an occupancy grid: load and save an image and its YAML.

A free cell is 254 (white), an occupied one 0 (black), an unknown one 205; the picture's lowest row
is row 0. ``origin`` is where its lower left corner lies: x, y and yaw [m, m, rad].
"""

import json
from pathlib import Path

import numpy as np
from PIL import Image

from slamlab.files.errors import SourceError
from slamlab.files.text_files import read_bytes, reason
from slamlab.gridmap.occupancy_grid import FREE, OCCUPIED, OccupancyGrid

PIXELS = np.array([254, 0, 205], np.uint8)  # grey values of the states 0, 1 and −1
REQUIRED_KEYS = ("image", "resolution", "origin")  # of the YAML file


def save(grid, path):
    """Save an occupancy grid as ``NAME.yaml`` and, beside it, the image ``NAME.png``.

    Parameters
    ----------
    grid : OccupancyGrid
    path : str or Path, with or without a suffix

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
    """Load an occupancy grid from its YAML file and the image that this names.

    Parameters
    ----------
    path : str or Path, of the YAML file

    Returns
    -------
    OccupancyGrid, every known cell at the clamp of its log-odds

    Raises
    ------
    SourceError : a file cannot be read, or what is wrong in it
    """
    path = Path(path)
    settings = _read_yaml(path)
    try:
        with Image.open(path.parent / settings["image"]) as picture:
            grey = np.asarray(picture.convert("L"), dtype=float)[::-1]
    except OSError as error:
        raise SourceError(f"{path}: its image cannot be read: {reason(error)}") from None
    x, y, yaw = settings["origin"]
    if yaw:
        raise SourceError(f"{path}: the map is rotated by {yaw} rad, which slamlab does not read")
    p = (grey if settings["negate"] else 255 - grey) / 255
    occupied, free = p > settings["occupied_thresh"], p < settings["free_thresh"]
    try:
        grid = OccupancyGrid(settings["resolution"], (x, y))
    except ValueError as error:
        raise SourceError(f"{path}: {error}") from None
    grid.set(np.select([occupied, free], [1, 0], -1))
    return grid


def _read_yaml(path):
    """Read and check the settings of the YAML file."""
    found = {"negate": 0, "occupied_thresh": OCCUPIED, "free_thresh": FREE, "mode": "trinary"}
    content, _ = read_bytes(path)
    try:
        found |= _parse_flat_yaml(content.decode("utf-8"))
        missing = [key for key in REQUIRED_KEYS if key not in found]
        if missing:
            raise SourceError(f"{path} is no map's YAML: the key {missing[0]} is missing")
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


def _parse_flat_yaml(text):
    """Parse flat YAML, which is all that map_server writes: keys with scalars, and one list."""
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
    """Scalar of YAML without its quotes; None for an empty one."""
    return word.strip().strip("'\"") or None
