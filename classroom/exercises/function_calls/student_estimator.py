"""Wrapper of a student's estimator that checks the results and converts them to arrays.

The estimator must have ``step(reading)`` and ``pose``; ``covariance``, ``trajectory()`` and
``map()`` are optional."""

import numpy as np

from classroom.exercises.function_calls import (
    StudentError,
    describe_exception,
    to_array,
    to_shaped_array,
)

MAX_MAP_POINTS = 50_000
FAR = 1e6  # larger than any building: a larger number counts as not finite [m, rad]
NO_POSE = "pose is None after step(reading): it must be [x, y, theta], from the first reading on"
HALF_OF_P = "covariance is not symmetric: is a term of P missing on one side?"


class GraderFault(Exception):
    """An error of the grader; the student is not blamed for it."""


class StudentEstimator:
    """An object of a student's class; each call returns arrays or raises StudentError."""

    def __init__(self, make):
        self._theirs = _called(make, "creating the estimator")
        for name, what in (("step", "a method step(reading)"), ("pose", "a pose (x, y, theta)")):
            if not self._has(name):
                raise StudentError("missing", f"the estimator has no {name}: it needs {what}")

    @property
    def offers(self):
        """Whether the estimator has ``trajectory`` and ``map``, two bool."""
        return self._has("trajectory"), self._has("map")

    def step(self, reading):
        """Process a reading; return pose (3,) and covariance (3, 3), NaN where not finite."""
        _called(lambda: self._theirs.step(reading), "step")
        pose = _called(lambda: self._theirs.pose, "pose")
        if pose is None:
            raise StudentError("malformed", NO_POSE)
        pose = _near(_called(pose, "pose") if callable(pose) else pose, "its pose", (3,))
        covariance = _called(lambda: getattr(self._theirs, "covariance", None), "covariance")
        if callable(covariance):
            covariance = _called(covariance, "covariance")
        if covariance is None:
            return pose, np.full((3, 3), np.nan)
        P = _finite(covariance, "its covariance", (3, 3))
        if np.isfinite(P).all() and not np.allclose(P, P.T, rtol=1e-4, atol=1e-9):
            raise StudentError("malformed", HALF_OF_P)
        return pose, P

    def trajectory(self, count):
        """Return all poses as estimated at the end, (count, 3), or None without ``trajectory``."""
        if not self.offers[0]:
            return None
        value = _called(self._theirs.trajectory, "trajectory")
        poses = getattr(value, "poses", value)  # a Trajectory of the library is accepted, too
        return _near(poses, "trajectory()", (count, 3))

    def map(self):
        if not self.offers[1]:
            return np.empty((0, 2))
        value = _called(self._theirs.map, "map")
        points = np.empty((0, 2)) if value is None else to_array(value, "map()")
        if points.size == 0:
            return np.empty((0, 2))
        if points.ndim != 2 or points.shape[1] != 2:
            raise StudentError("malformed", f"map() has shape {points.shape}, not (n, 2)")
        if len(points) > MAX_MAP_POINTS:
            raise StudentError(
                "malformed",
                f"map() has {len(points)} points, but at most {MAX_MAP_POINTS} are allowed: keep "
                "one point per cell of a grid",
            )
        near = (np.abs(points) < FAR).all(axis=1)
        if not near.any():
            message = f"map(): none of the {len(points)} points is finite, so there is no map"
            raise StudentError("malformed", message)
        return points[near]

    def _has(self, name):
        return _called(lambda: hasattr(self._theirs, name), name)


def _called(function, what):
    try:
        return function()
    except NotImplementedError:
        raise StudentError("not attempted", f"{what}: not attempted yet") from None
    except (StudentError, GraderFault):
        raise
    except Exception as error:
        raise StudentError("raised", f"{what} failed with {describe_exception(error)}") from None


def _near(value, name, shape):
    """Convert to an array, with NaN for numbers larger than any building."""
    array = to_shaped_array(value, name, shape)
    return np.where(np.abs(array) < FAR, array, np.nan)


def _finite(value, name, shape):
    array = to_shaped_array(value, name, shape)
    return np.where(np.isfinite(array), array, np.nan)
