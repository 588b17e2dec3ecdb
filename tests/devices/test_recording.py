"""Raw recordings: nothing is lost but what is torn, damage is named, replays are the same."""

import gzip
import io
import os
import signal
from itertools import accumulate, pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab import worlds
from slamlab.cli import main
from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir import commands
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.emulator_runner import EmulatorRunner, attach_ports, run_emulators
from slamlab.devices.emulator.robot_body import RobotBody
from slamlab.devices.errors import ConnectionLost
from slamlab.devices.memory_port import MemoryPort
from slamlab.devices.recording import Recorder, Recording, RecordingError, load
from slamlab.devices.recording.decoding import statuses, turns
from slamlab.devices.recording.playback import playback
from slamlab.devices.recording.recording_file import EVENT, RX, TX, Record, header_line, parse
from slamlab.devices.recording.replay_port import ReplayPort
from slamlab.devices.rplidar import RPLidar
from slamlab.devices.rplidar.requests import Command, Conf, conf, express, motor_pwm, request
from slamlab.devices.rplidar.responses import AnswerType
from slamlab.devices.rplidar.scan_stream import DECODERS
from tests.devices.emulator_helpers import machine
from tests.devices.test_emulator_ports import command
from tests.patience import PATIENCE

SCANS = {
    "standard": request(Command.SCAN),
    "express": express(1),
    "boost": express(2),
    "legacy": express(0),
}
TYPES = AnswerType.SCAN, AnswerType.EXPRESS, AnswerType.ULTRA, AnswerType.EXPRESS
ANSWERS = dict(zip(SCANS, TYPES, strict=True))
records = st.builds(
    Record,
    st.integers(0, 2),
    st.sampled_from(["lidar", "emir"]),
    st.integers(0, 2**63),
    st.binary(max_size=40),
)


def listen(port, seconds, clock):
    """Read for a while."""
    end = clock.now() + seconds
    while clock.now() < end:
        port.read(4096, 0.02)


@pytest.fixture(scope="session")
def recorded(tmp_path_factory):
    """A path by scan mode: a lidar and a robot, 3 s of each, in simulated time."""
    return {name: record(tmp_path_factory.mktemp("raw") / "a.raw", name) for name in SCANS}


def record(path, mode):
    clock = SimulatedClock(50.0)
    body = RobotBody(worlds.room(), np.random.default_rng(0))
    devices = {"lidar": machine(), "emir": EmirEmulator(body)}
    known = {"lidar": {"port": "memory", "baud": 115200}, "emir": {"port": "memory"}}
    with Recorder(path, known, clock) as recorder:
        ports = {
            name: recorder.opener(name, lambda n, b, d=device: MemoryPort(d, clock, n, b))(name, 1)
            for name, device in devices.items()
        }
        ports["emir"].write(commands.info(True) + commands.move(40, 20))
        listen(ports["emir"], 0.3, clock)
        asked = [request(Command.GET_INFO), request(Command.GET_HEALTH), conf(Conf.TYPICAL_MODE)]
        asked += [conf(Conf.MODE_COUNT)]
        asked += [
            conf(what, k)
            for k in range(3)
            for what in (Conf.US_PER_SAMPLE, Conf.MAX_DISTANCE, Conf.ANSWER_TYPE, Conf.NAME)
        ]
        for data in asked:
            ports["lidar"].write(data)
            listen(ports["lidar"], 0.05, clock)
        ports["lidar"].write(motor_pwm(660) + SCANS[mode])
        for _ in range(40):
            listen(ports["lidar"], 0.05, clock)
            listen(ports["emir"], 0.005, clock)
        ports["lidar"].write(request(Command.STOP))
        listen(ports["lidar"], 0.1, clock)
    return path


def same_scans(some, others):
    some, others = list(some), list(others)
    assert len(some) == len(others) > 10
    for a, b in zip(some, others, strict=True):
        np.testing.assert_array_equal(a.angle_deg, b.angle_deg)
        np.testing.assert_array_equal(a.range_mm, b.range_mm)
        assert a.complete == b.complete


@given(st.lists(records, max_size=8))
def test_what_was_written_is_read(written):
    content = header_line({"created": "now"}) + b"".join(record.pack() for record in written)
    recording = parse(content)
    assert recording.records == written and not recording.truncated
    assert recording.header["created"] == "now"


