"""Recorded logs in a contest: fixed by hashes, scored by relations, driven like the worlds."""

import csv
import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from slamlab import sources
from slamlab.cli import main
from slamlab.contest import commitment, contest_logs, pictures
from slamlab.contest.commitment import ContestError
from slamlab.contest.pictures import film_page, map_picture
from slamlab.contest.ranking import by_families
from slamlab.evaluation.relations import Relations, load_relations
from slamlab.geometry import between
from slamlab.layers import Points, Poses
from slamlab.project.drawing import draw_world
from slamlab.project.driving import Budget, Drive
from slamlab.project.recorded_logs import MAX_LOG_READINGS, recorded_log
from slamlab.project.scores import prepare
from slamlab.project.world_families import Family
from slamlab.sources.base import Source
from tests.contest import cheaters
from tests.grading.conftest import notebook, workers

HALL = Family("hall", plans=(("crc", "rcr"),))


@cache
def world():
    """A small world, of which a log is made up."""
    return draw_world(HALL, np.random.default_rng(4), 20.0)


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
def arena():
    """The made-up log, prepared once."""
    return prepare(recorded_log("hall", world(), relations()))


def estimate(noise):
    """A drive whose poses are the truth but for errors that grow."""
    n = len(world())
    steps = np.random.default_rng(0).standard_normal((n, 3)) * noise * np.array([0.02, 0.02, 0.01])
    poses = world().truth.poses + np.cumsum(steps, axis=0)
    claims = np.broadcast_to(1e-9 * np.eye(3), (n, 3, 3))
    return Drive(poses, claims, poses, np.empty((0, 2)), (), 1.0)


def test_baselines_are_the_marks_and_the_truth_scores_100():
    points = {name: arena().judge(driven).points for name, driven in arena().drives.items()}
    assert points["odometry"] == 0
    assert 0 < points["icp"] <= 55
    assert points["icp"] < points["graph"] <= 85
    assert arena().judge(estimate(0.0)).points > 99


