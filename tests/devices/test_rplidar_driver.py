"""The RPLIDAR driver against an emulated device in memory, in simulated time: no test waits."""

import numpy as np
import pytest

from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emulator.rplidar_emulator import RPLidarEmulator
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
from slamlab.devices.memory_port import MemoryPort
from slamlab.devices.rplidar import RPLidar
from slamlab.devices.rplidar.requests import Command
from slamlab.devices.rplidar.responses import AnswerType, Health
from slamlab.devices.rplidar.scan_stream import (
    DAMAGE_WINDOW,
    FIRST_DATA_TIMEOUT,
    RECEIVE_TIMEOUT,
    ScanStream,
)
from tests.devices.byte_streams import room, stream


def measure(times, directions):
    return room(directions)


class EmulatedLidar:
    """A machine, a clock, and the driver between them."""

    def __init__(self, **machine):
        self.clock, self.ports, self.back_at = SimulatedClock(100.0), 0, None
        self.faults = machine.setdefault("faults", Faults())
        self.machine = RPLidarEmulator(measure, **machine)

    def opener(self, name, baud):
        self.ports += 1
        if self.ports == self.back_at:
            self.faults.unplugged = False
        if self.faults.unplugged:
            raise ConnectionLost("unplugged", "it was", "plug it in")
        return MemoryPort(self.machine, self.clock, name)

    def lidar(self, **options):
        return RPLidar("memory", opener=self.opener, clock=self.clock, **options)

    def at(self, seconds, what):
        """Do something when the machine's time has come, whoever asks it then."""
        feed, due = self.machine.feed, self.clock.now() + seconds

        def later(data, now):
            nonlocal due
            if now >= due:
                due = np.inf
                what()
            return feed(data, now)

        self.machine.feed = later

    def commands(self):
        return [command for command, _ in self.machine.requests]


def assert_helps(error):
    """Every error says what, why, and what to do."""
    assert isinstance(error, SlamlabError)
    assert error.what and error.cause and error.step
    assert f"{error.what}. Likely: {error.cause}. Next: {error.step}." == str(error)


def assert_right(turn):
    mm = room(turn.angle_deg)
    assert np.abs(turn.range_mm - mm).max() < 12  # steps of 8 mm in the ultra mode
    assert turn.complete


def test_who_it_is_and_what_it_can_is_asked_at_once():
    with EmulatedLidar().lidar() as lidar:
        assert lidar.info.firmware == (1, 29)
        assert lidar.health == Health(0, 0)
        assert [m.name for m in lidar.modes] == ["Standard", "Express", "Boost"]
        assert [m.range_max for m in lidar.modes] == [12, 12, 12]
        assert lidar.typical.name == "Boost"
        assert "RPLIDAR A2" in repr(lidar)


@pytest.mark.parametrize("mode", ["Standard", "Express", "Boost", 0, 1, 2])
def test_every_mode_gives_whole_right_turns(mode):
    with EmulatedLidar().lidar() as lidar:
        lidar.start(mode)
        turns = [lidar.turn() for _ in range(3)]
        for turn in turns:
            assert_right(turn)
            assert turn.rate == pytest.approx(10, rel=0.01)
            assert np.diff(turn.times).min() > 0
        assert mode in (lidar.mode.name, lidar.mode.number)


def test_points_carry_the_time_at_which_they_were_measured():
    setup, took = EmulatedLidar(), []

    def stamped(times, directions):
        took.append((times[: len(directions)], directions))
        return room(directions)

    setup.machine._measure = stamped
    with setup.lidar() as lidar:
        lidar.start("Standard")
        turn = lidar.turn()
    times, directions = (np.concatenate(part) for part in zip(*took, strict=True))
    true = np.interp(turn.times, times, np.unwrap(directions, period=360))
    off = (true - turn.angle_deg + 180) % 360 - 180
    assert np.abs(off).max() < 3600 * 0.003  # 3 ms of ten turns a second


def test_forced_scanning_does_not_wait_for_an_even_rotation():
    setup = EmulatedLidar(spinning=False, spin_up=30.0)
    with setup.lidar() as lidar:
        lidar.start("Standard", force=True)
        assert_right(lidar.turn())
        assert Command.FORCE_SCAN in setup.commands()


@pytest.mark.parametrize("old", [AnswerType.SCAN, AnswerType.EXPRESS, AnswerType.ULTRA])
def test_the_stream_of_a_program_that_died_is_stopped_and_dropped(old):
    setup = EmulatedLidar(scanning=old)
    setup.machine.feed(b"", 99.5)  # half a second of it stands in the buffers
    with setup.lidar() as lidar:
        assert setup.commands()[:2] == [Command.STOP, Command.GET_INFO]
        assert_right(lidar.turn())


def test_thirty_three_stale_bytes_that_come_after_all_are_passed_over():
    setup = EmulatedLidar()
    stale = stream(AnswerType.SCAN, 2000)[-33:]
    feed, first = setup.machine.feed, []

    def late(data, now):
        answer = feed(data, now)
        if answer and not first:
            first.append(now)
            return stale + answer
        return answer

    setup.machine.feed = late
    with setup.lidar() as lidar:
        assert first
        assert_right(lidar.turn())


