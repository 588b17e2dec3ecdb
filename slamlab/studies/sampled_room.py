"""The room of lesson 11: a cloud of samples finds a robot among corners that all look alike."""

import numpy as np

from slamlab.filters.montecarlo.likelihood import of_unassociated_scan
from slamlab.filters.montecarlo.mcl import MCL
from slamlab.filters.montecarlo.motion_sampling import sample_motion
from slamlab.filters.montecarlo.particles import uniform
from slamlab.geometry import compose, wrap
from slamlab.layers import Segments
from slamlab.models.observation import h
from slamlab.models.parameters import RobotModel
from slamlab.simulation.differential_drive import arc

LOW, HIGH = [-3, -2], [3, 2]  # of the room [m]
CORNERS = np.array([[3, 2], [-3, 2], [-3, -2], [3, -2]], dtype=float)
POST = np.array([[1.4, -0.2]])
MAP = np.vstack([CORNERS, POST])
WALLS = Segments("walls", np.hstack([CORNERS, np.roll(CORNERS, -1, axis=0)]))
R = np.diag([0.3, np.radians(15)]) ** 2
WHEELS = RobotModel(distance_error=0.1, turn_error=0.1, turn_per_metre=0.1)
STEP = arc(0.10, 0.15, 0.75)  # 12 cm on, a little to the left
START = np.array([-1.8, -1.2, -0.3])
NEAR = 0.8  # of the robot, where its samples should be [m]


def look(truth, rng, reach):
    """Sightings of the corners, and of the post where it is near; nobody says which is which.

    Parameters
    ----------
    truth : (3,) [m, m, rad]
    rng : numpy.random.Generator
    reach : float, from how far the post is seen [m]

    Returns
    -------
    (m, 2) ranges [m] and bearings [rad]
    """
    seen = MAP if h(truth, POST)[0, 0] < reach else CORNERS
    z = h(truth, seen) + rng.multivariate_normal([0, 0], R, len(seen))
    z[:, 1] = wrap(z[:, 1])
    return z[z[:, 0] > 0]  # noise may push what is near behind the sensor


def film(n, seed, steps=36, reach=1.2, strangers=0, carried=None):
    """Samples that begin anywhere follow a robot that drives and looks.

    The drive is the same whatever n and the strangers are.

    Parameters
    ----------
    n : int, samples
    seed : int
    steps : int
    reach : float, from how far the post is seen [m]
    strangers : int, samples that are replaced by poses anywhere, in every step
    carried : int or None, the step in which the robot is set down 2.5 m away or more

    Returns
    -------
    list of (ParticleSet, (3,) true pose), at the start and after each step
    """
    world, rng = np.random.default_rng([seed, 0]), np.random.default_rng([seed, 1])
    truth, mcl = START, MCL(uniform(n, LOW, HIGH, rng), MAP, rng)
    pictures = [(mcl.cloud, truth)]
    for k in range(steps):
        if k == carried:
            truth = _elsewhere(truth, world)
        truth = sample_motion(truth[None], STEP, WHEELS, world)[0]
        if strangers:
            mcl.insert(uniform(strangers, LOW, HIGH, rng))
        mcl.predict(STEP, WHEELS)
        mcl.update(look(truth, world, reach), R)
        pictures.append((mcl.cloud, truth))
    return pictures


def near(cloud, place):
    """Share of a belief that lies within 0.8 m of a place: a sum of weights. Equation (11.1).

    Parameters
    ----------
    cloud : ParticleSet
    place : (2,) or longer [m]

    Returns
    -------
    float [1]
    """
    off = cloud.rows[:, :2] - np.asarray(place)[:2]
    return float(cloud.weights[np.hypot(*off.T) < NEAR].sum())


def evidence(seed, steps):
    """By what the likelihood of all that a film's robot sees is larger where it is than opposite.

    Opposite is where it would be if the room were turned by half a turn.

    Parameters
    ----------
    seed, steps : int, of the film

    Returns
    -------
    float, ratio of two likelihoods [1]
    """
    world, truth, log_ratio = np.random.default_rng([seed, 0]), START, 0.0
    for _ in range(steps):
        truth = sample_motion(truth[None], STEP, WHEELS, world)[0]
        z = look(truth, world, reach=0.0)
        both = np.array([truth, compose([0, 0, np.pi], truth)])
        here, opposite = of_unassociated_scan(both, MAP, z, np.tile(R, (len(z), 1, 1)))
        log_ratio += here - opposite
    return float(np.exp(log_ratio))


def _elsewhere(truth, rng):
    """A pose at least 2.5 m away, and a metre from the walls."""
    while True:
        x, y, theta = rng.uniform([-2, -1, -np.pi], [2, 1, np.pi])
        if np.hypot(x - truth[0], y - truth[1]) > 2.5:
            return np.array([x, y, theta])
