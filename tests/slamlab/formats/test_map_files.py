"""Maps of the map_server: YAML and image are read as it defines them."""

from fractions import Fraction

import numpy as np
import pytest
import yaml
from PIL import Image

from slamlab.gridmap import map_server
from slamlab.gridmap.occupancy_grid import CLAMP
from tests.slamlab.formats.map_writing import GOOD, GREY, PALETTE, RAW, SCALE, WIDE, YAMLS, pgm, png

COLOURS = np.stack([GREY, GREY[::-1], GREY[:, ::-1]], axis=-1)
ALPHA = np.array([[255, 255, 0, 255], [255, 128, 255, 254], [0, 255, 255, 255]], np.uint8)
WITH_ALPHA = np.dstack([GREY, GREY, GREY, ALPHA])


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
KEYED = Image.fromarray(GREY)
BITS = (GREY > 99).astype(np.uint8)
NEGATED = "negate: true\n"


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
