"""Invalid maps of the map_server are refused with a remedy; saved ones are read."""

import struct
import zlib

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image

from slamlab.files import SourceError
from slamlab.gridmap import OccupancyGrid, map_server
from tests.slamlab.formats.map_writing import GOOD, GREY, RAW, SCALE, WIDE, YAMLS, pgm, png
from tests.slamlab.formats.mutations import mutated

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
    "brackets without end": ("[" * 3000, "not the YAML file of a map"),
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