@settings(max_examples=10)
@given(st.lists(records, min_size=1, max_size=5))
def test_every_truncation_is_read_up_to_the_tear(written):
    head = header_line({})
    packed = [record.pack() for record in written]
    whole = [len(head), *(len(head) + n for n in accumulate(map(len, packed)))]
    content = head + b"".join(packed)
    for end in range(len(head), len(content) + 1):
        recording = parse(content[:end])
        count = sum(1 for n in whole[1:] if n <= end)
        assert recording.records == written[:count]
        assert bool(recording.truncated) == (end not in whole)
        if recording.truncated:
            assert f"record {count + 1} " in recording.truncated


@settings(max_examples=10)
@given(st.lists(records, min_size=1, max_size=4), st.integers(0, 7))
def test_a_flipped_bit_is_named_by_its_record(written, bit):
    head = header_line({"created": "then"})
    packed = [record.pack() for record in written]
    content = head + b"".join(packed)
    owner = [0] * len(head) + [k for k, p in enumerate(packed, 1) for _ in p]
    for at, number in enumerate(owner):
        hurt = bytearray(content)
        hurt[at] ^= 1 << bit
        try:
            recording = parse(bytes(hurt))
        except RecordingError as error:
            said = str(error)
        else:  # a length that reaches beyond the end looks cut off
            said = recording.truncated
            assert number == len(written) and recording.records == written[:-1]
        assert (f"record {number} " if number else "header") in said
        if number:
            kept = parse(bytes(hurt), salvage=True)
            assert kept.records == written[: number - 1] and kept.truncated


def test_packed_recordings_are_read_and_torn_ones_up_to_the_tear(recorded, tmp_path):
    content = recorded["express"].read_bytes()
    packed, torn = tmp_path / "a.gz", tmp_path / "torn.gz"
    packed.write_bytes(gzip.compress(content))
    torn.write_bytes(gzip.compress(content)[:-5000])
    whole, part = load(packed), load(torn)
    assert whole.records == load(recorded["express"]).records and not whole.truncated
    assert part.truncated and part.records == whole.records[: len(part.records)]
    assert len(part.records) > 0.5 * len(whole.records)


@pytest.mark.parametrize("content", [b"", b"x", b"{}\n", b"[1]\n", b'{"format": "other"}\n', b"\0"])
def test_other_files_are_refused_in_a_line(content, tmp_path):
    path = tmp_path / "other"
    path.write_bytes(content)
    with pytest.raises(RecordingError, match="no raw recording"):
        load(path)
    with pytest.raises(ValueError, match="no such file"):
        load(tmp_path / "none")


def test_a_newer_version_is_said_to_be_one():
    with pytest.raises(RecordingError, match="of version 2"):
        parse(header_line({"version": 2}))


class Scripted:
    """A device that sends given pieces, one each time it is asked."""

    def __init__(self, pieces):
        self.pieces, self.heard = list(pieces), b""

    def feed(self, data, now):
        self.heard += data
        if data or not self.pieces:
            return b""
        piece = self.pieces.pop(0)
        if piece is None:
            raise OSError(5, "Input/output error")
        return piece


def test_the_recorder_writes_every_byte_with_its_time_in_the_pieces_that_were_read(tmp_path):
    clock, device = SimulatedClock(7.0), Scripted([b"abc", b"de" * 10])
    with Recorder(tmp_path / "a", {"lidar": {"port": "p", "baud": 9600}}, clock) as recorder:
        port = recorder.opener("lidar", lambda name, baud: MemoryPort(device, clock, name, baud))(
            "p", 9600
        )
        assert (port.name, port.baud) == ("p", 9600)
        port.write(b"ask")
        assert port.read(4, 1.0) == b"abc"
        clock.sleep(1.5)
        assert port.read(4, 1.0) == b"dede"
        assert port.read(100, 1.0) == b"de" * 8
        device.pieces.append(None)
        with pytest.raises(ConnectionLost):
            port.read(1, 1.0)
        port.close()
    recording = load(tmp_path / "a")
    assert recording.baud("lidar") == 9600 and recording.header["monotonic_ns"] == 7_000_000_000
    told = [(r.kind, r.data) for r in recording.records]
    assert [told[k] for k in (1, 2, 3, 4)] == [
        (TX, b"ask"),
        (RX, b"abc"),
        (RX, b"dede"),
        (RX, b"de" * 8),
    ]
    assert told[0] == (EVENT, b"opened p at 9600 baud")
    assert told[5][1].startswith(b"gap: ") and told[6] == (EVENT, b"closed")
    times = [r.time for r in recording.records]
    assert times == sorted(times) and times[3] - times[2] >= 1.5


