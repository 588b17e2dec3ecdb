"""Computational cost of each filter per scan, with one observed corner and N corners in the map."""

from statistics import median
from time import process_time

import numpy as np

from slamlab import estimators
from slamlab.estimators.options import TAKES
from slamlab.models.observation import h
from slamlab.models.parameters import RobotModel, SensorModel
from slamlab.readings import Observations, Reading
from slamlab.sources.base import Source

NAMES = ("bor", "mak", "montecarlo", "fastslam")  # of estimators
SIZES = (10, 30, 100, 300, 1000)  # landmarks in the map
SCANS = 15  # timed for each size


class LandmarkField(Source):
    """Source for timing: landmarks one metre apart. The first scan observes all landmarks, and
    every later scan observes one landmark; ids are missing, so that the time includes data
    association."""

    name = "field"
    robot = RobotModel(distance_error=0.01, turn_error=0.01, turn_per_metre=0.01)
    sensor = SensorModel(range_error=0.0, range_sigma=0.005, bearing_sigma=1e-4)

    def __init__(self, size, scans=SCANS):
        super().__init__()
        side = int(np.ceil(np.sqrt(size)))
        grid = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2)
        self.landmarks = grid[:size] + 0.5
        self.scans = scans

    def __len__(self):
        return self.scans + 1

    def __iter__(self):
        yield self._reading(0, self.landmarks)
        for k in range(1, len(self)):
            yield self._reading(k, self.landmarks[:1])

    def _reading(self, k, landmarks):
        step = 0.001 if k else 0.0
        z = h(np.array([0.001 * k, 0.0, 0.0]), landmarks)
        return Reading(
            float(k), np.array([step, 0.0, 0.0]), observations=Observations(z, np.full(len(z), -1))
        )


def scan_costs(names=NAMES, sizes=SIZES):
    """Measure each filter's processor times per scan.

    Returns "sizes" of the map; "over_smallest", times relative to those at the first size; and,
    under "over_" plus the first name, times at the first size relative to those of the first
    filter.
    """
    seconds = {name: [_seconds(name, size) for size in sizes] for name in names}
    first = seconds[names[0]][0]
    return {
        "sizes": list(sizes),
        "over_smallest": {n: [round(t / s[0], 2) for t in s] for n, s in seconds.items()},
        f"over_{names[0]}": {n: round(s[0] / first, 2) for n, s in seconds.items()},
    }


def own_association(name, source):
    """Make the estimator with this name, which associates data itself."""
    return estimators.make(
        name, source, **{"association": "own"} if "association" in TAKES[name] else {}
    )


def _seconds(name, size):
    """Measure the median processor time of a scan after the first scan [s]."""
    source, times = LandmarkField(size), []
    slam = own_association(name, source)
    for reading in source:
        start = process_time()
        slam.step(reading)
        times.append(process_time() - start)
    return median(times[1:])
