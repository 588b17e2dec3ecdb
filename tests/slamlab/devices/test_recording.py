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

from slamlab.cli import main
from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir import Emir, commands
from slamlab.devices.emulator.emir_emulator import EmirEmulator
from slamlab.devices.emulator.emulated_robot import EmulatedRobot
from slamlab.devices.emulator.emulator_runner import run_emulators
from slamlab.devices.emulator.in_memory_emulators import InMemoryPort
from slamlab.devices.errors import ConnectionLost
from slamlab.devices.recording import Recorder, Recording, RecordingError, load
from slamlab.devices.recording.decoding import revolutions, statuses
from slamlab.devices.recording.playback import playback
from slamlab.devices.recording.recording_file import EVENT, RX, TX, Record, header_line, parse
from slamlab.devices.rplidar import RPLidar
from slamlab.devices.rplidar.requests import Command, Conf, conf, express, motor_pwm, request
from slamlab.devices.rplidar.responses import AnswerType
from slamlab.simulation import worlds
from tests.slamlab.devices.emulator_helpers import machine
from tests.slamlab.devices.test_emulator_ports import command
from tests.timeouts import PATIENCE

SCANS = {
    "standard": request(Command.SCAN),
    "express": express(1),
    "boost": express(2),
    "legacy": express(0),
}
records = st.builds(
    Record,
    st.integers(0, 2),
    st.sampled_from(["lidar", "emir"]),
    st.integers(0, 2**63),
    st.binary(max_size=40),
)


def listen(port, seconds, clock):
    end = clock.now() + seconds
    while clock.now() < end:
        port.read(4096, 0.02)


@pytest.fixture(scope="session")
def recorded(tmp_path_factory):
    """A path by scan mode: a lidar and a robot, 3 s of each, in simulated time."""
    return {name: record(tmp_path_factory.mktemp("raw") / "a.raw", name) for name in SCANS}


def record(path, mode):
    clock = SimulatedClock(50.0)
    body = EmulatedRobot(worlds.room(), np.random.default_rng(0))
    devices = {"lidar": machine(), "emir": EmirEmulator(body)}
    known = {"lidar": {"port": "memory", "baud": 115200}, "emir": {"port": "memory"}}
    with Recorder(path, known, clock) as recorder:
        ports = {
            name: recorder.opener(name, lambda n, b, d=device: InMemoryPort(d, clock, n, b))(
                name, 1
            )
            for name, device in devices.items()
        }
        ports["emir"].write(commands.info(True) + commands.move(40, 20))
        listen(ports["emir"], 0.3, clock)
        asked = [request(Command.GET_INFO), request(Command.GET_HEALTH), conf(Conf.TYPICAL_MODE)]
        asked += [conf(Conf.MODE_COUNT)]
        of_mode = Conf.US_PER_SAMPLE, Conf.MAX_DISTANCE, Conf.ANSWER_TYPE, Conf.NAME
        asked += [conf(what, k) for k in range(3) for what in of_mode]
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


@settings(max_examples=10)
@given(st.lists(records, max_size=5))
def test_what_was_written_is_read_up_to_any_tear(written):
    head = header_line({"created": "now"})
    packed = [record.pack() for record in written]
    whole = [len(head), *(len(head) + n for n in accumulate(map(len, packed)))]
    content = head + b"".join(packed)
    for end in range(len(head), len(content) + 1):
        recording = parse(content[:end])
        count = sum(1 for n in whole[1:] if n <= end)
        assert recording.records == written[:count] and recording.header["created"] == "now"
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
            message = str(error)
        else:  # a length that reaches beyond the end looks cut off
            message = recording.truncated
            assert number == len(written) and recording.records == written[:-1]
        assert (f"record {number} " if number else "header") in message
        if number:
            kept = parse(bytes(hurt), salvage=True)
            assert kept.records == written[: number - 1] and kept.truncated


def test_compressed_recordings_are_read_and_truncated_ones_in_part(recorded, tmp_path):
    content = recorded["express"].read_bytes()
    packed, torn = tmp_path / "a.gz", tmp_path / "torn.gz"
    packed.write_bytes(gzip.compress(content))
    torn.write_bytes(gzip.compress(content)[:-5000])
    whole, part = load(packed), load(torn)
    assert whole.records == load(recorded["express"]).records and not whole.truncated
    assert part.truncated and part.records == whole.records[: len(part.records)]
    assert len(part.records) > 0.5 * len(whole.records)


