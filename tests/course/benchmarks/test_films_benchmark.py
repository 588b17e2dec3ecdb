"""Films benchmark: it runs and reports its rows; times are not tested."""

import pytest

from benchmarks import common, films


def test_its_quick_run_compares_size_and_replay_with_what_it_promises(monkeypatch):
    monkeypatch.setattr(films, "RUNS", {"clouds": ("polygon", "icp", 800)})
    try:
        rows = films.run(quick=True)
    except common.Missing as reason:
        pytest.skip(str(reason))
    assert [(row["name"], row["reference"]) for row in rows] == [
        ("size: clouds", "the live view's frames"),
        ("size: clouds", "goal 800 kB"),
        ("replay: clouds", "goal 7 ms"),
    ]
    assert all(row["value"] > 0 and row["ratio"] > 0 for row in rows)
