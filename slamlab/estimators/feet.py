"""Smolec's EKF-SLAM as he has it: a wall is the foot of the perpendicular from the world's origin.

The foot is not seen, it is computed through the estimated pose, and then given to the filter as if
range and bearing to it had been measured. ``WallSlam`` is the same system mended.
"""

from dataclasses import replace

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.estimators.mak import predict
from slamlab.estimators.seen import R_of
from slamlab.filters.mak import MAK
from slamlab.geometry import transform
from slamlab.landmarks.ransac import THESIS, lines
from slamlab.landmarks.thinned import Thinned
from slamlab.layers import Ellipses, Points, Poses
from slamlab.models import g_line, h

OFFSET = 0.5  # m, LANDMARKOFFSET: a foot farther than this from every other is a new landmark
NEAREST = 0.05  # m, a foot on which the robot stands has no bearing


class FootSlam(Estimator):
    """Landmarks at the feet of walls, associated by distance, with sightings and lives.

    As in the thesis a landmark enters the state at its first sight and is used from its N-th on
    (his code: 5); a scan without it costs it a life, and at none it leaves the state. Of two
    sightings of one landmark in a scan the second is dropped. His lives and LANDMARKOFFSET stand
    in figures only; these are ours.

    Parameters
    ----------
    robot : RobotModel
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC
    ransac : Ransac
    sightings : int, before a landmark is used
    lives : int
    """

    def __init__(self, robot, sensor, rng, ransac=THESIS, sightings=5, lives=40):
        super().__init__()
        self.robot, self.sensor, self.rng, self.ransac = robot, sensor, rng, ransac
        self.sightings, self.lives = sightings, lives
        self.filter = MAK(np.zeros(3), np.zeros((3, 3)))
        self.seen: dict[int, int] = {}
        self.left: dict[int, int] = {}
        self.points = Thinned()
        self._next = 0

    def step(self, reading):
        """Take a reading in: predict, pair feet with landmarks, correct, add, let the unseen die.

        Parameters
        ----------
        reading : Reading
        """
        predict(self.filter, reading, self.robot)
        if reading.scan is None or not reading.scan.valid.any():
            self.skipped += 1
        else:
            found = lines(reading.scan, self.sensor, self.rng, self.ransac)
            self._take(self._feet(found))
            self.points.add(transform(self.filter.pose, reading.scan.points()))
        self.pose = self.filter.pose
        self.record(reading.time)
        used = sum(count >= self.sightings for count in self.seen.values())
        self.status = f"{used} landmarks in use of {len(self.seen)}"

    def layers(self):
        """Points, the landmarks in use, the track, the robot's 95 % ellipse."""
        P_rr, _, _ = self.filter.blocks()
        used = [self.seen[i] >= self.sightings for i in self.filter.ids]
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
        return feet[np.hypot(*(feet - self.filter.pose[:2]).T) > NEAREST]

    def _take(self, feet):
        paired, new = {}, []
        for foot in feet:
            off = np.hypot(*(self.filter.landmarks() - foot).T)
            if not len(off) or off.min() > OFFSET:
                new.append(foot)
            else:
                paired.setdefault(self.filter.ids[int(off.argmin())], foot)
        used = {}
        for i, foot in paired.items():
            self.seen[i] += 1
            if self.seen[i] >= self.sightings:
                used[i] = foot
        if used:
            self.filter.update(list(used), *self._measured(list(used.values())))
        for foot in new:
            i, self._next = self._next, self._next + 1
            self.filter.add([i], *self._measured([foot]))
            self.seen[i], paired[i] = 1, foot
        self._bury(paired)

    def _measured(self, feet):
        """Feet as if they had been seen: z and R."""
        z = h(self.filter.pose, np.array(feet))
        blunt = replace(self.sensor, bearing_sigma=max(self.sensor.bearing_sigma, 0.01))
        return z, R_of(blunt, z[:, 0])

    def _bury(self, paired):
        """Every landmark that was not seen loses a life; at none it leaves database, x and P."""
        for i in list(self.seen):
            self.left[i] = self.lives if i in paired else self.left[i] - 1
            if self.left[i] <= 0:
                self.filter.remove([i])
                del self.seen[i], self.left[i]
