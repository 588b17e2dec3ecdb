"""Particle-filter SLAM as estimators: the thesis' sample sets, and FastSLAM."""

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.estimators.landmark_observations import (
    DataAssociation,
    observed_landmarks,
    require_landmarks,
)
from slamlab.filters.montecarlo.fastslam import FastSLAM
from slamlab.filters.montecarlo.particle_association import associate
from slamlab.filters.montecarlo.sample_sets import SampleSets
from slamlab.layers import Ellipses, Points, Poses, Samples


class ParticleSlam(Estimator):
    """Particle-filter SLAM with point landmarks: those the source names, else corners of scans.

    Data association without names gates by the particles' own spread; an ambiguous observation, of
    a known landmark or a new one, is ignored and counted.

    Parameters
    ----------
    filter : SampleSets or FastSLAM
    robot : RobotModel, how wrong the odometry is
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC
    """

    def __init__(self, filter, robot, sensor, rng):
        super().__init__()
        self.filter, self.robot, self.sensor, self.rng = filter, robot, sensor, rng
        self.association = DataAssociation()

    @property
    def ambiguous(self):
        """int, ambiguous observations that were ignored, see :class:`DataAssociation`."""
        return self.association.ambiguous

    def step(self, reading):
        """Process a reading: move the particles, weight them by landmarks, resample, add new ones.

        Parameters
        ----------
        reading : Reading
        """
        self.filter.predict(reading.odometry, self.robot)
        found = observed_landmarks(reading, self.sensor, self.rng)
        if len(found.z):
            self._correct(found)
        self.pose = self.filter.robot.moments.x
        self.record(reading.time)
        self.status = f"{len(self.filter.ids)} landmarks, {self.ambiguous} ambiguous observations"

    def _correct(self, found):
        """Update by observations of known landmarks, add the new landmarks."""
        chosen = self.association.associate(found, self.filter.ids, self._associate)
        known = set(self.filter.ids)
        for correct_or_add, is_known in ((self.filter.update, True), (self.filter.add, False)):
            rows = {k: i for i, k in chosen.items() if (i in known) == is_known}
            if rows:
                correct_or_add(list(rows.values()), found.z[list(rows)], found.R[list(rows)])

    def _associate(self, z, R):
        return associate(z, R, self.filter.expected_scan())


class SampleSetSlam(ParticleSlam):
    """Sample-set SLAM, the thesis' algorithm 2: particles for the robot and for every landmark."""

    def step(self, reading):
        """Process a reading, see :class:`ParticleSlam`.

        Parameters
        ----------
        reading : Reading
        """
        super().step(reading)
        self.status += f", {len(self.filter.frozen)} frozen, {self.filter.depleted} sets depleted"

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


def montecarlo(source, seed=0, **options):
    """Make the thesis' sample-set SLAM for a source.

    Parameters
    ----------
    source : Source
    seed : int; the same seed gives the same run
    options : of :class:`SampleSets`

    Returns
    -------
    SampleSetSlam

    Raises
    ------
    ValueError : no reading holds landmarks or a scan
    """
    rng, other = _generators("montecarlo", source, seed)
    return SampleSetSlam(SampleSets(rng, **options), source.robot, source.sensor, other)


def fastslam(source, seed=0, **options):
    """Make FastSLAM for a source.

    Parameters
    ----------
    source : Source
    seed : int; the same seed gives the same run
    options : of :class:`FastSLAM`

    Returns
    -------
    FastSlam

    Raises
    ------
    ValueError : no reading holds landmarks or a scan
    """
    rng, other = _generators("fastslam", source, seed)
    return FastSlam(FastSLAM(rng, **options), source.robot, source.sensor, other)


def _generators(name, source, seed):
    """Random generators for the filter and for RANSAC; an error where nothing is observed."""
    require_landmarks(source, name)
    return np.random.default_rng(seed).spawn(2)
