"""The study of boxes: it counts what it should, its command writes, its stored table says zero."""

import json

import numpy as np
import pytest

from slamlab.filters.bor import BOR
from slamlab.studies.boxes import TABLE, BoundedNoise, BoundedRun, main, outside, study, violations


def test_whatever_of_the_truth_lies_outside_is_named():
    bor = BOR((0, 1, 0, 1), (3.0, 3.5), {0: (0, 1, 0, 1), 1: (5, 6, 5, 6)})
    truth = np.array([[0.5, 0.5], [5.5, 5.5]])
    assert outside(bor, (0.5, 0.5, -3.0), truth) == []
    assert outside(bor, (1.5, 0.5, 0.0), [np.add(t, [0, 1]) for t in truth]) == [
        "robot",
        "heading",
        0,
        1,
    ]


@pytest.mark.parametrize("at_ends", [True, False])
@pytest.mark.parametrize("drive", ["odometry", "wheels", "steered"])
def test_noise_stays_inside_its_bounds_and_reaches_them_where_it_should(drive, at_ends):
    world = BoundedNoise(drive=drive, seeing=(0.2, 0.1), at_ends=at_ends, share=1)
    run, off = BoundedRun(world, np.random.default_rng(0)), []
    for _, seen in run:
        d = run.objects - run.pose[:2]
        off += [r - np.hypot(*d[i]) for i, (r, _) in seen]
    off = np.abs(off)
    assert 0.19 < off.max() < 0.2 + 1e-9
    assert (off > 0.2 - 1e-9).all() == at_ends


def test_bounds_that_are_told_too_narrow_are_counted_as_outside_or_empty():
    class Liar(BoundedRun):
        def _noise(self, *bounds, rows=None):
            return 3 * super()._noise(*bounds, rows=rows)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("slamlab.studies.boxes.BoundedRun", Liar)
        found = violations(0, BoundedNoise(at_ends=True))
    assert found["outside"] > 100
    assert found["empty"] > 0


def test_the_same_seeds_give_the_same_table():
    first, second = (study(3, BoundedNoise(), jobs=1) for _ in range(2))
    assert first == second
    assert first["counted"]["steps"] == 600


def test_the_command_writes_its_words_seeds_and_versions(tmp_path, capsys):
    out = tmp_path / "table.json"
    assert main(["--runs", "2", "--jobs", "1", "--out", str(out)]) == 0
    table = json.loads(out.read_text())
    assert json.loads(capsys.readouterr().out) == table
    assert table["seeds"] == [0, 1]
    assert {"python", "slamlab", "numpy"} <= set(table["versions"])


def test_no_runs_at_all_are_refused_in_one_line(tmp_path, capsys):
    assert main(["--runs", "0", "--out", str(tmp_path / "t.json")]) == 2
    assert "--runs is at least 1" in capsys.readouterr().err


def test_the_stored_table_is_of_a_million_steps_and_none_of_them_is_outside():
    found = json.loads(TABLE.read_text())["counted"]
    assert found["steps"] >= 1_000_000
    assert min(found["sightings"], found["wide"], found["whole"]) > 100_000
    assert found["outside"] == found["empty"] == 0
