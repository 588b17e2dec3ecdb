"""Comparison of three filters: definition of lost, intervals, command, stored table."""

import json
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from course.studies import (
    arena_logs,
    filter_comparison,
    filter_consistency,
    filter_costs,
    filter_records,
)
from course.studies.arena_corners import associated_by_ekf
from course.studies.filter_comparison import FIRST_SEED, LOST, TABLE
from course.studies.filter_comparison_table import row
from course.studies.filter_records import Record, association_errors, record, scan_points, summary
from course.studies.paired_statistics import mcnemar_test, paired_difference, share_interval
from slamlab import estimators, sources
from slamlab.estimators.ekf_slam import EkfSlam
from slamlab.sources import arena_runs
from slamlab.sources.arena_runs import SETS, ArenaRun

error_arrays = st.lists(st.floats(0, 1), min_size=2, max_size=50).map(lambda e: np.array([0.0, *e]))


@given(error_arrays)
def test_lost_runs_count_as_strayed_and_there_is_no_error_beyond_the_largest(errors):
    found = summary(errors)
    assert found["strayed"] == (errors.max() > LOST)
    assert found["strayed"] or not found["lost"]
    assert found["lost"] == (errors[-1] > LOST) and found["laps_m"][-1] == errors[-1]
    assert found["before_m"] <= LOST
    assert found["before_m"] <= found["rms_m"] + 1e-12 or found["strayed"]
    assert found["rms_m"] <= errors.max() + 1e-12
    if found["lost_at"] is not None:  # from there on it never came back
        first = round(found["lost_at"] * len(errors))
        assert np.all(errors[first:] > LOST) and errors[first - 1] <= LOST


def test_a_run_that_strays_and_returns_has_strayed_and_is_not_lost():
    found = summary(np.array([0.0, 0.03, 0.04, 0.5, 0.5, 0.01]))
    assert found["strayed"] and not found["lost"] and found["lost_at"] is None
    assert found["before_m"] == pytest.approx(np.sqrt((0.03**2 + 0.04**2) / 3))


def test_the_nearer_filter_is_compared_only_until_either_strays():
    first, second = np.array([0.0, 0.01, 0.5]), np.array([0.0, 0.02, 0.01])
    assert filter_records.nearer(first, second) and not filter_records.nearer(second, first)


def row_of(errors):
    """The line of runs that end so far off, beside runs that end 4 cm off."""
    mine, others = (
        [Record(np.array([0.0, 0.0, e]), 7) for e in each]
        for each in (errors, [0.04] * len(errors))
    )
    return row(mine, others, others)


def test_a_line_counts_and_its_intervals_hold_what_they_are_of():
    line = row_of([0.01, 0.02, 0.03, 0.05, 0.5, 0.6])
    assert (line["runs"], line["runs_strayed"], line["runs_lost"]) == (6, 2, 2)
    assert line["lost"][0] == pytest.approx(1 / 3, abs=1e-4)
    assert line["lost_of_strayed"][0] == 1
    assert line["nearer_than_monte_carlo"][0] == 0.5  # a draw is no win
    assert line["nearer_than_odometry"][0] == 0.5
    assert line["lost_only_it_only_odometry_p"][:2] == [2, 0]
    assert line["landmarks"] == 7 and line["association"] is line["box"] is None
    intervals = [line[key] for key in ("rms_m", "lost", "strayed", "rms_minus_odometry_m")]
    for value, low, high in (*intervals, *line["laps_m"], *line["laps_minus_odometry_m"]):
        assert low <= value <= high
    assert row_of([0.01, 0.02, 0.03])["lost_of_strayed"] is None
    errors = np.random.default_rng(0).uniform(0, 0.3, 100)
    few, many = row_of(errors[:10]), row_of(errors)  # more runs make narrower intervals
    for key in ("rms_m", "lost"):
        assert np.ptp(many[key][1:]) < np.ptp(few[key][1:])


def test_the_interval_of_a_share_holds_the_true_one_in_about_95_percent_of_all_studies():
    rng, held = np.random.default_rng(1), 0
    for _ in range(400):
        _, low, high = share_interval(rng.binomial(50, 0.2), 50)
        held += low <= 0.2 <= high
    assert 0.9 < held / 400 < 0.99


