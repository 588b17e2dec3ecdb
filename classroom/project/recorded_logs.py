"""Recorded logs in addition to the hidden worlds, judged by known relative poses (relations).

A relation is the pose of the robot at one time relative to another (Kümmerle et al. 2009)."""

from dataclasses import dataclass

import numpy as np

from slamlab.evaluation.relations import relation_residuals, usable_relations

MAX_LOG_READINGS = 1000  # of one log, which has its own budget


@dataclass(frozen=True)
class RecordedLog:
    """A recorded log on which estimators are run as on a hidden world."""

    name: str  # in place of the name of a family
    readings: tuple
    pairs: np.ndarray  # (k, 2) int, the two readings of each relation
    relations: np.ndarray  # (k, 3) the second pose relative to the first [m, m, rad]

    truth = None

    def __len__(self):
        return len(self.readings)

    def __iter__(self):
        return iter(self.readings)

    def errors(self, poses):
        """Compute translational errors of the relations, δ* ⊖ (x_j ⊖ x_i): (k,) [m], or NaN."""
        with np.errstate(invalid="ignore"):
            error = relation_residuals(poses, self.pairs, self.relations)
        return np.hypot(error[:, 0], error[:, 1])


def recorded_log(name, readings, relations):
    """Combine a log and its Relations. Raises ValueError."""
    readings = tuple(readings)
    if not 0 < len(readings) <= MAX_LOG_READINGS:
        raise ValueError(
            f"the log {name} has {len(readings)} readings, but a contest accepts 1 to "
            f"{MAX_LOG_READINGS} per log: split the log"
        )
    times = np.array([reading.time for reading in readings])
    pairs, wanted = usable_relations(times, relations, what=f"a reading of {name}")
    return RecordedLog(name, readings, pairs, wanted)
