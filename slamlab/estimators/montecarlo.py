"""SLAM by samples as estimators: the thesis' sets, and FastSLAM on the same readings."""

import numpy as np

from slamlab.estimators.base import Estimator
from slamlab.estimators.seen import Names, need_landmarks, seen
from slamlab.filters.montecarlo.association import pair
from slamlab.filters.montecarlo.fastslam import FastSLAM
from slamlab.filters.montecarlo.sets import SampleSets
from slamlab.layers import Ellipses, Points, Poses, Samples


class CloudSlam(Estimator):
    """A filter of samples on what a reading shows: landmarks with names, else corners.

    Sightings without a name are paired by the filter's own spread; what could be a known landmark
    or a new one is left out and counted.

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
        self.names = Names()

    @property
    def unclear(self):
        """int, sightings left out, see :class:`Names`."""
        return self.names.unclear

    def step(self, reading):
        """Take a reading in: move the samples, weigh them by landmarks, add the new ones.

        Parameters
        ----------
        reading : Reading
        """
        self.filter.predict(reading.odometry, self.robot)
        found = seen(reading, self.sensor, self.rng)
        if len(found.z):
            self._take(found)
        self.pose = self.filter.robot.moments.x
        self.record(reading.time)
        self.status = f"{len(self.filter.ids)} landmarks, {self.unclear} sightings unclear"

    def _take(self, found):
        """Correct by the known among the sightings, add the new ones."""
        names = self.names.of(found, self.filter.ids, self._pair)
        known = set(self.filter.ids)
        for take, is_known in ((self.filter.update, True), (self.filter.add, False)):
            rows = {k: i for i, k in names.items() if (i in known) == is_known}
            if rows:
                take(list(rows.values()), found.z[list(rows)], found.R[list(rows)])

    def _pair(self, z, R):
        return pair(z, R, self.filter.expected())


class SampleSlam(CloudSlam):
    """The thesis' algorithm 2: a set of samples for the robot and one for every object."""

    def step(self, reading):
        """Take a reading in, see :class:`CloudSlam`.

        Parameters
        ----------
        reading : Reading
        """
        super().step(reading)
        self.status += f", {len(self.filter.frozen)} frozen, {self.filter.starved} sets starved"

    def layers(self):
        """The objects' samples, those that are frozen as points, the track, the robot's samples."""
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


class FastSlam(CloudSlam):
    """FastSLAM: samples of the way, to each a little Kalman filter per landmark."""

    def layers(self):
        """Landmarks, their 95 % ellipses, the track, the robot's samples."""
        landmarks = self.filter.landmarks()
        return [
            Points("landmark", landmarks),
            Ellipses("landmark", landmarks, self.filter.covariances()),
            Poses("corrected", self.trajectory().poses),
            Samples("robot", self.filter.robot.rows, self.filter.robot.weights),
        ]


def montecarlo(source, seed=0, **options):
    """The thesis' sets for a source.

    Parameters
    ----------
    source : Source
    seed : int; the same seed gives the same run
    options : of :class:`SampleSets`

    Returns
    -------
    SampleSlam

    Raises
    ------
    ValueError : no reading holds landmarks or a scan
    """
    rng, other = _rngs("montecarlo", source, seed)
    return SampleSlam(SampleSets(rng, **options), source.robot, source.sensor, other)


def fastslam(source, seed=0, **options):
    """FastSLAM for a source.

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
    rng, other = _rngs("fastslam", source, seed)
    return FastSlam(FastSLAM(rng, **options), source.robot, source.sensor, other)


def _rngs(name, source, seed):
    """Generators for the filter and for RANSAC, or an error where there is nothing to see."""
    need_landmarks(source, name)
    return np.random.default_rng(seed).spawn(2)