@pytest.mark.parametrize("content", [b"", b"x", b"{}\n", b"[1]\n", b'{"format": "other"}\n', b"\0"])
def test_other_files_are_refused(content):
    with pytest.raises(RecordingError, match="not a raw recording"):
        parse(content)
    with pytest.raises(RecordingError, match="has version 2"):
        parse(header_line({"version": 2}))


class Scripted:
    """A device that sends given pieces, one each time it is asked."""

    def __init__(self, pieces):
        self.pieces, self.received = list(pieces), b""

    def feed(self, data, now):
        self.received += data
        if data or not self.pieces:
            return b""
        piece = self.pieces.pop(0)
        if piece is None:
            raise OSError(5, "Input/output error")
        return piece


def test_the_recorder_writes_every_byte_with_its_time_in_the_pieces_that_were_read(tmp_path):
    clock, device = SimulatedClock(7.0), Scripted([b"abc", b"de" * 10])
    with Recorder(tmp_path / "a", {"lidar": {"port": "p", "baud": 9600}}, clock) as recorder:
        port = recorder.opener("lidar", lambda name, baud: InMemoryPort(device, clock, name, baud))(
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
    messages = [(r.kind, r.data) for r in recording.records]
    assert [messages[k] for k in (1, 2, 3, 4)] == [
        (TX, b"ask"),
        (RX, b"abc"),
        (RX, b"dede"),
        (RX, b"de" * 8),
    ]
    assert messages[0] == (EVENT, b"opened p at 9600 baud")
    assert messages[5][1].startswith(b"gap: ") and messages[6] == (EVENT, b"closed")
    times = [r.time for r in recording.records]
    assert times == sorted(times) and times[3] - times[2] >= 1.5


def test_a_port_that_is_closed_while_a_thread_reads_it_has_lost_no_connection(tmp_path):
    clock = SimulatedClock()
    with Recorder(tmp_path / "a", {}, clock) as recorder:
        opener = recorder.opener(
            "emir", lambda name, baud: InMemoryPort(Scripted([]), clock, name, baud)
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


def test_a_recording_is_compressed_when_it_is_closed(tmp_path):
    with Recorder(tmp_path / "a.raw.gz", {}, SimulatedClock()) as recorder:
        recorder.write(RX, "lidar", bytes(200_000))
        assert (tmp_path / "a.raw").exists()
    assert [p.name for p in tmp_path.iterdir()] == ["a.raw.gz"]
    assert load(tmp_path / "a.raw.gz").received("lidar") == bytes(200_000)


@settings(max_examples=15)
@given(st.sampled_from(list(SCANS)), st.lists(st.integers(1, 3000), min_size=1, max_size=10))
def test_the_scans_do_not_depend_on_the_chunks_of_received_bytes(recorded, mode, cuts):
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
    same_scans(revolutions(recording), revolutions(other))
    assert [s for _, s in statuses(recording)] == [s for _, s in statuses(other)]


@pytest.mark.parametrize("mode", SCANS)
def test_revolutions_of_a_recording_are_complete_and_have_the_length_of_the_mode(recorded, mode):
    recording = load(recorded[mode])
    found = list(revolutions(recording))
    assert len(found) > 15 and all(turn.complete for turn in found)
    period = {"standard": 508e-6, "boost": 127e-6}.get(mode, 254e-6)
    assert all(abs(len(turn) - 0.1 / period) < 3 for turn in found)
    assert found[0].period == period
    assert recording.begin < found[0].times[0] < found[-1].times[-1] < recording.records[-1].time


@pytest.mark.parametrize(
    ("mode", "kind"), [("standard", AnswerType.SCAN), ("boost", AnswerType.ULTRA)]
)
def test_a_replayed_lidar_responds_as_recorded(recorded, mode, kind):
    recording, clock = load(recorded[mode]), SimulatedClock(100.0)
    port = InMemoryPort(playback(recording)["lidar"], clock)
    answer = {}
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
        answer[name] = port.read(4096, 0.1)
    assert answer["info"] == answer["again"] and len(answer["info"]) == 27
    assert len(answer["health"]) == 10 and answer["never"] == b""
    assert answer["boost"].endswith(b"Boost\0") and answer["standard"].endswith(b"Standard\0")
    port.write(motor_pwm(500) + SCANS[mode])  # another speed than recorded
    came = b"".join(port.read(4096, 0.01) for _ in range(1200))
    received = recording.received("lidar")
    at = received.rindex(bytes([0x40, kind])) + 2 - 7
    assert len(came) > 18_000 and received[at:].startswith(came)


def test_a_replayed_scan_ends_with_a_request_and_resumes_at_the_recorded_time(recorded):
    recording, clock = load(recorded["standard"]), SimulatedClock()
    port = InMemoryPort(playback(recording)["lidar"], clock)
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
    emir, lidar = (InMemoryPort(devices[name], clock) for name in ("emir", "lidar"))
    emir.write(commands.info(True))
    emir.read(4096, 0.05)
    clock.sleep(0.8)  # the lidar is asked late
    lidar.write(SCANS["standard"])
    now = clock.now()
    clock.sleep(0.5)
    first, reported = (port.read(100_000, 0.01) for port in (lidar, emir))
    # what each device sends last now, it sent at the same moment of the recording
    moments = []
    for channel, data in (("lidar", first), ("emir", reported)):
        received, ends = recording.of(channel, RX), b""
        for r in received:
            ends += r.data
            if ends.endswith(data[-200:]):
                moments.append(r.time)
                break
    assert len(moments) == 2 and abs(moments[0] - moments[1]) < 0.15
    assert now > 20.8


@pytest.mark.usefixtures("busy_machine")
def test_a_session_is_recorded_and_driven_by_typed_commands(tmp_path):
    with run_emulators(worlds.polygon(), np.random.default_rng(0), ("127.0.0.1", 0, 0)) as it:
        ports = ",".join(it.ports.values())
        path = str(tmp_path / "a.raw")
        words = ["record", f"devices:{ports}", "--out", path, "--seconds", "2", "--mode", "1"]
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("sys.stdin", io.StringIO("nonsense\n30,20\n"))
            assert main(words) == 0
    recording = load(path)
    assert len(list(revolutions(recording))) > 5
    assert abs([s for _, s in statuses(recording)][-1].angle) > 2  # it was driven


def test_the_commands_report_what_is_wrong_in_a_line(tmp_path, capsys, recorded):
    there = tmp_path / "there"
    there.write_bytes(b"x")
    broken = tmp_path / "broken"
    content = bytearray(recorded["express"].read_bytes())
    content[-2000] ^= 1
    broken.write_bytes(content)
    new, missing = str(tmp_path / "new"), str(tmp_path / "none")
    for words, message in [
        (["record", "lidar", "--out", new], "must be devices:LIDAR,EMIR"),
        (["record", "devices:a,b,c", "--out", new], "must be devices:LIDAR,EMIR"),
        (["record", "devices:/no/such,", "--out", new], "port /no/such does not exist"),
        (["record", "devices:x", "--out", str(there)], "there exists. Name a new file"),
        (["replay", str(there)], "not a raw recording"),
        (["replay", missing], "does not exist"),
        (["replay", str(broken)], "is corrupted"),
        (["replay", str(recorded["express"]), "--speed", "0"], "speed must be positive"),
    ]:
        assert main(words) == 2, words
        assert message in capsys.readouterr().err, words
    assert main(["replay", "--info", "--salvage", str(broken)]) == 0
    assert "is corrupted; the file was read up to that point" in capsys.readouterr().out


def test_replay_reports_the_contents_of_a_recording(recorded, capsys):
    assert main(["replay", "--info", str(recorded["boost"])]) == 0
    out = capsys.readouterr().out
    recording = load(recorded["boost"])
    assert f"{len(recording.received('lidar'))} bytes" in out
    assert f"{len(list(revolutions(recording)))} revolutions" in out
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
        with RPLidar(ports["lidar"]) as lidar, Emir(ports["emir"]) as emir:
            assert lidar.info.model == 0x28 and lidar.modes[1].name == "Express"
            lidar.start("standard")
            assert lidar.revolution(timeout=PATIENCE) and emir.status is not None
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=PATIENCE)
    assert process.returncode == 0
