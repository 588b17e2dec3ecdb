"""What the notebooks print does not hang on the processor's last bit, or is compared nearly."""

import os
import subprocess
import sys

import pytest

from course.source import ROOT
from tests.notebooks.test_canary import ARGUMENTS

OTHER = ROOT / "tests/other_processor"


def other_processor(number):
    """The environment of a Python whose numpy rounds as some other processor might."""
    path = os.pathsep.join([str(OTHER), str(ROOT), os.environ.get("PYTHONPATH", "")])
    own = {"PYTHONPATH": path, "OTHER_PROCESSOR": str(number), "OPENBLAS_CORETYPE": "Nehalem"}
    return {**os.environ, **own, "PYTHONHASHSEED": "0"}


def test_the_other_processor_rounds_otherwise_and_no_more():
    code = "import numpy as np; print(*np.sin(np.arange(0.5, 100.0)), np.cos(0.0), np.sin(0.0))"
    printed = [
        subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, check=True)
        for env in (None, other_processor(1), other_processor(2))
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
        env=other_processor(number),
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout
