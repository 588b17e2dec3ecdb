"""Rasterisation (rasterization) without JavaScript: NumPy draws the pixels of a PNG image."""

import base64
import html
import struct
import zlib

import ipywidgets
import numpy as np

from slamlab.views.colours import COLOURS, in_legends
from slamlab.views.live.back_pressure import Screen

FRAME_PERIOD = 0.1  # [s] between two frames: an image acknowledges nothing, no queue may build up
ELLIPSE_CHORDS = 32  # straight pieces that an ellipse is drawn of
MARGIN = 0.06  # of the picture, free on each side


class RasterScreen(Screen):
    """Screen of plain ipywidgets: raster image of the map, fitted, grid line each metre, no curves.

    Parameters
    ----------
    alt : str, what the picture shows, for who cannot see it
    title : str
    size : (width, height) [pixels]
    """

    def __init__(self, alt="", title="", size=(720, 480)):
        super().__init__(acknowledged=False, frame_period=FRAME_PERIOD)
        self._size = tuple(map(int, size))
        self._image = ipywidgets.HTML()  # an Image of ipywidgets takes no alternative text
        self._words = ipywidgets.HTML()
        self._alt, self._title = html.escape(alt), title
        self.widget = ipywidgets.VBox([self._image, self._words])

    def _send_frame(self, scene):
        picture = base64.b64encode(png(rasterise(scene, self._size))).decode()
        self._image.value = (
            f'<img alt="{self._alt}" width="{self._size[0]}" style="max-width: 100%" '
            f'decoding="sync" src="data:image/png;base64,{picture}">'  # not drawn late: no flicker
        )
        layers = [each for each in scene.drawables if each.kind != "curve"]
        said = {in_legends(each.name): each.colour for each in layers}
        legend = " ".join(
            f'<span style="color:{colour};background:#ffffff">■</span> {html.escape(name)}'
            for name, colour in said.items()
        )
        title = f"<b>{html.escape(self._title)}</b> " if self._title else ""
        self._words.value = f"{title}{legend}<br>{html.escape(scene.status)}"


def rasterise(scene, size):
    """Rasterise a scene: an RGB image of its layers.

    Parameters
    ----------
    scene : Scene
    size : (width, height) [pixels]

    Returns
    -------
    (height, width, 3) uint8
    """
    width, height = size
    picture = np.full((height, width, 3), 255, np.uint8)
    primitives = [(each, *_primitives(each, scene.radius)) for each in scene.drawables]
    corner, scale = _fit_view([xy for _, *both in primitives for xy in both], size)

    def pixels(xy):
        return (xy - corner) * scale * [1, -1] + [0, height]

    low, high = np.ceil(corner), corner + np.array(size) / scale
    for axis in (0, 1):
        across = np.arange(low[axis], high[axis]) if scale > 4 else np.empty(0)
        ends = np.repeat(across, 2).reshape(-1, 1, 2).swapaxes(1, 2)
        far = np.broadcast_to([corner[1 - axis], high[1 - axis]], (len(across), 2))[..., None]
        grid = np.concatenate([ends, far] if axis == 0 else [far, ends], axis=2).reshape(-1, 2, 2)
        _paint_squares(picture, _rasterise_lines(pixels(grid)), COLOURS["guide"], 1)
    for drawable, dots, lines in primitives:
        few = len(dots) <= 300
        _paint_squares(picture, pixels(dots), drawable.colour, 5 if few else 2)
        _paint_squares(picture, _rasterise_lines(pixels(lines)), drawable.colour, 2)
    return picture


