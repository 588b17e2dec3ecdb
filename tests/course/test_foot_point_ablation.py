"""Ablation study of foot points: its interval, its runs, and its stored table."""

import itertools
import json

import numpy as np
import pytest

from course.studies import foot_point_ablation
from slamlab.estimators.foot_point_corrections import CORRECTIONS


def test_the_interval_is_the_medians_and_one_lost_run_does_not_move_it():
    rng = np.random.default_rng(0)
    baseline = rng.uniform(0.1, 0.5, 12)
    errors = baseline + rng.normal(0.3, 0.1, 12)
    row = foot_point_ablation.row(errors, baseline)
    assert row["low_m"] <= row["more_m"] <= row["high_m"]
    assert row["more_m"] == pytest.approx(np.median(errors - baseline))
    errors[np.argmax(errors - baseline)] += 1000
    lost = foot_point_ablation.row(errors, baseline)
    assert (lost["low_m"], lost["high_m"]) == (row["low_m"], row["high_m"])


def test_the_interval_covers_the_median_at_its_stated_rate():
    rng = np.random.default_rng(1)
    rows = [foot_point_ablation.row(rng.exponential(1.0, 6), np.zeros(6)) for _ in range(400)]
    held = [row["low_m"] <= np.log(2) <= row["high_m"] for row in rows]
    assert np.mean(held) > 0.93


def test_wheels_that_slip_less_make_odometry_better_and_beams_do_not_touch_it():
    def off(slip, beams):
        source, readings = foot_point_ablation._driven(3, slip, beams)
        assert {len(reading.scan.ranges) for reading in readings} == {beams}
        odometry = foot_point_ablation.VARIANTS[foot_point_ablation.ODOMETRY](source, None)
        return foot_point_ablation._rms(source, readings, odometry)

    assert off(0.2, 90) < 0.5 * off(1.0, 90)
    assert off(1.0, 90) == off(1.0, 120)


@pytest.fixture(scope="module")
def stored():
    return json.loads(foot_point_ablation.TABLE.read_text(encoding="utf-8"))


def test_the_stored_table_has_every_cell_and_every_correction(stored):
    cells = [(row["slip"], row["beams"]) for row in stored["verdicts"]]
    assert cells == list(itertools.product(foot_point_ablation.SLIPS, foot_point_ablation.BEAMS))
    assert list(stored["left_out"]) == [foot_point_ablation.ALL, *CORRECTIONS]


def test_the_stored_table_supports_the_lesson(stored):
    for row in stored["verdicts"]:
        assert row[foot_point_ablation.NONE]["low_m"] > 0, "as printed it is worse than odometry"
        assert row["walls"]["high_m"] < 0, "lines beat odometry in every row"
        low, high = (row[foot_point_ablation.ALL][key] for key in ("low_m", "high_m"))
        assert low > 0 if row["beams"] == 3600 else low < 0 < high
    matter = [name for name, row in stored["left_out"].items() if row["low_m"] > 0]
    assert matter == ["predict-first", "radians", "Q", "R"]
