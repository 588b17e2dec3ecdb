"""Raw recordings: nothing is lost but what is torn, and damage is named."""

import gzip
import io
from itertools import accumulate, pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab.cli import main
from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emulator.emulator_runner import run_emulators
from slamlab.devices.emulator.in_memory_emulators import InMemoryPort
from slamlab.devices.errors import ConnectionLost
from slamlab.devices.recording import Recorder, RecordingError, load
from slamlab.devices.recording.decoding import revolutions, statuses
from slamlab.devices.recording.recording_file import EVENT, RX, TX, Record, header_line, parse
from slamlab.simulation import worlds

records = st.builds(
    Record,
    st.integers(0, 2),
    st.sampled_from(["lidar", "emir"]),
    st.integers(0, 2**63),
    st.binary(max_size=40),
)


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
