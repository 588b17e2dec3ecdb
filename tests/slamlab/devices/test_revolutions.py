"""Revolutions (turns): whole, timestamped, in the robot's frame, gaps reported."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.devices.rplidar.measurement_nodes import NODE_DTYPE, ScanDecoder
from slamlab.devices.rplidar.responses import AnswerType
from slamlab.devices.rplidar.revolutions import MAX_NODES, RevolutionAssembler, robot_frame
from slamlab.devices.rplidar.scan_stream import DECODERS
from slamlab.devices.rplidar.timestamping import SampleTimestamps
from tests.slamlab.devices.byte_streams import ANSWERS, FAST, PERIODS, pieces, stream

PERIOD = 0.5e-3


def nodes_of(angles, starts=(), mm=1000):
    nodes = np.zeros(len(angles), NODE_DTYPE)
    nodes["angle_q6"] = np.round(np.mod(angles, 360) * 64).astype(int) % 23040
    nodes["distance_q2"] = 4 * mm
    nodes["start"][list(starts)] = True
    return nodes


def even(turns, per_turn=200):
    """Nodes of an even rotation, the mark on the first of each turn."""
    angles = np.arange(turns * per_turn) * 360 / per_turn
    return nodes_of(angles, range(0, len(angles), per_turn))


def turns_of(nodes, cuts=(10_000,)):
    assembler, found, at, times = RevolutionAssembler(PERIOD), [], 0, PERIOD * np.arange(len(nodes))
    for n in [c for _ in range(len(nodes)) for c in cuts]:
        if at >= len(nodes):
            break
        found += assembler.feed(nodes[at : at + n], times[at : at + n])
        at += n
    return found


def test_clockwise_degrees_and_millimetres_become_our_frame():
    angles, ranges = robot_frame([0, 90, 270, 350], [1000, 2000, 0, 500])
    x, y = ranges * np.cos(angles), ranges * np.sin(angles)
    assert np.allclose([x[0], y[0]], [1, 0])  # ahead
    assert np.allclose([x[1], y[1]], [0, -2])  # clockwise: to the right
    assert np.isnan(ranges[2])
    assert y[3] > 0
    angles, _ = robot_frame([180.0], [1000], front_deg=180.0)
    assert np.allclose(angles, 0)


def test_complete_revolutions_are_returned_without_the_first_partial_one():
    found = turns_of(np.concatenate([even(1)[70:], even(3)]))
    assert [len(turn) for turn in found] == [200, 200]
    assert all(turn.complete for turn in found)
    assert found[0].rate == pytest.approx(10)
    assert np.allclose(found[0].times, PERIOD * np.arange(130, 330))


@given(st.lists(st.integers(1, 300), min_size=1, max_size=9))
def test_the_revolutions_do_not_depend_on_the_chunks_of_nodes(cuts):
    nodes = np.concatenate([even(4), even(2)[50:], even(1)])
    for a, b in zip(turns_of(nodes), turns_of(nodes, cuts), strict=True):
        assert np.array_equal(a.angle_deg, b.angle_deg)
        assert np.array_equal(a.times, b.times)
        assert (a.complete, a.gaps) == (b.complete, b.gaps)


def test_a_short_revolution_or_one_with_a_gap_or_lost_bytes_is_not_complete():
    short = np.concatenate([even(1), even(1)[:150], even(2)])
    assert [t.complete for t in turns_of(short)] == [True, False, True]
    holed = even(3)
    holed = np.delete(holed, slice(290, 297))  # 14.4 degrees of the second turn
    found = turns_of(np.concatenate([holed, even(2)]))
    assert [t.complete for t in found] == [True, False, True, True]
    hurt = even(4)
    hurt["after_gap"][[250, 260]] = True
    assert [(t.complete, t.gaps) for t in turns_of(hurt)] == [(True, 0), (False, 2), (True, 0)]


def test_a_lost_start_flag_does_not_join_two_revolutions():
    nodes = even(6)
    nodes["start"][600] = False
    found = turns_of(nodes)
    assert [t.complete for t in found] == [True, True, False, False, True]
    assert max(len(t) for t in found) < 210
    assert sum(len(t) for t in found) == 1000


def test_angle_jitter_by_offsets_ends_no_revolution():
    rng = np.random.default_rng(4)
    angles = np.arange(2000) * 1.8 - rng.uniform(4, 8, 2000)
    found = turns_of(nodes_of(angles, range(0, 2000, 200)))
    assert [len(t) for t in found] == [200] * 9
    assert all(t.complete for t in found)


def test_a_lidar_that_does_not_rotate_uses_bounded_memory():
    assembler = RevolutionAssembler(PERIOD)
    still, kept = nodes_of(np.full(5000, 20.0)), 0
    for _ in range(30):
        assembler.feed(still, np.zeros(5000))
        kept = max(kept, sum(len(n) for n in assembler._nodes))
    assert kept <= MAX_NODES + 1


def test_samples_without_return_are_kept_and_masked():
    nodes = even(3)
    nodes["distance_q2"][250:260] = 0
    _, turn = turns_of(nodes)
    assert (len(turn), turn.valid.sum()) == (200, 190)
    scan = turn.scan(range_max=12.0)
    assert scan.valid.sum() == 190
    assert turn.rate == pytest.approx(10)


@given(st.integers(0, 2**32 - 1))
def test_random_nodes_never_fail(seed):
    rng = np.random.default_rng(seed)
    nodes = np.zeros(3000, NODE_DTYPE)
    nodes["angle_q6"] = rng.integers(0, 23040, 3000)
    nodes["start"] = rng.random(3000) < 0.02
    found = turns_of(nodes, rng.integers(1, 500, 20).tolist())
    assert all(not turn.complete for turn in found)


@pytest.mark.parametrize("answer", ANSWERS)
@pytest.mark.parametrize("drift", [-2e-4, 2e-4])
def test_timestamps_have_an_error_below_5_ms_despite_latency_jitter(answer, drift):
    """Bytes wait 1 to 16 ms in the adapter; the device's clock is a little off."""
    rng = np.random.default_rng(8)
    period, baud = PERIODS[answer], FAST.get(answer, 115200)
    decoder = DECODERS[answer]()
    data = stream(answer, int(3 / period))
    times = SampleTimestamps(period, baud, decoder)
    true_period = period * (1 + drift)
    samples = 1 if answer == AnswerType.SCAN else decoder.points
    done, worst, at, now = 0, 0.0, 0, 0.0
    packets, byte = np.arange(len(data) // decoder.size), 1 + np.arange(decoder.size)
    ready = ((packets + 1) * samples - 1 + 1.5) * true_period
    leaves = (ready[:, None] + byte * 10 / baud).ravel()
    while at < len(data):
        now += rng.uniform(0.002, 0.02)
        sent = int((leaves <= now).sum())
        nodes = decoder.feed(data[at:sent])
        stamps = times.of_samples(
            len(nodes), now + rng.uniform(0.001, 0.016) * (rng.random() < 0.7)
        )
        at = max(sent, at)
        if len(nodes) and done > 200:
            true = (done + np.arange(len(nodes))) * true_period
            worst = max(worst, np.abs(stamps - true).max() if now > 1 else 0)
        done += len(nodes)
        assert (np.diff(stamps) > 0).all()
    assert worst < 0.005


def test_lost_samples_advance_the_timestamps():
    decoder = ScanDecoder()
    data, times = stream(AnswerType.SCAN, 4000), SampleTimestamps(508e-6, 115200, decoder)
    for k, piece in enumerate(pieces(data[:5000], [50])):
        times.of_samples(len(decoder.feed(piece)), k * 10 * 508e-6)
    before = times.of_samples(len(decoder.feed(data[5000:5050])), 1000 * 508e-6)
    after = times.of_samples(len(decoder.feed(data[10000:10050])), 1.5)
    assert before[-1] == pytest.approx(1000 * 508e-6, abs=0.003)
    assert after[-1] == pytest.approx(1.5, abs=0.003)
