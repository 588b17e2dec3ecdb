"""Decoders give the nodes that Slamtec's SDK gives, at any cut, and survive whatever comes."""

import json
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from slamlab.devices.rplidar.capsules import MAJORS_MM, SCALE_LEVELS
from slamlab.devices.rplidar.measurement_nodes import NODE_DTYPE, TURN_Q6
from slamlab.devices.rplidar.responses import AnswerType
from slamlab.devices.rplidar.scan_stream import DECODERS
from tests.slamlab.devices.byte_streams import (
    ANSWERS,
    damaged,
    decoded,
    pieces,
    room,
    stream,
    turn_bytes,
)

VECTORS = json.loads((Path(__file__).parent / "vectors.json").read_text())
P = bytes.fromhex("a0580080" + "a00fa00f00" * 16)
Q = bytes.fromhex("a4533307" + "a30fa30faa" * 16)
ALL = tuple(DECODERS)
CAPSULES = tuple(answer for answer in ALL if hasattr(DECODERS[answer], "header"))
ROUGH = {answer: stream(answer, 40_000) for answer in ANSWERS}
cuts = st.lists(st.integers(1, 400), min_size=1, max_size=30)


def vector(*names):
    return b"".join(bytes.fromhex(VECTORS[name]) for name in names)


@pytest.mark.parametrize(
    ("answer", "capsules", "expected"),
    [
        (AnswerType.EXPRESS, "ABC", ("dA", "dB")),
        (AnswerType.ULTRA, "UVW", ("dU", "dV")),
        (AnswerType.DENSE, "DE", ("dD",)),
    ],
)
def test_capsules_decode_to_the_sdk_s_nodes(answer, capsules, expected):
    nodes, decoder = decoded(answer, vector(*capsules))
    rows = [row for name in expected for row in VECTORS[name]]
    assert len(nodes) == len(rows)
    assert nodes["angle_q6"].tolist() == [row[0] for row in rows]
    # the SDK's one negative distance, of a damaged difference, is no distance here
    assert nodes["distance_q2"].tolist() == [max(row[1], 0) for row in rows]
    if len(rows[0]) == 3:
        assert nodes["start"].tolist() == [bool(row[2]) for row in rows]
    assert not decoder.damage


@pytest.mark.parametrize(
    ("data", "start", "quality", "degrees", "mm"),
    [
        ("3d 01 00 40 1f", True, 15, 0, 2000),
        ("be 01 2d 71 17", False, 47, 90, 1500.25),
        ("02 01 5a 00 00", False, 0, 180, 0),
        ("fe ff b3 80 bb", False, 63, 359.984375, 12000),
        ("2a 41 2d d2 04", False, 10, 90.5, 308.5),
        ("02 8f 63 00 00", False, 0, 199.109375, 0),
    ],
)
def test_a_node_is_read_as_the_protocol_specifies(data, start, quality, degrees, mm):
    (node,), _ = decoded(AnswerType.SCAN, bytes.fromhex(data))
    assert (node["start"], node["quality"]) == (start, quality)
    assert (node["angle_q6"] / 64, node["distance_q2"] / 4) == (degrees, mm)


def capsule(answer, start_q6):
    """A capsule without distances."""
    header, size = DECODERS[answer].header, DECODERS[answer].size
    body = bytes(header - 4) + struct.pack("<H", start_q6 % TURN_Q6) + bytes(size - header)
    check = int(np.bitwise_xor.reduce(np.frombuffer(body, np.uint8)))
    return bytes([0xA0 | check & 15, 0x50 | check >> 4]) + body


@pytest.mark.parametrize("answer", CAPSULES)
@given(
    turned=st.integers(5 * 64, 60 * 64),
    before=st.integers(1, 8),
    off=st.one_of(st.integers(-2, 2), st.integers(-5 * 64, 5 * 64)),
    waver=st.integers(0, 20),
    seed=st.integers(0, 2**32 - 1),
)
def test_every_revolution_has_one_start_flag_for_any_capsule_offset(
    answer, turned, before, off, waver, seed
):
    steps = turned + np.random.default_rng(seed).integers(-waver, waver + 1, 40)
    starts = np.concatenate([[0], np.cumsum(steps)])
    starts += off - starts[before]  # one begins at 0° or close to it
    nodes, decoder = decoded(answer, b"".join(capsule(answer, q6) for q6 in starts))
    assert len(nodes) == 40 * decoder.points and not decoder.damage
    # a turn's mark stands at the last node before 0° by the motor's angle, uncorrected
    crossed = starts[-1] // TURN_Q6 - starts[0] // TURN_Q6
    assert nodes["start"].sum() == crossed


