"""ROS maps of the world: read as map_server defines them, or refused with line and remedy.

The truth is map_server's rule on the shades of the pixels, written here apart from slamlab's.
"""

import struct
import zlib
from fractions import Fraction

import numpy as np
import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image

from slamlab.files import SourceError
from slamlab.gridmap import OccupancyGrid, map_server
from slamlab.gridmap.occupancy_grid import CLAMP
from tests.slamlab.formats.mutations import mutated

GREY = np.array([[0, 50, 88, 90], [100, 150, 204, 205], [206, 230, 254, 255]], np.uint8)
WIDE = GREY.astype(np.uint16) * 257 + [[0, 5, -9, 100]] * (GREY[:, :] % 255 > 0)
COLOURS = np.stack([GREY, GREY[::-1], GREY[:, ::-1]], axis=-1)
ALPHA = np.array([[255, 255, 0, 255], [255, 128, 255, 254], [0, 255, 255, 255]], np.uint8)
WITH_ALPHA = np.dstack([GREY, GREY, GREY, ALPHA])


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


def truth(shades, alpha=None, mode="trinary", negate=False, occupied=0.65, free=0.196):
    """map_server's occupancy [%] of shades (rows, columns, channels) from 0 to 1; −1 unknown."""
    out = np.empty(shades.shape[:2], int)
    for cell in np.ndindex(*out.shape):
        channels = [Fraction(shade).limit_denominator(65535) for shade in shades[cell]]
        if mode == "trinary" and alpha is not None:
            channels.append(Fraction(alpha[cell]).limit_denominator(255))
        shade = sum(channels) / len(channels)
        occupancy = float(shade if negate else 1 - shade)
        out[cell] = 100 if occupancy > occupied else 0 if occupancy < free else -1
        if mode == "scale" and out[cell] < 0:
            out[cell] = round((occupancy - free) / (occupied - free) * 100)
        if mode == "raw":
            out[cell] = round(255 * shade) if round(255 * shade) <= 100 else -1
        if mode == "scale" and alpha is not None and alpha[cell] < 1:
            out[cell] = -1
    return out[::-1]


def assert_holds(grid, percent):
    """Assert that a grid's probabilities are these, unknown 0.5, clear ones at the clamp."""
    p = np.where(percent < 0, 0.5, percent / 100).clip(1 - CLAMP, CLAMP)
    np.testing.assert_allclose(grid.probability, p, atol=1e-6)


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


@pytest.mark.parametrize("kind", YAMLS)
def test_a_yaml_is_read_as_yaml(tmp_path, kind):
    (tmp_path / "map.png").write_bytes(png(GREY))
    text = YAMLS[kind].encode("utf-16" if kind == "UTF-16" else "utf-8")
    (tmp_path / "map.yaml").write_bytes(text)
    grid = map_server.load(tmp_path / "map.yaml")
    assert grid.resolution == 0.05
    np.testing.assert_array_equal(grid.origin, [-1, 2.5])
    assert_holds(grid, truth(GREY[..., None] / 255))


GREY_SHADES, WIDE_SHADES = GREY[..., None] / 255, WIDE[..., None] / 65535
PALETTE = Image.fromarray(GREY)
PALETTE = PALETTE.convert("RGB").quantize(16)
KEYED = Image.fromarray(GREY)
BITS = (GREY > 99).astype(np.uint8)
NEGATED = "negate: true\n"
SCALE = "mode: scale\n"
RAW = "mode: raw\n"


def saved(image, **options):
    """A writer of an image by Pillow."""
    image = image if isinstance(image, Image.Image) else Image.fromarray(image)
    return lambda path: image.save(path, **options)


def written(content):
    return lambda path: path.write_bytes(content)


def case(name, write, shades, keys="", **options):
    """A map: name of its image, a writer, the true shades, keys, more arguments of the truth."""
    return name, write, shades, keys, options


