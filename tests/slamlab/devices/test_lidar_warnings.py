"""Lidars that measure nothing, send unknown types or declare implausible modes are warned about."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.cli import main
from slamlab.devices.emulator.emulator_runner import run_emulators
from slamlab.devices.emulator.lidar_models import MODELS
from slamlab.devices.emulator.serial_line import Faults
from slamlab.devices.errors import UnsupportedMode
from slamlab.devices.recording import load
from slamlab.devices.rplidar.responses import AnswerType
from slamlab.devices.rplidar.scan_modes import ScanMode, plausible, select_mode
from slamlab.devices.rplidar.scan_stream import DECODERS
from slamlab.simulation import worlds
from tests.slamlab.devices.emulator_helpers import Bench, assert_right


def test_a_lidar_that_measures_nothing_is_warned_about_within_two_seconds_of_data():
    bench = Bench(faults=Faults(blind=True))
    with bench.lidar() as lidar:
        lidar.start()
        lidar.revolution()
        begin = bench.clock.now()
        while not lidar.warnings:
            lidar.revolution()
        assert bench.clock.now() - begin < 1.8  # a first turn was there before
        (warning,) = lidar.warnings
        assert "measures no distance" in warning and "range of 12 m" in warning
        bench.faults.blind = False
        bench.clock.sleep(2.0)
        assert not lidar.warnings
        bench.faults.blind = True
        bench.clock.sleep(2.0)
        assert len(lidar.warnings) == 1


@pytest.mark.parametrize("mode", [0, 1, 2])
def test_few_returns_are_not_none(mode):
    bench = Bench()
    bench.machine._measure = lambda times, directions: np.where(directions % 360 < 5, 2000.0, 0)
    with bench.lidar() as lidar:
        lidar.start(mode)
        bench.clock.sleep(5.0)
        assert not lidar.warnings


@pytest.mark.usefixtures("busy_machine")
def test_recording_reports_missing_measurements_and_the_baud_rate(tmp_path, capsys):
    path = tmp_path / "a.raw"
    local = "127.0.0.1", 0, 0
    with run_emulators(worlds.room(), np.random.default_rng(0), local) as it:
        it["lidar"].faults.blind = True
        port = it.ports["lidar"]
        words = [f"devices:{port}@256000", "--mode", "Sensitivity", "--seconds", "2"]
        assert main(["record", *words, "--out", str(path)]) == 0
    output = capsys.readouterr()
    assert "no scan mode 'Sensitivity'. The lidar scans in mode 0; choose one of: " in output.err
    assert output.err.count("warning: the lidar rotates but measures no distance") == 1
    assert "at 256000 baud in mode Standard" in output.out and "resyncs" not in output.out
    assert load(path).baud("lidar") == 256000
    assert load(path).header["devices"]["lidar"]["port"] == port
    assert main(["replay", str(path), "--info"]) == 0
    assert "256000 baud" in capsys.readouterr().out


@pytest.mark.parametrize("mode", [None, "Boost", 2])
def test_a_mode_of_an_unknown_type_is_reported_and_replaced_by_the_standard_scan(mode):
    bench = Bench(faults=Faults(unknown_type=True))
    with bench.lidar() as lidar:
        lidar.start(mode)
        assert_right(lidar.revolution())
        assert lidar.mode.name == "Standard"
        assert lidar.warnings == [
            "scan mode Boost sends data of an unknown type (0x99): "
            "the standard scan is used instead"
        ]
        lidar.start("Standard")
        assert not lidar.warnings


def test_data_of_another_type_than_declared_are_skipped_as_well():
    bench = Bench()
    with bench.lidar() as lidar:
        bench.faults.unknown_type = True  # after it has reported its modes
        lidar.start("Boost")
        assert_right(lidar.revolution())
        (warning,) = lidar.warnings
        assert "0x99" in warning and "the standard scan is used instead" in warning


def test_without_a_known_mode_the_standard_scan_is_used():
    strange = tuple(ScanMode(k, f"New{k}", 1e-4, 25.0, 0x90 + k) for k in range(3))
    bench = Bench("s2", modes=strange, typical=1)
    with bench.lidar() as lidar:
        assert_right(lidar.revolution())
        assert lidar.mode.answer_type == AnswerType.SCAN and len(lidar.warnings) == 1
        with pytest.raises(UnsupportedMode) as refused:
            lidar.start("Boost")
    assert refused.value.step == "choose one of: Standard"


def test_another_packet_size_is_an_unknown_type():
    """Slamtec's document gives ultra capsules the type 0x83, which is another in its SDK."""
    wrong = ScanMode(2, "Boost", 127e-6, 12.0, AnswerType.ULTRA)
    bench = Bench(modes=(*MODELS["a2m8"].modes[:2], wrong))
    kind = bench.machine._type
    bench.machine._type = lambda mode: AnswerType.HQ if mode == wrong else kind(mode)
    put = bench.machine.line.put
    bench.machine.line.put = lambda packet, ready: put(
        packet.replace(b"\xa5\x5a\x0d\x03\x00\x40\x83", b"\xa5\x5a\x84\x00\x00\x40\x83"), ready
    )
    with bench.lidar() as lidar:
        assert_right(lidar.revolution())
        assert lidar.mode.name == "Standard" and "132 bytes" in lidar.warnings[0]


def test_implausible_periods_and_ranges_are_replaced_by_defaults():
    assert plausible(508.0, 12.0, AnswerType.SCAN) == (508e-6, 12.0)
    assert plausible(0.0, 40.0, AnswerType.DENSE) == (31.25e-6, 40.0)  # some S3 report 0
    assert plausible(None, None, 0x99) == (508e-6, 16.0)
    assert plausible(1e9, 0.0, AnswerType.ULTRA) == (127e-6, 16.0)


modes = st.lists(
    st.builds(
        ScanMode,
        st.integers(0, 5),
        st.sampled_from(["Standard", "Boost", "", "é"]),
        st.just(1e-4),
        st.just(12.0),
        st.integers(0x80, 0x8A),
    ),
    max_size=5,
)
standard = ScanMode(9, "Standard", 5e-4, 12.0, AnswerType.SCAN)


@given(modes, st.one_of(st.none(), st.integers(0, 9), st.sampled_from(["boost", "Standard", "x"])))
def test_a_mode_with_a_decoder_is_chosen_or_all_modes_are_listed(listed, wanted):
    listed = [*listed, standard]
    try:
        mode, warning = select_mode(listed, listed[0], wanted)
    except UnsupportedMode as error:
        assert all(wanted != m.number and wanted != m.name for m in listed)
        assert "Standard" in error.step
    else:
        assert mode.answer_type in DECODERS
        asked = wanted in (mode.number, mode.name, mode.name.lower()) or wanted is None
        assert asked or warning
