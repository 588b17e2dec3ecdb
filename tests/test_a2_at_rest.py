"""The stored statistics of a real RPLIDAR A2: what lesson 02 says of them, where they come from."""

import json
from dataclasses import replace

import numpy as np
import pytest

from course.source import ROOT, read
from slamlab import sources
from slamlab.simulation.range_scanners import RPLIDAR_A2
from slamlab.sources import SourceError
from slamlab.studies import a2_at_rest
from slamlab.worlds import World, box


def test_the_stored_statistics_say_what_the_lesson_says():
    kept = a2_at_rest.stored()
    near, far = kept["by_range"]["share"][0], kept["by_range"]["share"][-1]
    assert far > 3 * near, "no share of the range fits everywhere"
    assert kept["errors"]["rms"] > 1.3 * kept["errors"]["median"]
    assert kept["errors"]["median"] == pytest.approx(0.0025, abs=0.0001), "the question says so"
    assert kept["by_slant"]["share"] == sorted(kept["by_slant"]["share"])
    for (low, high), values in zip(a2_at_rest.WINDOWS[1:], kept["steps"][1:], strict=True):
        step = np.median(np.diff(values))
        assert step == pytest.approx(0.1 * ((low + high) / 2) ** 2, abs=1.0), "steps of 1/r"
    at_most, surely = kept["empty"]["lost"]
    assert surely < at_most < kept["empty"]["readings"]


def test_the_lesson_opens_no_recording():
    lesson = read(ROOT / "course" / "lessons" / "02_sensors_and_worlds.py")
    assert not [
        cell.id for cell in lesson.cells if cell.type == "code" and "recording(" in cell.text
    ]


def test_a_known_noise_is_found_again():
    known = replace(
        RPLIDAR_A2, range_error=0.004, range_curvature=0.0, bearing_sigma=0.0, dropouts=0.02
    )
    square, rng = World(box((0, 0), (6, 6))), np.random.default_rng(3)
    turns = [known.scan(square, np.zeros(3), rng) for _ in range(30)]
    rows = a2_at_rest.repeats(turns)
    assert a2_at_rest.spread(rows[:, 1]) == pytest.approx(0.004, rel=0.05)
    shares = a2_at_rest.by_range(rows, least=500)["share"]
    assert shares == pytest.approx([0.004] * len(shares), rel=0.15)
    assert a2_at_rest.lost([turns]) == pytest.approx([0.02] * 2, rel=0.2)
    assert a2_at_rest.statistics([turns])["empty"]["readings"] == pytest.approx(0.02, rel=0.2)


def test_without_the_recordings_the_command_says_so_in_one_line(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("SLAMLAB_DATA", str(tmp_path))
    assert a2_at_rest.main(["--out", str(tmp_path / "a2.json")]) == 2
    assert "SLAMLAB_DATA" in capsys.readouterr().err
    assert not (tmp_path / "a2.json").exists()


def test_the_recordings_give_the_stored_statistics(tmp_path):
    try:
        for number in (1, 2, 3):
            sources.recording(f"rplidar-a2-{number}")
    except SourceError as missing:
        pytest.skip(str(missing))
    assert a2_at_rest.main(["--out", str(tmp_path / "a2.json")]) == 0
    made, kept = json.loads((tmp_path / "a2.json").read_text("utf-8")), a2_at_rest.stored()
    for name in ("turns", "steps", "first_turn"):
        assert made[name] == kept[name]
    assert made["errors"] == pytest.approx(kept["errors"], rel=1e-3)
    for name in ("by_range", "by_slant"):
        for column, values in kept[name].items():
            assert made[name][column] == pytest.approx(values, rel=0.01), (name, column)