@pytest.fixture
def brief(monkeypatch):
    """One lap, two filters, two data sets, small maps."""
    short = partial(ArenaRun, laps=1)
    for module in (filter_comparison, arena_runs):
        monkeypatch.setattr(module, "ArenaRun", short)
    own = filter_comparison.OWN_ASSOCIATION
    settings = {
        "FILTERS": {k: filter_comparison.FILTERS[k] for k in ("odometry", "Monte Carlo")},
        "OWN_ASSOCIATION": {"Monte Carlo": own["Monte Carlo"]},
        "SIGMAS": (),
        "SETS": SETS[-2:],
        "scan_costs": partial(filter_costs.scan_costs, ("bor", "mak"), (3, 5)),
    }
    for name, value in settings.items():
        monkeypatch.setattr(filter_comparison, name, value)


@pytest.mark.slow
def test_the_command_writes_a_line_for_every_filter_and_kind(tmp_path, capsys, brief):
    out = tmp_path / "three.json"
    assert filter_comparison.main(["--runs", "3", "--jobs", "1", "--out", str(out)]) == 0
    table = json.loads(out.read_text())
    assert json.loads(capsys.readouterr().out) == table
    assert table["seeds"] == [FIRST_SEED, FIRST_SEED + 2] and table["lost_beyond_m"] == LOST
    for rows in table["many"].values():
        assert list(rows) == ["odometry", "Monte Carlo"]
        assert all(line["runs"] == 3 for line in rows.values())
    free, snagged = (table["many"][kind]["odometry"] for kind in ("free", "snagged"))
    assert snagged["laps_m"][-1][0] > free["laps_m"][-1][0]
    assert [line["snagged"] for line in table["six"]] == [False, True]
    assert table["cost"]["over_smallest"]["bor"][0] == table["cost"]["over_bor"]["bor"] == 1


def test_corners_found_once_are_those_that_an_estimator_finds():
    source = ArenaRun(np.random.default_rng(2), laps=1)
    poses = []
    for readings in (source, filter_comparison.with_corners(source)):
        slam = estimators.make("mak", source)
        for reading in readings:
            slam.step(reading)
        poses.append(slam.trajectory().poses)
    np.testing.assert_array_equal(*poses)


def test_in_the_field_of_costs_every_landmark_is_in_the_map_and_one_is_seen():
    field = filter_costs.LandmarkField(40, scans=4)
    for name in filter_costs.NAMES:
        slam = filter_costs.own_association(name, field)
        for reading in field:
            slam.step(reading)
        assert slam.status.startswith("40 landmarks, 0 ")
    assert len(list(field)) == len(field) == 5


