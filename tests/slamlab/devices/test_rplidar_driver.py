"""The RPLIDAR driver: handshake, scans and their times, stop and close."""

import numpy as np
import pytest

from slamlab.devices.emulator.lidar_models import MODELS
from slamlab.devices.emulator.serial_line import Faults
from slamlab.devices.errors import ConnectionLost, DataTimeout, DeviceNotResponding
from slamlab.devices.rplidar.requests import Command
from slamlab.devices.rplidar.responses import AnswerType, Health
from tests.slamlab.devices.byte_streams import room, stream
from tests.slamlab.devices.emulator_helpers import Bench, assert_helps, assert_right


def test_samples_have_the_time_of_their_measurement():
    setup, took = Bench(), []

    def stamped(times, directions):
        took.append((times[: len(directions)], directions))
        return room(directions)

    setup.machine._measure = stamped
    with setup.lidar() as lidar:
        lidar.start("Standard")
        turn = lidar.revolution()
    times, directions = (np.concatenate(part) for part in zip(*took, strict=True))
    true = np.interp(turn.times, times, np.unwrap(directions, period=360))
    off = (true - turn.angle_deg + 180) % 360 - 180
    assert np.abs(off).max() < 3600 * 0.003  # 3 ms of ten turns a second


@pytest.mark.parametrize(("spin_up", "force"), [(5.0, False), (30.0, True)])
def test_a_spin_up_is_waited_for_unless_scanning_is_forced(spin_up, force):
    setup = Bench(spinning=False, spin_up=spin_up, health=(1, 7))  # a warning only
    with setup.lidar() as lidar:
        assert lidar.health.status == 1
        lidar.start("Standard", force=force)
        assert_right(lidar.revolution())
        assert (Command.FORCE_SCAN in setup.commands()) == force


@pytest.mark.parametrize(
    ("model", "old"),
    [
        ("a2m8", AnswerType.SCAN),
        ("a2m8", AnswerType.ULTRA),
        ("s2", MODELS["s2"].modes[-1].answer_type),
    ],
)
def test_the_stream_of_a_crashed_program_is_stopped_and_drained(model, old):
    setup = Bench(model, scanning=old)
    setup.machine.feed(b"", 99.5)  # half a second of it stands in the buffers
    with setup.lidar() as lidar:
        assert lidar.baud == MODELS[model].baud
        assert setup.commands()[:2] == [Command.STOP, Command.GET_INFO]
        assert_right(lidar.revolution())


@pytest.mark.parametrize("count", [33, 2000])
def test_late_stale_bytes_are_skipped(count):
    setup = Bench(faults=Faults(stale=stream(AnswerType.SCAN, 2000)[-count:]))
    with setup.lidar() as lidar:
        assert not setup.faults.stale  # they came, and nothing was asked twice
        assert setup.commands().count(Command.GET_INFO) == 1
        assert lidar.info.firmware == (1, 29) and lidar.health == Health(0, 0)
        assert_right(lidar.revolution())


@pytest.mark.parametrize(
    ("model", "firmware", "mode"),
    [("a2m8", (1, 15), None), ("a2m8", (1, 29), None), ("s2", None, "standard")],
)
def test_a_lidar_that_does_not_report_its_modes_scans(model, firmware, mode):
    setup = Bench(model, firmware=firmware)
    setup.faults.silent.add(Command.GET_LIDAR_CONF)
    with setup.lidar() as lidar:
        names = ["Standard"] if firmware == (1, 15) else ["Standard", "Express"]
        assert [m.name for m in lidar.modes] == names
        lidar.start(mode)
        assert_right(lidar.revolution())


def test_a_mode_that_does_not_begin_is_replaced_by_the_standard_scan():
    setup = Bench()
    setup.faults.silent.add(Command.EXPRESS_SCAN)
    with setup.lidar() as lidar:
        assert_right(lidar.revolution())
        assert lidar.mode.name == "Standard"
        with pytest.raises(DeviceNotResponding) as refused:
            lidar.start("Boost")
        assert_helps(refused.value)


def test_a_lidar_in_protection_stop_is_reset_once_and_its_boot_text_is_dropped():
    setup = Bench(health=(2, 4))
    with setup.lidar() as lidar:
        assert setup.commands().count(Command.RESET) == 1
        assert lidar.health == Health(0, 0)
        assert_right(lidar.revolution())


def test_a_stopped_lidar_ends_the_iteration():
    setup, seen = Bench(), 0
    with setup.lidar() as lidar:
        for _ in lidar:
            seen += 1
            assert seen < 50
            if seen == 3:
                lidar.stop()
        assert seen <= 5  # two may have been ready
        assert setup.machine.pwm == 0 and setup.machine._scan is None
        assert_right(lidar.revolution())  # asked for one it scans again
        for mode in ("Express", "Standard"):
            lidar.start(mode)
            assert_right(lidar.revolution())
            assert lidar.mode.name == mode


def test_an_error_in_the_block_closes_it_too_which_may_be_done_twice():
    setup = Bench()
    with pytest.raises(ZeroDivisionError), setup.lidar() as lidar:
        lidar.revolution()
        _ = 1 / 0
    lidar.close()
    assert setup.machine.pwm == 0 and setup.machine._scan is None
    assert setup.commands()[-2:] == [Command.STOP, Command.SET_MOTOR_PWM]
    while lidar.revolution() is not None:
        pass
    assert list(lidar) == []
    with pytest.raises(ConnectionLost) as refused:
        lidar.start()
    assert_helps(refused.value)


def test_a_time_limit_that_is_too_short_is_reported():
    setup = Bench(spinning=False, spin_up=1e6)
    with setup.lidar() as lidar:
        lidar._revolutions.start()
        lidar._reader = object.__new__(type("Nobody", (), {"stop": lambda self: None}))
        with pytest.raises(DataTimeout) as late:
            lidar.revolution(timeout=0.01)
        assert_helps(late.value)