def test_points_fall_as_errors_of_relations_grow_and_missing_poses_cost_their_share():
    points = [arena().judge(estimate(noise)).points for noise in (0, 0.1, 0.2, 0.5, 3)]
    assert points == sorted(points, reverse=True)
    assert len(set(points)) > 3
    half = estimate(0.0)
    half.trajectory[len(world()) // 2 :] = np.nan
    found = arena().judge(half)
    assert found.points < 51
    assert np.isfinite(found.measures.relations)


def test_neither_a_map_nor_a_claim_is_scored_where_there_is_no_truth():
    found = arena().judge(estimate(0.1)).measures
    assert np.isnan([*found.errors, found.map, found.nees]).all()


def test_relations_that_do_not_belong_to_the_log_and_long_logs_are_refused():
    foreign = Relations(relations().stamps + 1e6, relations().poses)
    with pytest.raises(ValueError, match="do they belong to this log"):
        recorded_log("hall", world(), foreign)
    with pytest.raises(ValueError, match=f"1 to {MAX_LOG_READINGS}: cut it"):
        recorded_log("hall", [world().reading(0)] * (MAX_LOG_READINGS + 1), relations())
    with pytest.raises(ValueError, match="has 0 readings"):
        recorded_log("hall", [], relations())


def test_a_log_counts_like_a_family_whatever_the_number_of_worlds():
    table = by_families([1, 5, 9, 70], ["plain", "plain", "plain", "hall"])
    np.testing.assert_array_equal(table, [[1, 5, 9], [70, 70, 70]])


def test_logs_are_fixed_by_the_hash_and_found_by_their_content(tmp_path):
    spec = write_log(tmp_path)
    contest = commitment.commit(tmp_path / "out", 1, contest_logs.hashes_of([spec]))
    assert commitment.commit(tmp_path / "out") == contest
    assert contest.places[-1] == ("hall", 1)
    assert str(tmp_path) not in contest.text
    (log,) = contest_logs.open_logs(contest, [spec])
    assert (log.name, len(log), len(log.pairs)) == ("hall", len(world()), len(relations().poses))
    with pytest.raises(ContestError, match=r"say where it is with --log LOG,RELATIONS"):
        contest_logs.open_logs(contest, [])
    (tmp_path / "hall.relations").write_text("0 1 0 0 0 0 0 0\n")
    with pytest.raises(ContestError, match="another file of that name"):
        contest_logs.open_logs(contest, [spec])


@pytest.mark.parametrize(
    ("spec", "told"),
    [
        ("nothing", "a recording's name that has relations, such as intel, or LOG,RELATIONS"),
        ("{tmp}/no.log,{tmp}/no.relations", "there is no file"),
        ("{tmp}/plain.log,{tmp}/plain.relations", "cannot be called 'plain'"),
        ("{tmp}/hall.log,{tmp}/hall.log", "holds no relation"),
        ("{tmp}/hall.relations,{tmp}/hall.relations", "no log that slamlab knows"),
    ],
)
def test_what_is_no_log_with_relations_is_told_in_a_line(tmp_path, spec, told, capsys):
    write_log(tmp_path)
    write_log(tmp_path, "plain")
    words = ["contest", "--out", str(tmp_path / "out"), "--log", spec.format(tmp=tmp_path)]
    assert main(words) == 2
    assert told in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_where_a_recording_is_absent_it_is_told_what_it_is_and_what_to_do(
    tmp_path, capsys, monkeypatch
):
    monkeypatch.setenv("SLAMLAB_DATA", str(tmp_path))
    assert main(["contest", "--out", str(tmp_path / "out"), "--log", "intel"]) == 2
    assert "Set SLAMLAB_DATA to the folder that holds it" in capsys.readouterr().err


@pytest.mark.slow
def test_the_command_drives_a_log_beside_the_worlds(tmp_path, capsys, monkeypatch):
    draw = commitment.draw_contest
    monkeypatch.setattr(
        commitment, "draw_contest", lambda worlds, logs: draw(("plain",), worlds, logs)
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
    with open(board / "worlds.csv", newline="", encoding="utf-8") as file:
        rows = {(row["name"], row["family"]): row for row in csv.DictReader(file)}
    assert set(rows) == {(name, of) for name in ("ada", "bob") for of in ("plain", "hall")}
    assert float(rows["ada", "hall"]["points"]) > 40 > float(rows["bob", "hall"]["points"])
    assert float(rows["ada", "hall"]["error of relations"]) > 0
    assert rows["ada", "hall"]["map"] == "nan"
    revealed = json.loads((board / commitment.REVEALED).read_text())
    assert [log[0] for log in revealed["logs"]] == ["hall"]
    assert "over its relations" in (board / "students" / "ada.html").read_text("utf-8")
    capsys.readouterr()
    again = ["--out", str(tmp_path / "again"), "--again", str(board), "--log", spec]
    assert main(["contest", *words, *again]) == 0
    assert "4 worlds compared: points differ by 0 at most" in capsys.readouterr().out


def test_what_a_contest_was_made_with_cannot_be_changed(tmp_path, capsys):
    spec, out = write_log(tmp_path), str(tmp_path / "out")
    assert main(["contest", "--out", out, "--worlds", "1"]) == 0
    assert main(["contest", "--out", out, "--worlds", "2"]) == 2
    assert "has 1 worlds a family, and cannot be changed" in capsys.readouterr().err
    assert main(["contest", str(tmp_path), "--out", out, "--log", spec]) == 2
    assert "made without the log hall" in capsys.readouterr().err


def test_the_intel_log_is_scored_by_its_published_relations():
    try:
        hashes = contest_logs.hashes_of(["intel"])
    except sources.SourceError as error:
        pytest.skip(str(error))
    (log,) = contest_logs.open_logs(commitment.draw_contest(logs=hashes), [])
    assert (len(log), len(log.pairs)) == (910, 108)
    assert len(load_relations("intel-relations").poses) > len(log.pairs)
    at_rest = log.errors(np.zeros((len(log), 3)))
    np.testing.assert_allclose(at_rest, np.hypot(*log.relations[:, :2].T))


def test_a_film_and_a_map_of_a_log_need_no_truth_and_no_finite_pose(tmp_path):
    for noise in (0.1, np.nan):
        driven = estimate(noise)
        assert "Two tracks of a recorded log" in map_picture(arena(), driven)
        page = film_page(arena(), driven, "hall", tmp_path / "hall.film")
        assert "the true track" not in page


def test_who_runs_off_leaves_map_and_film_and_does_not_stretch_them():
    inside = prepare(world())
    for where in (arena(), inside):
        gone, usual = estimate(0.1), estimate(0.1)
        far = np.linspace([0, 0, 0], [3.0, 1e5, 0], len(world()))
        gone = replace(gone, online=far, trajectory=far, points=far[:, :2])
        box, usual_box = (
            map_picture(where, driven).split('viewBox="')[1].split('"')[0]
            for driven in (gone, usual)
        )
        assert box == usual_box
        for scene in pictures._scenes(where, gone):
            for layer in scene.layers:
                if isinstance(layer, Points | Poses):
                    rows = layer.xy if isinstance(layer, Points) else layer.rows
                    assert np.abs(rows[:, :2]).max(initial=0) < 200