def test_the_six_logs_are_written_and_read_again(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(arena_runs, "ArenaRun", partial(ArenaRun, laps=1))
    assert arena_logs.main([str(tmp_path / "new")]) == 0
    names = [f"arena-{k}.log.gz" for k in range(1, 6)] + ["arena-6-snagged.log.gz"]
    assert sorted(path.name for path in (tmp_path / "new").iterdir()) == names
    logs = [sources.open(tmp_path / "new" / name) for name in names]
    assert [log.name for log in logs] == ["sim:arena"] * 5 + ["sim:arena-snagged"]
    assert all(len(log) > 90 for log in logs)
    (tmp_path / "file").write_text("")
    assert arena_logs.main([str(tmp_path / "file")]) == 2


@pytest.fixture(scope="module")
def stored():
    return json.loads(TABLE.read_text())


def test_the_stored_table_is_of_eighty_runs_and_whole(stored):
    runs = stored["seeds"][1] - stored["seeds"][0] + 1
    assert runs >= 80
    assert [(line["seed"], line["snagged"]) for line in stored["six"]] == list(SETS)
    names = {
        "free": list(filter_comparison.FILTERS),
        "snagged": list(filter_comparison.FILTERS),
        "own_association": ["odometry", *filter_comparison.OWN_ASSOCIATION],
        "bounds": ["odometry", "Monte Carlo", *map(str, filter_comparison.SIGMAS)],
    }
    assert {kind: list(rows) for kind, rows in stored["many"].items()} == names
    for rows in stored["many"].values():
        for line in rows.values():
            assert len(line["rms_each_m"]) == runs
            assert line["runs"] == runs >= line["runs_strayed"] >= line["runs_lost"]


def test_the_stored_table_shows_bounded_errors_and_that_the_guaranteed_box_holds(stored):
    rows = stored["many"]["free"]
    for name in ("MAK", "FastSLAM"):
        assert rows[name]["lap_3_minus_lap_1_m"][2] < 0  # of the same drive, by its interval
        assert rows[name]["rms_minus_odometry_m"][2] < 0
        assert rows[name]["runs_lost"] <= 1
    assert rows["odometry"]["lap_3_minus_lap_1_m"][1] > 0
    box = rows["BOR, 4.5 σ"]["box"]
    assert box["scans_outside"] == 0 and box["widest_m"][0] <= 1.2


def test_the_stored_table_shows_that_wider_bounds_make_wider_boxes_that_fail_less_often(stored):
    many = stored["many"]
    boxes = [many["bounds"][str(k)]["box"] for k in filter_comparison.SIGMAS]
    outside = [box["scans_outside"] for box in boxes]
    assert outside == sorted(outside, reverse=True) and outside[0] > 0 == outside[-1]
    assert [box["widest_m"] for box in boxes] == sorted(box["widest_m"] for box in boxes)
    guaranteed = many["free"]["BOR, 4.5 σ"]["box"]
    assert many["bounds"]["4.5"]["box"] == guaranteed
    assert guaranteed["runs_outside_reported"] <= guaranteed["runs_outside"]


def test_the_stored_table_shows_rare_false_associations_and_boxes_broken_by_own_ones(stored):
    row, own = stored["many"]["free"]["MAK"], stored["many"]["own_association"]
    assert row["association"]["runs_with_false"] <= 0.05 * row["runs"]
    assert row["association"]["duplicates"] <= 0.1 * row["runs"]
    assert own["BOR, 4.5 σ"]["box"]["scans_outside"] > 0


def test_an_association_is_false_where_its_landmark_was_first_seen_elsewhere():
    corners = np.array([[0.0, 0.0], [0.12, 0.0]])
    places = [("a", -0.02), ("b", 0.12), ("a", 0.05), ("a", 0.11), ("c", 0.13)]
    found = association_errors([(i, np.array([x, 0.0])) for i, x in places], corners)
    assert found == {"false": 1, "duplicates": 1}  # a at 0.11; c is b again


def test_events_in_both_or_neither_do_not_show_which_is_better():
    mine, other = np.array([1, 1, 1, 1, 0, 0, 0, 0]), np.array([1, 0, 0, 0, 0, 0, 0, 0])
    assert mcnemar_test(mine, other)[:2] == [3, 0] and mcnemar_test(mine, other)[2] == 2 / 2**3
    assert mcnemar_test(mine, mine) == [0, 0, 1.0]


def test_a_paired_difference_shows_what_variation_between_runs_hides():
    rng = np.random.default_rng(0)
    luck = rng.normal(0, 1.0, 60)
    _, low, high = paired_difference(luck + rng.normal(0.1, 0.05, 60), luck)
    assert 0 < low < 0.1 < high < 0.2


def test_scans_drawn_at_the_true_poses_lie_on_the_walls():
    source = ArenaRun(np.random.default_rng(1), laps=1)
    points = scan_points(source, source.truth.poses)
    a, b = np.split(source.world.walls, 2, axis=1)
    along = np.sum((points[:, None] - a) * (b - a), axis=2) / np.sum((b - a) ** 2, axis=1)
    along = along.clip(0, 1)
    off = np.hypot(*(points[:, None] - a - along[..., None] * (b - a)).T).min(axis=0)
    assert len(points) > 1000 and np.median(off) < 0.01


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4000, 4004))
def test_in_the_arena_no_corner_is_taken_for_another_and_none_is_in_the_map_twice(seed):
    source = ArenaRun(np.random.default_rng(seed), laps=2)
    reported = record(EkfSlam(source.robot, source.sensor), source, source)
    assert reported.false == reported.duplicates == 0
    assert 10 <= reported.landmarks <= 20


def test_the_95_percent_regions_are_those_of_the_pose_covariances():
    source = ArenaRun(np.random.default_rng(3), laps=1)
    readings = associated_by_ekf(source, filter_comparison.with_corners(source))
    values = {}
    for name in ("MAK", "Monte Carlo"):
        slam = filter_comparison.FILTERS[name](source)
        values[name] = filter_consistency.pose_nees_of_run(slam, readings, source.truth.poses)
        x, P = filter_consistency.pose_belief(slam)
        assert x.shape == (3,) and P.shape == (3, 3) and np.allclose(P, P.T)
        assert len(values[name]) == len(source) - 1
    assert np.median(values["MAK"]) < np.median(values["Monte Carlo"])


def test_the_stored_regions_of_independent_sets_are_far_too_small(stored):
    table = json.loads(filter_consistency.TABLE.read_text())
    assert list(table["filters"]) == list(filter_consistency.GAUSSIAN)
    assert table["seeds"] == stored["seeds"]
    outside = {name: one["outside_mean"] for name, one in table["filters"].items()}
    assert outside["walls"] < outside["MAK"] < outside["FastSLAM"] < outside["Monte Carlo"]
