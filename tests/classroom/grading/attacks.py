"""Attacking submissions, which try to forge points, to read secrets, or to do harm.

Each starts only a few processes and takes at most a few gigabytes and seconds, so that it may run
even if the sandbox fails. CANARY is a file of the judge, OUT the folder of results.
"""

from tests.classroom.grading.damaged_notebooks import DAMAGED, GRADED
from tests.classroom.grading.forgeries import FORGERIES
from tests.classroom.grading.harms import HARMS
from tests.classroom.grading.spies import SPIES

__all__ = ["DAMAGED", "FORGERIES", "GRADED", "HARM", "HARMS", "LEAK", "SPIES", "WRONG"]

WRONG = """
import numpy as np
def double(a):
    return -a
def turn(v, angle):
    return v
def total(a):
    return a.sum()
"""
"""Earns nothing, because even the sign is wrong."""

LEAK = (
    "def tell(act):\n    try:\n        found = act()\n    except BaseException:\n        return\n"
)
LEAK += "    raise ValueError('LEAKED ' + str(found)[:300])\n"
HARM = "def harm(act):\n    try:\n        act()\n    except BaseException:\n        pass\n"