def test_a_port_that_is_closed_while_a_thread_reads_it_has_lost_no_connection(tmp_path):
    clock = SimulatedClock()
    with Recorder(tmp_path / "a", {}, clock) as recorder:
        opener = recorder.opener(
            "emir", lambda name, baud: MemoryPort(Scripted([]), clock, name, baud)
        )
        port = opener("p", 9600)
        port.close()
        for act in (lambda: port.read(1, 0.1), lambda: port.write(b"stop")):
            with pytest.raises(ConnectionLost):
                act()
    events = [r.data for r in load(tmp_path / "a").records if r.kind == EVENT]
    assert events == [b"opened p at 9600 baud", b"closed"]


def test_within_a_second_all_is_in_the_file_and_what_is_there_stays(tmp_path):
    clock = SimulatedClock()
    recorder, sizes = Recorder(tmp_path / "a", {}, clock), []
    written = []
    for k in range(40):
        recorder.write(RX, "emir", bytes([k]) * 10)
        written.append(clock.now())
        content = (tmp_path / "a").read_bytes()
        sizes.append(content)
        there = parse(content).records
        assert all(time > clock.now() - 1.0 - 0.3 for time in written[len(there) :])
        clock.sleep(0.3)
    recorder.close()
    recorder.close()
    sizes.append((tmp_path / "a").read_bytes())
    assert all(b.startswith(a) for a, b in pairwise(sizes))
    assert len(load(tmp_path / "a").records) == 40


def test_a_file_that_is_there_is_not_touched(tmp_path):
    for name in ("a", "b.gz"):
        (tmp_path / name).write_bytes(b"precious")
        with pytest.raises(FileExistsError):
            Recorder(tmp_path / name, {})
        assert (tmp_path / name).read_bytes() == b"precious"


def test_a_recording_is_packed_when_it_is_closed(tmp_path):
    with Recorder(tmp_path / "a.raw.gz", {}, SimulatedClock()) as recorder:
        recorder.write(RX, "lidar", bytes(200_000))
        assert (tmp_path / "a.raw").exists()
    assert [p.name for p in tmp_path.iterdir()] == ["a.raw.gz"]
    assert load(tmp_path / "a.raw.gz").received("lidar") == bytes(200_000)


@settings(max_examples=20)
@given(
    st.sampled_from(list(SCANS)),
    st.sampled_from([None, 0.3, 1.0, 20.0]),
    st.lists(st.tuples(st.integers(1, 5000), st.floats(0, 0.5)), min_size=1, max_size=10),
)
def test_at_any_speed_and_cut_a_replay_gives_the_same_bytes_and_nodes(recorded, mode, speed, reads):
    recording, clock = load(recorded[mode]), SimulatedClock(3.0)
    port, pieces, k = ReplayPort(recording, "lidar", clock, speed), [], 0
    with pytest.raises(ConnectionLost, match="ends here"):
        while True:
            n, timeout = reads[k % len(reads)]
            pieces.append(port.read(n, timeout))
            k += 1
            clock.sleep(0.05)
    received = recording.received("lidar")
    assert b"".join(pieces) == received
    at = received.rindex(bytes([0x40, ANSWERS[mode]])) + 2  # the scan's descriptor ends there
    together, piecewise = DECODERS[ANSWERS[mode]](), DECODERS[ANSWERS[mode]]()
    nodes, skip = [], at
    for piece in pieces:
        nodes.append(piecewise.feed(piece[skip:]))
        skip = max(skip - len(piece), 0)
    np.testing.assert_array_equal(np.concatenate(nodes), together.feed(received[at:]))


def test_a_replay_comes_at_its_times(recorded):
    recording = load(recorded["boost"])
    begins = [r.time - recording.begin for r in recording.of("emir", RX)]
    for speed in (0.5, 1.0, 4.0):
        clock = SimulatedClock(9.0)
        port, came = ReplayPort(recording, "emir", clock, speed), []
        while len(came) < len(begins):
            if port.read(4096, 0.01):
                came.append(clock.now() - 9.0)
                assert abs(port.time - recording.begin - begins[len(came) - 1]) < 1e-9
        np.testing.assert_allclose(came, np.array(begins) / speed, atol=1e-6)


