"""The emulated eMIR obeys commands, has counters of eight bits, and options for unknown details."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab.devices.emir import commands
from slamlab.devices.emir.frames import STATUS, Framer
from slamlab.devices.emir.status import Status
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.emulated_robot import COUNT_SIZE
from slamlab.devices.emulator.serial_line import Faults
from slamlab.simulation.worlds.world import World
from tests.slamlab.devices.emulator_helpers import COUNT, HALL, body_in, receive

POLL_INTERVAL = 0.01  # how often it is asked [s]
INFO = commands.info(True)


def emir(world=HALL, counts=COUNT, **options):
    body = body_in(world, counts)
    return EmirEmulator(body, **options), body


def statuses_of(machine, data, begin, seconds):
    """Status frames that come from a time on, after data."""
    framer = Framer(STATUS)
    received = framer.feed(receive(machine, data, begin, seconds, POLL_INTERVAL))
    assert not framer.damage["bad frames"]
    return [Status.unpack(content) for content in received]


def test_it_is_silent_until_asked_and_again_on_request():
    machine, _ = emir()
    assert statuses_of(machine, b"", 0.0, 1.0) == []
    assert 9 <= len(statuses_of(machine, INFO, 1.0, 1.0)) <= 11  # ten a second
    statuses_of(machine, commands.info(False), 2.0, 0.1)
    assert statuses_of(machine, b"", 2.1, 1.0) == []


def test_a_status_takes_as_long_as_the_line_needs():
    machine, _ = emir()
    received, t = machine.feed(INFO, 0.0), 0.0
    while t < 0.05:
        t += 0.0005
        received += machine.feed(b"", t)
        assert len(received) <= 5760 * t + 1
    assert len(received) == 36


@given(st.integers(-100, 100), st.integers(-100, 100))
@settings(max_examples=30)
def test_it_moves_as_commanded_and_reports_it(v, omega):
    machine, body = emir()
    status = statuses_of(machine, INFO + commands.move(v, omega), 0.0, 0.5)[-1]
    assert (status.speed, status.rotation, status.mode) == (v, omega, 1)
    assert (status.left, status.right) == tuple(np.clip([v - omega, v + omega], -100, 100))
    way, turn = (0.5 * top * share / 100 for top, share in ((0.4, v), (np.radians(100), omega)))
    assert abs(np.hypot(*body.pose[:2]) - abs(way) * abs(np.sinc(turn / 2 / np.pi))) < 0.01
    assert abs(body.pose[2] - turn) < 0.03


@pytest.mark.parametrize("halt", [commands.stop(), commands.move(0, 0), commands.power_off()])
def test_it_stops_on_request(halt):
    machine, body = emir()
    statuses_of(machine, commands.move(80, 20), 0.0, 1.0)
    statuses_of(machine, halt, 1.0, 0.1)
    before = body.pose
    off = halt == commands.power_off()  # then it receives and sends nothing more
    came = statuses_of(machine, INFO + commands.move(50, 0) if off else INFO, 1.1, 1.0)
    assert bool(came) != off
    np.testing.assert_array_equal(body.pose, before)


def test_an_invalid_frame_moves_nothing_and_is_counted():
    machine, body = emir()
    good = commands.move(50, 0)
    bad = [good[:5] + b"3" + good[6:], b"#01FF01-1/", good.replace(b"/", b"|"), b"#01320"]
    statuses_of(machine, b"".join(bad), 0.0, 1.0)
    assert not machine.commands and not body.pose.any() and machine.bad >= 3
    statuses_of(machine, b"xyz" + good, 1.0, 1.0)
    assert body.pose[0] > 0.1


@given(st.lists(st.integers(1, 12), min_size=1, max_size=30))
def test_commands_are_parsed_in_any_chunks(cuts):
    machine, _ = emir()
    data, at, t = INFO + commands.move(3, -4) + commands.beep(0.5), 0, 0.0
    for cut in [*cuts, len(data)]:
        machine.feed(data[at : at + cut], t)
        at, t = at + cut, t + 0.001
    assert machine.commands == [(0x10, 1, 0), (1, 3, 0xFC), (4, 5, 0)]


def test_counters_overflow_and_differences_modulo_256_give_the_path():
    machine, _ = emir()
    statuses = statuses_of(machine, INFO + commands.move(100, 60), 0.0, 12.0)
    for name, whole, count in (("path", 0.4 * 12, 0.01), ("angle", np.radians(60) * 12, COUNT[1])):
        values = [getattr(status, name) for status in statuses]
        assert min(values) < -100 and max(values) > 100  # once over the end at least
        way = sum((b - a + 128) % 256 - 128 for a, b in pairwise(values))
        assert abs(way * count - whole) < 0.02 * whole
    assert all(-128 <= s.path <= 127 and -128 <= s.angle <= 127 for s in statuses)


def test_counters_that_saturate_stop_at_their_end_until_reset():
    machine, _ = emir(saturates=True)
    assert statuses_of(machine, INFO + commands.move(100, -60), 0.0, 8.0)[-1].path == 127
    assert statuses_of(machine, b"", 8.0, 0.5)[-1].angle == -128
    fresh = statuses_of(machine, commands.reset_counters(), 9.0, 0.2)[-1]
    assert 0 <= fresh.path <= 10 and -10 <= fresh.angle <= 0


def test_a_reset_sets_both_counters_to_0_and_moves_nothing():
    machine, _ = emir()
    statuses_of(machine, INFO + commands.move(50, 20), 0.0, 2.0)
    statuses_of(machine, commands.stop(), 2.0, 0.2)
    status = statuses_of(machine, commands.reset_counters(), 3.0, 0.3)[-1]
    assert (status.path, status.angle) == (0, 0)


@given(st.integers(-100, 100), st.integers(10, 100))
@settings(max_examples=12)
def test_a_motion_command_moves_a_distance_and_ends_at_rest(centimetres, speed):
    machine, body = emir()
    status = statuses_of(
        machine, INFO + commands.translate(centimetres / 100, speed), 0.0, abs(centimetres) / 4 + 1
    )[-1]
    assert abs(body.pose[0] - centimetres / 100) < 0.015
    assert (status.speed, status.mode) == (0, 0)


@pytest.mark.parametrize("degrees", [-180, -30, 4, 90])
def test_it_turns_an_angle_and_stands(degrees):
    machine, body = emir()
    status = statuses_of(machine, INFO + commands.rotate(degrees, 50), 0.0, 5.0)[-1]
    assert abs(np.angle(np.exp(1j * (body.pose[2] - np.radians(degrees))))) < np.radians(3)
    assert (status.rotation, status.mode) == (0, 0) and not body.pose[:2].any()


def test_by_default_its_counts_are_not_what_the_thesis_takes_them_for():
    machine, body = emir(counts=COUNT_SIZE)
    statuses_of(machine, commands.translate(1.0, 100), 0.0, 4.0)
    assert abs(body.pose[0] - 1.03) < 0.015
    statuses_of(machine, commands.rotate(180, 50), 4.0, 6.0)
    assert abs(body.pose[2] % (2 * np.pi) - np.radians(90 * 2.14)) < np.radians(3)


def test_limits_of_speed_and_turn_rate_hold():
    machine, _ = emir()
    limits = commands.max_speed(30) + commands.max_rotation(20)
    status = statuses_of(machine, INFO + limits + commands.move(-90, 90), 0.0, 0.3)[-1]
    assert (status.speed, status.rotation) == (-30, 20)


def test_the_minimum_distance_stops_the_robot():
    machine, body = emir(World([(2, -3, 2, 3)]))
    statuses_of(machine, commands.min_distance(0.4) + commands.move(100, 0), 0.0, 10.0)
    # its eyes look 20° aside and see from its rim, 0.15 m off its centre
    ahead = (2 - body.pose[0]) / np.cos(np.radians(20)) - 0.15
    assert 0.38 < ahead < 0.41


def test_the_azimuth_is_its_heading_and_can_be_reset():
    machine, _ = emir()
    statuses_of(machine, commands.rotate(90, 50), 0.0, 3.0)
    assert abs(statuses_of(machine, INFO, 3.0, 0.3)[-1].azimuth - 45) <= 1
    assert statuses_of(machine, commands.reset_azimuth(), 4.0, 0.3)[-1].azimuth == 0


def test_the_emulated_watchdog_is_optional():
    for watchdog, mode in ((None, 1), (0.5, 0)):
        machine, _ = emir(watchdog=watchdog)
        assert statuses_of(machine, INFO + commands.move(20, 0), 0.0, 2.0)[-1].mode == mode


def test_faults_silence_flip_and_unplug_it():
    machine, body = emir(faults=Faults(silent={commands.MOVE}))
    statuses_of(machine, commands.move(50, 0), 0.0, 1.0)
    assert not body.pose.any()
    machine.faults.flip = 0.01
    framer = Framer(STATUS)
    framer.feed(receive(machine, INFO, 1.0, 20.0, POLL_INTERVAL))
    assert 20 < framer.damage["bad frames"] < 120
    machine.faults.unplugged = True
    with pytest.raises(OSError):
        machine.feed(b"", 30.0)
