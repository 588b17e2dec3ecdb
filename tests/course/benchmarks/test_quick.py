"""Every benchmark runs in its quickest form, and its table has the stated ratios.

Times are not tested: each method runs once, on the smallest sizes.
"""

import importlib
import pkgutil
import time

import numpy as np
import pytest

import benchmarks
from benchmarks import common
from benchmarks.__main__ import OF_A_FOLDER, SHARED

KEYS = {"name", "value", "unit", "reference", "ratio"}
# ports, sandboxes, a browser; a test of its own
ELSEWHERE = {"films", "grading", "live", "live_page", "project", "raycast", "soak"}

SMALL = {  # what is set to run in seconds, and what the rows must compare: (name, reference)
    "accuracy": (
        {"TOURS": ("room",)},
        {("room, 1 seeds: start to end", "20 mm"), ("room, 1 seeds: false loops", "")},
    ),
    "bor": (
        {"SIZES": (10, 30), "PREDICTIONS": 5, "SAMPLES": 200},
        {
            ("N = 10: slamlab", "MAK filter"),
            ("slamlab: N = 30 over N = 10", "constant"),
            ("wheels: width of the turn", "hull of sampled motions"),
        },
    ),
    "false_loops": (
        {"GRAPHS": ("CSAIL",)},
        {
            ("CSAIL, random false loops (sets: 1): solved: slamlab", "GTSAM's GNC"),
            ("CSAIL, locally grouped false loops (sets: 1): slamlab", "GTSAM's GNC"),
            ("CSAIL, grouped false loops (sets: 1): ambiguous of the solved", "2 %"),
        },
    ),
    "devices": (
        {},
        {
            ("SCAN: share of a core", "limit 1.0 %"),
            ("ultra: share of a core", "limit 3.0 %"),
            ("eMIR: share of a core", "limit 1.0 %"),
        },
    ),
    "growth": (
        {"LANDMARKS": (5, 10), "POSES": (30, 60), "LAPS": (1, 2), "FITTED": 2},
        {
            ("landmarks: a step of EKF-SLAM: 10", "10 landmarks"),
            ("poses: pose-graph optimisation: exponent", "linear"),
            ("scans: graph SLAM, the whole run: 231", "462 scans"),
        },
    ),
    "handheld_lidar": (
        {"WALKS": (("flat-3", "C1", 1.0, 3),)},
        {
            ("flat-3, C1, 1.0 m/s: graph", "0.5 %"),
            ("nine of ten: icp", "1.0 %"),
            ("median: graph", "icp"),
        },
    ),
    "icp": (
        {"BASINS": {"near": ((10,), (0.1,)), "far": ((90,), (0.5,))}},
        {
            ("a match: match", "thesis' ICP"),
            ("a match: match", "point to line"),
            ("a match: match, clouds preprocessed", "thesis' ICP"),
            ("parts of a match: fitting lines to both", "match"),
            ("position error: match", "thesis' ICP"),
            ("heading error: match", "thesis' ICP"),
            ("tight at 1 % noise: match", "all"),
            ("basin near: point to point", "all"),
            ("basin far: match", "all"),
            ("basin far: match, with search", "match"),
        },
    ),
    "lines": (
        {"PLACES": ("polygon",)},
        {
            ("polygon: found: slamlab", "thesis' parameters"),
            ("polygon: false: scikit-learn, line by line", "thesis' parameters"),
            ("a scan: slamlab", "scikit-learn, line by line"),
            ("a scan: slamlab", "period / 10"),
        },
    ),
    "mak": (
        {"SIZES": (20, 60), "GROWTH_FROM": 20, "REGION": 6, "REGION_STEPS": 3},
        {
            ("N = 20: slamlab", "np.copyto(P)"),
            ("N = 60: slamlab", "textbook dense EKF"),
            ("N = 60: slamlab", "filterpy EKF"),
            ("growth exponent, slamlab, N = 500…2000", "N²"),
        },
    ),
    "montecarlo": (
        {"SIZES": (50,)},
        {
            ("50 particles: slamlab", "plain Python loop"),
            ("50 particles: slamlab", "numpy + filterpy's resampling"),
            ("50 draws: slamlab multinomial", "filterpy multinomial"),
        },
    ),
    "pose_graphs": (
        {"GRAPHS": ("CSAIL",)},
        {
            ("CSAIL: χ², slamlab", "GTSAM"),
            ("CSAIL: reading: slamlab", "GTSAM"),
            ("CSAIL: optimising: slamlab", "GTSAM"),
        },
    ),
}


def once(methods, quick, seconds=0.0):
    """In place of ``common.cpu_times``: the time of one call of each."""
    times = {}
    for name, method in methods.items():
        begin = time.perf_counter()
        method()
        times[name] = time.perf_counter() - begin
    return times


def test_every_benchmark_of_the_folder_is_tried_here_or_elsewhere_and_can_be_imported():
    names = {module.name for module in pkgutil.iter_modules(benchmarks.__path__)}
    assert names - SHARED == ELSEWHERE | OF_A_FOLDER | SMALL.keys()
    for name in names - SHARED - OF_A_FOLDER:
        module = importlib.import_module(f"benchmarks.{name}")
        assert module.TITLE
        assert callable(module.run)


@pytest.mark.slow
@pytest.mark.parametrize("name", SMALL)
def test_its_quickest_run_gives_the_ratios_it_promises(name, monkeypatch):
    module = importlib.import_module(f"benchmarks.{name}")
    settings, promised = SMALL[name]
    for setting, value in settings.items():
        monkeypatch.setattr(module, setting, value)
    monkeypatch.setattr(module, "cpu_times", once, raising=False)
    try:
        rows = module.run(quick=True)
    except common.Missing as reason:
        pytest.skip(str(reason))
    assert promised <= {(row["name"], row["reference"]) for row in rows}
    for row in rows:
        assert set(row) == KEYS
        assert np.isfinite(row["value"])
        assert not np.isnan(row["ratio"])
        # where a thing is compared with itself the ratio is one
        if row["name"].endswith(f": {row['reference']}") and row["unit"] == "ms":
            assert row["ratio"] == 1
