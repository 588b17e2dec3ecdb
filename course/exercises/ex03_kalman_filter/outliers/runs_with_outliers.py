"""Runs with outliers of task 03-outliers, and what measures a filter in them."""
# No input contains the true states. The errors of all runs have mean 0, so the mean of all runs is
# the truth.

import numpy as np

from classroom.exercises.correctness_laws import once

DRIVEN, STEPS, SETTLED = 160, 50, 5  # errors of the first steps are those of the start: left out
T, OUTLIERS, REACH = 0.5, 0.25, 10.0
CLEAR, DOUBTFUL = 0.5, 0.9  # up to and from which quantile of the reference variance NEES is judged


def drives(rng):
    """One trajectory to and fro before a wall, repeated with independent errors."""
    seconds = T * np.arange(STEPS + 1)
    swing, start, period = rng.uniform(2, 3.5), rng.uniform(0, 2 * np.pi), rng.uniform(10, 14)
    place = REACH / 2 + swing * np.sin(2 * np.pi * seconds / period + start)
    way = np.stack([place, np.gradient(place, T)], axis=1)
    F, H = np.array([[1, T], [0, 1]]), np.array([[1.0, 0.0]])
    P, Q, R = np.diag([0.3, 0.2]) ** 2, np.diag([0.03, 0.08]) ** 2, rng.uniform(0.09, 0.11) ** 2
    zs = way[1:, :1] + np.sqrt(R) * _errors(rng, STEPS, 1)
    replaced = rng.random(zs.shape) < OUTLIERS
    given = {
        "x": way[0] + _errors(rng, 2) @ np.sqrt(P),
        "P": P,
        "us": way[1:] - way[:-1] @ F.T + _errors(rng, STEPS, 2) @ np.sqrt(Q),
        "zs": np.where(replaced, rng.uniform(0, REACH, zs.shape), zs),
        "F": F,
        "Q": Q,
        "H": H,
        "R": np.array([[R]]),
    }
    same = ("P", "F", "Q", "H", "R")
    return given | {name: np.tile(given[name], (DRIVEN, 1, 1)) for name in same}


def _errors(rng, *shape):
    # their mean over the runs is 0
    errors = rng.standard_normal((DRIVEN, *shape))
    return (errors - errors.mean(axis=0)) * np.sqrt(DRIVEN / (DRIVEN - 1))


def truth(i):
    """True states after each step, (steps, 2)."""
    x, way = i["x"].mean(axis=0), []
    for u in i["us"].mean(axis=0):
        x = i["F"][0] @ x + u
        way.append(x)
    return np.array(way)


def ordinary(i, taken):
    """States (drives, steps, 2) of a Kalman filter that uses the ``taken`` (drives, steps)
    readings."""
    F, Q, R, x, P, xs = i["F"][0], i["Q"][0], i["R"][0, 0, 0], i["x"], i["P"], []
    for k in range(i["zs"].shape[1]):
        x, P = x @ F.T + i["us"][:, k], F @ P @ F.T + Q
        K = P[:, :, 0] / (P[:, :1, 0] + R) * taken[:, k, None]
        x = x + K * (i["zs"][:, k] - x[:, :1])
        P = P - K[:, :, None] * P[:, :1, :]
        xs.append(x)
    return np.stack(xs, axis=1)


def typical(i, xs):
    """Median of the runs' root mean square position errors [m]."""
    off = (xs - truth(i))[:, SETTLED:, 0]
    return np.median(np.sqrt(np.mean(off**2, axis=1)))


def outliers(i):
    """Which readings are outliers, (drives, steps) bool, by the truth."""
    off = (i["zs"] - truth(i)[:, :1])[..., 0]
    return np.abs(off) > 5 * np.sqrt(i["R"][0, 0, 0])


@once
def with_outliers(i):
    """Typical error of the Kalman filter that uses all readings [m]."""
    return typical(i, ordinary(i, np.ones(i["zs"].shape[:2], dtype=bool)))


def without_outliers(i):
    """Typical error of the Kalman filter without the outliers [m]."""
    return typical(i, ordinary(i, ~outliers(i)))


def definite(o):
    P = o["Ps"][:, SETTLED:]
    return bool(np.linalg.eigvalsh((P + np.swapaxes(P, 2, 3)) / 2).min() > 0)


def nees_of(i, o):
    """NEES of each step, (drives, steps); NaN if a P is not positive definite."""
    off, P = (o["xs"] - truth(i))[:, SETTLED:], o["Ps"][:, SETTLED:]
    if not definite(o):
        return np.full(P.shape[:2], np.nan)
    return np.einsum("rki,rkij,rkj->rk", off, np.linalg.inv(P), off)


@once
def _doubt(i):
    """Variance of the position (drives, steps) of a filter that weights both hypotheses."""
    F, Q, R, x, P, found = i["F"][0], i["Q"][0], i["R"][:, 0, 0], i["x"], i["P"], []
    for k in range(i["zs"].shape[1]):
        x, P = x @ F.T + i["us"][:, k], F @ P @ F.T + Q
        S, v = P[:, 0, 0] + R, i["zs"][:, k, 0] - x[:, 0]
        K = P[:, :, 0] / S[:, None]
        real = (1 - OUTLIERS) * np.exp(-(v**2) / S / 2) / np.sqrt(2 * np.pi * S)
        share = real / (real + OUTLIERS / REACH)
        x = x + (share * v)[:, None] * K
        less = share * S - share * (1 - share) * v**2
        P = P - less[:, None, None] * K[:, :, None] * K[:, None, :]
        found.append(P[:, 0, 0])
    return np.stack(found, axis=1)


def usual_nees(i, o):
    """Mean NEES of clear and of doubtful steps, (2,), without the worst tenth of the runs."""
    nees, doubt = nees_of(i, o), _doubt(i)[:, SETTLED:]
    clear, doubtful = doubt <= np.quantile(doubt, CLEAR), doubt >= np.quantile(doubt, DOUBTFUL)
    usual = np.argsort(nees.mean(axis=1))[: len(nees) * 9 // 10]
    return np.array([nees[usual][steps[usual]].mean() for steps in (clear, doubtful)])


def compared(i, o):
    """NEES of clear steps, and how many times as large it is in doubtful steps."""
    clear, doubtful = usual_nees(i, o)
    return np.array([clear, doubtful / clear])


@once
def corrections(i, o):
    """Corrections of the state (r, k, 2), innovations (r, k), and which readings are outliers."""
    # Every filter predicts the same from its last belief; the rest is due to the reading.
    before = np.concatenate([i["x"][:, None], o["xs"][:, :-1]], axis=1)
    predicted = before @ i["F"][0].T + i["us"]
    v = i["zs"][..., 0] - predicted[..., 0]
    return o["xs"] - predicted, v, outliers(i)
