"""The worker's side of a hidden world: messages create the estimator and pass readings to it.

The worker contains only the readings that it has received."""

import numpy as np

from classroom.exercises.function_calls import FunctionCall, StudentError
from classroom.exercises.function_calls.student_estimator import StudentEstimator
from slamlab.readings import Observations, Reading, Scan

NAME = "MySlam"
"""Name of the class that a student writes."""
STEP_SECONDS, END_SECONDS = 10.0, 20.0  # wall clock, in case it hangs without using the CPU [s]


def arrays_of(reading):
    """Convert a reading to arrays by name, to send it through the pipe."""
    arrays = {"time": np.array(reading.time), "odometry": reading.odometry}
    if reading.scan is not None:
        scan = reading.scan
        limits = np.array([scan.range_max, scan.range_min])
        arrays |= {"angles": scan.angles, "ranges": scan.ranges, "limits": limits}
    if reading.observations is not None:
        arrays |= {"z": reading.observations.z, "ids": reading.observations.ids}
    return arrays


def reading_of(arrays):
    scan = observations = None
    if "ranges" in arrays:
        scan = Scan(arrays["angles"], arrays["ranges"], *map(float, arrays["limits"]))
    if "z" in arrays:
        observations = Observations(arrays["z"], arrays["ids"])
    return Reading(float(arrays["time"]), arrays["odometry"], scan, observations)


class Session:
    """The state that the worker keeps between messages: the estimator."""

    def __init__(self):
        self._estimator = None

    def begin(self, functions, inputs):
        """Create an estimator, and return whether it offers ``trajectory()`` and ``map()``."""
        self._estimator = None  # so that an old one is not used if the creation fails
        self._estimator = StudentEstimator(functions[NAME])
        return {"offers": np.array(self._estimator.offers)}

    def step(self, functions, inputs):
        pose, covariance = self._made().step(reading_of(inputs))
        return {"pose": pose, "covariance": covariance}

    def trajectory(self, functions, inputs):
        return {"trajectory": self._made().trajectory(int(inputs["count"]))}

    def map(self, functions, inputs):
        return {"points": self._made().map()}

    def _made(self):
        if self._estimator is None:
            raise StudentError("died", "the process of the estimator has ended")
        return self._estimator


def function_calls():
    session = Session()
    return {
        "begin": FunctionCall((NAME,), session.begin, STEP_SECONDS),
        "step": FunctionCall((NAME,), session.step, STEP_SECONDS),
        "trajectory": FunctionCall((NAME,), session.trajectory, END_SECONDS),
        "map": FunctionCall((NAME,), session.map, END_SECONDS),
    }


CALLS = function_calls()
