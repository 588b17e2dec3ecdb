"""The RPLIDAR driver against an emulated device in memory, in simulated time: no test waits."""

import numpy as np
import pytest

from slamlab.devices.emulator.serial_line import Faults
from slamlab.devices.errors import (
    ChecksumError,
    ConnectionLost,
    DataTimeout,
    DeviceFault,
    DeviceNotResponding,
    DeviceSilent,
    ProtocolError,
    SlamlabError,
    UnexpectedDescriptor,
    UnsupportedMode,
)
from slamlab.devices.rplidar.requests import Command
from slamlab.devices.rplidar.responses import AnswerType, Health
from slamlab.devices.rplidar.scan_stream import (
    CORRUPTION_WINDOW,
    FIRST_DATA_TIMEOUT,
    RECEIVE_TIMEOUT,
    ScanStream,
)
from tests.slamlab.devices.byte_streams import room, stream
from tests.slamlab.devices.emulator_helpers import Bench, assert_right


def after(setup, seconds, fault):
    """Let a fault begin in some seconds; a list to which its time is added then."""
    feed, due, begun = setup.machine.feed, setup.clock.now() + seconds, []

    def later(data, now):
        if now >= due and not begun:
            begun.append(now)
            setattr(setup.faults, fault, True)
        return feed(data, now)

    setup.machine.feed = later
    return begun


def assert_helps(error):
    """Every error states what, why, and what to do."""
    assert isinstance(error, SlamlabError)
    assert error.what and error.cause and error.step
    assert f"{error.what}. Likely cause: {error.cause}. What to do: {error.step}." == str(error)


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


@pytest.mark.parametrize("old", [AnswerType.SCAN, AnswerType.ULTRA])
def test_the_stream_of_a_crashed_program_is_stopped_and_drained(old):
    setup = Bench(scanning=old)
    setup.machine.feed(b"", 99.5)  # half a second of it stands in the buffers
    with setup.lidar() as lidar:
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


def test_an_unknown_mode_is_refused_with_the_available_ones():
    with Bench().lidar() as lidar, pytest.raises(UnsupportedMode) as refused:
        lidar.start("Sensitivity")
    assert_helps(refused.value)
    assert "Standard, Express, Boost" in str(refused.value)


def test_a_lidar_in_protection_stop_is_reset_once_and_its_boot_text_is_dropped():
    setup = Bench(health=(2, 4))
    with setup.lidar() as lidar:
        assert setup.commands().count(Command.RESET) == 1
        assert lidar.health == Health(0, 0)
        assert_right(lidar.revolution())


def test_a_persistent_lidar_fault_is_raised_with_its_code():
    setup = Bench(health=(2, 0x0204), reset_heals=False)
    with pytest.raises(DeviceFault) as refused:
        setup.lidar()
    assert_helps(refused.value)
    assert refused.value.health == Health(2, 0x0204)
    assert "0x0204" in str(refused.value)
    assert setup.commands().count(Command.RESET) == 1
    assert setup.machine.pwm == 0


def test_a_missing_response_is_reported_with_the_baud_rates():
    setup = Bench()
    setup.faults.silent |= set(Command)
    with pytest.raises(DeviceNotResponding) as refused:
        setup.lidar()
    assert_helps(refused.value)
    assert "115200" in str(refused.value) and "no bytes are received" in str(refused.value)
    with pytest.raises(DeviceNotResponding, match="115200, 256000, 460800, 1000000"):
        setup.lidar(baud=None)


@pytest.mark.parametrize(
    ("junk", "word"), [(b"\xaa\x55\x01\x02" * 9, "YDLIDAR"), (b"\x07" * 40, "baud rate")]
)
def test_a_device_that_is_not_an_rplidar_is_distinguished(junk, word):
    setup = Bench()
    messages = [0.0]

    def talk(data, now):
        if now - messages[-1] < 0.02:
            return b""
        messages.append(now)
        return junk

    setup.machine.feed = talk
    with pytest.raises(DeviceNotResponding, match=word) as refused:
        setup.lidar()
    assert_helps(refused.value)


def test_a_device_that_does_not_report_its_health_is_refused():
    setup = Bench()
    setup.faults.silent.add(Command.GET_HEALTH)
    with pytest.raises(UnexpectedDescriptor) as refused:
        setup.lidar()
    assert_helps(refused.value)


