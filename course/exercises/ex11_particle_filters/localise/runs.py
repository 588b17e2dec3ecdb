"""Runs among landmarks, from weighted particles.

Those of ``runs`` are so nearly linear that the Kalman filter is exact.
"""

import numpy as np

from slamlab.geometry import wrap
from slamlab.models.jacobians import A_odometry, H_robot, W_odometry
from slamlab.models.motion import f_odometry
from slamlab.models.observation import g, h

STEPS, SAMPLES = 3, 2000
SURE = 1e-9  # odometry's standard deviations where it is nearly exact [m] and [rad]


def runs(rng, blunt=(0.7, 0.7, 3.0, 3.0), **sizes):
    """Runs of one size; the blunter the sensor, the fewer steps must resample.
    rows (k, n, 3), weights (k, n), us (k, t, 2), C (k, 2, 2), p (k, m, 2), zs (k, t, m, 2),
    R (k, 2, 2), seed (k,).
    """
    parts = [_run(rng, factor, **sizes) for factor in blunt]
    return {name: np.array([part[name] for part in parts]) for name in parts[0]}


def sure_wheels(rng, blunt=(0.5, 0.5, 0.6, 0.6, 6.0), samples=100, marks=3, **more):
    """Nearly exact odometry: each particle's place and weight is known; some near ±π."""
    return runs(rng, blunt, samples=samples, marks=marks, wide=4.0, sure=True, **more)


def related_wheels(rng):
    """Odometry errors that are strongly correlated, and dominate."""
    return runs(rng, (3.0, 3.0), wide=0.4, together=(0.93, 0.96))


def _run(rng, blunt, samples=SAMPLES, marks=4, wide=1.0, sure=False, off=0.0, together=(0.3, 0.5)):
    x = np.array([*rng.uniform(-3, 3, 2), rng.choice([-1, 1]) * rng.uniform(2.9, 3.1)])
    sigma = wide * np.array([0.08, 0.08, 0.04])
    white = rng.standard_normal((samples, 3))
    # weights that tilt a Gaussian shift its mean and leave its covariance
    tilt = rng.choice([-1, 1], 3) * rng.uniform(0.25, 0.33, 3)
    weights, rows = np.exp(white @ tilt), x + white * sigma
    rows[:, 2] = wrap(rows[:, 2])
    x = x + tilt * sigma
    C = _covariance(rng, rng.uniform(0.08, 0.09), rng.uniform(0.04, 0.045), together=together)
    R = _covariance(rng, blunt * rng.uniform(0.2, 0.25), blunt * rng.uniform(0.1, 0.12))
    r = rng.uniform(3, 6, marks)
    bearing = wrap(np.arange(marks) * np.pi / 2 + rng.uniform(0.2, 1.2))
    p, us, zs = g(x, np.column_stack([r, bearing])), [], []
    # less noise than C and R state: no scan is so unlikely that only few particles explain it
    truth = rng.multivariate_normal(x, np.diag(sigma / 2) ** 2) + off * np.array([1, 1, 0])
    for _ in range(STEPS):
        u = np.array([rng.uniform(0.2, 0.4), rng.choice([-1, 1]) * rng.uniform(0.1, 0.3)])
        truth = f_odometry(truth, u if sure else rng.multivariate_normal(u, C / 4))
        z = h(truth, p) + rng.multivariate_normal([0, 0], R / 4, marks)
        zs.append(np.column_stack([z[:, 0], wrap(z[:, 1])]))
        us.append(u)
    C = np.eye(2) * SURE**2 if sure else C
    seed = float(rng.integers(1, 2**31))
    known = dict(us=np.array(us), C=C, p=p, zs=np.array(zs), R=R, seed=seed)
    return dict(rows=rows, weights=weights / weights.sum(), **known)


def _covariance(rng, *sigma, together=(0.3, 0.5)):
    share = rng.choice([-1, 1]) * rng.uniform(*together)
    return np.array([[1, share], [share, 1]]) * np.outer(sigma, sigma)


def log_likelihoods(i, rows):
    """(k, t, n) of the scans given particles (k, t, n, 3), up to a constant."""
    v = i["zs"][:, :, None] - h(rows[:, :, :, None], i["p"][:, None, None])
    v[..., 1] = wrap(v[..., 1])
    return -0.5 * np.einsum("ktnma,kab,ktnmb->ktn", v, np.linalg.inv(i["R"]), v, optimize=True)


def begun(i, o):
    """Particles (k, t, n, 3) and weights (k, t, n) before each step."""
    return tuple(
        np.concatenate([i[name][:, None], o[name][:, :-1]], axis=1) for name in ("rows", "weights")
    )


def exact(i):
    """(k, t, 3), (k, t, 3, 3) the Kalman filter's estimates after each step."""
    beliefs = [_filtered({name: a[k] for name, a in i.items()}) for k in range(len(i["rows"]))]
    return tuple(np.array(part) for part in zip(*beliefs, strict=True))


def _filtered(i):
    w, p, means, covariances = i["weights"], i["p"], [], []
    x, P = moments(i["rows"], w)
    for u, z in zip(i["us"], i["zs"], strict=True):
        A, W = A_odometry(x, u), W_odometry(x, u)
        x, P = f_odometry(x, u), A @ P @ A.T + W @ i["C"] @ W.T
        H = H_robot(x, p).reshape(-1, 3)
        v = z - h(x, p)
        v[:, 1] = wrap(v[:, 1])
        S = H @ P @ H.T + np.kron(np.eye(len(p)), i["R"])
        K = np.linalg.solve(S, H @ P).T
        x, P = x + K @ v.ravel(), P - K @ H @ P
        means.append(x)
        covariances.append(P)
    return np.array(means), np.array(covariances)


def moments(rows, weights):
    """(..., 3), (..., 3, 3) mean and covariance of particles (..., n, 3), weights (..., n)."""
    w = weights / weights.sum(axis=-1, keepdims=True)
    off = rows - rows[..., :1, :]
    off[..., 2] = wrap(off[..., 2])
    mean = np.einsum("...n,...na->...a", w, off)
    off = off - mean[..., None, :]
    spread = np.swapaxes(off * w[..., None], -1, -2) @ off
    return rows[..., 0, :] + mean, spread
