"""EKF-SLAM with walls as Smolec has it: the landmark is the foot of the wall's perpendicular.

The foot, from the world's origin, is computed through the estimated pose and given to the filter as
a pseudo-observation, as if its range and bearing had been measured. ``WallSlam`` mends that.
"""

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.estimators.foot_formulas import R_feet, make_filter, predict
from slamlab.estimators.foot_mends import checked
from slamlab.estimators.mak_slam import predict as predict_by_odometry
from slamlab.estimators.sufficiency import (
    against_odometry,
    hardly_surer,
    mostly_unknown,
    wider_than_map,
)
from slamlab.estimators.wall_slam import ONLY_NEW
from slamlab.filters.mak import MAK
from slamlab.geometry import transform
from slamlab.landmarks.downsampling import DownsampledPoints
from slamlab.landmarks.line_fitting import total_least_squares
from slamlab.landmarks.ransac import THESIS, lines
from slamlab.landmarks.sampled_lines import ordinary_least_squares, sampled_lines
from slamlab.layers import Ellipses, Points, Poses, Segments
from slamlab.models.observation import g_line, h

ASSOCIATION_DISTANCE = 0.5  # m, his LANDMARKOFFSET: a foot farther from every other is new
SAMPLES = 40  # his RANSAC_SAMPLE: readings of a scan round which a wall is looked for
START = np.diag([0.01, 0.01, np.radians(1)]) ** 2  # P of a start in doubt
MIN_RANGE = 0.05  # m, a foot on which the robot stands has no bearing


