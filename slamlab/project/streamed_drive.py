"""The worker's side of a hidden world: one message makes the estimator, one hands it a reading.

Between messages the worker holds the estimator and the readings that have been: none to come.
"""

import numpy as np

from slamlab.exercises.drives import Drive, StudentError
from slamlab.exercises.drives.student_estimator import StudentEstimator
from slamlab.project.reading_arrays import reading_of

NAME = "MySlam"
"""The class that a student writes."""
STEP_SECONDS, END_SECONDS = 10.0, 20.0  # wall clock, for what hangs without using the CPU [s]


class Session:
    """What stays between messages: the estimator, if it could be made."""

    def __init__(self):
        self._estimator = None

    def begin(self, functions, inputs):
        """Make an estimator; tell whether it offers ``trajectory()`` and ``map()``."""
        self._estimator = None  # so that one that cannot be made again is not driven on
        self._estimator = StudentEstimator(functions[NAME])
        return {"offers": np.array(self._estimator.offers)}

    def step(self, functions, inputs):
        """Hand it a reading."""
        pose, covariance = self._made().step(reading_of(inputs))
        return {"pose": pose, "covariance": covariance}

    def trajectory(self, functions, inputs):
        """Ask for all poses."""
        return {"trajectory": self._made().trajectory(int(inputs["count"]))}

    def map(self, functions, inputs):
        """Ask for the map."""
        return {"points": self._made().map()}

    def _made(self):
        if self._estimator is None:
            raise StudentError("died", "the process in which the estimator was has ended")
        return self._estimator


def drives():
    """The drives of a session: name to Drive."""
    session = Session()
    return {
        "begin": Drive((NAME,), session.begin, STEP_SECONDS),
        "step": Drive((NAME,), session.step, STEP_SECONDS),
        "trajectory": Drive((NAME,), session.trajectory, END_SECONDS),
        "map": Drive((NAME,), session.map, END_SECONDS),
    }


DRIVES = drives()
