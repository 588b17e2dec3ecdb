"""Recorded logs in a contest: fixed by hashes, scored by relations, run like the worlds."""

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from classroom.contest import contest_logs, pictures, seed_commitment
from classroom.contest.pictures import film_page, map_picture
from classroom.contest.ranking import by_families
from classroom.contest.seed_commitment import ContestError
from classroom.project.estimator_runs import Budget, EstimatorRun
from classroom.project.recorded_logs import MAX_LOG_READINGS, recorded_log
from classroom.project.scores import prepare
from classroom.project.world_generation import generate_world
from classroom.project.world_parameters import WorldFamily
from slamlab import sources
from slamlab.cli import main
from slamlab.evaluation.relations import Relations, load_relations
from slamlab.geometry import between
from slamlab.layers import Points, Poses
from slamlab.sources.base import Source
from tests.classroom.contest import cheaters
from tests.classroom.grading.conftest import notebook, table, workers

HALL = WorldFamily("hall", plans=(("crc", "rcr"),))


@cache
def world():
    """A small world, of which a log is made up."""
    return generate_world(HALL, np.random.default_rng(4), 20.0)


class Made(Source):
    """The readings of a world as a source."""

    name = "made"

    def __iter__(self):
        return iter(world())


def relations():
    """True relations, some of neighbours and some of poses far apart."""
    n, poses, times = len(world()), world().truth.poses, world().truth.times
    pairs = [(i, i + 1) for i in range(1, n - 1, 4)] + [(i, n - 1 - i) for i in range(0, n // 2, 5)]
    first, second = np.transpose(pairs)
    return Relations(times[np.array(pairs)], between(poses[first], poses[second]))


def write_log(folder, name="hall"):
    """A log and its relations as files; what ``--log`` takes."""
    log, file = folder / f"{name}.log", folder / f"{name}.relations"
    sources.write(Made(), log)
    lines = (f"{t1} {t2} {x} {y} 0 0 0 {turn}" for (t1, t2), (x, y, turn) in zip(
        relations().stamps, relations().poses, strict=True))  # fmt: skip
    file.write_text("\n".join(lines) + "\n")
    return f"{log},{file}"


@cache
def prepared_world():
    """The made-up log, prepared once."""
    return prepare(recorded_log("hall", world(), relations()))


def estimate(noise):
    """A drive whose poses are the truth but for errors that grow."""
    n = len(world())
    steps = np.random.default_rng(0).standard_normal((n, 3)) * noise * np.array([0.02, 0.02, 0.01])
    poses = world().truth.poses + np.cumsum(steps, axis=0)
    claims = np.broadcast_to(1e-9 * np.eye(3), (n, 3, 3))
    return EstimatorRun(poses, claims, poses, np.empty((0, 2)), (), 1.0)


def points_of(run):
    return prepared_world().judge(run).points


def test_baselines_are_the_marks_and_the_truth_scores_100():
    points = {name: points_of(run) for name, run in prepared_world().runs.items()}
    assert points["odometry"] == 0
    assert 0 < points["icp"] <= 55
    assert points["icp"] < points["graph"] <= 85
    assert points_of(estimate(0.0)) > 99


def test_points_fall_as_errors_of_relations_grow_and_missing_poses_cost_their_share():
    points = [points_of(estimate(noise)) for noise in (0, 0.1, 0.2, 0.5, 3)]
    assert points == sorted(points, reverse=True)
    assert len(set(points)) > 3
    half = estimate(0.0)
    half.trajectory[len(world()) // 2 :] = np.nan
    found = prepared_world().judge(half)
    assert found.points < 51
    assert np.isfinite(found.measures.relations)
    without_truth = *found.measures.errors, found.measures.map, found.measures.nees
    assert np.isnan(without_truth).all()


def test_relations_that_do_not_belong_to_the_log_and_long_logs_are_refused():
    foreign = Relations(relations().stamps + 1e6, relations().poses)
    with pytest.raises(ValueError, match="do they belong to this log"):
        recorded_log("hall", world(), foreign)
    with pytest.raises(ValueError, match=f"1 to {MAX_LOG_READINGS} per log"):
        recorded_log("hall", [world().reading(0)] * (MAX_LOG_READINGS + 1), relations())
    with pytest.raises(ValueError, match="has 0 readings"):
        recorded_log("hall", [], relations())


def test_a_log_counts_like_a_family_whatever_the_number_of_worlds():
    table = by_families([1, 5, 9, 70], ["plain", "plain", "plain", "hall"])
    np.testing.assert_array_equal(table, [[1, 5, 9], [70, 70, 70]])


def test_logs_are_fixed_by_the_hash_and_found_by_their_content(tmp_path):
    spec = write_log(tmp_path)
    contest = seed_commitment.commit(tmp_path / "out", 1, contest_logs.hash_logs([spec]))
    assert seed_commitment.commit(tmp_path / "out") == contest
    assert contest.worlds_in_order[-1] == ("hall", 1)
    assert str(tmp_path) not in contest.text
    (log,) = contest_logs.open_logs(contest, [spec])
    assert (log.name, len(log), len(log.pairs)) == ("hall", len(world()), len(relations().poses))
    with pytest.raises(ContestError, match=r"give its files with --log LOG,RELATIONS"):
        contest_logs.open_logs(contest, [])
    (tmp_path / "hall.relations").write_text("0 1 0 0 0 0 0 0\n")
    with pytest.raises(ContestError, match="another file of that name"):
        contest_logs.open_logs(contest, [spec])


@pytest.mark.parametrize(
    ("spec", "message"),
    [
        ("intel", "the command 'slamlab data get intel' fetches it"),
        ("nothing", "the name of a recording with relations, such as intel, or two files"),
        ("{tmp}/no.log,{tmp}/no.relations", "does not exist"),
        ("{tmp}/plain.log,{tmp}/plain.relations", "cannot have the name 'plain'"),
        ("{tmp}/hall.log,{tmp}/hall.log", "contains no relation"),
        ("{tmp}/hall.relations,{tmp}/hall.relations", "no format that slamlab can read"),
    ],
)
def test_a_log_without_relations_is_reported_in_a_line(
    tmp_path, spec, message, capsys, monkeypatch
):
    monkeypatch.setenv("SLAMLAB_DATA", str(tmp_path))
    write_log(tmp_path)
    write_log(tmp_path, "plain")
    words = ["contest", "--out", str(tmp_path / "out"), "--log", spec.format(tmp=tmp_path)]
    assert main(words) == 2
    assert message in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_the_command_runs_a_log_beside_the_worlds(tmp_path, capsys, monkeypatch):
    draw = seed_commitment.draw_contest
    monkeypatch.setattr(
        seed_commitment, "draw_contest", lambda worlds, logs: draw(("plain",), worlds, logs)
    )
    for limit in ("total", "reading", "ending", "patience"):  # a crowded machine takes longer
        monkeypatch.setattr(Budget, limit, 10 * getattr(Budget, limit))
    (tmp_path / "class").mkdir()
    for name, cell in {"ada": cheaters.SOLUTION, "bob": cheaters.TEMPLATE}.items():
        text = notebook(cell, exercise=None)
        (tmp_path / "class" / f"{name}.ipynb").write_text(text, encoding="utf-8")
    out, spec = tmp_path / "out", write_log(tmp_path)
    assert main(["contest", "--out", str(out), "--worlds", "1", "--log", spec]) == 0
    words = [str(tmp_path / "class"), "--names", "--isolation", workers().level]
    assert main(["contest", *words, "--out", str(out), "--log", spec]) == 0, capsys.readouterr()
    board = out / "board"
    rows = {(row["name"], row["family"]): row for row in table(board / "worlds.csv")}
    assert set(rows) == {(name, of) for name in ("ada", "bob") for of in ("plain", "hall")}
    assert float(rows["ada", "hall"]["points"]) > 40 > float(rows["bob", "hall"]["points"])
    assert float(rows["ada", "hall"]["error of relations"]) > 0
    assert rows["ada", "hall"]["map"] == "nan"
    revealed = json.loads((board / seed_commitment.REVEALED).read_text())
    assert [log[0] for log in revealed["logs"]] == ["hall"]
    assert "over its relations" in (board / "students" / "ada.html").read_text("utf-8")
    capsys.readouterr()
    again = ["--out", str(tmp_path / "again"), "--again", str(board), "--log", spec]
    assert main(["contest", *words, *again]) == 0
    assert "4 runs compared: points differ by at most 0" in capsys.readouterr().out


def test_what_a_contest_was_made_with_cannot_be_changed(tmp_path, capsys):
    spec, out = write_log(tmp_path), str(tmp_path / "out")
    assert main(["contest", "--out", out, "--worlds", "1"]) == 0
    assert main(["contest", "--out", out, "--worlds", "2"]) == 2
    assert "has 1 worlds of each family, and cannot be changed" in capsys.readouterr().err
    assert main(["contest", str(tmp_path), "--out", out, "--log", spec]) == 2
    assert "made without the log hall" in capsys.readouterr().err


def test_the_intel_log_is_scored_by_its_published_relations():
    try:
        hashes = contest_logs.hash_logs(["intel"])
    except sources.SourceError as error:
        pytest.skip(str(error))
    (log,) = contest_logs.open_logs(seed_commitment.draw_contest(logs=hashes), [])
    assert (len(log), len(log.pairs)) == (910, 108)
    assert len(load_relations("intel-relations").poses) > len(log.pairs)
    at_rest = log.errors(np.zeros((len(log), 3)))
    np.testing.assert_allclose(at_rest, np.hypot(*log.relations[:, :2].T))


def test_a_film_and_a_map_of_a_log_need_no_truth_and_no_finite_pose(tmp_path):
    for noise in (0.1, np.nan):
        run = estimate(noise)
        assert "Two trajectories of a recorded log" in map_picture(prepared_world(), run)
        page = film_page(prepared_world(), run, "hall", tmp_path / "hall.film")
        assert "the true track" not in page


def test_a_diverging_estimate_leaves_map_and_film_and_does_not_stretch_them():
    inside = prepare(world())
    for where in (prepared_world(), inside):
        gone, usual = estimate(0.1), estimate(0.1)
        far = np.linspace([0, 0, 0], [3.0, 1e5, 0], len(world()))
        gone = replace(gone, online=far, trajectory=far, points=far[:, :2])
        box, usual_box = (
            map_picture(where, run).split('viewBox="')[1].split('"')[0] for run in (gone, usual)
        )
        assert box == usual_box
        for scene in pictures._scenes(where, gone):
            for layer in scene.layers:
                if isinstance(layer, Points | Poses):
                    rows = layer.xy if isinstance(layer, Points) else layer.rows
                    assert np.abs(rows[:, :2]).max(initial=0) < 200
