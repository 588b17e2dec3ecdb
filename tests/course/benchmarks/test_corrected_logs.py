"""The benchmark on corrected logs: corrupted odometry, and the estimators that correct it."""

import json

import numpy as np
import pytest

from benchmarks import corrected_logs
from slamlab import sources

BEAMS = np.linspace(-np.pi / 2, np.pi / 2, 181)


@pytest.fixture
def folder(tmp_path):
    """A folder with one corrected CARMEN log: a drive through the room, without noise."""
    room, lines = sources.simulation("room", np.random.default_rng(0)), []
    for k, (x, y, theta) in enumerate(room.truth.poses[:60]):
        ranges = np.nan_to_num(room.world.cast((x, y), theta + BEAMS), nan=80.0, posinf=80.0)
        numbers = [*ranges, *(x, y, theta) * 2]
        line = f"FLASER 181 {' '.join(f'{v:.4f}' for v in numbers)} {k}.0 robot {k}.0"
        lines.append(line)
    (tmp_path / "room-corrected.log").write_text("\n".join(lines) + "\n")
    return tmp_path


def test_every_estimator_is_measured_with_the_same_corrupted_odometry(folder, monkeypatch, capsys):
    monkeypatch.setattr(corrected_logs, "DISTANCE", 0.5)
    out = folder / "rows.json"
    messages = [str(folder), "--estimators", "odometry,graph", "--kinds", "gain,noise"]
    assert corrected_logs.main([*messages, "--json", str(out)]) == 0
    rows = json.loads(out.read_text())
    found = {(row["kind"], row["estimator"]): row for row in rows}
    assert len(rows) == len(found) == 4 == len(capsys.readouterr().out.splitlines())
    for kind in ("gain", "noise"):
        odometry, graph = found[kind, "odometry"], found[kind, "graph"]
        assert 0 < graph["over"] < odometry["over"] and 0 < graph["ape"] < odometry["ape"]


def test_true_wheels_have_no_error_and_a_moved_map_is_the_same_map(folder):
    _, readings, reference = corrected_logs.load(folder / "room-corrected.log")
    assert len(readings) == len(reference) == 60
    c, s = np.cos(0.7), np.sin(0.7)
    turned = reference @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + [3.0, -2.0, 0.7]
    assert corrected_logs.aligned_error(turned, reference) == pytest.approx(0, abs=1e-9)
    assert corrected_logs.error_over(0.5, turned, reference) == pytest.approx(0, abs=1e-9)
    assert corrected_logs.error_over(0.5, 1.1 * reference, reference) > 0.03