def png(picture):
    """Encode an RGB image as PNG, with the fastest compression.

    Parameters
    ----------
    picture : (height, width, 3) uint8

    Returns
    -------
    bytes
    """
    height, width, _ = picture.shape
    # each row begins with the number of its filter, 0 for none
    raw = np.hstack([np.zeros((height, 1), np.uint8), picture.reshape(height, -1)]).tobytes()
    header = struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(raw, 1)), (b"IEND", b""))
    packed = (
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        for name, data in chunks
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(packed)


def _primitives(drawable, radius):
    """(n, 2) dots and (m, 2, 2) lines that make a layer up: its primitives [m]."""
    rows = drawable.rows.astype(float)
    no_dots, no_lines = np.empty((0, 2)), np.empty((0, 2, 2))
    match drawable.kind:
        case "points" | "samples":
            return rows[:, :2], no_lines
        case "segments":
            return no_dots, rows.reshape(-1, 2, 2)
        case "boxes":
            corners = rows[:, [0, 2, 1, 2, 1, 3, 0, 3, 0, 2]].reshape(-1, 5, 2)
        case "ellipses":
            corners = _ellipse_outlines(*rows.T)
        case "poses" if len(rows):
            x, y, theta = rows[-1]
            nose = [[x, y], [x + 1.5 * radius * np.cos(theta), y + 1.5 * radius * np.sin(theta)]]
            body = _outline_segments(_ellipse_outlines(*np.array([[x, y, radius, radius, 0]]).T))
            return no_dots, np.concatenate([_outline_segments(rows[None, :, :2]), body, [nose]])
        case _:
            return no_dots, no_lines
    return no_dots, _outline_segments(corners)


def _ellipse_outlines(x, y, a, b, angle):
    """(n, ELLIPSE_CHORDS + 1, 2) closed outlines of ellipses, as polygons."""
    t = np.linspace(0, 2 * np.pi, ELLIPSE_CHORDS + 1)
    u, v = a[:, None] * np.cos(t), b[:, None] * np.sin(t)
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    return np.stack([x[:, None] + c * u - s * v, y[:, None] + s * u + c * v], axis=2)


def _outline_segments(corners):
    """(m, 2, 2) lines from each corner to the next, of (n, k, 2) outlines."""
    return np.stack([corners[:, :-1], corners[:, 1:]], axis=2).reshape(-1, 2, 2)


def _fit_view(places, size):
    """(2,) what stands at the lower left corner [m] and the scale [pixels/m] that show all."""
    all_ = np.concatenate([np.zeros((0, 2)), *(place.reshape(-1, 2) for place in places)])
    all_ = all_[np.isfinite(all_).all(axis=1)]
    low, high = (all_.min(axis=0), all_.max(axis=0)) if len(all_) else (-np.ones(2), np.ones(2))
    scale = ((1 - 2 * MARGIN) * np.array(size) / np.maximum(high - low, 1.0)).min()
    return (low + high) / 2 - np.array(size) / scale / 2, scale


def _rasterise_lines(lines):
    """(k, 2) points along lines without a gap (line rasterisation); all in pixels."""
    lines = lines[np.isfinite(lines).all(axis=(1, 2))]
    if not len(lines):
        return np.empty((0, 2))
    extent = lines[:, 1] - lines[:, 0]
    # closer than a pixel, so that rounding leaves no gap
    counts = np.ceil(1.5 * np.abs(extent).max(axis=1)).astype(int) + 1
    which = np.repeat(np.arange(len(lines)), counts)
    first = np.repeat(np.cumsum(counts) - counts, counts)
    share = (np.arange(len(which)) - first) / np.maximum(counts - 1, 1)[which]
    return lines[which, 0] + share[:, None] * extent[which]


def _paint_squares(picture, places, colour, size):
    """Paint squares of so many pixels round places; what lies outside is left out."""
    height, width, _ = picture.shape
    places = places[np.isfinite(places).all(axis=1)]
    corner = np.floor(places - (size - 1) / 2).astype(int)
    rgb = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    for dx in range(size):
        for dy in range(size):
            x, y = corner[:, 0] + dx, corner[:, 1] + dy
            inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
            picture[y[inside], x[inside]] = rgb