MAPS = {
    "PNG": case("m.png", written(png(GREY)), GREY_SHADES),
    "PNG, negate": case("m.png", written(png(GREY)), GREY_SHADES, NEGATED, negate=True),
    "PGM": case("m.pgm", written(pgm(GREY, 255)), GREY_SHADES),
    "PGM with GIMP's comment": case(
        "m.pgm", written(pgm(GREY, 255, comment="# CREATOR: GIMP\n")), GREY_SHADES
    ),
    "plain PGM": case("m.pgm", written(pgm(GREY, 255, "P2")), GREY_SHADES),
    "PGM of 100 levels": case("m.pgm", written(pgm(GREY // 3, 85)), (GREY // 3)[..., None] / 85),
    "plain PGM of 16 bit": case("m.pgm", written(pgm(WIDE, 65535, "P2")), WIDE_SHADES),
    "PNG of 16 bit": case("m.png", written(png(WIDE.astype(np.uint16))), WIDE_SHADES),
    "plain bitmap": case("m.pbm", written(pgm(1 - BITS, 1, "P1")), BITS[..., None] / 1),
    "PNG of 1 bit": case(
        "m.png", saved(Image.fromarray(BITS * 255).convert("1")), BITS[..., None] / 1
    ),
    "colours": case("m.png", saved(COLOURS), COLOURS / 255),
    "palette": case("m.png", saved(PALETTE), np.asarray(PALETTE.convert("RGB")) / 255),
    "bitmap of Windows": case("m.bmp", saved(GREY), GREY_SHADES),
    "TIFF": case("m.tif", saved(GREY), GREY_SHADES),
    "alpha, trinary": case(
        "m.png", saved(WITH_ALPHA), WITH_ALPHA[..., :3] / 255, alpha=ALPHA / 255
    ),
    "alpha, scale": case(
        "m.png",
        saved(WITH_ALPHA),
        WITH_ALPHA[..., :3] / 255,
        SCALE,
        alpha=ALPHA / 255,
        mode="scale",
    ),
    "grey with alpha": case(
        "m.png", saved(np.dstack([GREY, ALPHA])), WITH_ALPHA[..., :3] / 255, alpha=ALPHA / 255
    ),
    "a colour that is transparent": case(
        "m.png",
        saved(KEYED, transparency=100),
        GREY_SHADES,
        SCALE,
        alpha=(GREY != 100) * 1.0,
        mode="scale",
    ),
    "scale": case("m.png", written(png(GREY)), GREY_SHADES, SCALE, mode="scale"),
    "scale, other thresholds": case(
        "m.png",
        written(png(GREY)),
        GREY_SHADES,
        SCALE + "occupied_thresh: 0.9\nfree_thresh: 0.1\n",
        mode="scale",
        occupied=0.9,
        free=0.1,
    ),
    "one threshold": case(
        "m.png",
        written(png(GREY)),
        GREY_SHADES,
        "occupied_thresh: 0.5\nfree_thresh: 0.5\n",
        occupied=0.5,
        free=0.5,
    ),
    "raw": case("m.png", written(png(GREY)), GREY_SHADES, RAW, mode="raw"),
    "a folder and a blank": case("my maps/the map.png", written(png(GREY)), GREY_SHADES),
    "no suffix": case("map", written(pgm(GREY, 255)), GREY_SHADES),
}


@pytest.mark.parametrize("kind", MAPS)
def test_an_image_is_read_as_map_server_defines_it(tmp_path, kind):
    name, write, shades, keys, options = MAPS[kind]
    (tmp_path / name).parent.mkdir(exist_ok=True)
    write(tmp_path / name)
    text = f"image: {name}\nresolution: 0.1\norigin: [0, 0, 0]\n{keys}"
    assert yaml.safe_load(text)["image"] == name
    (tmp_path / "m.yaml").write_text(text)
    assert_holds(map_server.load(tmp_path / "m.yaml"), truth(shades, **options))


def test_an_absolute_path_of_the_image_is_taken_as_it_is(tmp_path):
    (tmp_path / "map.png").write_bytes(png(GREY))
    (tmp_path / "yaml").mkdir()
    text = GOOD.replace("map.png", str(tmp_path / "map.png"))
    (tmp_path / "yaml" / "map.yaml").write_text(text)
    assert map_server.load(tmp_path / "yaml" / "map.yaml").states.shape == GREY.shape


REFUSED = {
    "no image": (GOOD.replace("image: map.png\n", ""), "the key image is missing"),
    "no path": (GOOD.replace("map.png", ""), "line 1: image must be a single value"),
    "image is a list": (GOOD.replace("map.png", "[a, b]"), "line 1: image must be a single"),
    "image elsewhere": (
        GOOD.replace("map.png", "/home/me/map.pgm"),
        "/home/me/map.pgm does not exist",
    ),
    "image is a device": (GOOD.replace("map.png", "/dev/zero"), "does not exist"),
    "image is the YAML": (GOOD.replace("map.png", "map.yaml"), "not a supported image.* PGM, PNG"),
    "image cut short": (GOOD.replace("map.png", "short.png"), "damaged or truncated"),
    "PGM cut short": (GOOD.replace("map.png", "short.pgm"), "damaged or truncated"),
    "a bomb": (GOOD.replace("map.png", "bomb.png"), "more than 100000000 pixels: crop"),
    "floats": (GOOD.replace("map.png", "float.tif"), "must have grey values of 8 or 16 bits"),
    "no resolution at all": (GOOD.replace("0.05", "0"), "resolution must be above 0 m"),
    "resolution NaN": (GOOD.replace("0.05", ".nan"), "line 2: resolution must be a finite"),
    "resolution with a unit": (GOOD.replace("0.05", "0.05 m"), "line 2: .* not '0.05 m'"),
    "two numbers": (GOOD.replace(", 0.0]", "]"), "line 3: origin must be a list of x, y and yaw"),
    "origin in words": (GOOD.replace("2.5", "y"), "line 3: origin must be a finite number"),
    "rotated": (GOOD.replace("2.5, 0.0", "2.5, 1.57"), "rotated by 1.57 rad.* rotate its image"),
    "negate maybe": (GOOD.replace("negate: 0", "negate: maybe"), "line 4: negate must be 0 or 1"),
    "per cent": (GOOD.replace("0.65", "65"), "line 5: occupied_thresh .* 65 .not a percentage"),
    "thresholds exchanged": (GOOD.replace("0.65", "0.1"), "free_thresh 0.196 must not be above"),
    "unknown mode": (GOOD + "mode: ternary\n", "line 7: mode must be one of trinary, scale, raw"),
    "raw and negate": (GOOD.replace("negate: 0", "negate: 1") + RAW, "ROS 1 .* ROS 2"),
    "a key twice": (GOOD + "negate: 1\n", "line 7: the key negate is repeated"),
    "a misspelt key": (
        GOOD.replace("free_thresh", "free_tresh"),
        "line 6: .* did you mean free_thresh",
    ),
    "a list": ("- 1\n", "not the YAML file of a map"),
    "no colon": (
        GOOD.replace("negate: 0", "negate 0"),
        "line 5: this is not the YAML|line 4: this is not the",
    ),
    "brackets without end": ("[" * 20000, "not the YAML file of a map"),
    "an escape out of range": ('image: "\\UFFFFFFFF"\n', "not the YAML file of a map"),
    "empty": ("", "not the YAML file of a map"),
    "much too long": (GOOD + "# " + "x" * 100000, "not the YAML file of a map"),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Images, whole and damaged."""
    folder = tmp_path_factory.mktemp("maps")
    (folder / "map.png").write_bytes(png(GREY))
    (folder / "short.png").write_bytes(png(np.tile(GREY, (50, 50)))[:-30])
    (folder / "short.pgm").write_bytes(pgm(GREY, 255)[:-2])
    (folder / "plain.pgm").write_bytes(pgm(GREY, 255, "P2")[:-8])
    bomb = png(GREY)
    head = b"IHDR" + struct.pack(">II", 60000, 60000) + bomb[24:29]
    head += struct.pack(">I", zlib.crc32(head))
    (folder / "bomb.png").write_bytes(bomb[:12] + head + bomb[33:])
    Image.fromarray(GREY.astype(np.float32)).save(folder / "float.tif")
    Image.fromarray(GREY.astype(np.int32) * 1000).save(folder / "deep.tif")
    return folder


@pytest.mark.parametrize("kind", REFUSED)
def test_an_invalid_map_is_refused_with_a_remedy(folder, kind):
    text, message = REFUSED[kind]
    (folder / "map.yaml").write_text(text)
    with pytest.raises(SourceError, match=message) as refused:
        map_server.load(folder / "map.yaml")
    assert len(str(refused.value).splitlines()) == 1
    assert str(refused.value).startswith(str(folder / "map.yaml"))


def test_an_image_in_place_of_its_yaml_is_refused(folder):
    with pytest.raises(SourceError, match="give the YAML file of the map, not its image"):
        map_server.load(folder / "map.png")


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.lists(st.lists(st.sampled_from([-1, 0, 1]), min_size=3, max_size=3), min_size=1, max_size=5),
    st.floats(1e-6, 1e3),
    st.tuples(st.floats(-1e9, 1e9), st.floats(-1e9, 1e9)),
)
def test_saving_and_loading_bring_back_the_same_states(tmp_path, states, resolution, corner):
    grid = OccupancyGrid(resolution, corner)
    grid.set(states)
    path = map_server.save(grid, tmp_path / "map")
    before = path.read_bytes(), path.with_suffix(".png").read_bytes()
    again = map_server.load(path)
    np.testing.assert_array_equal(again.states, states)
    np.testing.assert_array_equal(again.origin, grid.origin)
    assert again.resolution == resolution
    map_server.save(again, tmp_path / "map.yaml")
    assert (path.read_bytes(), path.with_suffix(".png").read_bytes()) == before


def perhaps_mutated(*contents):
    whole = st.sampled_from(contents)
    return whole | whole.flatmap(mutated)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=200)
@given(
    perhaps_mutated((GOOD + SCALE).encode(), YAMLS["JSON"].encode()),
    perhaps_mutated(png(GREY), pgm(GREY, 255), pgm(WIDE, 65535, "P2")),
)
def test_a_mutated_map_is_read_or_refused_and_raises_nothing_else(tmp_path, text, image):
    (tmp_path / "map.yaml").write_bytes(text)
    (tmp_path / "map.png").write_bytes(image)
    try:
        grid = map_server.load(tmp_path / "map.yaml")
    except SourceError as refused:
        assert len(str(refused)) < 600
    else:
        assert np.isfinite(grid.log_odds).all()
