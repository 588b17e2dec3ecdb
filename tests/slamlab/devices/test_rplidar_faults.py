"""Faults of an RPLIDAR or its connection: reported in time with the remedy, or reconnected."""

import numpy as np
import pytest

from slamlab.devices import errors
from slamlab.devices.emulator.serial_line import Faults
from slamlab.devices.rplidar.requests import Command
from slamlab.devices.rplidar.responses import AnswerType, Health
from slamlab.devices.rplidar.scan_stream import (
    CORRUPTION_WINDOW,
    FIRST_DATA_TIMEOUT,
    RECEIVE_TIMEOUT,
    ScanStream,
)
from tests.slamlab.devices.byte_streams import stream
from tests.slamlab.devices.emulator_helpers import Bench, assert_helps, assert_right


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


def test_a_persistent_lidar_fault_is_raised_with_its_code():
    setup = Bench(health=(2, 0x0204), reset_heals=False)
    with pytest.raises(errors.DeviceFault) as refused:
        setup.lidar()
    assert_helps(refused.value)
    assert refused.value.health == Health(2, 0x0204)
    assert "0x0204" in str(refused.value)
    assert setup.commands().count(Command.RESET) == 1
    assert setup.machine.pwm == 0


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
    with pytest.raises(errors.DeviceNotResponding, match=word) as refused:
        setup.lidar()
    assert_helps(refused.value)


def test_a_device_that_does_not_report_its_health_is_refused():
    setup = Bench()
    setup.faults.silent.add(Command.GET_HEALTH)
    with pytest.raises(errors.UnexpectedDescriptor) as refused:
        setup.lidar()
    assert_helps(refused.value)


@pytest.mark.parametrize(
    ("fault", "kind", "limit"),
    [("unplugged", errors.ConnectionLost, 1.0), ("stalled", errors.DeviceSilent, 1.1)],
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
        with pytest.raises(errors.ConnectionLost):
            lidar.revolution()


def silent(quiet, begin, seconds):
    """Feed a stream nothing, in the small steps of one who listens."""
    for k in range(1, round(seconds / 0.05) + 1):
        quiet.feed(b"", begin + 0.05 * k)


def test_the_receive_timeout_uses_the_clock_of_the_stream():
    quiet = ScanStream(AnswerType.SCAN, 508e-6, 115200, now=10.0)
    silent(quiet, 10.0, FIRST_DATA_TIMEOUT - 0.05)
    with pytest.raises(errors.DataTimeout):
        silent(quiet, 10.0 + FIRST_DATA_TIMEOUT, 0.15)
    begun = ScanStream(AnswerType.SCAN, 508e-6, 115200, now=10.0)
    begun.feed(stream(AnswerType.SCAN, 10), 10.0 + FIRST_DATA_TIMEOUT)
    silent(begun, 10.0 + FIRST_DATA_TIMEOUT, RECEIVE_TIMEOUT - 0.05)
    with pytest.raises(errors.DeviceSilent):
        silent(begun, 10.0 + FIRST_DATA_TIMEOUT + RECEIVE_TIMEOUT, 0.15)
    assert RECEIVE_TIMEOUT + 0.05 < 1


def test_a_suspended_program_does_not_raise_a_receive_timeout():
    begun = ScanStream(AnswerType.SCAN, 508e-6, 115200, now=10.0)
    begun.feed(stream(AnswerType.SCAN, 10), 10.1)
    for k in range(5):
        begun.feed(b"", 20.0 + 10 * k)  # a laptop that slept, a cell that took all the time
    begun.feed(stream(AnswerType.SCAN, 10), 80.0)
    with pytest.raises(errors.DeviceSilent):
        silent(begun, 80.0, RECEIVE_TIMEOUT + 0.1)


def test_a_stream_of_garbage_is_an_error_but_a_burst_is_not():
    rng, good = np.random.default_rng(1), stream(AnswerType.SCAN, 20_000)
    burst = ScanStream(AnswerType.SCAN, 508e-6, 115200, now=0.0)
    for k in range(10):
        burst.feed(rng.bytes(8000), k)
        burst.feed(good, k + 0.5)
    with pytest.raises(errors.ChecksumError) as refused:
        for k in range(20):
            burst.feed(rng.bytes(CORRUPTION_WINDOW // 2), 20 + k)
    assert_helps(refused.value)
    assert isinstance(refused.value, errors.ProtocolError)


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
