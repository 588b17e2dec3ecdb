"""The study of three filters: what lost means, its intervals, its command, what its table says."""

import json
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab import estimators, sources
from slamlab.sources import arena_runs
from slamlab.sources.arena_runs import SETS, ArenaRun
from slamlab.studies import arena_logs, three, three_costs, three_records
from slamlab.studies.paired_statistics import only_one, paired_difference, share_interval
from slamlab.studies.three import FIRST_SEED, LOST, TABLE
from slamlab.studies.three_records import Record, association_errors, scan_points, summary
from slamlab.studies.three_rows import row

ways = st.lists(st.floats(0, 1), min_size=2, max_size=50).map(lambda e: np.array([0.0, *e]))


@given(ways)
def test_lost_is_a_way_of_straying_and_there_is_no_error_beyond_the_largest(errors):
    found = summary(errors)
    assert found["strayed"] == (errors.max() > LOST)
    assert found["strayed"] or not found["lost"]
    assert found["lost"] == (errors[-1] > LOST) and found["laps_m"][-1] == errors[-1]
    assert found["before_m"] <= LOST
    assert found["before_m"] <= found["rms_m"] + 1e-12 or found["strayed"]
    assert found["rms_m"] <= errors.max() + 1e-12


@given(ways)
def test_from_where_it_was_lost_it_never_came_back(errors):
    at = summary(errors)["lost_at"]
    if at is not None:
        first = round(at * len(errors))
        assert np.all(errors[first:] > LOST) and errors[first - 1] <= LOST


def test_who_strays_and_comes_back_has_strayed_and_is_not_lost():
    found = summary(np.array([0.0, 0.03, 0.04, 0.5, 0.5, 0.01]))
    assert found["strayed"] and not found["lost"] and found["lost_at"] is None
    assert found["before_m"] == pytest.approx(np.sqrt((0.03**2 + 0.04**2) / 3))


def test_who_is_nearer_is_asked_only_until_either_strays():
    first, second = np.array([0.0, 0.01, 0.5]), np.array([0.0, 0.02, 0.01])
    assert three_records.nearer(first, second) and not three_records.nearer(second, first)


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
    assert line["nearer_than_odometry"][0] == 0.5 and line["lost_only_it_only_odometry_p"][:2] == [
        2,
        0,
    ]
    assert line["landmarks"] == 7 and line["association"] is line["box"] is None
    intervals = [line[key] for key in ("rms_m", "lost", "strayed", "rms_minus_odometry_m")]
    for value, low, high in (*intervals, *line["laps_m"], *line["laps_minus_odometry_m"]):
        assert low <= value <= high
    assert row_of([0.01, 0.02, 0.03])["lost_of_strayed"] is None


def test_more_runs_make_narrower_intervals():
    errors = np.random.default_rng(0).uniform(0, 0.3, 100)
    few, many = row_of(errors[:10]), row_of(errors)
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
    for module in (three, arena_runs):
        monkeypatch.setattr(module, "ArenaRun", short)
    makers = {name: three.FILTERS[name] for name in ("odometry", "Monte Carlo")}
    monkeypatch.setattr(three, "FILTERS", makers)
    monkeypatch.setattr(three, "OWN_NAMES", {"Monte Carlo": three.OWN_NAMES["Monte Carlo"]})
    monkeypatch.setattr(three, "SIGMAS", ())
    monkeypatch.setattr(three, "SETS", SETS[-2:])
    few = partial(three_costs.scan_costs, ("bor", "mak"), (3, 5))
    monkeypatch.setattr(three, "scan_costs", few)


@pytest.mark.slow
def test_the_command_writes_a_line_for_every_filter_and_kind(tmp_path, capsys, brief):
    out = tmp_path / "three.json"
    assert three.main(["--runs", "3", "--jobs", "1", "--out", str(out)]) == 0
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


def test_the_same_seed_gives_the_same_errors(brief):
    first, second = three.run(1), three.run(1)
    assert first.keys() == second.keys()
    for kind, records in first.items():
        for name, record in records.items():
            np.testing.assert_array_equal(record.errors, second[kind][name].errors)


def test_corners_found_once_are_those_that_an_estimator_finds():
    source = ArenaRun(np.random.default_rng(2), laps=1)
    poses = []
    for readings in (source, three.with_corners(source)):
        slam = estimators.make("mak", source)
        for reading in readings:
            slam.step(reading)
        poses.append(slam.trajectory().poses)
    np.testing.assert_array_equal(*poses)


def test_too_few_runs_are_refused_in_one_line(capsys, tmp_path):
    assert three.main(["--runs", "2", "--out", str(tmp_path / "x")]) == 2
    assert "at least 3" in capsys.readouterr().err


def test_in_the_field_of_costs_every_landmark_is_in_the_map_and_one_is_seen():
    field = three_costs.LandmarkField(40, scans=4)
    for name in three_costs.NAMES:
        slam = three_costs.own_association(name, field)
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


