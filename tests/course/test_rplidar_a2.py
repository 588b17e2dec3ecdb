"""The simulated RPLIDAR A2 agrees with three recordings of a real one, by the same statistics.

The recordings are taken as they are, the simulated device stands in rooms of many sizes.
"""

from dataclasses import replace

import numpy as np
import pytest

from course.studies.rplidar_a2_noise import lost, repeats, spread
from slamlab import sources
from slamlab.simulation.range_scanners import RPLIDAR_A2
from slamlab.simulation.worlds import box
from slamlab.simulation.worlds.world import World

TURNS = 20
RANGES = [(2.0, 2.5), (2.5, 3.0), (3.0, 4.0), (6.0, 8.0), (10.0, 11.5), (11.5, 13.0)]  # m
INCIDENCES = [(0.0, 0.3), (0.3, 0.6), (0.6, 1.0), (1.0, 1.5)]  # tan of the angle of incidence
TOLERANCE = 0.2  # of σ; the median of 250 readings is good to a tenth


@pytest.fixture(scope="module")
def recorded(recording):
    """Scans of each recording, a turn each."""
    paths = [recording(f"rplidar-a2-{number}") for number in (1, 2, 3)]
    return [[reading.scan for reading in sources.open(path)] for path in paths]


@pytest.fixture(scope="module")
def real(recorded):
    """Rows of repeated readings of all recordings; none of them empty."""
    return came_back(np.vstack([repeats(turns) for turns in recorded]))


def came_back(rows):
    """Those rows whose reading was not empty."""
    return rows[np.isfinite(rows[:, 1])]


def simulated(beside, ahead):
    """Scans from the middle of a room, its walls at these distances [m]."""
    room, rng = World(box((0, 0), (2 * ahead, 2 * beside))), np.random.default_rng(11)
    far = replace(RPLIDAR_A2, range_max=20.0)  # the real one reports up to 15 m
    return [far.scan(room, np.zeros(3), rng) for _ in range(TURNS)]


@pytest.mark.parametrize(("low", "high"), RANGES)
def test_its_standard_deviation_at_every_range_is_that_of_the_real_one(real, low, high):
    rows = real[(low <= real[:, 0]) & (real[:, 0] < high) & (real[:, 2] < 0.5)]
    assert len(rows) > 200
    distance = np.median(rows[:, 0])
    ours = came_back(repeats(simulated(distance, distance)))
    ours = ours[ours[:, 2] < 0.5]
    assert spread(ours[:, 1]) == pytest.approx(spread(rows[:, 1]), rel=TOLERANCE)


@pytest.mark.parametrize(("low", "high"), INCIDENCES)
def test_its_standard_deviation_at_every_incidence_is_that_of_the_real_one(real, low, high):
    rows = real[(low <= real[:, 2]) & (real[:, 2] < high)]
    rows = rows[(rows[:, 0] > 2.5) & (rows[:, 0] < 4)]
    distance = np.median(rows[:, 0]) / np.hypot(1, (low + high) / 2)
    ours = came_back(repeats(simulated(distance, 9.0)))
    ours = ours[(ours[:, 0] > 2.5) & (ours[:, 0] < 4)]
    ours = ours[(low <= ours[:, 2]) & (ours[:, 2] < high)]
    assert spread(ours[:, 1]) == pytest.approx(spread(rows[:, 1]), rel=TOLERANCE)


def test_its_dropouts_lie_between_the_real_ones_lower_and_upper_bounds(recorded):
    at_most, surely = lost(recorded)
    assert surely < 0.8 * RPLIDAR_A2.dropouts
    assert RPLIDAR_A2.dropouts < at_most
    assert lost([simulated(3.0, 3.0)]) == pytest.approx([RPLIDAR_A2.dropouts] * 2, rel=0.3)


def test_it_has_as_many_beams_as_the_real_one_at_some_speed_of_its_motor(recorded):
    points = [len(scan.ranges) for turns in recorded for scan in turns]
    assert (min(points), max(points)) == (356, 539)
    assert min(points) < RPLIDAR_A2.beams < max(points)
