"""Outputs of notebooks do not depend on the last bit, or are compared approximately."""

import subprocess
import sys

import pytest

from course.perturbed_rounding import environment
from course.source import ROOT
from tests.course.notebooks.test_canary import ARGUMENTS


def test_perturbed_rounding_changes_the_last_bit_only():
    code = "import numpy as np; print(*np.sin(np.arange(0.5, 100.0)), np.cos(0.0), np.sin(0.0))"
    printed = [
        subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, check=True)
        for env in (None, environment(1), environment(2))
    ]
    here, *others = ([float(x) for x in each.stdout.split()] for each in printed)
    assert others[0] != others[1]
    for there in others:
        assert 5 < sum(a != b for a, b in zip(here, there, strict=True)) < 60
        assert there == pytest.approx(here, rel=3e-16)
        assert there[-2:] == [1, 0]


@pytest.mark.soak
@pytest.mark.parametrize("number", [1, 2, 3])
def test_every_notebook_passes_on_another_processor(number):
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *ARGUMENTS, "notebooks", "exercises", "solutions"],
        cwd=ROOT,
        env={**environment(number), "PYTHONHASHSEED": "0"},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout
