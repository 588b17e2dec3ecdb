"""EKF-SLAM with walls as Smolec has it: the landmark is the foot of the wall's perpendicular.

The foot, from the world's origin, is computed through the estimated pose and given to the filter as
a pseudo-observation, as if its range and bearing had been measured. ``WallSlam`` mends that.
"""

from dataclasses import replace

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.estimators.landmark_observations import measurement_noise
from slamlab.estimators.mak_slam import predict
from slamlab.filters.mak import MAK
from slamlab.geometry import transform
from slamlab.landmarks.downsampling import DownsampledPoints
from slamlab.landmarks.ransac import THESIS, lines
from slamlab.layers import Ellipses, Points, Poses
from slamlab.models.observation import g_line, h

ASSOCIATION_DISTANCE = 0.5  # m, his LANDMARKOFFSET: a foot farther from every other is new
MIN_RANGE = 0.05  # m, a foot on which the robot stands has no bearing


class FootSlam(Estimator):
    """EKF-SLAM on feet of walls: nearest-neighbour association, tentative landmarks, lives.

    As in the thesis a landmark enters the state at its first sight and is used once confirmed, from
    its N-th on (his code: 5); a scan without it costs a life, at none it leaves the state. Of two
    observations of one in a scan the second is dropped. His lives and LANDMARKOFFSET stand in
    figures only; these are ours.

    Parameters
    ----------
    robot : RobotModel
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC
    ransac : Ransac
    sightings : int, observations that confirm a tentative landmark: from then on it is used
    lives : int, scans that a landmark survives unseen
    """

    def __init__(self, robot, sensor, rng, ransac=THESIS, sightings=5, lives=40):
        super().__init__()
        self.robot, self.sensor, self.rng, self.ransac = robot, sensor, rng, ransac
        self.sightings, self.lives = sightings, lives
        self.filter = MAK(np.zeros(3), np.zeros((3, 3)))
        self.observed: dict[int, int] = {}
        self.lives_left: dict[int, int] = {}
        self.points = DownsampledPoints()
        self._next = 0

    def step(self, reading):
        """Process a reading: predict, associate feet, correct, augment, remove the long unseen.

        Parameters
        ----------
        reading : Reading
        """
        predict(self.filter, reading, self.robot)
        if reading.scan is None or not reading.scan.valid.any():
            self.skipped += 1
        else:
            found = lines(reading.scan, self.sensor, self.rng, self.ransac)
            self._update(self._feet(found))
            self.points.add(transform(self.filter.pose, reading.scan.points()))
        self.pose = self.filter.pose
        self.record(reading.time)
        used = sum(count >= self.sightings for count in self.observed.values())
        self.status = f"{used} confirmed of {len(self.observed)} landmarks"

    def layers(self):
        """Points, the confirmed landmarks, the trajectory, the robot's 95 % covariance ellipse."""
        P_rr, _, _ = self.filter.blocks()
        used = [self.observed[i] >= self.sightings for i in self.filter.ids]
        return [
            Points("scan", self.points.xy),
            Points("landmark", self.filter.landmarks()[np.array(used, dtype=bool)]),
            Poses("corrected", self.trajectory().poses),
            Ellipses("robot", self.pose[None, :2], P_rr[None, :2, :2]),
        ]

    def _feet(self, found):
        """(k, 2) the walls' feet in the world, through the pose as it is believed [m]."""
        if not found:
            return np.empty((0, 2))
        rho, alpha = g_line(self.filter.pose, np.array([line.z for line in found])).T
        feet = np.column_stack([rho * np.cos(alpha), rho * np.sin(alpha)])
        return feet[np.hypot(*(feet - self.filter.pose[:2]).T) > MIN_RANGE]

    def _update(self, feet):
        """Associate feet with landmarks by nearest neighbour; correct, augment, prune."""
        paired, new = {}, []
        for foot in feet:
            off = np.hypot(*(self.filter.landmarks() - foot).T)
            if not len(off) or off.min() > ASSOCIATION_DISTANCE:
                new.append(foot)
            else:
                paired.setdefault(self.filter.ids[int(off.argmin())], foot)
        used = {}
        for i, foot in paired.items():
            self.observed[i] += 1
            if self.observed[i] >= self.sightings:
                used[i] = foot
        if used:
            self.filter.update(list(used), *self._pseudo_observations(list(used.values())))
        for foot in new:
            i, self._next = self._next, self._next + 1
            self.filter.add([i], *self._pseudo_observations([foot]))
            self.observed[i], paired[i] = 1, foot
        self._prune(paired)

    def _pseudo_observations(self, feet):
        """Feet as pseudo-observations, as if they had been seen: z and R."""
        z = h(self.filter.pose, np.array(feet))
        inflated = replace(self.sensor, bearing_sigma=max(self.sensor.bearing_sigma, 0.01))
        return z, measurement_noise(inflated, z[:, 0])

    def _prune(self, paired):
        """Remove landmarks: one not observed loses a life; at none it leaves database, x and P."""
        for i in list(self.observed):
            self.lives_left[i] = self.lives if i in paired else self.lives_left[i] - 1
            if self.lives_left[i] <= 0:
                self.filter.remove([i])
                del self.observed[i], self.lives_left[i]
