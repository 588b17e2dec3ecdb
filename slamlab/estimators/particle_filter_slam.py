"""Particle-filter SLAM as estimators: independent particle sets and FastSLAM."""

import numpy as np

from slamlab.estimators.base import Estimator, counted
from slamlab.estimators.corner_association import CornerAssociation
from slamlab.estimators.ekf_slam import predict
from slamlab.estimators.estimate_warnings import (
    little_better_than_odometry,
    mostly_ambiguous,
    single_landmark,
    uncertainty_wider_than_map,
)
from slamlab.estimators.landmark_observations import (
    DataAssociation,
    correct_or_add,
    require_landmarks_or_scans,
)
from slamlab.filters.ekf_slam_filter import MAK
from slamlab.filters.particle_filters.fastslam import FastSLAM
from slamlab.filters.particle_filters.independent_particle_sets import IndependentParticleSets
from slamlab.filters.particle_filters.particle_association import associate
from slamlab.layers import Ellipses, Particles, Points, Poses


class ParticleFilterSlam(Estimator):
    """Particle-filter SLAM with point landmarks: those of the source, or corners of its scans.

    Parameters
    ----------
    filter : IndependentParticleSets or FastSLAM
    robot : RobotModel
    sensor : SensorModel
    rng : numpy.random.Generator, for RANSAC
    association : str, see :class:`CornerAssociation`
    """

    def __init__(self, filter, robot, sensor, rng, association="ekf"):
        super().__init__()
        self.filter, self.robot, self.sensor = filter, robot, sensor
        self.corner_association = CornerAssociation(association, robot, sensor, rng)
        self.association = DataAssociation()
        self._odometry_only = MAK(np.zeros(3), np.zeros((3, 3)), capacity=0)
        self._steps, self._seen = 0, 0

    @property
    def ambiguous(self):
        return self.association.ambiguous + self.corner_association.ambiguous

    @property
    def warnings(self):
        P = self.filter.robot.moments.P
        return [
            *little_better_than_odometry(P, self._odometry_only, self._steps),
            *single_landmark(self.filter.landmarks(), self._steps),
            *uncertainty_wider_than_map(P, self.filter.landmarks(), self._steps),
            *mostly_ambiguous(self.ambiguous, self._seen + self.corner_association.ambiguous),
        ]

    def step(self, reading):
        """Move, weight and resample the particles, and initialise new landmarks."""
        reading = self.usable(reading)
        self.filter.predict(reading.odometry, self.robot)
        predict(self._odometry_only, reading, self.robot)
        self._steps += 1
        found = self.corner_association.observe(reading)
        if len(found.z):
            chosen = self.association.associate(found, self.filter.ids, self._associate)
            correct_or_add(self.filter, chosen, found)
        self._seen += len(found.z)
        self.pose = self.filter.robot.moments.x
        self.record(reading.time)
        self.status = self.status_line(*self._status_parts())

    def _status_parts(self):
        return counted(len(self.filter.ids), "landmark"), counted(
            self.ambiguous, "ambiguous observation"
        )

    def _associate(self, found):
        return associate(found.z, found.R, self.filter.expected_scan())


class IndependentParticleSlam(ParticleFilterSlam):
    """SLAM by independent particle sets (algorithm 2 of the MAK thesis): one set for the robot's
    pose, and one for each landmark."""

    def _status_parts(self):
        counts = f"{len(self.filter.frozen)} frozen", f"{self.filter.depleted} sets depleted"
        return *super()._status_parts(), *counts

    def layers(self):
        sets = self.filter.landmark_sets
        moving = [particles for i, particles in sets.items() if i not in self.filter.frozen]
        rows = np.concatenate([np.empty((0, 2)), *(particles.rows for particles in moving)])
        weights = np.concatenate(
            [np.empty(0), *(particles.weights / len(moving) for particles in moving)]
        )
        points = [sets[i].rows for i in self.filter.ids if i in self.filter.frozen]
        return [
            Particles("landmark", rows, weights),
            Points("landmark", np.concatenate([np.empty((0, 2)), *points])),
            Poses("corrected", self.trajectory().poses),
            Particles("robot", self.filter.robot.rows, self.filter.robot.weights),
        ]


class FastSlam(ParticleFilterSlam):
    """FastSLAM: particles of the trajectory, each with a small EKF for every landmark."""

    def layers(self):
        landmarks = self.filter.landmarks()
        return [
            Points("landmark", landmarks),
            Ellipses("landmark", landmarks, self.filter.covariances()),
            Poses("corrected", self.trajectory().poses),
            Particles("robot", self.filter.robot.rows, self.filter.robot.weights),
        ]


def montecarlo(source, seed=0, association="ekf", **options):
    """Return an IndependentParticleSlam; ``options`` of :class:`IndependentParticleSets`."""
    rng, other = _generators("montecarlo", source, seed)
    return IndependentParticleSlam(
        IndependentParticleSets(rng, **options), source.robot, source.sensor, other, association
    )


def fastslam(source, seed=0, association="ekf", **options):
    """Return a FastSlam; ``options`` of :class:`FastSLAM`."""
    rng, other = _generators("fastslam", source, seed)
    return FastSlam(FastSLAM(rng, **options), source.robot, source.sensor, other, association)


def _generators(name, source, seed):
    require_landmarks_or_scans(source, name)
    return np.random.default_rng(seed).spawn(2)
