"""Ray casting benchmark: it runs and reports its rows; times are not tested."""

import json
import subprocess
import sys
from itertools import groupby
from pathlib import Path

import numpy as np
import pytest

from benchmarks import common
from benchmarks.raycast import CASES, dense_numpy, python_loop, scene
from slamlab.files import SourceError
from slamlab.simulation.worlds.ray_casting import cast

ROOT = Path(__file__).parents[3]
KEYS = {"name", "value", "unit", "reference", "ratio"}


@pytest.mark.slow
def test_its_quick_run_prints_a_table_and_writes_its_rows(tmp_path):
    file = tmp_path / "rows.json"
    command = [sys.executable, "-m", "benchmarks.raycast", "--quick", "--json", str(file)]
    shown = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    rows = json.loads(file.read_text())
    assert "Ray casting" in shown.stdout
    assert len(rows) == 4 * len(CASES)
    for row in rows:
        assert set(row) == KEYS
        assert row["value"] > 0
        assert row["reference"] in ("Python loop", "dense NumPy")
    ratios = [row["ratio"] for row in rows if row["name"].endswith("Python loop")]
    assert ratios == [1.0] * len(CASES)


def test_the_three_methods_of_ray_casting_agree():
    position, directions, walls = scene(200, 30)
    ranges = python_loop(position, directions, walls)
    np.testing.assert_allclose(dense_numpy(position, directions, walls), ranges)
    np.testing.assert_allclose(cast(position, directions, walls), ranges)


def test_methods_take_turns_and_each_has_a_median():
    calls = []
    methods = {name: lambda name=name: calls.append(name) for name in "ab"}
    times = common.cpu_times(methods, quick=False, seconds=0.0)
    assert [name for name, _ in groupby(calls)] == ["a", "b"] * 3
    assert set(times) == {"a", "b"}
    assert min(times.values()) > 0


def test_speed_is_reported_as_a_ratio_to_the_first_method():
    rows = common.speed_rows("case", {"slow": 0.2, "fast": 0.05})
    assert rows[1] == {
        "name": "case: fast",
        "value": pytest.approx(50),
        "unit": "ms",
        "reference": "slow",
        "ratio": pytest.approx(4),
    }


def test_a_file_that_cannot_be_written_is_reported_in_one_line(tmp_path, capsys):
    code = common.main({"none": lambda quick: []}, "x", ["--json", str(tmp_path / "no" / "f")])
    assert code == 2
    assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.parametrize("error", [common.Missing, SourceError])
def test_a_benchmark_that_cannot_run_is_left_out_and_the_others_run(error, tmp_path, capsys):
    def lonely(quick):
        raise error("install the peer")

    file = tmp_path / "rows"
    both = {"fine": lambda quick: [common.row("a", 1.0, "ms", "b", 2.0)], "lonely": lonely}
    assert common.main(both, "x", ["--json", str(file)]) == 2
    assert "skipped: lonely: install the peer" in capsys.readouterr().err
    assert [row["name"] for row in json.loads(file.read_text())] == ["a"]


def test_rows_are_kept_if_a_later_benchmark_is_interrupted(tmp_path):
    def interrupted(quick):
        raise KeyboardInterrupt

    file = tmp_path / "rows"
    both = {"fine": lambda quick: [common.row("a", 1.0, "ms", "b", 2.0)], "long": interrupted}
    with pytest.raises(KeyboardInterrupt):
        common.main(both, "x", ["--json", str(file)])
    assert [row["name"] for row in json.loads(file.read_text())] == ["a"]
