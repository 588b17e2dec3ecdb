"""eMIR's frames, commands, status and counters, as the protocol has them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.devices.emir import Calibration, commands
from slamlab.devices.emir.frames import COMMAND, STATUS, Framer
from slamlab.devices.emir.status import Status
from slamlab.devices.emir.wheel_odometry import CounterUnwrapper, Odometry
from tests.property_testing import assert_same_pose
from tests.slamlab.devices.byte_streams import damaged, pieces

COMMANDS = [
    (commands.move(20, -30), "#0114E209/"),
    (commands.move(0, -1), "#0100FF00/"),
    (commands.stop(), "#00000000/"),
    (commands.info(True), "#100100EF/"),
    (commands.info(False), "#100000F0/"),
    (commands.translate(0.5, 100), "#02326468/"),
    (commands.rotate(90, 50), "#032D329E/"),
    (commands.beep(0.5), "#040500F7/"),
    (commands.reset_azimuth(), "#140000EC/"),
    (commands.reset_counters(), "#150000EB/"),
    (commands.power_off(), "#FF000001/"),
]
DOCUMENTED = b"*235050503E295A32EC2D3701F00CFD07A9/"
RECORDED = [b"*505050505050800000000000F00019C1D6/", b"*505050505050330000000000F00019C123/"]
cuts = st.lists(st.integers(1, 60), min_size=1, max_size=20)
bytes_ = st.integers(-128, 127)


@pytest.mark.parametrize(("made", "expected"), COMMANDS)
def test_a_command_is_the_frame_that_the_protocol_specifies(made, expected):
    assert made == expected.encode()


def test_all_bytes_of_every_move_sum_to_zero_and_are_two_digits():
    for v in range(-100, 101):
        for omega in range(-100, 101):
            made = commands.move(v, omega)
            data = bytes.fromhex(made[1:-1].decode())
            assert (len(made), sum(data) % 256) == (10, 0)
            assert data[:3] == bytes([1, v % 256, omega % 256])


@pytest.mark.parametrize(
    ("wild", "limit"), [(-1e9, -100), (np.inf, 100), (100.4, 100), (np.nan, 0)]
)
def test_moves_are_cut_off_at_a_hundred_percent_and_nan_stops(wild, limit):
    assert commands.move(wild, -wild) == commands.move(limit, -limit)


def test_a_status_is_read_by_name_and_sign():
    (data,) = Framer(STATUS).feed(DOCUMENTED)
    status = Status.unpack(data)
    assert status.proximity == (35, 80, 80, 80, 62, 41)
    assert (status.speed, status.rotation, status.left, status.right) == (50, -20, 45, 55)
    assert (status.mode, status.inputs, status.azimuth) == (1, 0xF0, 12)
    assert (status.path, status.angle) == (-3, 7)
    assert status.volts == pytest.approx(9 + 0x5A / 17)
    assert not status.charging
    assert status.pack() == DOCUMENTED


def test_recorded_frames_hold_their_checksum():
    found = [Status.unpack(data) for data in Framer(STATUS).feed(b"".join(RECORDED))]
    assert [s.charging for s in found] == [True, False]
    assert [(s.path, s.angle) for s in found] == [(0x19, 0xC1 - 256)] * 2


@given(
    st.tuples(*[st.integers(0, 255)] * 6),
    st.tuples(st.integers(0, 255), *[bytes_] * 4, *[st.integers(0, 255)] * 3, *[bytes_] * 2),
)
def test_a_status_packed_and_read_is_the_same(proximity, rest):
    status = Status(proximity, *rest)
    (data,) = Framer(STATUS).feed(status.pack())
    assert Status.unpack(data) == status


@given(cuts, st.integers(0, 2**32 - 1), st.sampled_from([0, 0.003, 0.05]))
def test_the_frames_do_not_depend_on_the_chunks_of_the_stream(sizes, seed, share):
    data = damaged(
        b"".join([DOCUMENTED, *RECORDED] * 20), np.random.default_rng(seed), share, share
    )
    whole, cut = Framer(STATUS), Framer(STATUS)
    expected = whole.feed(data)
    assert [f for piece in pieces(data, sizes) for f in cut.feed(piece)] == expected
    assert +whole.damage == +cut.damage


@pytest.mark.parametrize("mark", [STATUS, COMMAND])
def test_random_and_damaged_characters_never_fail_and_little_is_kept(mark):
    rng = np.random.default_rng(2)
    good = DOCUMENTED if mark == STATUS else commands.move(20, -30)
    framer = Framer(mark)
    marks = np.frombuffer(mark + b"/0123456789ABCDEF", np.uint8)
    for junk in (rng.bytes(50_000), rng.choice(marks, 50_000).tobytes()):
        for piece in pieces(junk + good * 50, rng.integers(1, 100, 50)):
            found = framer.feed(piece)
            assert len(framer._buffer) < 36
        assert found[-1] == bytes.fromhex(good[1:-3].decode())
    assert framer.damage["bad frames"] > 0


def test_a_frame_with_a_flipped_bit_is_no_frame():
    for at in range(1, len(DOCUMENTED) - 1):
        for digit in b"0123456789ABCDEF":
            if DOCUMENTED[at] != digit:
                assert not Framer(STATUS).feed(
                    DOCUMENTED[:at] + bytes([digit]) + DOCUMENTED[at + 1 :]
                )


@pytest.mark.parametrize("n", range(1, len(DOCUMENTED)))
def test_a_frame_truncated_does_not_take_the_next_one_with_it(n):
    framer = Framer(STATUS)
    assert framer.feed(DOCUMENTED[:n] + DOCUMENTED + RECORDED[0]) == [
        bytes.fromhex(frame[1:-3].decode()) for frame in (DOCUMENTED, RECORDED[0])
    ]
    assert framer.damage["bytes dropped"] == n


@given(st.lists(st.integers(-127, 127), max_size=60), bytes_)
def test_counters_that_run_over_are_unwrapped(steps, first):
    counter, value = CounterUnwrapper(), first
    assert counter.advance(first) == 0
    for step in steps:
        value = (value + step + 128) % 256 - 128
        assert counter.advance(value) == step


def test_a_saturating_counter_is_reset_in_time_without_loss():
    counter, zero, total, at = CounterUnwrapper(saturates=True), 0, 0, 0
    counter.advance(0)
    asked = None
    for k in range(400):
        at += 7 if k < 200 else -9
        if asked is not None and k == asked + 2:  # the robot takes its time
            zero, asked = at - 7 if k < 200 else at + 9, None
        total += counter.advance(min(max(at - zero, -128), 127))
        if counter.near_limit and asked is None:
            counter.expect_reset()
            asked = k
    assert total == at


def test_a_reset_that_was_not_received_is_forgotten():
    counter = CounterUnwrapper()
    counter.advance(50)
    counter.expect_reset()
    assert [counter.advance(v) for v in (51, 52, 53, 52, 51, 50, 49, 48, 47, 46)] == [
        *[1, 1, 1],
        *[-1] * 7,
    ]
    assert counter.advance(-4) == -50


def test_a_circle_in_counts_is_a_circle_in_metres():
    odometry = Odometry(Calibration(path=0.01, angle=np.radians(2)))
    odometry.advance(0, 0, 0.0)
    for k in range(1, 181):
        pose = odometry.advance((k + 128) % 256 - 128, (k + 128) % 256 - 128, 0.1 * k)
    assert_same_pose(pose, np.zeros(3), 1e-9)
    radius = 0.01 / np.radians(2)
    assert_same_pose(odometry.pose_at(9.0), np.array([0, 2 * radius, np.pi]))


def test_calibration_scales_distance_and_turn():
    odometry = Odometry(Calibration(path=0.0103, angle=-np.radians(2.14)))
    odometry.advance(0, 0, 0.0)
    odometry.advance(100, 0, 1.0)
    assert_same_pose(odometry.advance(100, 10, 2.0), np.array([1.03, 0, -np.radians(21.4)]))


def test_a_pose_is_interpolated_and_a_little_extrapolated():
    odometry = Odometry(Calibration())
    assert_same_pose(odometry.pose_at(5.0), np.zeros(3))
    odometry.advance(0, 0, 10.0)
    odometry.advance(10, 0, 10.2)
    for time, x in ((9, 0), (10.0, 0), (10.05, 0.025), (10.2, 0.1), (10.3, 0.15), (99, 0.25)):
        assert_same_pose(odometry.pose_at(time), np.array([x, 0, 0]))