@pytest.mark.parametrize(
    ("mm", "code"),
    [(511, 511), (512, 512), (2048, 1280), (4096, 1792), (8000, 2280), (16384, 3328)],
)
def test_ultra_distances_are_coded_in_steps_that_grow(mm, code):
    assert MAJORS_MM[code] == mm
    assert MAJORS_MM[3554] == 20000
    assert (np.diff(MAJORS_MM) == 1 << SCALE_LEVELS[:-1]).all()


# by hand, after the SDK: scale, bits of the code and the distance that they mean
SCALES = [(0, 10, 2, 0), (1, 11, 3, 2046), (2, 12, 4, 8187), (3, 13, 5, 24567)]


@pytest.mark.parametrize(("scale", "bits", "step", "first"), SCALES)
@given(data=st.data())
def test_ultra_dense_distances_have_four_scales(scale, bits, step, first, data):
    codes = data.draw(st.lists(st.integers(0, 2**bits - 1), min_size=64, max_size=64))
    qualities = data.draw(st.lists(st.integers(0, 2 ** (8 - scale) - 1), min_size=64, max_size=64))
    words = [scale | c << 2 | q << 2 + bits for c, q in zip(codes, qualities, strict=True)]
    cabins = b"".join(
        struct.pack("<HHB", a & 0xFFFF, b & 0xFFFF, a >> 16 | b >> 16 << 4)
        for a, b in zip(words[::2], words[1::2], strict=True)
    )
    body = bytes(6) + struct.pack("<H", 90 * 64) + cabins
    check = int(np.bitwise_xor.reduce(np.frombuffer(body, np.uint8)))
    whole = bytes([0xA0 | check & 15, 0x50 | check >> 4]) + body
    nodes, decoder = decoded(
        AnswerType.ULTRA_DENSE, whole + capsule(AnswerType.ULTRA_DENSE, 106 * 64)
    )
    assert not decoder.damage and len(nodes) == 64
    mm = [first + step * c for c in codes]
    assert (nodes["distance_q2"] / 4).tolist() == mm
    assert (nodes["angle_q6"] / 64).tolist() == [90 + k / 4 for k in range(64)]
    there = [q << scale >> 2 if d else 0 for d, q in zip(mm, qualities, strict=True)]
    assert nodes["quality"].tolist() == there


def hq_capsule(nodes):
    """An HQ capsule of 96 (angle [90°/16384], distance [1/4 mm], quality, flags)."""
    data = b"\xa5" + bytes(range(8)) + b"".join(struct.pack("<HIBB", *node) for node in nodes)
    return data + struct.pack("<I", zlib.crc32(data + bytes(3)))


def test_hq_nodes_are_fine_in_angle_and_far_in_distance():
    nodes = [(170 * k, 400_000 + k, 200, 1 if k == 7 else 2) for k in range(96)]
    found, decoder = decoded(AnswerType.HQ, hq_capsule(nodes) * 2)
    assert not decoder.damage and len(found) == 192
    degrees = [170 * k * 90 / 16384 for k in range(96)]
    assert np.abs(found["angle_q6"][:96] / 64 - degrees).max() <= 0.5 / 64
    assert found["distance_q2"][:96].tolist() == [400_000 + k for k in range(96)]
    assert np.flatnonzero(found["start"]).tolist() == [7, 103]
    assert set(found["quality"].tolist()) == {50}


def test_a_restarted_measurement_forgets_the_capsule_before():
    nodes, decoder = decoded(AnswerType.EXPRESS, Q + P)
    assert len(nodes) == 0
    assert not decoder.damage


@pytest.mark.parametrize("answer", ANSWERS)
def test_packets_of_an_emulator_are_decoded_exactly(answer):
    nodes, _ = decoded(answer, ROUGH[answer])
    angle, mm = nodes["angle_q6"] / 64, nodes["distance_q2"] / 4
    slope, off = 70, 2 / 64 + (0.02 if answer == AnswerType.ULTRA else 0)  # mm and degrees
    # distances of the ultra mode are in steps of up to 8 mm, of the ultra-dense one up to 4 mm here
    step = {AnswerType.ULTRA: 8, AnswerType.ULTRA_DENSE: 2}.get(answer, 1)
    assert np.abs(mm - room(angle)).max() < slope * off + step
    starts = np.flatnonzero(nodes["start"])
    assert np.ptp(np.diff(starts)) <= 1


@pytest.mark.parametrize("answer", ALL)
@given(cuts=cuts, seed=st.integers(0, 2**32 - 1), flips=st.sampled_from([0, 1e-3, 0.03]))
@example(cuts=[2], seed=32, flips=0.03)  # at its end a single byte that begins no capsule
def test_the_nodes_do_not_depend_on_the_chunks_of_the_stream(answer, cuts, seed, flips):
    rng = np.random.default_rng(seed)
    source = ROUGH.get(answer, vector("D", "E") * 20)
    data = damaged(source[: 2 * turn_bytes(AnswerType.ULTRA)], rng, flips, flips / 3, flips / 3)
    whole, one = decoded(answer, data)
    cut, other = decoded(answer, data, cuts)
    assert np.array_equal(whole, cut)
    assert one.damage == other.damage
    assert one.pending == other.pending