@pytest.mark.parametrize("firmware", [(1, 15), (1, 20), (1, 29)])
def test_firmware_that_keeps_silent_about_its_modes_scans_anyway(firmware):
    setup = EmulatedLidar(firmware=firmware)
    setup.faults.silent.add(Command.GET_LIDAR_CONF)
    with setup.lidar() as lidar:
        names = ["Standard"] if firmware < (1, 17) else ["Standard", "Express"]
        assert [m.name for m in lidar.modes] == names
        assert_right(lidar.turn())


def test_a_mode_that_does_not_begin_gives_way_to_the_standard_scan():
    setup = EmulatedLidar()
    setup.faults.silent.add(Command.EXPRESS_SCAN)
    with setup.lidar() as lidar:
        assert_right(lidar.turn())
        assert lidar.mode.name == "Standard"
        with pytest.raises(DeviceNotResponding) as refused:
            lidar.start("Boost")
        assert_helps(refused.value)


def test_an_unknown_mode_is_refused_with_those_there_are():
    with EmulatedLidar().lidar() as lidar, pytest.raises(UnsupportedMode) as refused:
        lidar.start("Sensitivity")
    assert_helps(refused.value)
    assert "Standard, Express, Boost" in str(refused.value)


def test_a_lidar_that_protects_itself_is_reset_once_and_its_boot_text_dropped():
    setup = EmulatedLidar(health=(2, 4))
    with setup.lidar() as lidar:
        assert setup.commands().count(Command.RESET) == 1
        assert lidar.health == Health(0, 0)
        assert_right(lidar.turn())


def test_a_lidar_that_stays_ill_is_a_fault_with_its_code():
    setup = EmulatedLidar(health=(2, 0x0204), reset_heals=False)
    with pytest.raises(DeviceFault) as refused:
        setup.lidar()
    assert_helps(refused.value)
    assert refused.value.health == Health(2, 0x0204)
    assert "0x0204" in str(refused.value)
    assert setup.commands().count(Command.RESET) == 1
    assert setup.machine.pwm == 0


def test_a_warning_does_not_keep_it_from_scanning():
    with EmulatedLidar(health=(1, 7)).lidar() as lidar:
        assert lidar.health.status == 1
        assert_right(lidar.turn())


def test_silence_is_told_with_the_speeds_tried():
    setup = EmulatedLidar()
    setup.faults.silent |= set(Command)
    with pytest.raises(DeviceNotResponding) as refused:
        setup.lidar()
    assert_helps(refused.value)
    assert "115200" in str(refused.value) and "nothing comes" in str(refused.value)
    with pytest.raises(DeviceNotResponding, match="115200, 256000, 460800, 1000000"):
        setup.lidar(baud=None)


@pytest.mark.parametrize(
    ("junk", "word"), [(b"\xaa\x55\x01\x02" * 9, "YDLIDAR"), (b"\x07" * 40, "speed")]
)
def test_what_is_no_rplidar_is_told_apart(junk, word):
    setup = EmulatedLidar()
    said = [0.0]

    def talk(data, now):
        if now - said[-1] < 0.02:
            return b""
        said.append(now)
        return junk

    setup.machine.feed = talk
    with pytest.raises(DeviceNotResponding, match=word) as refused:
        setup.lidar()
    assert_helps(refused.value)


def test_one_that_does_not_say_how_it_is_is_not_trusted():
    setup = EmulatedLidar()
    setup.faults.silent.add(Command.GET_HEALTH)
    with pytest.raises(UnexpectedDescriptor) as refused:
        setup.lidar()
    assert_helps(refused.value)


def test_five_seconds_of_spin_up_are_waited_for():
    setup = EmulatedLidar(spinning=False, spin_up=5.0)
    with setup.lidar() as lidar:
        lidar.start()
        begin = setup.clock.now()
        assert_right(lidar.turn())
        assert lidar._stream is not None
        assert begin >= 100


def test_a_motor_that_never_turns_is_a_timeout():
    setup = EmulatedLidar(faults=Faults(stalled=True))
    with setup.lidar() as lidar, pytest.raises(DataTimeout) as lost:
        lidar.turn()
    assert_helps(lost.value)
    assert not isinstance(lost.value, ConnectionLost)


def test_an_unplugged_lidar_is_told_within_a_second():
    setup, when = EmulatedLidar(), []
    with setup.lidar() as lidar:
        lidar.start()

        def pull():
            when.append(setup.clock.now())
            setup.faults.unplugged = True

        setup.at(2.0, pull)
        with pytest.raises(ConnectionLost) as lost:
            while lidar.turn():
                pass
        assert_helps(lost.value)
        assert setup.clock.now() - when[0] < 1.0
        with pytest.raises(ConnectionLost):
            lidar.turn()


