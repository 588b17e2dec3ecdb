"""Every model of RPLIDAR is found at its baud rate and asked for its modes."""

import numpy as np
import pytest
from serial.tools import list_ports

from slamlab.cli import main
from slamlab.devices.clock import SimulatedClock
from slamlab.devices.emulator.emulator_runner import run_emulators
from slamlab.devices.emulator.in_memory_emulators import InMemoryEmulators
from slamlab.devices.emulator.lidar_models import MODELS, lidar_model
from slamlab.devices.emulator.rplidar_emulator import RPLidarEmulator
from slamlab.devices.errors import ConnectionLost, DeviceNotResponding, PortBusy, PortError
from slamlab.devices.recording import Recorder, load
from slamlab.devices.recording.decoding import RecordedLidar, revolutions
from slamlab.devices.recording.playback import playback
from slamlab.devices.rplidar import RPLidar
from slamlab.devices.rplidar.identification import BAUD_RATES
from slamlab.devices.rplidar.requests import Command
from slamlab.devices.rplidar.responses import AnswerType, Info
from slamlab.devices.rplidar.scan_stream import DECODERS
from slamlab.simulation import worlds
from slamlab.sources import raw_recordings
from tests.slamlab.devices.emulator_helpers import Bench, assert_helps, assert_right
from tests.slamlab.devices.test_emulator_ports import needs_pty
from tests.timeouts import PATIENCE

BAUDS = {
    **{"a1": 115200, "a2m8": 115200, "a2m12": 256000, "a3": 256000},
    **{"s1": 256000, "s2": 1000000, "s3": 1000000, "c1": 460800},
}


@pytest.mark.parametrize("model", MODELS)
def test_the_baud_rate_is_detected_and_every_mode_yields_correct_revolutions(model):
    bench = Bench(model)
    with bench.lidar() as lidar:
        assert lidar.baud == BAUDS[model] and bench.opened[-1] == BAUDS[model]
        assert lidar.info.short_name.lower() == model[:2]
        assert [(m.name, m.answer_type) for m in lidar.modes] == [
            (m.name, m.answer_type) for m in MODELS[model].modes
        ]
        assert lidar.sensor.range_max == lidar.typical.range_max == MODELS[model].modes[0].range_max
        for mode in (None, *range(len(lidar.modes))):
            lidar.start(mode)
            seen = [lidar.revolution() for _ in range(3)]
            for turn in seen:
                assert_right(turn)
                assert np.diff(turn.times).min() > 0
            rate = MODELS[model].scanner.rate
            assert seen[-1].rate == pytest.approx(rate, rel=0.01)
            assert len(seen[-1]) == pytest.approx(1 / rate / lidar.mode.period, rel=0.01)
        assert not lidar.warnings and not lidar.stats["bytes dropped"]
        assert not bench.machine.line.dropped
    assert bench.machine.pwm == 0


def test_the_models_are_those_that_are_sold():
    assert {name: model.baud for name, model in MODELS.items()} == BAUDS
    with pytest.raises(ValueError, match="there is no lidar model 'a9'; available: a1, "):
        lidar_model("a9")
    for model in MODELS.values():
        for mode in model.modes:  # what it sends fits its line
            decoder = DECODERS[mode.answer_type]
            per_second = decoder.size / getattr(decoder, "points", 1) / mode.period
            assert per_second <= 0.95 * model.baud / 10, (model, mode)


@pytest.mark.parametrize(
    ("model", "name"),
    [
        *((0x18, "A1"), (0x28, "A2"), (0x31, "A3"), (0x41, "C1"), (0x61, "S1"), (0x71, "S2")),
        *((0x82, "S3"), (0x91, "T1"), (0xC1, "M1"), (0x00, "A0")),
    ],
)
def test_models_have_the_names_that_slamtec_gives_them(model, name):
    info = Info(model, (1, 1), 18, "")
    assert info.name.startswith(f"RPLIDAR {name} ")
    assert info.has_conf == info.has_express == (name[0] != "A")


def test_baud_rate_detection_does_not_delay_an_a2():
    bench, alone = Bench(), Bench()
    with bench.lidar(), alone.lidar(baud=115200):
        assert bench.opened == alone.opened == [115200]
        assert bench.clock.now() == alone.clock.now() < 100.3


def test_a_given_baud_rate_is_the_only_one_tried():
    bench = Bench("a3")
    with bench.lidar("lidar@256000") as lidar:
        assert lidar.name == "lidar" and bench.opened == [256000]
    with pytest.raises(DeviceNotResponding, match="at 115200 baud") as refused:
        bench.lidar("lidar@115200")
    assert set(bench.opened[1:]) == {115200}
    assert "without a baud rate" in refused.value.step and "lidar" in refused.value.step


@pytest.mark.parametrize("scanning", [None, AnswerType.ULTRA])
def test_a_silent_or_wrong_device_is_reported_with_all_rates_and_the_remedy(scanning):
    bench = Bench("a3", scanning=scanning, baud=230400)
    with pytest.raises(DeviceNotResponding) as refused:
        bench.lidar()
    assert bench.clock.now() < 110
    assert_helps(refused.value)
    assert "115200, 256000, 460800, 1000000 baud" in refused.value.what
    assert ("no bytes are received" in str(refused.value)) == (scanning is None)
    assert set(bench.opened) == set(BAUD_RATES)
    if scanning is not None:  # bytes come: then it is the rate, and it can be named
        assert "lidar@230400" in refused.value.step
    with bench.lidar("lidar@230400") as lidar:
        assert_right(lidar.revolution())


