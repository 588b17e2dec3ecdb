"""The consistency study: its ideal filter, its table, its command, what the stored tables say."""

import json
from dataclasses import asdict

import numpy as np
import pytest

from slamlab.evaluation import band
from slamlab.filters.mak import MAK
from slamlab.geometry import compose
from slamlab.simulation.differential_drive import DifferentialDrive
from slamlab.sources import simulation
from slamlab.sources.landmark_runs import LandmarkRun, Loop
from slamlab.studies import walls
from slamlab.studies.consistency import FILTERS, TABLE, main, study
from slamlab.studies.ideal_filter import IdealFilter

SHORT = Loop(steps=25, landmarks=8)
STORED = sorted(TABLE.parent.glob("consistency*.json"))


def test_where_the_estimate_is_the_truth_the_ideal_filter_is_mak():
    quiet = Loop(steps=30, v_sigma=0, omega_sigma=0, range_sigma=0, bearing_sigma=0)
    source = LandmarkRun(quiet, np.random.default_rng(3))
    Q, R = np.diag([1e-3, 2e-3, 1e-4]), np.diag([0.01, 0.001])
    ideal, mak = IdealFilter(source.landmarks), MAK(np.zeros(3), np.zeros((3, 3)))
    for reading, true in zip(source, source.truth.poses, strict=True):
        ideal.predict(compose(ideal.x[:3], reading.odometry), Q, true)
        mak.predict(compose(mak.pose, reading.odometry), Q)
        ids, z = reading.observations.ids, reading.observations.z
        ideal.observe(ids, z, np.broadcast_to(R, (len(ids), 2, 2)))
        new = ~np.isin(ids, mak.ids)
        if not new.all():
            mak.update(ids[~new].tolist(), z[~new], R)
        if new.any():
            mak.add(ids[new].tolist(), z[new], R)
    assert ideal.ids == mak.ids
    np.testing.assert_allclose(ideal.x, mak.x, atol=1e-9)
    np.testing.assert_allclose(ideal.P, mak.P, atol=1e-9)


def test_the_same_seeds_give_the_same_table():
    first, second = (study(SHORT, 3, jobs=1) for _ in range(2))
    assert first == second
    assert set(first["filters"]) == set(FILTERS)


def test_the_command_writes_its_words_seeds_versions_and_scenario(tmp_path, capsys):
    out = tmp_path / "new" / "table.json"
    words = ["--runs", "3", "--jobs", "1", "--steps", "15", "--out", str(out)]
    assert main(words) == 0
    table = json.loads(out.read_text())
    assert json.loads(capsys.readouterr().out) == table
    assert table["command"].endswith("--steps 15 --out " + str(out))
    assert table["seeds"] == [0, 2]
    assert table["scenario"] == asdict(Loop(steps=15))
    assert {"python", "slamlab", "numpy"} <= set(table["versions"])


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--runs", "1"], "at least 3"),
        (["--v", "0"], "a loop needs"),
        (["--steps", "9"], "--steps"),
        (["--jobs", "0"], "at least 1"),
    ],
)
def test_wrong_use_is_refused_in_one_line(capsys, tmp_path, words, says):
    assert main([*words, "--out", str(tmp_path / "x")]) == 2
    said = capsys.readouterr().err
    assert says in said
    assert said.count("\n") == 1
    assert not (tmp_path / "x").exists()


@pytest.mark.parametrize("path", STORED, ids=lambda path: path.stem)
def test_a_stored_table_is_of_many_runs_and_first_estimates_come_near_the_ideal(path):
    table = json.loads(path.read_text())
    first, last = table["seeds"]
    runs = last - first + 1
    assert runs >= 50
    assert table["band_95"] == pytest.approx(band(3, runs))
    nees = {name: table["filters"][name]["nees"] for name in FILTERS}
    assert nees["first estimates"] == pytest.approx(nees["ideal"], rel=0.1)
    assert nees["standard"] > nees["ideal"]


def test_the_table_is_stored():
    assert TABLE in STORED


@pytest.mark.slow
def test_the_wall_study_drives_every_variant_through_both_situations(monkeypatch):
    monkeypatch.setattr(walls, "simulation", _brief)
    table = walls.study(3, jobs=1)
    assert list(table["situations"]) == list(walls.SITUATIONS)
    for rows in table["situations"].values():
        assert list(rows) == list(walls.VARIANTS)
        assert rows["true poses"]["final_m"] == 0 and "nees" not in rows["true poses"]
        assert rows["(ρ, α), first estimates"]["final_m"] < rows["odometry"]["final_m"]
        assert rows["true poses"]["map_m"] < 0.2


def _brief(name, rng):
    """The first metres of a situation: driven by hand, so that it is short."""
    source = simulation(name, rng, robot=DifferentialDrive(slip=0.05), tour=False)
    for _ in range(14):
        source.drive((0.2, 0.5))
    return source