@settings(max_examples=15)
@given(st.sampled_from(list(SCANS)), st.lists(st.integers(1, 3000), min_size=1, max_size=10))
def test_however_the_received_bytes_are_cut_the_scans_are_the_same(recorded, mode, cuts):
    recording = load(recorded[mode])
    cut, k = [], 0
    for r in recording.records:
        at = 0
        while r.kind == RX and at < len(r.data):
            cut.append(Record(RX, r.channel, r.time_ns, r.data[at : at + cuts[k % len(cuts)]]))
            at, k = at + cuts[k % len(cuts)], k + 1
        if r.kind != RX:
            cut.append(r)
    other = Recording(recording.header, cut)
    same_scans(turns(recording), turns(other))
    assert [s for _, s in statuses(recording)] == [s for _, s in statuses(other)]


@pytest.mark.parametrize("mode", SCANS)
def test_a_recording_s_turns_are_whole_and_as_long_as_the_mode_has_them(recorded, mode):
    recording = load(recorded[mode])
    found = list(turns(recording))
    assert len(found) > 15 and all(turn.complete for turn in found)
    period = {"standard": 508e-6, "boost": 127e-6}.get(mode, 254e-6)
    assert all(abs(len(turn) - 0.1 / period) < 3 for turn in found)
    assert found[0].period == period
    assert recording.begin < found[0].times[0] < found[-1].times[-1] < recording.records[-1].time


def test_turns_of_a_recording_are_those_the_driver_saw(tmp_path):
    clock, seen = SimulatedClock(), []
    with Recorder(tmp_path / "a", {"lidar": {"baud": 115200}}, clock) as recorder:
        device = machine()
        opener = recorder.opener("lidar", lambda n, b: MemoryPort(device, clock, n, b))
        with RPLidar("memory", opener=opener, clock=clock) as lidar:
            while len(seen) < 12:
                seen.append(lidar.turn())
            dropped = lidar.stats["turns dropped"]
    found = list(turns(load(tmp_path / "a")))
    assert len(found) >= len(seen) + dropped
    # who read slowly missed turns, but those seen are the recorded ones, in their order
    at = 0
    for turn in seen:
        while not np.array_equal(turn.range_mm, found[at].range_mm):
            at += 1
        np.testing.assert_allclose(turn.times, found[at].times, atol=2e-3)
        at += 1


@pytest.mark.parametrize("mode", ["standard", "boost"])
def test_a_played_lidar_answers_a_program_as_the_real_one_did(recorded, mode):
    recording, clock = load(recorded[mode]), SimulatedClock(100.0)
    port = MemoryPort(playback(recording)["lidar"], clock)
    heard = {}
    for name, data in {
        "health": request(Command.GET_HEALTH),  # in another order than recorded
        "info": request(Command.GET_INFO),
        "again": request(Command.GET_INFO),
        "boost": conf(Conf.NAME, 2),
        "standard": conf(Conf.NAME, 0),
        "never": request(Command.GET_SAMPLERATE),
    }.items():
        port.write(data)
        clock.sleep(0.1)
        heard[name] = port.read(4096, 0.1)
    assert heard["info"] == heard["again"] and len(heard["info"]) == 27
    assert len(heard["health"]) == 10 and heard["never"] == b""
    assert heard["boost"].endswith(b"Boost\0") and heard["standard"].endswith(b"Standard\0")
    port.write(motor_pwm(500) + SCANS[mode])  # another speed than recorded
    came = b"".join(port.read(4096, 0.01) for _ in range(1200))
    received = recording.received("lidar")
    at = received.rindex(bytes([0x40, ANSWERS[mode]])) + 2 - 7
    assert len(came) > 18_000 and received[at:].startswith(came)


def test_a_played_scan_ends_with_a_request_and_goes_on_where_the_time_is(recorded):
    recording, clock = load(recorded["standard"]), SimulatedClock()
    port = MemoryPort(playback(recording)["lidar"], clock)
    port.write(SCANS["standard"])
    clock.sleep(0.5)
    before = port.read(10_000, 0.0)
    port.write(request(Command.STOP))
    clock.sleep(0.5)
    assert port.read(10_000, 0.0) == b""
    port.write(SCANS["standard"])
    clock.sleep(0.5)
    after = port.read(10_000, 0.0)[7:]
    received = recording.received("lidar")
    begin = received.index(before[7:])
    gap = received.index(after[:500]) - begin - len(before[7:])
    assert 0.3 < gap / 9843 < 0.7  # as much as the lidar sends in half a second