@pytest.mark.skipif(not TABLE.exists(), reason="the table has not been made")
def test_the_stored_table_is_of_eighty_runs_and_whole():
    table = json.loads(TABLE.read_text())
    runs = table["seeds"][1] - table["seeds"][0] + 1
    assert runs >= 80
    assert [(line["seed"], line["snagged"]) for line in table["six"]] == list(SETS)
    names = {
        "free": list(three.FILTERS),
        "snagged": list(three.FILTERS),
        "own_names": ["odometry", *three.OWN_NAMES],
        "bounds": ["odometry", "Monte Carlo", *map(str, three.SIGMAS)],
    }
    assert {kind: list(rows) for kind, rows in table["many"].items()} == names
    for rows in table["many"].values():
        for line in rows.values():
            assert len(line["rms_each_m"]) == runs
            assert line["runs"] == runs >= line["runs_strayed"] >= line["runs_lost"]


@pytest.mark.skipif(not TABLE.exists(), reason="the table has not been made")
def test_the_stored_table_says_that_the_error_does_not_grow_and_the_honest_box_holds():
    rows = json.loads(TABLE.read_text())["many"]["free"]
    for name in ("MAK", "FastSLAM"):
        assert rows[name]["lap_3_minus_lap_1_m"][2] < 0  # of the same drive, by its interval
        assert rows[name]["rms_minus_odometry_m"][2] < 0
        assert rows[name]["runs_lost"] <= 1
    assert rows["odometry"]["lap_3_minus_lap_1_m"][1] > 0
    box = rows["BOR, honest"]["box"]
    assert box["scans_outside"] == 0 and box["widest_m"][0] <= 1.2


@pytest.mark.skipif(not TABLE.exists(), reason="the table has not been made")
def test_the_stored_table_says_that_wider_bounds_make_wider_boxes_that_fail_less_often():
    many = json.loads(TABLE.read_text())["many"]
    boxes = [many["bounds"][str(k)]["box"] for k in three.SIGMAS]
    outside = [box["scans_outside"] for box in boxes]
    assert outside == sorted(outside, reverse=True) and outside[0] > 0 == outside[-1]
    assert [box["widest_m"] for box in boxes] == sorted(box["widest_m"] for box in boxes)
    honest = many["free"]["BOR, honest"]["box"]
    assert many["bounds"]["4.5"]["box"] == honest
    assert honest["runs_outside_reported"] <= honest["runs_outside"]


@pytest.mark.skipif(not TABLE.exists(), reason="the table has not been made")
def test_the_stored_table_says_that_false_pairings_are_rare_and_own_names_break_the_honest_box():
    table = json.loads(TABLE.read_text())["many"]
    row, own = table["free"]["MAK"], table["own_names"]
    assert row["association"]["runs_with_false"] <= 0.05 * row["runs"]
    assert row["association"]["duplicates"] <= 0.1 * row["runs"]
    assert own["BOR, honest"]["box"]["scans_outside"] > 0


def test_a_sighting_is_false_where_its_landmark_was_first_seen_elsewhere():
    corners = np.array([[0.0, 0.0], [0.12, 0.0]])
    places = [("a", -0.02), ("b", 0.12), ("a", 0.05), ("a", 0.11), ("c", 0.13)]
    found = association_errors([(i, np.array([x, 0.0])) for i, x in places], corners)
    assert found == {"false": 1, "duplicates": 1}  # a at 0.11; c is b again


def test_what_befalls_both_or_none_says_nothing_of_which_is_better():
    mine, other = np.array([1, 1, 1, 1, 0, 0, 0, 0]), np.array([1, 0, 0, 0, 0, 0, 0, 0])
    assert only_one(mine, other)[:2] == [3, 0] and only_one(mine, other)[2] == 2 / 2**3
    assert only_one(mine, mine) == [0, 0, 1.0]


def test_paired_a_small_difference_shows_that_is_lost_between_drives():
    rng = np.random.default_rng(0)
    luck = rng.normal(0, 1.0, 60)
    _, low, high = paired_difference(luck + rng.normal(0.1, 0.05, 60), luck)
    assert 0 < low < 0.1 < high < 0.2


def test_scans_drawn_at_the_true_poses_lie_on_the_walls():
    source = ArenaRun(np.random.default_rng(1), laps=1)
    points, (a, b) = (
        scan_points(source, source.truth.poses),
        np.split(source.world.walls, 2, axis=1),
    )
    along = np.clip(
        np.sum((points[:, None] - a) * (b - a), axis=2) / np.sum((b - a) ** 2, axis=1), 0, 1
    )
    off = np.hypot(*(points[:, None] - a - along[..., None] * (b - a)).T).min(axis=0)
    assert len(points) > 1000 and np.median(off) < 0.01
