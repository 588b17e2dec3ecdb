"""The eMIR driver against an emulated robot in simulated time: no test waits."""

import numpy as np
import pytest

from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir import Calibration, Emir, commands
from slamlab.devices.emir.driver import WATCHDOG_TIMEOUT
from slamlab.devices.emir.session import Session
from slamlab.devices.emir.wheel_odometry import Odometry
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.in_memory_emulators import InMemoryPort
from slamlab.devices.emulator.serial_line import Faults
from slamlab.devices.errors import ConnectionLost, DeviceNotResponding, DeviceSilent
from slamlab.geometry import between
from tests.property_testing import assert_same_pose
from tests.slamlab.devices.emulator_helpers import COUNT, body_in


class Driven(EmirEmulator):
    """An eMIR that does things when its time has come."""

    def at(self, seconds, what):
        self.agenda = [*getattr(self, "agenda", []), (seconds, what)]
        return self

    def feed(self, data, now):
        agenda = getattr(self, "agenda", [])
        for seconds, what in [entry for entry in agenda if now >= entry[0]]:
            agenda.remove((seconds, what))
            what()
        return super().feed(data, now)


def opened(machine, clock=None, **options):
    clock = clock or SimulatedClock(100.0)
    return Emir(
        "memory",
        opener=lambda name, baud: InMemoryPort(machine, clock, name),
        clock=clock,
        **options,
    )


def until(emir, time):
    """Let simulated time pass."""
    while emir.clock.now() < time and emir.error is None:
        emir.wait()


def moves(machine):
    return [(a, b) for opcode, a, b in machine.commands if opcode == commands.MOVE]


def test_it_stands_and_reports_its_status_once_it_is_open():
    machine = EmirEmulator(body_in())
    with opened(machine) as emir:
        assert machine.commands[:2] == [(0, 0, 0), (0x10, 1, 0)]
        assert emir.status.proximity == (80,) * 6
        assert_same_pose(emir.pose, np.zeros(3))


@pytest.mark.parametrize("saturates", [False, True])
def test_the_path_length_is_summed_far_beyond_a_byte(saturates):
    body = body_in()
    machine = EmirEmulator(body, saturates=saturates)
    with opened(machine, saturates=saturates, watchdog=None) as emir:
        emir.move(100, 30)
        until(emir, 112.0)
        emir.stop()
        until(emir, emir.clock.now() + 2)
        counts = body.counters()
        assert counts[0] > 2 * 128 and counts[1] > 128
        # counted in whole centimetres and two degrees: within a few of each
        d, turn = np.array(counts) * [0.01, np.radians(2)]
        assert emir.pose[2] == pytest.approx(np.angle(np.exp(1j * turn)), abs=np.radians(6))
        assert np.hypot(*(emir.pose[:2] - body.pose[:2])) < 0.1
        assert d > 3
    resets = sum(opcode == commands.RESET_COUNTERS for opcode, _, _ in machine.commands)
    assert (resets > 0) == saturates


def test_a_command_is_repeated_five_times_a_second_until_the_next():
    machine = EmirEmulator(body_in(), watchdog=0.5)
    with opened(machine, watchdog=None) as emir:
        begin = emir.clock.now()
        emir.move(30, -20)
        until(emir, begin + 10)
        assert len(moves(machine)) == pytest.approx(50, rel=0.25)
        assert set(moves(machine)) == {(30, 256 - 20)}
        emir.stop()
        until(emir, emir.clock.now() + 1)
        count = len(moves(machine))
        until(emir, emir.clock.now() + 2)
        assert len(moves(machine)) == count


class Stepped(Session):
    """A connection in simulated time that passes only as the test goes on: no thread is late."""

    def __init__(self, machine):
        self.time = SimulatedClock(100.0)
        odometry = Odometry(Calibration())
        super().__init__(
            "memory", 57600, odometry, WATCHDOG_TIMEOUT, self.opener(machine), self.time
        )

    def opener(self, machine):
        return lambda name, baud: InMemoryPort(machine, self.time, name)

    def go_on(self, seconds):
        end = self.time.now() + seconds
        while self.time.now() < end:
            self.step()


@pytest.mark.parametrize("watchdog", [None, 0.5])
def test_the_command_watchdog_ends_a_motion_unless_it_is_renewed(watchdog):
    body = body_in()
    session = Stepped(EmirEmulator(body, watchdog=watchdog))
    session.move(commands.move(50, 0), repeated=True)
    for _ in range(20):
        session.go_on(0.5)
        session.renew()
        assert body._speeds.any()
    session.go_on(0.9 * WATCHDOG_TIMEOUT)
    assert body._speeds.any() and not session.watchdog_stops
    session.go_on(0.1 * WATCHDOG_TIMEOUT + 0.5)
    for _ in range(2):
        assert not body._speeds.any() and session.watchdog_stops == 1
        session.go_on(10)
    session.move(commands.move(50, 0), repeated=True)
    session.go_on(0.5)
    assert body._speeds.any()


