"""Particle-filter SLAM as estimators: the thesis' sample sets, and FastSLAM."""

import numpy as np

from slamlab.estimators.base import Estimator, counted
from slamlab.estimators.corner_names import CornerNames
from slamlab.estimators.landmark_observations import DataAssociation, require_landmarks
from slamlab.estimators.mak_slam import predict
from slamlab.estimators.sufficiency import (
    hardly_surer,
    mostly_ambiguous,
    single_landmark,
    wider_than_map,
)
from slamlab.filters.mak import MAK
from slamlab.filters.montecarlo.fastslam import FastSLAM
from slamlab.filters.montecarlo.particle_association import associate
from slamlab.filters.montecarlo.sample_sets import SampleSets
from slamlab.layers import Ellipses, Points, Poses, Samples


class ParticleSlam(Estimator):
    """Particle-filter SLAM with point landmarks: those the source names, else corners of scans.

    Its own data association gates by the particles' spread; an ambiguous observation, of a known
    landmark or a new one, is ignored and counted.

    Parameters
    ----------
    filter : SampleSets or FastSLAM
    robot : RobotModel, how wrong the odometry is
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC
    names : str, who names corners, see :class:`CornerNames`
    """

    def __init__(self, filter, robot, sensor, rng, names="mak"):
        super().__init__()
        self.filter, self.robot, self.sensor = filter, robot, sensor
        self.names = CornerNames(names, robot, sensor, rng)
        self.association = DataAssociation()
        self._alone = MAK(np.zeros(3), np.zeros((3, 3)), capacity=0)
        self._steps, self._seen = 0, 0

    @property
    def ambiguous(self):
        """int, ambiguous observations that were ignored, see :class:`DataAssociation`."""
        return self.association.ambiguous + self.names.ambiguous

    @property
    def warnings(self):
        """What it says where its landmarks correct hardly anything: list of sentences."""
        P = self.filter.robot.moments.P
        return [
            *hardly_surer(P, self._alone, self._steps),
            *single_landmark(self.filter.landmarks(), self._steps),
            *wider_than_map(P, self.filter.landmarks(), self._steps),
            *mostly_ambiguous(self.ambiguous, self._seen + self.names.ambiguous),
        ]

    def step(self, reading):
        """Process a reading: move the particles, weight them by landmarks, resample, add new ones.

        Parameters
        ----------
        reading : Reading
        """
        reading = self.usable(reading)
        self.filter.predict(reading.odometry, self.robot)
        predict(self._alone, reading, self.robot)
        self._steps += 1
        found = self.names.observe(reading)
        if len(found.z):
            self._correct(found)
        self._seen += len(found.z)
        self.pose = self.filter.robot.moments.x
        self.record(reading.time)
        self.status = self.status_line(*self._status_parts())

    def _status_parts(self):
        return counted(len(self.filter.ids), "landmark"), counted(
            self.ambiguous, "ambiguous observation"
        )

    def _correct(self, found):
        """Update by observations of known landmarks, add the new landmarks."""
        chosen = self.association.associate(found, self.filter.ids, self._associate)
        known = set(self.filter.ids)
        for correct_or_add, is_known in ((self.filter.update, True), (self.filter.add, False)):
            rows = {k: i for i, k in chosen.items() if (i in known) == is_known}
            if rows:
                correct_or_add(list(rows.values()), found.z[list(rows)], found.R[list(rows)])

    def _associate(self, found):
        return associate(found.z, found.R, self.filter.expected_scan())


class SampleSetSlam(ParticleSlam):
    """Sample-set SLAM, the thesis' algorithm 2: particles for the robot and for every landmark."""

    def _status_parts(self):
        counts = f"{len(self.filter.frozen)} frozen", f"{self.filter.depleted} sets depleted"
        return *super()._status_parts(), *counts

    def layers(self):
        """Particles of landmarks (points where frozen), the trajectory, the robot's particles."""
        sets = self.filter.objects
        loose = [cloud for i, cloud in sets.items() if i not in self.filter.frozen]
        rows = np.concatenate([np.empty((0, 2)), *(cloud.rows for cloud in loose)])
        weights = np.concatenate([np.empty(0), *(cloud.weights / len(loose) for cloud in loose)])
        points = [sets[i].rows for i in self.filter.ids if i in self.filter.frozen]
        return [
            Samples("landmark", rows, weights),
            Points("landmark", np.concatenate([np.empty((0, 2)), *points])),
            Poses("corrected", self.trajectory().poses),
            Samples("robot", self.filter.robot.rows, self.filter.robot.weights),
        ]


class FastSlam(ParticleSlam):
    """FastSLAM: particles of the trajectory, each with a small EKF per landmark."""

    def layers(self):
        """Landmarks with 95 % covariance ellipses, the trajectory, the robot's particles."""
        landmarks = self.filter.landmarks()
        return [
            Points("landmark", landmarks),
            Ellipses("landmark", landmarks, self.filter.covariances()),
            Poses("corrected", self.trajectory().poses),
            Samples("robot", self.filter.robot.rows, self.filter.robot.weights),
        ]


def montecarlo(source, seed=0, names="mak", **options):
    """Make the thesis' sample-set SLAM for a source.

    Parameters
    ----------
    source : Source
    seed : int; the same seed gives the same run
    names : str, who names corners, see :class:`CornerNames`
    options : of :class:`SampleSets`

    Returns
    -------
    SampleSetSlam

    Raises
    ------
    ValueError : no reading holds landmarks or a scan
    """
    rng, other = _generators("montecarlo", source, seed)
    return SampleSetSlam(SampleSets(rng, **options), source.robot, source.sensor, other, names)


def fastslam(source, seed=0, names="mak", **options):
    """Make FastSLAM for a source.

    Parameters
    ----------
    source : Source
    seed : int; the same seed gives the same run
    names : str, who names corners, see :class:`CornerNames`
    options : of :class:`FastSLAM`

    Returns
    -------
    FastSlam

    Raises
    ------
    ValueError : no reading holds landmarks or a scan
    """
    rng, other = _generators("fastslam", source, seed)
    return FastSlam(FastSLAM(rng, **options), source.robot, source.sensor, other, names)


def _generators(name, source, seed):
    """Random generators for the filter and for RANSAC; an error where nothing is observed."""
    require_landmarks(source, name)
    return np.random.default_rng(seed).spawn(2)