def test_both_devices_are_played_on_one_timeline(recorded):
    recording, clock = load(recorded["standard"]), SimulatedClock(20.0)
    devices = playback(recording)
    emir, lidar = (MemoryPort(devices[name], clock) for name in ("emir", "lidar"))
    emir.write(commands.info(True))
    emir.read(4096, 0.05)
    clock.sleep(0.8)  # the lidar is asked late
    lidar.write(SCANS["standard"])
    now = clock.now()
    clock.sleep(0.5)
    first, told = (port.read(100_000, 0.01) for port in (lidar, emir))
    # what each device sends last now, it sent at the same moment of the recording
    moments = []
    for channel, data in (("lidar", first), ("emir", told)):
        received, ends = recording.of(channel, RX), b""
        for r in received:
            ends += r.data
            if ends.endswith(data[-200:]):
                moments.append(r.time)
                break
    assert len(moments) == 2 and abs(moments[0] - moments[1]) < 0.15
    assert now > 20.8


@pytest.mark.usefixtures("busy_machine")
def test_a_recorded_session_is_played_to_our_drivers(tmp_path):
    with run_emulators(worlds.polygon(), np.random.default_rng(0), ("127.0.0.1", 0, 0)) as it:
        ports = ",".join(it.ports.values())
        path = str(tmp_path / "a.raw")
        words = ["record", f"devices:{ports}", "--out", path, "--seconds", "2", "--mode", "1"]
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("sys.stdin", io.StringIO("nonsense\n30,20\n"))
            assert main(words) == 0
    recording = load(path)
    assert len(list(turns(recording))) > 5
    assert abs([s for _, s in statuses(recording)][-1].angle) > 2  # it was driven
    played = EmulatorRunner(attach_ports(playback(recording), ("127.0.0.1", 0, 0)))
    with played, RPLidar(played.ports["lidar"]) as lidar:
        assert lidar.info.model == 0x28 and [m.name for m in lidar.modes][1] == "Express"
        lidar.start("express")
        assert lidar.turn(timeout=PATIENCE).complete


def test_the_commands_say_what_is_wrong_in_a_line(tmp_path, capsys, recorded):
    there = tmp_path / "there"
    there.write_bytes(b"x")
    broken = tmp_path / "broken"
    content = bytearray(recorded["express"].read_bytes())
    content[-2000] ^= 1
    broken.write_bytes(content)
    for words, said in [
        (["record", "lidar", "--out", str(tmp_path / "a")], "is not devices:LIDAR,EMIR"),
        (["record", "devices:a,b,c", "--out", str(tmp_path / "a")], "is not devices:LIDAR,EMIR"),
        (["record", "devices:/no/such,", "--out", str(tmp_path / "b")], "no port /no/such"),
        (["record", "devices:x", "--out", str(there)], "is there already"),
        (["replay", str(there)], "no raw recording"),
        (["replay", str(tmp_path / "none")], "no such file"),
        (["replay", str(broken)], "is damaged"),
        (["replay", str(recorded["express"]), "--speed", "0"], "speed is above 0"),
    ]:
        assert main(words) == 2, words
        assert said in capsys.readouterr().err, words
    assert main(["replay", "--info", "--salvage", str(broken)]) == 0
    assert "is damaged: read up to there" in capsys.readouterr().out


def test_replay_says_what_a_recording_holds(recorded, capsys):
    assert main(["replay", "--info", str(recorded["boost"])]) == 0
    out = capsys.readouterr().out
    recording = load(recorded["boost"])
    assert f"{len(recording.received('lidar'))} bytes" in out
    assert f"{len(list(turns(recording)))} turns" in out
    assert f"{len(list(statuses(recording)))} statuses" in out


@pytest.mark.usefixtures("busy_machine")
@pytest.mark.skipif(os.name != "posix", reason="Ctrl-C cannot be sent to one process there")
def test_replay_serves_ports_until_ctrl_c(recorded):
    process = command("replay", str(recorded["standard"]), "--tcp", "--speed", "2")
    try:
        ports = {}
        while "emir" not in ports and (line := process.stdout.readline()):
            words = line.split()
            if words[-1].startswith("socket://"):
                ports[words[0]] = words[-1]
        with RPLidar(ports["lidar"]) as lidar:
            lidar.start("standard")
            assert lidar.turn(timeout=PATIENCE)
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=PATIENCE)
    assert process.returncode == 0
