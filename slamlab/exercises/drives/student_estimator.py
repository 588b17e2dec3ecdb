"""A student's estimator, held at arm's length: what it answers is checked and turned into arrays.

It is a class with ``step(reading)`` and ``pose``; it may offer ``covariance``, ``trajectory()`` and
``map()``. Nothing here knows a truth, so it can run where the student's code runs.
"""

import numpy as np

from slamlab.exercises.drives import StudentError, describe, numbers, shaped

MAX_MAP_POINTS = 50_000
FAR = 1e6  # farther away there is no building: such a number counts as not finite [m, rad]
NO_POSE = "pose is None after step(reading): it has to be [x, y, theta], from the first reading on"
HALF_OF_P = "covariance is not symmetric: is a term of P missing on one side?"


class GraderFault(Exception):
    """What went wrong is no fault of the student's, and must not be told as one."""


class StudentEstimator:
    """One object of a student's class; each call answers arrays or raises StudentError.

    Parameters
    ----------
    make : callable, the class

    Raises
    ------
    StudentError : it cannot be made, or lacks ``step`` or ``pose``
    """

    def __init__(self, make):
        self._theirs = _called(make, "making the estimator")
        for name, what in (("step", "a method step(reading)"), ("pose", "a pose (x, y, theta)")):
            if not self._has(name):
                raise StudentError("missing", f"the estimator has no {name}: it needs {what}")

    @property
    def offers(self):
        """Whether it has a ``trajectory`` and a ``map``, two bool."""
        return self._has("trajectory"), self._has("map")

    def step(self, reading):
        """Hand it one reading.

        Parameters
        ----------
        reading : Reading

        Returns
        -------
        pose (3,), with NaN where it is not finite, and covariance (3, 3), NaN where none is claimed
        """
        _called(lambda: self._theirs.step(reading), "step")
        pose = _called(lambda: self._theirs.pose, "pose")
        if pose is None:
            raise StudentError("malformed", NO_POSE)
        pose = _near(_called(pose, "pose") if callable(pose) else pose, "its pose", (3,))
        claimed = _called(lambda: getattr(self._theirs, "covariance", None), "covariance")
        if callable(claimed):
            claimed = _called(claimed, "covariance")
        if claimed is None:
            return pose, np.full((3, 3), np.nan)
        P = _finite(claimed, "its covariance", (3, 3))
        if np.isfinite(P).all() and not np.allclose(P, P.T, rtol=1e-4, atol=1e-9):
            raise StudentError("malformed", HALF_OF_P)
        return pose, P

    def trajectory(self, count):
        """Ask for all poses as believed at the end.

        Parameters
        ----------
        count : int, readings so far

        Returns
        -------
        (count, 3), or None where it has no ``trajectory``
        """
        if not self.offers[0]:
            return None
        value = _called(self._theirs.trajectory, "trajectory")
        poses = getattr(value, "poses", value)  # a Trajectory of the package's will do, too
        return _near(poses, "trajectory()", (count, 3))

    def map(self):
        """Ask for its map: (n, 2) points, none where it has no ``map``."""
        if not self.offers[1]:
            return np.empty((0, 2))
        value = _called(self._theirs.map, "map")
        points = np.empty((0, 2)) if value is None else numbers(value, "map()")
        if points.size == 0:
            return np.empty((0, 2))
        if points.ndim != 2 or points.shape[1] != 2:
            raise StudentError("malformed", f"map() has shape {points.shape}, not (n, 2)")
        if len(points) > MAX_MAP_POINTS:
            raise StudentError(
                "malformed",
                f"map() has {len(points)} points, at most {MAX_MAP_POINTS} are allowed: keep one "
                "of those that fall into the same cell of a grid",
            )
        near = (np.abs(points) < FAR).all(axis=1)
        if not near.any():
            told = f"map(): none of the {len(points)} points is finite, so there is no map"
            raise StudentError("malformed", told)
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
        raise StudentError("raised", f"{what} failed with {describe(error)}") from None


def _near(value, name, shape):
    """An array of a shape, NaN for what is not finite or beyond any building."""
    array = shaped(value, name, shape)
    return np.where(np.abs(array) < FAR, array, np.nan)


def _finite(value, name, shape):
    """An array of a shape, NaN for what is not finite."""
    array = shaped(value, name, shape)
    return np.where(np.isfinite(array), array, np.nan)
