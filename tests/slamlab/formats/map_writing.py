"""Maps of the map_server as files."""

import struct
import zlib

import numpy as np
from PIL import Image

GREY = np.array([[0, 50, 88, 90], [100, 150, 204, 205], [206, 230, 254, 255]], np.uint8)
WIDE = GREY.astype(np.uint16) * 257 + [[0, 5, -9, 100]] * (GREY[:, :] % 255 > 0)


def png(pixels):
    """The bytes of a PNG of grey values of 8 or 16 bit."""
    depth = pixels.dtype.itemsize
    rows = b"".join(b"\0" + row.astype(f">u{depth}").tobytes() for row in pixels)
    height, width = pixels.shape

    def chunk(kind, data):
        check = struct.pack(">I", zlib.crc32(kind + data))
        return struct.pack(">I", len(data)) + kind + data + check

    head = struct.pack(">IIBBBBB", width, height, 8 * depth, 0, 0, 0, 0)
    parts = chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + parts


def pgm(pixels, maximum, kind="P5", comment=""):
    """The bytes of a PGM or PBM."""
    head = f"{kind}\n{comment}{pixels.shape[1]} {pixels.shape[0]}\n"
    head += "" if kind in ("P1", "P4") else f"{maximum}\n"
    if kind in ("P1", "P2"):
        return (head + "\n".join(" ".join(map(str, row)) for row in pixels) + "\n").encode()
    return head.encode() + pixels.astype(">u2" if maximum > 255 else ">u1").tobytes()


GOOD = (
    "image: map.png\nresolution: 0.05\norigin: [-1.0, 2.5, 0.0]\nnegate: 0\n"
    "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
)
YAMLS = {
    "as map_saver writes it": GOOD,
    "with mode": GOOD + "mode: trinary\n",
    "bytes of Windows": GOOD.replace("\n", "\r\n"),
    "negate false": GOOD.replace("negate: 0", "negate: false"),
    "quoted keys and values": GOOD.replace("resolution: 0.05", "\"resolution\": '0.05'").replace(
        "map.png", '"map.png"'
    ),
    "flow style": "{image: map.png, resolution: 0.05, origin: [-1.0, 2.5, 0.0], negate: 0}",
    "JSON": '{"image": "map.png", "resolution": 0.05, "origin": [-1, 2.5, 0], "negate": 0}',
    "list over lines": GOOD.replace("[-1.0, 2.5, 0.0]", "\n  - -1.0\n  - 2.5\n  - 0.0"),
    "exponents without a point": GOOD.replace("0.05", "5e-2").replace("-1.0,", "-1e0,"),
    "comments": "# made by hand\n" + GOOD.replace("\n", "  # as measured\n"),
    "tabs": GOOD.replace(": ", ":\t"),
    "document marks": "---\n" + GOOD + "...\n",
    "other keys": GOOD + "frame_id: map\nfloor: {level: 2, rooms: [a, b]}\n",
    "thresholds by default": "".join(GOOD.splitlines(keepends=True)[:3]),
    "tiny yaw": GOOD.replace("2.5, 0.0", "2.5, -1e-9"),
    "anchors": GOOD.replace("0.05", "&cell 0.05") + "cell: *cell\n",
    "UTF-16": GOOD,
}
PALETTE = Image.fromarray(GREY)
PALETTE = PALETTE.convert("RGB").quantize(16)
SCALE = "mode: scale\n"
RAW = "mode: raw\n"