def test_baud_rates_that_the_adapter_does_not_support_are_skipped():
    with Bench("s2", refused={256000, 460800}).lidar() as lidar:
        assert lidar.baud == 1000000
    with pytest.raises(DeviceNotResponding, match="at 115200, 256000 baud"):
        Bench("s2", refused={460800, 1000000}).lidar()
    bench = Bench("s2", refused=set(BAUD_RATES))
    with pytest.raises(PortError, match="does not open"):
        bench.lidar()
    assert bench.opened == list(BAUD_RATES)


def test_a_busy_port_ends_the_baud_rate_detection():
    def busy(name, baud):
        raise PortBusy("it is in use", "another program has it", "close that")

    bench = Bench()
    with pytest.raises(PortBusy):
        bench.lidar(opener=busy)
    assert bench.clock.now() == 100.0


def test_a_tcp_port_needs_no_baud_rate_detection():
    bench = Bench("s2")
    opened = []

    def opener(name, baud):
        opened.append(baud)
        return bench.emulators.opener("lidar", None)

    with bench.lidar("socket://there:1", opener=opener) as lidar:
        assert_right(lidar.revolution())
    assert len(opened) == 1
    bench.faults.silent |= set(Command)
    with pytest.raises(DeviceNotResponding) as refused:
        bench.lidar("socket://there:1", opener=opener)
    assert "baud" not in refused.value.what


@needs_pty
def test_on_a_pseudo_terminal_the_emulator_receives_only_its_baud_rate():
    rng = np.random.default_rng(0)
    with (
        run_emulators(worlds.room(), rng, lidar={"model": "c1"}) as it,
        RPLidar(it.ports["lidar"]) as lidar,
    ):
        assert lidar.baud == 460800 and lidar.info.short_name == "C1"
        assert lidar.revolution(timeout=PATIENCE).complete


def test_recording_looks_for_a_lidar_that_is_not_named(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(list_ports, "comports", list)
    for words in ([], ["devices:"], ["devices:@256000"], ["devices:,socket://127.0.0.1:1"]):
        assert main(["record", *words, "--out", str(tmp_path / "a")]) == 2
        assert "no USB adapter of an RPLIDAR is plugged in" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("model", ["a1", "c1", "s3"])
def test_a_recording_stores_the_detected_baud_rate_for_its_playback(model, tmp_path):
    bench = Bench(model)
    known = {"lidar": {"port": "there", "baud": None}}
    with Recorder(tmp_path / "a", known, bench.clock) as recorder:
        opener = recorder.opener("lidar", bench.opener)
        with bench.lidar(opener=opener) as lidar:
            seen = [lidar.revolution() for _ in range(12)]
            expected = lidar.mode, lidar.sensor
    recording = load(tmp_path / "a")
    assert recording.baud("lidar") == BAUDS[model]
    assert recording.header["devices"]["lidar"] == {"port": "there", "baud": BAUDS[model]}
    found, decoder = list(revolutions(recording)), RecordedLidar(BAUDS[model])
    assert len(found) >= len(seen)
    for turn in seen:
        same = min(found, key=lambda other: abs(other.times[0] - turn.times[0]))
        np.testing.assert_array_equal(same.range_mm, turn.range_mm)
        np.testing.assert_allclose(same.times, turn.times, atol=2e-3)
    for record in recording.records:
        decoder.feed(record)
    assert decoder.info.short_name.lower() == model and not decoder.damage
    mode, sensor = expected
    assert (decoder.mode.period, decoder.mode.range_max) == (mode.period, mode.range_max)
    source = raw_recordings.RecordedDevices("a", ((tmp_path / "a").read_bytes(), False))
    assert source.sensor == sensor
    clock = SimulatedClock(7.0)
    played = InMemoryEmulators(playback(recording), clock)
    with RPLidar("lidar", opener=played.opener, clock=clock) as again:
        assert again.baud == BAUDS[model] and again.info.short_name.lower() == model
        assert_right(again.revolution())


def test_a_recorder_that_knows_the_baud_rate_keeps_it(tmp_path):
    bench = Bench("a3")
    with Recorder(tmp_path / "a", {"lidar": {"baud": 115200}}, bench.clock) as recorder:
        bench.lidar(opener=recorder.opener("lidar", bench.opener)).close()
    assert load(tmp_path / "a").baud("lidar") == 115200


def test_another_lidar_that_gets_the_port_is_not_taken_for_it():
    bench, other = Bench(), Bench()
    other.machine._answer = lambda command, payload: (
        (AnswerType.INFO, bytes([0x28, 29, 1, 5]) + bytes(16))
        if command == Command.GET_INFO
        else RPLidarEmulator._answer(other.machine, command, payload)
    )
    with bench.lidar(reconnect=True) as lidar:
        lidar.revolution()
        opened = []

        def opener(name, baud):
            opened.append(baud)
            if len(opened) < 3:
                return InMemoryEmulators({"lidar": other.machine}, bench.clock).opener(
                    "lidar", baud
                )
            bench.faults.unplugged = False
            return bench.emulators.opener("lidar", baud)

        lidar._opener = opener
        bench.faults.unplugged = True
        while not (turn := lidar.revolution()).after_gap:
            pass
        assert len(opened) == 3 and other.machine._scan is None
        assert turn.after_gap and lidar.stats["reconnects"] == 1
        lidar.close()
        with pytest.raises(ConnectionLost):
            lidar.start()