def test_an_invalid_motion_leaves_the_motion_unchanged():
    body = body_in()
    session = Stepped(EmirEmulator(body, watchdog=0.5))
    session.move(commands.move(50, 0), repeated=True)
    session.go_on(0.5)
    for frame in (commands.beep(0.2), commands.reset_counters()):
        session.send(frame)
    session.go_on(1)
    assert body._speeds.any()  # still repeated: the robot's own watchdog keeps quiet
    session.go_on(WATCHDOG_TIMEOUT)
    assert not body._speeds.any()  # and still to be renewed


@pytest.mark.parametrize("act", [Emir.reset, Emir.beep])
def test_to_beep_and_to_reset_are_no_motions(act):
    with opened(EmirEmulator(body_in()), watchdog=None) as emir:
        emir.move(50, 0)
        act(emir)
        assert emir._session._repeated_frame == commands.move(50, 0)


def replugged(machine, begin, end):
    """A machine that is out of reach from a time to another."""
    for when, gone in ((begin, True), (end, False)):
        machine.at(when, lambda gone=gone: setattr(machine.faults, "unplugged", gone))
    return machine


def test_the_driver_reconnects_on_request_and_the_robot_is_at_rest():
    body = body_in()
    machine = replugged(Driven(body), 105.0, 106.0)
    with opened(machine, reconnect=True, watchdog=None) as emir:
        emir.move(50, 20)
        while not emir.stats["reconnects"]:
            emir.clock.sleep(0.1)
        until(emir, emir.clock.now() + 1)
        assert emir.error is None and not body._speeds.any()
        d, turn = np.array(body.counters()) * COUNT
        off = np.angle(np.exp(1j * (emir.pose[2] - turn)))
        assert abs(off) < np.radians(4)  # what it drove meanwhile, too
        assert d > 0.5
        emir.move(50, 0)
        until(emir, emir.clock.now() + 1)
        assert body.counters()[0] * COUNT[0] > d + 0.1


def test_a_restarted_robot_keeps_its_pose():
    odometry = Odometry(Calibration())
    for k in range(50):
        odometry.advance(k, k, 0.1 * k)
    before = odometry.pose_at(4.9)
    odometry.expect_gap()
    odometry.advance(0, 0, 9.0)
    assert_same_pose(odometry.pose_at(9.0), before)
    odometry.advance(1, 0, 9.1)
    assert between(before, odometry.pose_at(9.1))[0] == pytest.approx(0.01)


def test_metres_and_radians_a_second_become_percent_by_the_calibration():
    machine = EmirEmulator(body_in())
    with opened(machine, calibration=Calibration(top_speed=0.5, top_turn=-2.0)) as emir:
        emir.drive(0.1, 1.0)
        assert moves(machine)[-1] == (20, 256 - 50)


def test_an_error_in_the_block_stops_it_and_it_may_be_closed_twice():
    body = body_in()
    machine = EmirEmulator(body)
    with pytest.raises(ZeroDivisionError), opened(machine) as emir:
        emir.move(50, 0)
        _ = 1 / 0
    emir.close()
    assert machine.commands[-3:] == [(1, 0, 0), (0, 0, 0), (0x10, 0, 0)]
    assert not body._speeds.any()
    assert emir.wait() is None
    with pytest.raises(ConnectionLost, match="What to do:"):
        emir.move(1, 1)


def test_a_missing_first_status_is_reported_with_what_to_check():
    faults = Faults(silent={commands.INFO})
    with pytest.raises(DeviceNotResponding, match=r"switched off.*What to do:"):
        opened(EmirEmulator(body_in(), faults=faults))


def test_a_stopped_status_stream_is_requested_again():
    machine = Driven(body_in())
    machine.at(101.0, lambda: setattr(machine, "_streaming", False))
    with opened(machine) as emir:
        until(emir, 104.0)
        assert emir.error is None
        assert machine.commands.count((0x10, 1, 0)) > 1


@pytest.mark.parametrize(
    ("fault", "kind"), [({"unplugged": True}, ConnectionLost), ({"lose": 1.0}, DeviceSilent)]
)
def test_a_lost_robot_is_reported_within_a_second(fault, kind):
    machine = Driven(body_in(), rng=np.random.default_rng(0))
    for name, value in fault.items():
        machine.at(103.0, lambda name=name, value=value: setattr(machine.faults, name, value))
    emir = opened(machine)
    with pytest.raises(kind):
        until(emir, 200.0)
        emir.move(1, 1)
    assert emir.clock.now() < 104.2
    emir.close()


def test_damaged_frames_are_counted_and_the_path_is_still_right():
    body = body_in()
    machine = EmirEmulator(body, faults=Faults(flip=0.01), rng=np.random.default_rng(1))
    with opened(machine, watchdog=None) as emir:
        emir.move(100, 0)
        until(emir, 120.0)
        emir.stop()
        until(emir, emir.clock.now() + 3)
        assert emir.stats["bad frames"] > 10
        assert emir.pose[0] == pytest.approx(body.pose[0], abs=0.03)