@pytest.mark.parametrize("answer", ALL)
def test_random_bytes_never_fail_and_little_is_kept(answer):
    rng = np.random.default_rng(5)
    decoder, kept = DECODERS[answer](), 0
    for piece in pieces(rng.bytes(100_000), rng.integers(1, 300, 100)):
        nodes = decoder.feed(piece)
        kept = max(kept, decoder.pending)
        assert nodes.dtype == NODE_DTYPE
        assert ((nodes["angle_q6"] >= 0) & (nodes["angle_q6"] < TURN_Q6)).all()
        assert (nodes["distance_q2"] >= 0).all()
    assert kept < max(decoder.size, 24)
    assert decoder.damage["resyncs"] > 0


@pytest.mark.parametrize("answer", ANSWERS)
@pytest.mark.parametrize(
    "hurt",
    [{"flips": 0.01}, {"losses": 0.01}, {"additions": 0.01}, {"flips": 0.3, "losses": 0.1}],
    ids=lambda hurt: "-".join(hurt),
)
def test_within_a_revolution_after_corruption_all_nodes_are_correct(answer, hurt):
    rng = np.random.default_rng(6)
    clean, tail = ROUGH[answer], stream(answer, 40_000, first_angle=123.4)
    bad = damaged((clean * 2)[:100_000], rng, **hurt)
    expected, _ = decoded(answer, tail)
    nodes, decoder = decoded(answer, bad + tail, rng.integers(1, 300, 100))
    late = len(decoded(answer, tail[: turn_bytes(answer)])[0])
    n = len(expected) - late
    for name in ("angle_q6", "distance_q2", "quality", "start", "after_gap"):
        assert np.array_equal(nodes[name][-n:], expected[name][-n:])
    assert decoder.damage["resyncs"] > 0


@pytest.mark.parametrize(
    ("answer", "lost"),  # whole nodes of the standard scan can be missed by nobody
    [(a, n) for a in ANSWERS for n in range(1, 12) if a != AnswerType.SCAN or n % 5],
)
def test_lost_bytes_cost_the_packets_they_belong_to_and_the_gap_is_marked(answer, lost):
    data = ROUGH[answer]
    at = 5 * 84 * 132 // 44 + 3
    nodes, decoder = decoded(answer, data[:at] + data[at + lost :])
    whole, _ = decoded(answer, data)
    size = DECODERS[answer].size
    per_packet = 1 if answer == AnswerType.SCAN else decoder.points
    touched = (at % size + lost - 1) // size + 1
    # a capsule is decoded with the next, which a start seen by chance in a damaged one can cost
    most = 4 if answer == AnswerType.SCAN else touched + 2
    assert 0 < len(whole) - len(nodes) <= most * per_packet
    assert nodes["after_gap"].sum() == 1
    assert decoder.damage["resyncs"] == 1
    wrong = [
        node for node in nodes[["angle_q6", "distance_q2"]].tolist() if node not in GOOD[answer]
    ]
    assert len(wrong) <= 1


GOOD = {
    answer: set(decoded(answer, data)[0][["angle_q6", "distance_q2"]].tolist())
    for answer, data in ROUGH.items()
}


@pytest.mark.parametrize("lost", [1, 2, 3, 4])
@pytest.mark.parametrize("at", [1000, 1001, 1002, 1003, 1004])
def test_distances_that_look_like_nodes_do_not_lead_out_of_step(at, lost):
    """Read from its fourth byte on this stream has all marks of nodes, at one angle for ever."""
    rows = [struct.pack("<BHH", 0x3E, 117 * k % TURN_Q6 << 1 | 1, 8001) for k in range(1000)]
    data = b"".join(rows)
    nodes, _ = decoded(AnswerType.SCAN, data[:at] + data[at + lost :])
    assert (nodes["distance_q2"] != 8001).sum() <= 4
    assert len(nodes) >= 990


@pytest.mark.parametrize("odd", [0, 7])
@pytest.mark.parametrize(
    ("answer", "lost"), [*((AnswerType.EXPRESS, n) for n in (1, 12, 13)), (AnswerType.ULTRA, 2)]
)
def test_lost_capsules_leave_a_gap_and_no_wrong_angles(answer, lost, odd):
    """Twelve capsules are nearly a turn, so that the next one seems to follow."""
    data, size = ROUGH[answer], DECODERS[answer].size
    nodes, _ = decoded(answer, data[: 9 * size] + data[(9 + lost) * size + odd :])
    assert nodes["after_gap"].sum() == 1
    assert set(nodes[["angle_q6", "distance_q2"]].tolist()) <= GOOD[answer]
