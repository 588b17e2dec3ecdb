"""Byte streams as a lidar in a known room sends them, and ways to split and to corrupt them."""

import numpy as np

from slamlab.devices.emulator.packet_encoder import ENCODERS
from slamlab.devices.rplidar.responses import AnswerType
from slamlab.devices.rplidar.scan_stream import DECODERS

PERIODS = {
    AnswerType.SCAN: 508e-6,
    AnswerType.EXPRESS: 254e-6,
    AnswerType.ULTRA: 127e-6,
    AnswerType.DENSE: 190e-6,
    AnswerType.ULTRA_DENSE: 127e-6,
    AnswerType.HQ: 90e-6,
}
FAST = {AnswerType.ULTRA_DENSE: 256000, AnswerType.HQ: 1000000}  # baud rates that carry these
ANSWERS = tuple(PERIODS)
TURNS_PER_SECOND = 10.0


def room(directions):
    """Distances in a smooth room, from 1 to 5 m [mm]."""
    return 3000 + 2000 * np.sin(np.radians(directions) * 2)


def stream(answer, samples, measure=room, first_angle=0.0):
    """Bytes of so many samples."""
    packer, size, ahead = ENCODERS[answer]
    step = 360 * TURNS_PER_SECOND * PERIODS[answer]
    packets, together = [], samples if size == 1 else size
    for at in range(0, samples - together + 1, together):
        angle = first_angle + step * np.arange(at, at + together + ahead)
        packets += packer(angle, step, measure, at == 0)
    assert all(len(packet) == DECODERS[answer].size for packet in packets)
    return b"".join(packets)


def turn_bytes(answer):
    """How many bytes a turn has."""
    per_second = DECODERS[answer].size / ENCODERS[answer][1] / PERIODS[answer]
    return int(per_second / TURNS_PER_SECOND)


def decoded(answer, data, cuts=()):
    """Nodes of a stream cut into pieces, and the decoder."""
    decoder, nodes = DECODERS[answer](), []
    for piece in pieces(data, cuts):
        nodes.append(decoder.feed(piece))
    return np.concatenate(nodes), decoder


def pieces(data, cuts):
    """Data cut into pieces of given lengths, in turn."""
    at, cuts = 0, list(cuts) or [len(data) or 1]
    k = 0
    while at < len(data):
        n = cuts[k % len(cuts)]
        yield data[at : at + n]
        at, k = at + n, k + 1


def damaged(data, rng, flips=0.0, losses=0.0, additions=0.0):
    """Data with shares of its bytes changed, lost, and random ones put in between."""
    raw = np.frombuffer(data, np.uint8).copy()
    hit = rng.random(len(raw)) < flips
    raw[hit] ^= (1 << rng.integers(0, 8, hit.sum())).astype(np.uint8)
    raw = raw[rng.random(len(raw)) >= losses]
    places = np.flatnonzero(rng.random(len(raw)) < additions)
    return np.insert(raw, places, rng.integers(0, 256, len(places), dtype=np.uint8)).tobytes()
