"""Playback of raw recordings: the devices answer as recorded, on one timeline."""

import os
import signal

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slamlab.cli import main
from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emir import Emir, commands
from slamlab.devices.emulator.in_memory_emulators import InMemoryPort
from slamlab.devices.recording import Recording, load
from slamlab.devices.recording.decoding import revolutions, statuses
from slamlab.devices.recording.playback import playback
from slamlab.devices.recording.recording_file import RX, Record
from slamlab.devices.rplidar import RPLidar
from slamlab.devices.rplidar.requests import Command, Conf, conf, motor_pwm, request
from slamlab.devices.rplidar.responses import AnswerType
from tests.slamlab.devices.recorded_devices import SCANS
from tests.slamlab.devices.test_emulator_ports import command
from tests.timeouts import PATIENCE


def same_scans(some, others):
    some, others = list(some), list(others)
    assert len(some) == len(others) > 10
    for a, b in zip(some, others, strict=True):
        np.testing.assert_array_equal(a.angle_deg, b.angle_deg)
        np.testing.assert_array_equal(a.range_mm, b.range_mm)
        assert a.complete == b.complete


@settings(max_examples=10)
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
    turns = list(revolutions(recording))
    same_scans(turns, revolutions(other))
    period = {"standard": 508e-6, "boost": 127e-6}.get(mode, 254e-6)
    assert all(turn.complete and abs(len(turn) - 0.1 / period) < 3 for turn in turns)
    assert turns[0].period == period
    assert [s for _, s in statuses(recording)] == [s for _, s in statuses(other)]


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
