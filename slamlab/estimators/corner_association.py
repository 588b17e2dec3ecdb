"""Data association of corners for another filter, by an EKF-SLAM that runs in parallel."""

from dataclasses import replace

import numpy as np

from slamlab.estimators.ekf_slam import EkfSlam
from slamlab.estimators.landmark_observations import observed_landmarks

ASSOCIATORS = "ekf", "own"  # what associates corners: a parallel EKF-SLAM, or the filter itself


class CornerAssociation:
    """Landmark observations with ids from the source or from a parallel EKF-SLAM ("ekf"), which
    leaves out ambiguous observations. With "own", corners get no ids, and the filter itself
    associates them. Raises ValueError for another associator."""

    def __init__(self, associator, robot, sensor, rng):
        if associator not in ASSOCIATORS:
            raise ValueError(f"association must be {' or '.join(ASSOCIATORS)}, not {associator!r}")
        self.sensor, self.rng = sensor, rng
        self._slam = EkfSlam(robot, sensor, rng=rng) if associator == "ekf" else None

    @property
    def ambiguous(self):
        return 0 if self._slam is None else self._slam.association.ambiguous

    def observe(self, reading):
        """Return the observations of the next reading, with their noise R."""
        ids = () if reading.observations is None else reading.observations.ids
        if self._slam is None or (len(ids) and min(ids) >= 0):
            return observed_landmarks(reading, self.sensor, self.rng)
        self._slam.step(reading)
        associated = self._slam.associated
        observations = self._slam.observations.subset(list(associated.values()))
        # EKF-SLAM's own ids are negative: −1 becomes 0
        return replace(observations, ids=np.array([-1 - i for i in associated], dtype=int))
