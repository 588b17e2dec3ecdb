"""The simulated RPLIDAR A2 does what three recordings of a real one do, measured by the same means.

The recordings are taken as they are, the simulated device stands in rooms of many sizes.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from slamlab import sources
from slamlab.simulation.range_scanners import RPLIDAR_A2
from slamlab.worlds import box
from slamlab.worlds.world import World

TURNS = 20
RANGES = [(2.0, 2.5), (2.5, 3.0), (3.0, 4.0), (6.0, 8.0), (10.0, 11.5), (11.5, 13.0)]  # m
SLANTS = [(0.0, 0.3), (0.3, 0.6), (0.6, 1.0), (1.0, 1.5)]  # tan of the angle of incidence
TOLERANCE = 0.2  # of σ; the median of 250 readings is good to a tenth


@pytest.fixture(scope="module")
def recorded():
    """Scans of each recording, a turn each."""
    try:
        paths = [sources.recording(f"rplidar-a2-{number}") for number in (1, 2, 3)]
    except sources.SourceError as missing:
        pytest.skip(str(missing))
    return [[reading.scan for reading in sources.open(path)] for path in paths]


@pytest.fixture(scope="module")
def real(recorded):
    """Rows of ``errors`` of all recordings."""
    return np.vstack([errors(turns) for turns in recorded])


def simulated(beside, ahead):
    """Scans from the middle of a room, its walls at these distances [m]."""
    room, rng = World(box((0, 0), (2 * ahead, 2 * beside))), np.random.default_rng(11)
    far = replace(RPLIDAR_A2, range_max=20.0)  # the real one reports up to 15 m
    return [far.scan(room, np.zeros(3), rng) for _ in range(TURNS)]


def surfaces(scan, angles):
    """What a scan saw at these angles: ranges [m], NaN at edges and empties; tan of incidence."""
    order = np.argsort(scan.angles)
    known, ranges = scan.angles[order], scan.ranges[order]
    after = np.clip(np.searchsorted(known, angles), 1, len(known) - 1)
    width, jump = known[after] - known[after - 1], ranges[after] - ranges[after - 1]
    tau = (angles - known[after - 1]) / width
    between = ranges[after - 1] + tau * jump
    with np.errstate(invalid="ignore"):
        rough = ~(abs(jump) < 0.05 * between) | (abs(tau - 0.5) > 0.5)
    between[rough] = np.nan
    return between, abs(jump) / width / between, np.sqrt(1 + tau**2 + (1 - tau) ** 2)


def errors(turns):
    """Rows of range [m], error as a share of it and tan of incidence, against the turn before."""
    rows = []
    for before, scan in pairwise(turns):
        expected, slant, readings = surfaces(before, scan.angles)
        error = (scan.ranges - expected) / expected / readings
        rows.append(np.column_stack([expected, error, slant])[np.isfinite(error)])
    return np.vstack(rows)


def spread(shares):
    """Standard deviation told by the median: people and edges do not move it."""
    return 1.4826 * np.median(abs(shares))


def lost(turns):
    """Shares of empty readings where the turn before saw a surface, and where the next did, too."""
    rows = []
    for before, scan, after in zip(turns, turns[1:], turns[2:], strict=False):
        one, other = surfaces(before, scan.angles)[0], surfaces(after, scan.angles)[0]
        with np.errstate(invalid="ignore"):
            agreed = abs(one - other) < 0.05 * one
        rows.append(np.column_stack([np.isnan(scan.ranges), np.isfinite(one), agreed]))
    empty, before, around = np.vstack(rows).T
    return empty[before == 1].mean(), empty[around == 1].mean()


@pytest.mark.parametrize(("low", "high"), RANGES)
def test_its_spread_at_every_range_is_that_of_the_real_one(real, low, high):
    rows = real[(low <= real[:, 0]) & (real[:, 0] < high) & (real[:, 2] < 0.5)]
    assert len(rows) > 200
    distance = np.median(rows[:, 0])
    ours = errors(simulated(distance, distance))
    ours = ours[ours[:, 2] < 0.5]
    assert spread(ours[:, 1]) == pytest.approx(spread(rows[:, 1]), rel=TOLERANCE)


@pytest.mark.parametrize(("low", "high"), SLANTS)
def test_its_spread_at_every_slant_is_that_of_the_real_one(real, low, high):
    rows = real[(low <= real[:, 2]) & (real[:, 2] < high)]
    rows = rows[(rows[:, 0] > 2.5) & (rows[:, 0] < 4)]
    distance = np.median(rows[:, 0]) / np.hypot(1, (low + high) / 2)
    ours = errors(simulated(distance, 9.0))
    ours = ours[(ours[:, 0] > 2.5) & (ours[:, 0] < 4)]
    ours = ours[(low <= ours[:, 2]) & (ours[:, 2] < high)]
    assert spread(ours[:, 1]) == pytest.approx(spread(rows[:, 1]), rel=TOLERANCE)


def test_its_dropouts_lie_between_what_the_real_one_surely_and_at_most_loses(recorded):
    at_most, surely = np.mean([lost(turns) for turns in recorded], axis=0)
    assert surely < 0.8 * RPLIDAR_A2.dropouts
    assert RPLIDAR_A2.dropouts < at_most
    assert lost(simulated(3.0, 3.0)) == pytest.approx([RPLIDAR_A2.dropouts] * 2, rel=0.3)


def test_it_has_as_many_beams_as_the_real_one_at_some_speed_of_its_motor(recorded):
    points = [len(scan.ranges) for turns in recorded for scan in turns]
    assert (min(points), max(points)) == (356, 539)
    assert min(points) < RPLIDAR_A2.beams < max(points)
