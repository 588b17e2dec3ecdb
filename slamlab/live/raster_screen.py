"""Raster screen: a live view without JavaScript, by rasterisation with NumPy into a PNG image."""

import base64
import html
import struct
import zlib

import numpy as np

from slamlab.extras import needs
from slamlab.live.back_pressure import Screen
from slamlab.views.colours import COLOURS, in_legends

with needs("notebook"):
    import ipywidgets

FRAME_PERIOD = 0.1  # [s] between two frames: images are not acknowledged, and no queue may build up
ELLIPSE_CHORDS = 32  # line segments of an ellipse
MARGIN = 0.06  # free part of the picture on each side


class RasterScreen(Screen):
    """Screen of plain ipywidgets: the whole map with a grid of 1 m, without curves."""

    def __init__(self, alt="", title="", size=(720, 480)):
        super().__init__(acknowledged=False, frame_period=FRAME_PERIOD)
        self._size = tuple(map(int, size))
        self._image = ipywidgets.HTML()  # an Image of ipywidgets has no alternative text
        self._caption = ipywidgets.HTML()
        self._alt, self._title = html.escape(alt), title
        self.widget = ipywidgets.VBox([self._image, self._caption])

    def _send_frame(self, scene):
        picture = base64.b64encode(png(rasterise(scene, self._size))).decode()
        self._image.value = (
            f'<img alt="{self._alt}" width="{self._size[0]}" style="max-width: 100%" '
            f'decoding="sync" src="data:image/png;base64,{picture}">'  # without flicker
        )
        layers = [each for each in scene.drawables if each.kind != "curve" and len(each.rows)]
        entries = {in_legends(each.name): each.colour for each in layers}
        legend = " ".join(
            f'<span style="color:{colour};background:#ffffff">■</span> {html.escape(name)}'
            for name, colour in entries.items()
        )
        title = f"<b>{html.escape(self._title)}</b> " if self._title else ""
        self._caption.value = f"{title}{legend}<br>{html.escape(scene.status)}"


def rasterise(scene, size):
    """Draw a scene as an RGB image, (height, width, 3) uint8."""
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
    """Encode an RGB image (height, width, 3) uint8 as PNG."""
    height, width, _ = picture.shape
    # each row begins with its filter type, 0 for none
    raw = np.hstack([np.zeros((height, 1), np.uint8), picture.reshape(height, -1)]).tobytes()
    header = struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(raw, 1)), (b"IEND", b""))
    packed = (
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        for name, data in chunks
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(packed)


def _primitives(drawable, radius):
    """Return the dots (n, 2) and lines (m, 2, 2) of a layer [m]."""
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
    """Return ellipses as closed polygons, (n, ELLIPSE_CHORDS + 1, 2)."""
    t = np.linspace(0, 2 * np.pi, ELLIPSE_CHORDS + 1)
    u, v = a[:, None] * np.cos(t), b[:, None] * np.sin(t)
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    return np.stack([x[:, None] + c * u - s * v, y[:, None] + s * u + c * v], axis=2)


def _outline_segments(corners):
    """Return the lines (m, 2, 2) along outlines (n, k, 2)."""
    return np.stack([corners[:, :-1], corners[:, 1:]], axis=2).reshape(-1, 2, 2)


def _fit_view(points, size):
    """Return the lower left corner (2,) [m] and the scale [pixels/m] that show everything."""
    all_ = np.concatenate([np.zeros((0, 2)), *(part.reshape(-1, 2) for part in points)])
    all_ = all_[np.isfinite(all_).all(axis=1)]
    low, high = (all_.min(axis=0), all_.max(axis=0)) if len(all_) else (-np.ones(2), np.ones(2))
    scale = ((1 - 2 * MARGIN) * np.array(size) / np.maximum(high - low, 1.0)).min()
    return (low + high) / 2 - np.array(size) / scale / 2, scale


def _rasterise_lines(lines):
    """Return points (k, 2) [pixels] along lines, so close together that they leave no gaps."""
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


def _paint_squares(picture, points, colour, size):
    height, width, _ = picture.shape
    points = points[np.isfinite(points).all(axis=1)]
    corner = np.floor(points - (size - 1) / 2).astype(int)
    rgb = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    for dx in range(size):
        for dy in range(size):
            x, y = corner[:, 0] + dx, corner[:, 1] + dy
            inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
            picture[y[inside], x[inside]] = rgb
