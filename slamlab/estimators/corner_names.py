"""Names for the corners of scans: one EKF-SLAM tells every filter which corner is which.

Association asks how sure pose and map are of each other, so it is done where that is known: boxes
and sample sets keep no correlations, and are soon too wide or too sure to tell two corners apart.
"""

from dataclasses import replace

import numpy as np

from slamlab.estimators.landmark_observations import observed_landmarks
from slamlab.estimators.mak_slam import MakSlam

NAMERS = "mak", "own"  # who names corners: EKF-SLAM run beside the filter, or the filter itself


class CornerNames:
    """Landmark observations of readings, named: by the source, else by an EKF-SLAM run beside.

    A source names all of its landmarks or none. What EKF-SLAM finds ambiguous is left out.

    Parameters
    ----------
    namer : str, one of NAMERS; "own" leaves observations without names to the filter
    robot : RobotModel
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC

    Raises
    ------
    ValueError : an unknown namer
    """

    def __init__(self, namer, robot, sensor, rng):
        if namer not in NAMERS:
            raise ValueError(f"names is {' or '.join(NAMERS)}, not {namer!r}")
        self.sensor, self.rng = sensor, rng
        self._slam = MakSlam(robot, sensor, rng=rng) if namer == "mak" else None

    @property
    def ambiguous(self):
        """int, observations left out as ambiguous."""
        return 0 if self._slam is None else self._slam.association.ambiguous

    def observe(self, reading):
        """Landmark observations of the next reading.

        Parameters
        ----------
        reading : Reading

        Returns
        -------
        Observations, with R
        """
        ids = () if reading.observations is None else reading.observations.ids
        if self._slam is None or (len(ids) and min(ids) >= 0):
            return observed_landmarks(reading, self.sensor, self.rng)
        self._slam.step(reading)
        named = self._slam.named
        observations = self._slam.observations.subset(list(named.values()))
        # of EKF-SLAM's own ids, which are negative, 0 is the first
        return replace(observations, ids=np.array([-1 - i for i in named], dtype=int))