def test_a_lidar_cut_off_behind_its_adapter_is_told_within_a_second():
    setup, when = EmulatedLidar(), []
    with setup.lidar() as lidar:
        lidar.start()

        def cut():
            when.append(setup.clock.now())
            setup.faults.stalled = True

        setup.at(2.0, cut)
        with pytest.raises(DeviceSilent) as lost:
            while lidar.turn():
                pass
        assert setup.clock.now() - when[0] < 1.1
        assert isinstance(lost.value, ConnectionLost) and isinstance(lost.value, DataTimeout)


def silent(quiet, begin, seconds):
    """Feed a stream nothing, in the small steps of one who listens."""
    for k in range(1, round(seconds / 0.05) + 1):
        quiet.feed(b"", begin + 0.05 * k)


def test_silence_is_judged_by_the_stream_s_own_clock():
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


def test_a_program_that_did_not_come_to_listening_takes_no_device_for_lost():
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
            burst.feed(rng.bytes(DAMAGE_WINDOW // 2), 20 + k)
    assert_helps(refused.value)
    assert isinstance(refused.value, ProtocolError)


def test_replugged_it_goes_on_where_that_is_wanted_and_marks_the_gap():
    setup = EmulatedLidar()
    with setup.lidar(reconnect=True) as lidar:
        lidar.start("Express")
        setup.at(2.0, lambda: setattr(setup.faults, "unplugged", True))
        setup.back_at = setup.ports + 3  # two tries are in vain
        while not lidar.turn().after_gap:
            pass
        assert not lidar.turn().after_gap
        assert_right(lidar.turn())
        assert lidar.mode.name == "Express"
        assert lidar.stats["reconnects"] == 1


def test_who_comes_late_finds_the_two_newest_turns_and_the_rest_counted():
    setup = EmulatedLidar()
    lidar = setup.lidar()
    lidar.start()
    first = lidar.turn()
    setup.clock.sleep(2.0)
    made = lidar.stats["turns"]
    assert 20 <= made <= 22
    assert lidar.stats["turns dropped"] == made - 3
    rest = [lidar.turn(), lidar.turn()]
    assert lidar.stats["turns"] == made  # both were there
    assert rest[1].times[0] - rest[0].times[0] == pytest.approx(0.1, abs=0.01)
    between = (rest[0].times[0] - first.times[0]) / 0.1
    assert between == pytest.approx(made - 2, abs=0.2)
    lidar.close()


def test_the_latest_turn_can_be_had_alone():
    setup = EmulatedLidar()
    with setup.lidar() as lidar:
        lidar.start()
        setup.clock.sleep(1.0)
        newest = lidar._turns._items[-1]
        assert lidar.turn(latest=True) is newest


def test_bytes_lost_in_a_scan_are_counted_and_the_turn_is_marked():
    setup = EmulatedLidar(faults=Faults(lose=2e-4))
    with setup.lidar() as lidar:
        lidar.start("Standard")
        turns = [lidar.turn() for _ in range(30)]
        while lidar.stats["resyncs"] < 3:
            turns.append(lidar.turn())
        assert lidar.stats["bytes dropped"] > 0
        assert any(turn.complete for turn in turns)


def test_stop_and_start_again():
    setup = EmulatedLidar()
    with setup.lidar() as lidar:
        assert_right(lidar.turn())
        lidar.stop()
        assert setup.machine.pwm == 0
        assert setup.machine._scan is None
        lidar.start("Express")
        assert_right(lidar.turn())
        lidar.start("Standard")
        assert_right(lidar.turn())


def test_stopped_it_gives_no_more_turns_to_who_goes_through_them():
    setup, seen = EmulatedLidar(), 0
    with setup.lidar() as lidar:
        for _ in lidar:
            seen += 1
            assert seen < 50
            if seen == 3:
                lidar.stop()
        assert seen <= 5  # two may have been ready
        assert setup.machine.pwm == 0 and setup.machine._scan is None
        assert_right(lidar.turn())  # asked for one it scans again


def test_closing_stops_scan_and_motor_and_may_be_done_twice():
    setup = EmulatedLidar()
    lidar = setup.lidar()
    lidar.start()
    lidar.turn()
    lidar.close()
    lidar.close()
    assert setup.machine.pwm == 0
    assert setup.machine._scan is None
    assert setup.commands()[-2:] == [Command.STOP, Command.SET_MOTOR_PWM]
    while lidar.turn() is not None:
        pass
    assert list(lidar) == []
    with pytest.raises(ConnectionLost) as refused:
        lidar.start()
    assert_helps(refused.value)


def test_an_exception_in_the_block_stops_the_motor_too():
    setup = EmulatedLidar()
    with pytest.raises(ZeroDivisionError), setup.lidar() as lidar:
        lidar.turn()
        _ = 1 / 0
    assert setup.machine.pwm == 0


def test_a_patience_that_is_too_short_says_so():
    setup = EmulatedLidar(spinning=False, spin_up=1e6)
    with setup.lidar() as lidar:
        lidar._turns.start()
        lidar._reader = object.__new__(type("Nobody", (), {"stop": lambda self: None}))
        with pytest.raises(DataTimeout) as late:
            lidar.turn(timeout=0.01)
        assert_helps(late.value)
