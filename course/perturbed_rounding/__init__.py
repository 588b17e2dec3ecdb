"""Simulation of other processors: ``environment(2)`` starts a Python with another rounding."""

import os
from pathlib import Path

from course.source import ROOT


def environment(number=1):
    """Return environment variables for a Python whose numpy rounds like another processor.

    Parameters
    ----------
    number : int, which processor

    Returns
    -------
    dict
    """
    here = str(Path(__file__).parent)  # of sitecustomize, which Python imports as it starts
    path = os.pathsep.join([here, str(ROOT), os.environ.get("PYTHONPATH", "")])
    own = {"PYTHONPATH": path, "OTHER_PROCESSOR": str(number), "OPENBLAS_CORETYPE": "Nehalem"}
    return {**os.environ, **own}
