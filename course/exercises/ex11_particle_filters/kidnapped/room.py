"""Runs of a kidnapped robot, with one measurement a step, some false.

The number ``world`` gives measurements and truth.
"""

import functools

import numpy as np

from slamlab.geometry import wrap
from slamlab.models.motion import f_odometry
from slamlab.models.observation import h

ROOM = np.array([10.0, 8.0])  # its middle is the origin [m]
POSTS = np.array([[4.5, 3.5], [-4.5, 3.5], [-4.5, -3.5], [4.5, -3.5], [1.0, 3.0], [-2.0, -3.2]])
OUTLIERS, REACH = 0.1, 10.0  # share of false measurements; their ranges are from 0 to this [m]
RUNS, STEPS, SAMPLES = 16, 30, 300
CARRIED = 8, 12  # first and last step before which the robot is kidnapped
SEARCH = 10  # steps in which it must be relocalised
START = np.diag([0.2, 0.2, 0.1]) ** 2
WHEELS, EYES = np.diag([0.04, 0.04]) ** 2, np.diag([0.15, 0.06]) ** 2


def runs(rng):
    """The robots' measurements, and the number they are drawn from."""
    world = rng.integers(1, 2**53)
    return _world(int(world))[0] | {"world": np.full(RUNS, float(world))}


def truth(i):
    """(k, t, 2) positions after each step, and (k,) the steps of the kidnapping."""
    return _world(int(i["world"][0]))[1:]


@functools.lru_cache(maxsize=4)
def _world(number):
    rng = np.random.default_rng([number, 11])
    parts = [_run(rng) for _ in range(RUNS)]
    told = {name: np.array([part[0][name] for part in parts]) for name in parts[0][0]}
    return told, np.array([part[1] for part in parts]), np.array([part[2] for part in parts])


def _run(rng):
    x, carried, last = _somewhere(rng), rng.integers(*CARRIED, endpoint=True), -1
    rows = rng.multivariate_normal(rng.multivariate_normal(x, START), START, SAMPLES)
    rows[:, 2] = wrap(rows[:, 2])
    us, ps, zs, way = [], [], [], []
    for k in range(STEPS):
        x = _somewhere(rng, x) if k == carried else x
        u = _steered(rng, x)
        x = f_odometry(x, rng.multivariate_normal(u, WHEELS))
        last = rng.choice([j for j in range(len(POSTS)) if j != last])
        z = h(x, POSTS[last]) + rng.multivariate_normal([0, 0], EYES)
        if rng.random() < OUTLIERS:
            z = rng.uniform([0, -np.pi], [REACH, np.pi])
        us.append(u)
        ps.append(POSTS[[last]])
        zs.append([[abs(z[0]), wrap(z[1])]])
        way.append(x[:2])
    told = {"rows": rows, "us": us, "C": WHEELS, "ps": ps, "zs": zs, "R": EYES}
    told["seed"] = float(rng.integers(1, 2**31))
    return told, np.array(way), carried


def _somewhere(rng, far_from=None):
    for _ in range(1000):
        x = rng.uniform([-3.5, -2.5, -np.pi], [3.5, 2.5, np.pi])
        if far_from is None or np.hypot(*(x - far_from)[:2]) > 3:
            break
    return x


def _steered(rng, x):
    if np.hypot(x[0] / 3.5, x[1] / 2.5) > 1:
        return np.array([0.25, np.clip(wrap(np.arctan2(-x[1], -x[0]) - x[2]), -0.5, 0.5)])
    return np.array([0.25, rng.uniform(-0.4, 0.4)])
