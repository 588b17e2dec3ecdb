"""Stored noise statistics of a real RPLIDAR A2: consistency with lesson 02, and their sources."""

import json
from dataclasses import replace

import numpy as np
import pytest

from course.source import ROOT, read
from course.studies import rplidar_a2_noise
from slamlab.simulation.range_scanners import RPLIDAR_A2
from slamlab.simulation.worlds import World, box


def test_the_stored_statistics_support_the_lesson():
    kept = rplidar_a2_noise.stored()
    near, far = kept["by_range"]["share"][0], kept["by_range"]["share"][-1]
    assert far > 3 * near, "no share of the range fits everywhere"
    assert kept["errors"]["rms"] > 1.3 * kept["errors"]["median"]
    assert kept["errors"]["median"] == pytest.approx(0.0025, abs=0.0001), "the question says so"
    assert kept["by_slant"]["share"] == sorted(kept["by_slant"]["share"])
    for (low, high), values in zip(rplidar_a2_noise.WINDOWS[1:], kept["steps"][1:], strict=True):
        step = np.median(np.diff(values))
        assert step == pytest.approx(0.1 * ((low + high) / 2) ** 2, abs=1.0), "steps of 1/r"
    at_most, surely = kept["empty"]["lost"]
    assert surely < at_most < kept["empty"]["readings"]


def test_the_lesson_opens_no_recording():
    cells = read(ROOT / "course" / "lessons" / "02_sensors_and_worlds.py").cells
    assert not [c.id for c in cells if c.type == "code" and "recording(" in c.text]


def test_a_known_noise_is_found_again():
    noise = {"range_error": 0.004, "range_curvature": 0.0, "bearing_sigma": 0.0}
    known = replace(RPLIDAR_A2, **noise, dropouts=0.02)
    square, rng = World(box((0, 0), (6, 6))), np.random.default_rng(3)
    turns = [known.scan(square, np.zeros(3), rng) for _ in range(30)]
    rows = rplidar_a2_noise.repeats(turns)
    assert rplidar_a2_noise.spread(rows[:, 1]) == pytest.approx(0.004, rel=0.05)
    shares = rplidar_a2_noise.by_range(rows, least=500)["share"]
    assert shares == pytest.approx([0.004] * len(shares), rel=0.15)
    assert rplidar_a2_noise.lost([turns]) == pytest.approx([0.02] * 2, rel=0.2)
    assert rplidar_a2_noise.statistics([turns])["empty"]["readings"] == pytest.approx(0.02, rel=0.2)


def test_the_recordings_give_the_stored_statistics(tmp_path, recording):
    for number in (1, 2, 3):
        recording(f"rplidar-a2-{number}")
    assert rplidar_a2_noise.main(["--out", str(tmp_path / "a2.json")]) == 0
    made, kept = json.loads((tmp_path / "a2.json").read_text("utf-8")), rplidar_a2_noise.stored()
    for name in ("turns", "steps", "first_turn"):
        assert made[name] == kept[name]
    assert made["errors"] == pytest.approx(kept["errors"], rel=1e-3)
    for name in ("by_range", "by_slant"):
        for column, values in kept[name].items():
            assert made[name][column] == pytest.approx(values, rel=0.01), (name, column)
