"""Consistency study: its ideal filter, and the stored tables."""

import json

import numpy as np
import pytest

from course.studies import wall_slam_variants
from course.studies.consistency import FILTERS, TABLE
from course.studies.ideal_ekf_slam import IdealEkfSlam
from slamlab.evaluation import band
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.geometry import compose
from slamlab.simulation.differential_drive import DifferentialDrive
from slamlab.sources import simulation
from slamlab.sources.landmark_runs import LandmarkRun, Loop

STORED = [TABLE, TABLE.with_stem("consistency-noisy")]


def test_where_the_estimate_is_the_truth_the_ideal_filter_is_mak():
    quiet = Loop(steps=30, v_sigma=0, omega_sigma=0, range_sigma=0, bearing_sigma=0)
    source = LandmarkRun(quiet, np.random.default_rng(3))
    Q, R = np.diag([1e-3, 2e-3, 1e-4]), np.diag([0.01, 0.001])
    ideal, mak = IdealEkfSlam(source.landmarks), MAK(np.zeros(3), np.zeros((3, 3)))
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


def brief(name, rng):
    """The first metres of a situation: driven by hand, so that it is short."""
    source = simulation(name, rng, robot=DifferentialDrive(slip=0.05), tour=False)
    for _ in range(14):
        source.drive((0.2, 0.5))
    return source


@pytest.mark.slow
def test_the_wall_study_runs_every_variant_in_both_situations(monkeypatch):
    monkeypatch.setattr(wall_slam_variants, "simulation", brief)
    table = wall_slam_variants.study(3, jobs=1)
    assert list(table["situations"]) == list(wall_slam_variants.SITUATIONS)
    for rows in table["situations"].values():
        assert list(rows) == list(wall_slam_variants.VARIANTS)
        assert rows["true poses"]["final_m"] == 0 and "nees" not in rows["true poses"]
        assert rows["(ρ, α), first estimates"]["final_m"] < rows["odometry"]["final_m"]
        assert rows["true poses"]["map_m"] < 0.2
