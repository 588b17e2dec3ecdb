"""Loading and saving of occupancy grids as ROS map_server files: an image and its YAML file. Free
cells are 254, occupied 0, unknown 205. Row 0 is the lowest; ``origin`` is the lower left corner."""

import json
import warnings
from pathlib import Path

import numpy as np
from PIL import Image, UnidentifiedImageError

from slamlab.files import SourceError, reason
from slamlab.gridmap.map_yaml import read_settings
from slamlab.gridmap.occupancy_grid import CLAMP, FREE, MAX_CELLS, OCCUPIED, OccupancyGrid, log_odds

PIXELS = np.array([254, 0, 205], np.uint8)  # grey values of the states 0, 1 and −1
FORMATS = "PPM", "PNG", "BMP", "GIF", "JPEG", "TIFF", "TGA", "WEBP"  # Pillow's names; PPM: PGM, too
MAX_YAW = 1e-6  # largest yaw of a map without rotation [rad]


def save(grid, path):
    """Save for the ROS map_server: ``NAME.yaml``, whose path is returned, and ``NAME.png``."""
    path = Path(path)
    path = path if path.suffix == ".yaml" else path.with_name(path.name + ".yaml")
    picture = path.with_suffix(".png")
    if not grid.states.size:
        raise SourceError(f"{path} cannot be written: the grid has no cells")
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
    """Load an OccupancyGrid from its YAML file; free and occupied cells get the clamp's values.

    The modes are those of the map_server. ``trinary`` compares the mean of all channels, including
    alpha, with the thresholds. ``scale`` interpolates the colours' mean between the thresholds;
    transparent pixels are unknown. ``raw``: pixels are per cent; values above 100 are unknown.
    """
    path = Path(path)
    settings = read_settings(path)
    x, y, yaw = settings.origin
    if abs(yaw) > MAX_YAW:
        raise SourceError(
            f"{path}: the map is rotated by {yaw:g} rad, which is not supported: rotate its image "
            "about the lower left corner, and set the third number of the origin to 0"
        )
    try:
        grid = OccupancyGrid(settings.resolution, (x, y))
    except ValueError as error:
        raise SourceError(f"{path}: {error}") from None
    brightness, white, clear = _read_image(path, settings)
    percent = _percent(np.arange(white + 1), white, settings)
    grid.set(np.select([percent == 100, percent == 0], [1, 0], -1).astype(np.int8)[brightness])
    if settings.mode != "trinary":
        most = log_odds(CLAMP)
        p = np.where(percent < 0, 50, percent).clip(1, 99) / 100
        grid.log_odds[:] = np.where(clear, log_odds(p).clip(-most, most)[brightness], 0)
    return grid


def _percent(level, white, settings):
    """Return the occupancy [%] for each brightness from 0 to ``white``; −1 means unknown."""
    if settings.mode == "raw":
        percent = np.rint(level / white * 255)
        return np.where(percent <= 100, percent, -1)
    occupancy = (level if settings.negate else white - level) / white
    free, occupied = settings.free_thresh, settings.occupied_thresh
    percent = np.full(len(level), -1.0)
    if settings.mode == "scale":
        percent = np.rint((occupancy - free) / max(occupied - free, 1e-12) * 100)
    return np.select([occupancy > occupied, occupancy < free], [100, 0], percent)


def _read_image(path, settings):
    """Return the pixels' brightness (lowest row first), white's, and a mask of opaque pixels."""
    file = path.parent / settings.image
    where = f"{path}: its image {file}"
    if not file.is_file():
        raise SourceError(
            f"{where} does not exist: write the path of the image relative to the YAML file"
        )
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # Pillow's warnings on sizes, which are checked here
            with Image.open(file, formats=FORMATS) as picture:
                if picture.width * picture.height > MAX_CELLS:
                    raise Image.DecompressionBombError
                brightness, white, clear = _grey(picture, where, settings.mode == "trinary")
    except SourceError:
        raise
    except Image.DecompressionBombError:
        raise SourceError(f"{where} has more than {MAX_CELLS} pixels: crop or scale it") from None
    except UnidentifiedImageError:
        kinds = ", ".join(FORMATS).replace("PPM", "PGM")
        raise SourceError(f"{where} is not a supported image; use {kinds}") from None
    except Exception:  # Pillow raises errors of many kinds for a damaged image
        raise SourceError(f"{where} cannot be read: it is damaged or truncated") from None
    return brightness[::-1], white, clear[::-1]


def _grey(picture, where, with_alpha):
    """Return pixels' brightness (sum of channels), white's brightness, a mask of opaque pixels."""
    if picture.mode.startswith(("I", "F")):  # more than 8 bit
        grey, opaque = np.asarray(picture), np.ones((1, 1), bool)
        wide = "F" in picture.mode or grey.min() < 0 or grey.max() >= 1 << 16
        if wide or "transparency" in picture.info:
            raise SourceError(
                f"{where} must have grey values of 8 or 16 bits: save it as PGM or PNG"
            )
        return grey, (1 << 16) - 1, opaque
    if picture.has_transparency_data:
        channels = np.asarray(picture.convert("RGBA"))
        opaque, channels = channels[..., 3] == 255, channels[..., : 4 if with_alpha else 3]
    else:
        one = picture.mode in ("1", "L")
        channels, opaque = np.asarray(picture.convert("L" if one else "RGB")), np.ones((1, 1), bool)
        channels = channels.reshape(picture.height, picture.width, -1)
    return channels.sum(2, dtype=np.uint16), 255 * channels.shape[2], opaque
