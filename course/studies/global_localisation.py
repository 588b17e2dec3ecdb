"""Global localisation by a particle filter in a room with similar corners (lesson 11)."""

import numpy as np

from slamlab.filters.particle_filters.likelihood import of_unassociated_scan
from slamlab.filters.particle_filters.monte_carlo_localisation import MCL
from slamlab.filters.particle_filters.motion_sampling import sample_motion
from slamlab.filters.particle_filters.particle_set import uniform
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
NEAR = 0.8  # distance from the robot within which particles count [m]


def look(truth, rng, reach):
    """Return observations (m, 2) [m, rad] of the corners without ids, and of the post if it is
    within range [m]."""
    seen = MAP if h(truth, POST)[0, 0] < reach else CORNERS
    z = h(truth, seen) + rng.multivariate_normal([0, 0], R, len(seen))
    z[:, 1] = wrap(z[:, 1])
    return z[z[:, 0] > 0]  # noise may make a short range negative


def film(n, seed, steps=36, reach=1.2, injected=0, carried=None):
    """Run Monte Carlo localisation from n uniform particles; return (ParticleSet, true pose) for
    each step.

    In each step, ``injected`` random particles replace other particles. In step ``carried``, the
    robot is kidnapped and placed at least 2.5 m away. The run depends on the seed alone.
    """
    world, rng = np.random.default_rng([seed, 0]), np.random.default_rng([seed, 1])
    truth, mcl = START, MCL(uniform(n, LOW, HIGH, rng), MAP, rng)
    pictures = [(mcl.particles, truth)]
    for k in range(steps):
        if k == carried:
            truth = _elsewhere(truth, world)
        truth = sample_motion(truth[None], STEP, WHEELS, world)[0]
        if injected:
            mcl.insert(uniform(injected, LOW, HIGH, rng))
        mcl.predict(STEP, WHEELS)
        mcl.update(look(truth, world, reach), R)
        pictures.append((mcl.particles, truth))
    return pictures


def near(cloud, place):
    """Return the probability that the robot is within 0.8 m of a position: a sum of weights.
    Equation (11.1)."""
    off = cloud.rows[:, :2] - np.asarray(place)[:2]
    return float(cloud.weights[np.hypot(*off.T) < NEAR].sum())


def evidence(seed, steps):
    """Return the likelihood ratio of a run's observations between the true poses and poses rotated
    by half a turn."""
    world, truth, log_ratio = np.random.default_rng([seed, 0]), START, 0.0
    for _ in range(steps):
        truth = sample_motion(truth[None], STEP, WHEELS, world)[0]
        z = look(truth, world, reach=0.0)
        both = np.array([truth, compose([0, 0, np.pi], truth)])
        here, opposite = of_unassociated_scan(both, MAP, z, np.tile(R, (len(z), 1, 1)))
        log_ratio += here - opposite
    return float(np.exp(log_ratio))


def _elsewhere(truth, rng):
    """Draw a pose at least 2.5 m away and at least one metre from the walls."""
    while True:
        x, y, theta = rng.uniform([-2, -1, -np.pi], [2, 1, np.pi])
        if np.hypot(x - truth[0], y - truth[1]) > 2.5:
            return np.array([x, y, theta])