class FootSlam(Estimator):
    """EKF-SLAM on feet of walls, as Smolec prints it; each of ``mends`` switches one mend on.

    A landmark enters the state at its first sight and is used once confirmed, from its N-th on (his
    code: 5); a scan without it costs a life, at none it leaves the state. Of two observations of
    one in a scan the second is dropped. See :mod:`slamlab.estimators.foot_mends` for what is
    printed, and what is not.

    Parameters
    ----------
    robot : RobotModel
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC
    ransac : Ransac; lines that grow need the mends "distinct-lines" and "orthogonal-fit"
    sightings : int, observations that confirm a tentative landmark: from then on it is used
    lives : int, scans that a landmark survives unseen
    offset : float, LANDMARKOFFSET: a foot farther from every landmark is a new one [m]
    samples : int, RANSAC_SAMPLE: readings round which a line is tried, unless "distinct-lines"
    c : float, of Q as printed: variance as a share of the squared step [1]
    mends : collection of names of MENDS; MENDS itself for all

    Raises
    ------
    ValueError : a mend that there is not; a number out of its range
    """

    def __init__(
        self,
        robot,
        sensor,
        rng,
        ransac=THESIS,
        sightings=5,
        lives=40,
        *,
        offset=ASSOCIATION_DISTANCE,
        samples=SAMPLES,
        c=0.01,
        mends=(),
    ):
        super().__init__()
        self.mends = checked(mends)
        _check(ransac, self.mends, sightings, lives, samples, offset, c)
        self.robot, self.sensor, self.rng, self.ransac = robot, sensor, rng, ransac
        self.sightings, self.lives, self.samples = sightings, lives, samples
        self.offset, self.c = offset, c
        start = np.zeros((3, 3)) if "exact-start" in self.mends else START
        self.filter = make_filter(self.mends, start)
        self._alone = MAK(np.zeros(3), np.zeros((3, 3)), capacity=0)
        self._steps = self._scans = 0
        self.observed: dict[int, int] = {}
        self.lives_left: dict[int, int] = {}
        self.points = DownsampledPoints()
        self._next = 0

    def step(self, reading):
        """Process a reading: feet, association, predict, correct, augment, remove the long unseen.

        Parameters
        ----------
        reading : Reading
        """
        reading = self.usable(reading)
        self._steps += 1
        predict_by_odometry(self._alone, reading, self.robot)
        seen = reading.scan is not None and reading.scan.valid.any()
        if "predict-first" in self.mends or not seen:
            self._predict(reading)
        if not seen:
            self.skipped += 1
        else:
            self._scans += 1
            paired, new = self._associate(self._feet(reading.scan))
            self.counts.update([ONLY_NEW] * bool(self.filter.ids and new and not paired))
            z = {i: h(self.filter.pose, foot) for i, foot in paired.items()}
            if "predict-first" not in self.mends:
                self._predict(reading)
            self._update(z)
            self._augment(new)
            self._prune({*paired, *self.filter.ids[len(self.filter.ids) - len(new) :]})
            self.points.add(transform(self.filter.pose, reading.scan.points()))
        self.pose = self.filter.pose
        self.record(reading.time)
        self.status = self.status_line(
            f"{len(self.feet())} confirmed of {len(self.observed)} landmarks"
        )

    def feet(self):
        """(k, 2) the confirmed landmarks, the feet in use [m]."""
        used = [self.observed[i] >= self.sightings for i in self.filter.ids]
        return self.filter.landmarks()[np.array(used, dtype=bool)]

    @property
    def warnings(self):
        """What it says where too little is seen again, or odometry is denied: list of sentences."""
        P = self.filter.block([0, 1])
        return [
            *hardly_surer(P, self._alone, self._steps),
            *against_odometry(self.pose, self._alone, self._steps),
            *wider_than_map(P, self.feet(), self._steps),
            *mostly_unknown(self.counts[ONLY_NEW], self._scans),
        ]

    def layers(self):
        """Points, confirmed feet and their perpendiculars from the origin, trajectory, ellipse."""
        P_rr, _, _ = self.filter.blocks()
        feet = self.feet()
        return [
            Points("scan", self.points.xy),
            Segments("perpendicular", np.hstack([np.zeros_like(feet), feet])),
            Points("landmark", feet),
            Poses("corrected", self.trajectory().poses),
            Ellipses("robot", self.pose[None, :2], P_rr[None, :2, :2]),
        ]

    def _predict(self, reading):
        predict(self.filter, reading.odometry, self.robot, self.c, self.mends)

    def _feet(self, scan):
        """(k, 2) the walls' feet in the world, through the pose as it is believed [m]."""
        found = self._lines(scan)
        if not len(found):
            return np.empty((0, 2))
        rho, alpha = np.transpose(found)
        feet = np.column_stack([rho * np.cos(alpha), rho * np.sin(alpha)])
        return feet[np.hypot(*(feet - self.filter.pose[:2]).T) > MIN_RANGE]

    def _lines(self, scan):
        """The walls' lines in the world, (ρ, α) each."""
        pose, orthogonal = self.filter.pose, "orthogonal-fit" in self.mends
        fit = total_least_squares if orthogonal else ordinary_least_squares
        if "distinct-lines" not in self.mends:
            points = transform(pose, scan.points())
            return sampled_lines(points, self.rng, self.ransac, self.samples, fit)
        found = lines(scan, self.sensor, self.rng, self.ransac)
        if orthogonal:
            return [g_line(pose, line.z) for line in found]
        points, beams = transform(pose, scan.points()), np.flatnonzero(scan.valid)
        return [fit(points[np.isin(beams, line.beams)]) for line in found]

    def _associate(self, feet):
        """Associate feet with landmarks: a foot each, the first that came; and the new feet."""
        paired, new = {}, []
        for foot in feet:
            off = np.hypot(*(self.filter.landmarks() - foot).T)
            within = np.flatnonzero(off <= self.offset)
            if not len(within):
                new.append(foot)
            else:
                k = off.argmin() if "nearest" in self.mends else within[0]
                paired.setdefault(self.filter.ids[int(k)], foot)
        return paired, new

    def _update(self, z):
        """Count the observations of landmarks; correct by the confirmed ones."""
        for i in z:
            self.observed[i] += 1
        used = {i: seen for i, seen in z.items() if self.observed[i] >= self.sightings}
        together = [list(used)] if "joint-update" in self.mends else [[i] for i in used]
        for ids in together if used else []:
            rows = np.array([used[i] for i in ids])
            self.filter.update(ids, rows, R_feet(self.sensor, rows[:, 0], self.mends))

    def _augment(self, new):
        """Add new feet to the state, one after the other."""
        for foot in new:
            i, self._next = self._next, self._next + 1
            z = h(self.filter.pose, foot)[None]
            self.filter.add([i], z, R_feet(self.sensor, z[:, 0], self.mends))
            self.observed[i] = 1

    def _prune(self, sighted):
        """Remove landmarks: one not observed loses a life; at none it leaves database, x and P."""
        for i in list(self.observed):
            self.lives_left[i] = self.lives if i in sighted else self.lives_left[i] - 1
            if self.lives_left[i] <= 0:
                self.filter.remove([i])
                del self.observed[i], self.lives_left[i]


def _check(ransac, mends, sightings, lives, samples, offset, c):
    """Raise ValueError for what the listing cannot run with."""
    counts = {"sightings": sightings, "lives": lives, "samples": samples}
    for name, count in counts.items():
        if count < 1:
            raise ValueError(f"{name} is at least 1, not {count}")
    if not offset > 0 or not c > 0:
        raise ValueError(f"offset and c are above zero, not {offset} and {c}")
    if not mends >= {"distinct-lines", "orthogonal-fit"} and (ransac.grow or ransac.band is None):
        raise ValueError(
            "lines that grow, or a band of the noise's own, need the mends 'distinct-lines' and "
            "'orthogonal-fit'; or use THESIS"
        )
