"""Recorded logs beside the hidden worlds: nobody knows the truth, but trusted relations judge.

A relation says where the robot was at one moment as seen from another (Kümmerle et al. 2009).
"""

from dataclasses import dataclass

import numpy as np

from slamlab.evaluation.relations import relation_residuals, usable_relations

MAX_LOG_READINGS = 1000  # of one log; it has a budget of its own


@dataclass(frozen=True)
class RecordedLog:
    """A recorded log to be driven through, reading by reading, like a hidden world.

    Parameters
    ----------
    name : str, in place of a family's
    readings : tuple of Reading
    pairs : (k, 2) int, the readings that each relation is of
    relations : (k, 3) the second pose seen from the first [m, m, rad]
    """

    name: str
    readings: tuple
    pairs: np.ndarray
    relations: np.ndarray

    truth = None

    def __len__(self):
        return len(self.readings)

    def __iter__(self):
        return iter(self.readings)

    def errors(self, poses):
        """Translational errors of the relations, δ* ⊖ (x_j ⊖ x_i).

        Parameters
        ----------
        poses : (n, 3) [m, m, rad]

        Returns
        -------
        (k,) [m]; NaN where a pose is
        """
        with np.errstate(invalid="ignore"):
            error = relation_residuals(poses, self.pairs, self.relations)
        return np.hypot(error[:, 0], error[:, 1])


def recorded_log(name, readings, relations):
    """Put a log and its relations together.

    Parameters
    ----------
    name : str
    readings : iterable of Reading
    relations : Relations

    Returns
    -------
    RecordedLog

    Raises
    ------
    ValueError : too many readings, or no relation that belongs to them
    """
    readings = tuple(readings)
    if not 0 < len(readings) <= MAX_LOG_READINGS:
        raise ValueError(
            f"the log {name} has {len(readings)} readings, and a contest drives from 1 to "
            f"{MAX_LOG_READINGS}: cut it into several"
        )
    times = np.array([reading.time for reading in readings])
    pairs, wanted = usable_relations(times, relations, what=f"a reading of {name}")
    return RecordedLog(name, readings, pairs, wanted)
