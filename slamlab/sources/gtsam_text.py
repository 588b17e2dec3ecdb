"""Text format of GTSAM's examples (Victoria Park): odometry and landmark measurements of a graph.

``ODOMETRY i j dx dy dtheta`` and ``LANDMARK i j x y``, in the frame of pose i, each followed by the
upper triangle of its covariance, row by row [m, m, rad].
"""

from typing import NamedTuple

import numpy as np

from slamlab.files import InputFile, SourceError

SIZES = {b"ODOMETRY": 3, b"LANDMARK": 2}  # keyword: numbers of its measurement


class GraphMeasurement(NamedTuple):
    """Measurement of node j from pose i: z (3,) of a pose or (2,) of a landmark, and its
    covariance."""

    i: int
    j: int
    z: np.ndarray
    covariance: np.ndarray

    @property
    def of_landmark(self):
        return len(self.z) == 2


def load(path):
    """Load the measurements of a file, plain or compressed, as a list in the order of its lines.

    Empty lines and comments (#) are ignored. Raises SourceError with the number of the first bad
    line.
    """
    file, measurements = InputFile(path), []
    for number, line, _ in file.lines():
        words = line.partition(b"#")[0].split()
        if words:
            try:
                measurements.append(_measurement(words))
            except ValueError as error:
                raise SourceError(f"{path}, line {number}: {error}") from None
    if file.truncated or not measurements:
        what = "is truncated" if file.truncated else "contains no measurements"
        raise SourceError(f"{path} {what}. Expected are lines ODOMETRY and LANDMARK of GTSAM")
    return measurements


def _measurement(words):
    keyword, *fields = words
    size = SIZES.get(keyword)
    if size is None:
        name = keyword[:20].decode(errors="replace")
        raise ValueError(f"unknown keyword {name!r}; known are ODOMETRY and LANDMARK")
    count = 2 + size + size * (size + 1) // 2
    if len(fields) != count:
        raise ValueError(f"{keyword.decode()} needs {count} numbers, not {len(fields)}")
    i, j, values = int(fields[0]), int(fields[1]), np.array(fields[2:], dtype=float)
    if i == j or not np.isfinite(values).all():
        raise ValueError("the two ids must differ, and all numbers must be finite")
    covariance, upper = np.zeros((size, size)), np.triu_indices(size)
    covariance[upper] = covariance.T[upper] = values[size:]
    if np.linalg.eigvalsh(covariance)[0] <= 0:
        raise ValueError("the covariance is not positive definite")
    return GraphMeasurement(i, j, values[:size], covariance)
