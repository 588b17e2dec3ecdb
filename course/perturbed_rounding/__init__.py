"""Another processor, as far as Python can play one: ``environment(2)`` is that of its processes."""

import os
from pathlib import Path

from course.source import ROOT


def environment(number=1):
    """The environment of a Python whose numpy rounds as some other processor might.

    Parameters
    ----------
    number : int, which one

    Returns
    -------
    dict
    """
    here = str(Path(__file__).parent)  # of sitecustomize, which Python imports as it starts
    path = os.pathsep.join([here, str(ROOT), os.environ.get("PYTHONPATH", "")])
    own = {"PYTHONPATH": path, "OTHER_PROCESSOR": str(number), "OPENBLAS_CORETYPE": "Nehalem"}
    return {**os.environ, **own}
