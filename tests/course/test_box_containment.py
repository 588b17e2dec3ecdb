"""Study of box containment: its counts, and its stored table without violations."""

import json

import numpy as np
import pytest

from course.studies.box_containment import (
    TABLE,
    BoundedNoise,
    BoundedRun,
    outside,
    violations,
)
from slamlab.filters.set_membership import BOR


def test_whatever_of_the_truth_lies_outside_is_named():
    bor = BOR((0, 1, 0, 1), (3.0, 3.5), {0: (0, 1, 0, 1), 1: (5, 6, 5, 6)})
    truth = np.array([[0.5, 0.5], [5.5, 5.5]])
    assert outside(bor, (0.5, 0.5, -3.0), truth) == []
    assert outside(bor, (1.5, 0.5, 0.0), np.add(truth, [0, 1])) == ["robot", "heading", 0, 1]


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


def test_bounds_that_are_declared_too_narrow_are_counted_as_outside_or_empty(monkeypatch):
    noise = BoundedRun._noise
    monkeypatch.setattr(BoundedRun, "_noise", lambda *words, **more: 3 * noise(*words, **more))
    found = violations(0, BoundedNoise(at_ends=True))
    assert found["outside"] > 100
    assert found["empty"] > 0


def test_the_stored_table_is_of_a_million_steps_and_none_of_them_is_outside():
    found = json.loads(TABLE.read_text())["counted"]
    assert found["steps"] >= 1_000_000
    assert min(found["observations"], found["wide"], found["whole"]) > 100_000
    assert found["outside"] == found["empty"] == 0
