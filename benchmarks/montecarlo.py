"""Monte Carlo localisation (particle filter), compared with a plain loop; and resampling alone.

A step moves every particle with its own noise, weights it by 20 known landmarks and resamples.
"""

import math
import sys

import numpy as np
from filterpy.monte_carlo import resampling as filterpy

from benchmarks.common import cpu_times, main, speed_rows
from slamlab import models
from slamlab.filters.particle_filters import likelihood
from slamlab.filters.particle_filters.importance_weights import normalise
from slamlab.filters.particle_filters.motion_sampling import sample_motion
from slamlab.filters.particle_filters.resampling import multinomial, systematic
from slamlab.geometry import wrap
from slamlab.models import noise
from slamlab.models.parameters import RobotModel

TITLE = "Monte Carlo localisation: predict, weight by 20 landmarks, resample (CPU time, one thread)"
SIZES = (100, 1000, 10_000)
LANDMARKS = 20
ROBOT, ODOMETRY = RobotModel(slip=0.01), np.array([0.2, 0.01, 0.05])
R = np.diag([0.05**2, 0.03**2])


def scene(n):
    """Make a test scene: particles around a pose, a map, and an observation."""
    rng = np.random.default_rng(n)
    x = rng.normal([1, 2, 0.5], [0.2, 0.2, 0.1], (n, 3))
    p = rng.uniform(-8, 8, (LANDMARKS, 2))
    z = models.h(np.array([1.2, 2.1, 0.55]), p) + rng.standard_normal((LANDMARKS, 2)) * 0.03
    return x, p, z


def slamlab_step(x, p, z, rng):
    """Do a step with slamlab, for all particles and landmarks at once."""
    x = sample_motion(x, ODOMETRY, ROBOT, rng)
    noises = np.broadcast_to(R, (len(p), 2, 2))
    weights, _ = normalise(likelihood.of_scan(x, p, z, noises))
    return x[systematic(weights, len(x), rng)]


def textbook_step(x, p, z, rng):
    """Do a step with straightforward NumPy: one array of samples × landmarks for each quantity."""
    x = sample_motion(x, ODOMETRY, ROBOT, rng)
    v = z - models.h(x[:, None], p)
    v[..., 1] = wrap(v[..., 1])
    logs = -0.5 * (v**2 / np.diag(R)).sum(axis=(1, 2))
    weights, _ = normalise(logs)
    return x[filterpy.systematic_resample(weights)]


def loop_weights(x, p, z):
    """Compute log weights by a plain loop in Python."""
    var_r, var_b, tau, pi = R[0, 0], R[1, 1], math.tau, math.pi
    marks = [(*place, *seen) for place, seen in zip(p.tolist(), z.tolist(), strict=True)]
    logs = []
    for x0, y0, theta in x.tolist():
        log = 0.0
        for px, py, r, bearing in marks:
            dx, dy = px - x0, py - y0
            off_r = r - math.hypot(dx, dy)
            off_b = (bearing - math.atan2(dy, dx) + theta + pi) % tau - pi
            log -= 0.5 * (off_r * off_r / var_r + off_b * off_b / var_b)
        logs.append(log)
    return logs


def loop_step(x, p, z, rng):
    """Do a step in plain Python: a loop over particles that contains a loop over landmarks."""
    d, turn = math.hypot(*ODOMETRY[:2]), ODOMETRY[2]
    direction = math.atan2(ODOMETRY[1], ODOMETRY[0])
    C = noise.C_odometry((d, turn), ROBOT.distance_error, ROBOT.turn_error, ROBOT.turn_per_metre)
    C = C + noise.C_wheels((d, turn), ROBOT.slip, ROBOT.base)
    (a, _), (b, c) = np.linalg.cholesky(C).tolist()
    rows = []
    for (x0, y0, theta), (e, f) in zip(
        x.tolist(), rng.standard_normal((len(x), 2)).tolist(), strict=True
    ):
        way, turned = d + a * e, b * e + c * f
        along = theta + direction + turned / 2
        heading = (theta + turn + turned + math.pi) % math.tau - math.pi
        rows.append([x0 + way * math.cos(along), y0 + way * math.sin(along), heading])
    logs = loop_weights(np.array(rows), p, z)
    top = max(logs)
    weights = [math.exp(log - top) for log in logs]
    return np.array(loop_resample(rows, weights, rng.random()))


def loop_resample(rows, weights, u):
    """Do systematic (low-variance) resampling in plain Python."""
    n, total = len(rows), sum(weights)
    drawn, edge, i = [], weights[0], 0
    for k in range(n):
        while (u + k) / n * total >= edge and i < n - 1:
            i += 1
            edge += weights[i]
        drawn.append(rows[i])
    return drawn


def same_weights(x, p, z):
    """Check that the methods' weights agree, so that all are timed for the same work."""
    noises = np.broadcast_to(R, (len(p), 2, 2))
    ours, _ = normalise(likelihood.of_scan(x, p, z, noises))
    loop, _ = normalise(loop_weights(x, p, z))
    np.testing.assert_allclose(ours, loop, rtol=1e-6, atol=1e-12)


def times_of_size(n, quick):
    """Return {method: median CPU time} of a step with n particles [s]."""
    x, p, z = scene(n)
    same_weights(x, p, z)
    rng = np.random.default_rng(0)
    steps = {
        "plain Python loop": loop_step,
        "numpy + filterpy's resampling": textbook_step,
        "slamlab": slamlab_step,
    }
    return cpu_times(
        {name: lambda step=step: step(x, p, z, rng) for name, step in steps.items()}, quick
    )


def draws_of(n, quick):
    """Return {method: median CPU time} of drawing n samples from n weights [s]."""
    rng = np.random.default_rng(n)
    weights = rng.dirichlet(np.ones(n))
    return cpu_times(
        {
            "filterpy systematic": lambda: filterpy.systematic_resample(weights),
            "filterpy stratified": lambda: filterpy.stratified_resample(weights),
            "filterpy multinomial": lambda: filterpy.multinomial_resample(weights),
            "slamlab systematic": lambda: systematic(weights, n, rng),
            "slamlab multinomial": lambda: multinomial(weights, n, rng),
        },
        quick,
        3.0,
    )


def run(quick):
    """Make rows for all sizes: steps relative to the loop, resampling relative to filterpy."""
    rows = []
    for n in SIZES:
        compared = [("slamlab", "numpy + filterpy's resampling")]
        rows += speed_rows(f"{n} particles", times_of_size(n, quick), compared)
    compared = [("slamlab multinomial", "filterpy multinomial")]
    return rows + speed_rows(f"{SIZES[-1]} draws", draws_of(SIZES[-1], quick), compared)


if __name__ == "__main__":
    sys.exit(main({TITLE: run}, "python -m benchmarks.montecarlo"))