def test_a_motor_that_never_rotates_is_a_timeout():
    setup = Bench(faults=Faults(stalled=True))
    with setup.lidar() as lidar, pytest.raises(DataTimeout) as lost:
        lidar.revolution()
    assert_helps(lost.value)
    assert not isinstance(lost.value, ConnectionLost)


@pytest.mark.parametrize(
    ("fault", "kind", "limit"), [("unplugged", ConnectionLost, 1.0), ("stalled", DeviceSilent, 1.1)]
)
def test_a_lost_lidar_is_reported_within_a_second(fault, kind, limit):
    setup = Bench()
    with setup.lidar() as lidar:
        lidar.start()
        begun = after(setup, 2.0, fault)
        with pytest.raises(kind) as lost:
            while lidar.revolution():
                pass
        assert_helps(lost.value)
        assert setup.clock.now() - begun[0] < limit
        with pytest.raises(ConnectionLost):
            lidar.revolution()


def silent(quiet, begin, seconds):
    """Feed a stream nothing, in the small steps of one who listens."""
    for k in range(1, round(seconds / 0.05) + 1):
        quiet.feed(b"", begin + 0.05 * k)


def test_the_receive_timeout_uses_the_clock_of_the_stream():
    quiet = ScanStream(AnswerType.SCAN, 508e-6, 115200, now=10.0)
    silent(quiet, 10.0, FIRST_DATA_TIMEOUT - 0.05)
    with pytest.raises(DataTimeout):
        silent(quiet, 10.0 + FIRST_DATA_TIMEOUT, 0.15)
    begun = ScanStream(AnswerType.SCAN, 508e-6, 115200, now=10.0)
    begun.feed(stream(AnswerType.SCAN, 10), 10.0 + FIRST_DATA_TIMEOUT)
    silent(begun, 10.0 + FIRST_DATA_TIMEOUT, RECEIVE_TIMEOUT - 0.05)
    with pytest.raises(DeviceSilent):
        silent(begun, 10.0 + FIRST_DATA_TIMEOUT + RECEIVE_TIMEOUT, 0.15)
    assert RECEIVE_TIMEOUT + 0.05 < 1


def test_a_suspended_program_does_not_raise_a_receive_timeout():
    begun = ScanStream(AnswerType.SCAN, 508e-6, 115200, now=10.0)
    begun.feed(stream(AnswerType.SCAN, 10), 10.1)
    for k in range(5):
        begun.feed(b"", 20.0 + 10 * k)  # a laptop that slept, a cell that took all the time
    begun.feed(stream(AnswerType.SCAN, 10), 80.0)
    with pytest.raises(DeviceSilent):
        silent(begun, 80.0, RECEIVE_TIMEOUT + 0.1)


def test_a_stream_of_garbage_is_an_error_but_a_burst_is_not():
    rng, good = np.random.default_rng(1), stream(AnswerType.SCAN, 20_000)
    burst = ScanStream(AnswerType.SCAN, 508e-6, 115200, now=0.0)
    for k in range(10):
        burst.feed(rng.bytes(8000), k)
        burst.feed(good, k + 0.5)
    with pytest.raises(ChecksumError) as refused:
        for k in range(20):
            burst.feed(rng.bytes(CORRUPTION_WINDOW // 2), 20 + k)
    assert_helps(refused.value)
    assert isinstance(refused.value, ProtocolError)


def test_reconnection_after_replugging_marks_the_gap():
    setup = Bench()
    with setup.lidar(reconnect=True) as lidar:
        lidar.start("Express")
        after(setup, 2.0, "unplugged")
        tries = []

        def opener(name, baud):
            tries.append(name)
            setup.faults.unplugged = len(tries) < 3
            return setup.opener(name, baud)

        lidar._opener = opener
        while not lidar.revolution().after_gap:
            pass
        assert not lidar.revolution().after_gap
        assert_right(lidar.revolution())
        assert lidar.mode.name == "Express"
        assert lidar.stats["reconnects"] == 1


def test_lost_bytes_are_counted_and_the_revolution_is_marked():
    setup = Bench(faults=Faults(lose=2e-4))
    with setup.lidar() as lidar:
        lidar.start("Standard")
        turns = [lidar.revolution() for _ in range(30)]
        while lidar.stats["resyncs"] < 3:
            turns.append(lidar.revolution())
        assert lidar.stats["bytes dropped"] > 0
        assert any(turn.complete for turn in turns)


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
