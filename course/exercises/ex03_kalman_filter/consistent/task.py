"""Task 03-consistent: NEES, NIS and their χ² intervals, and which noise of a filter is wrong."""

import numpy as np
from scipy.stats import chi2

from classroom.exercises.correctness_laws import equals, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex03_kalman_filter.beliefs import covariances, times
from course.exercises.ex03_kalman_filter.calls import CALLS

STEPS, WARM, DRAWN = 400, 40, 60
WRONG = np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]])
"""Whether Q and R are too small (1), too large (−1) or right (0)."""
LEAST, MOST = np.array([[2.5, 1.6], [4.0, 2.5]])
"""Factors by which the σ of the process noise or of the measurement noise is wrong."""


def _innovations(rng):
    """Innovations and S of filters of random walks, two runs of each kind in :data:`WRONG`.

    Runs whose statistics are within chance of another kind are drawn again."""
    wrong = np.repeat(WRONG, DRAWN, axis=0)
    sigma = rng.uniform(0.25, 0.5, wrong.shape)
    Q, R = (sigma * rng.uniform(LEAST, MOST, wrong.shape) ** -wrong).T ** 2
    truth, x, P = np.zeros((3, len(wrong)))
    vs, Ss = [], []
    for _ in range(WARM + STEPS):
        truth = truth + sigma[:, 0] * rng.standard_normal(len(wrong))
        z = truth + sigma[:, 1] * rng.standard_normal(len(wrong))
        P = P + Q
        v, S = z - x, P + R
        x, P = x + P / S * v, P - P**2 / S
        vs.append(v)
        Ss.append(S)
    vs, Ss = np.array(vs[WARM:]).T, np.array(Ss[WARM:]).T
    nis, follows = _statistics(vs, Ss)
    right = (np.abs(nis - 1) < 0.09) & (np.abs(follows) < 0.06)
    clear = (np.abs(np.log(nis)) > 0.3) & (np.abs(follows) > 0.15)
    clear &= (_which(nis, follows) == wrong).all(axis=1)
    clear &= (np.mean(vs[:, 1:] * vs[:, :-1] > 0, axis=1) > 0.5) == (follows > 0)
    usable = np.where(wrong.any(axis=1), clear, right).reshape(len(WRONG), DRAWN)
    kept = [DRAWN * k + np.flatnonzero(of)[:2] for k, of in enumerate(usable)]
    chosen = rng.permutation(np.concatenate(kept))
    return {"vs": vs[chosen], "Ss": Ss[chosen]}


def _errors(rng, rows, runs, states):
    """Errors, larger or smaller than reported, and their covariances."""
    Ps = np.stack([covariances(rng, runs, states) for _ in range(rows)])
    normal = rng.standard_normal((rows, runs, states)) * rng.uniform(0.6, 1.6, (rows, 1, 1))
    return {"errors": times(np.linalg.cholesky(Ps), normal), "Ps": Ps}


def _random(rng):
    innovations = _innovations(rng)
    return _errors(rng, len(innovations["vs"]), 5, 2) | innovations


def _small(rng, runs=4, states=2, steps=3):
    return _errors(rng, 3, runs, states) | {
        "vs": rng.uniform(-2, 2, (3, steps)),
        "Ss": rng.uniform(0.5, 2, (3, steps)),
    }


def _statistics(vs, Ss):
    """Mean NIS and autocorrelation over one step, (rows,)."""
    white = vs / np.sqrt(Ss)
    nis = np.mean(white**2, axis=1)
    return nis, np.mean(white[:, 1:] * white[:, :-1], axis=1) / nis


def _which(nis, follows):
    """Whether Q and R are too small or too large, (rows, 2), for clear statistics."""
    size = np.sign(np.log(nis)) * (np.abs(np.log(nis)) > 0.2)
    return np.where((size * follows > 0)[:, None], [1, 0], [0, 1]) * size[:, None]


@once
def _right(i):
    _, N, n = i["errors"].shape
    steps = i["vs"].shape[1]
    white = times(np.linalg.inv(np.linalg.cholesky(i["Ps"])), i["errors"])
    nis, follows = _statistics(i["vs"], i["Ss"])
    found = {"nees": (white**2).sum(axis=(1, 2)) / N, "nis": nis}
    for name, (size, count) in {"nees": (n, N), "nis": (1, steps)}.items():
        interval = chi2.ppf([0.025, 0.975], size * count) / count
        found[name] = np.column_stack([found[name], np.tile(interval, (len(nis), 1))])
    return found | {"wrong": _which(nis, follows)}


def _of(*names):
    return lambda i: {name: _right(i)[name] for name in names}


def _terms(i):
    squares = np.einsum("rki,rkij,rkj->rk", i["errors"], np.linalg.inv(i["Ps"]), i["errors"])
    return {"NEES of the first run": squares[:, 0], "first NIS": i["vs"][:, 0] ** 2 / i["Ss"][:, 0]}


def _degrees(i):
    _, N, n = i["errors"].shape
    return {"degrees of freedom of the sum of NEES": np.array([n * N] * len(i["vs"]))}


def _autocorrelation(i):
    nis, follows = _statistics(i["vs"], i["Ss"])
    return {"mean NIS": nis, "autocorrelation over one step": follows}


BOTH = {"nees": np.s_[0], "nis": np.s_[0]}
INTERVALS = {"nees": np.s_[1:], "nis": np.s_[1:]}
SHORT = ("means", "intervals")

CONSISTENT = Task(
    id="03-consistent",
    title="Is the filter consistent?",
    call=CALLS["03-consistent"],
    inputs=_random,
    shapes={"nees": (None, 3), "nis": (None, 3), "wrong": (None, 2)},
    laws=(
        equals(
            "means",
            1,
            "the first entries of nees and nis are the mean NEES and the mean NIS",
            _of("nees", "nis"),
            parts=BOTH,
            asks="Which covariance normalises an estimation error, and which normalises an "
            "innovation? Over what do you take each mean?",
            step=_terms,
        ),
        equals(
            "intervals",
            1,
            "the other entries are the bounds of the 95 % χ² intervals of these means",
            _of("nees", "nis"),
            parts=INTERVALS,
            asks="Which distribution has the sum of all NEES, and with how many degrees of "
            "freedom? How does the interval of the sum become the interval of the mean?",
            step=_degrees,
        ),
        equals(
            "wrong",
            1,
            "the two numbers of wrong tell for Q and for R whether it is too small or too large",
            _of("wrong"),
            asks="A filter with too small a Q follows too slowly. Which sign do successive "
            "innovations then have? And if R is too small, so that it follows each reading?",
            step=_autocorrelation,
        ),
    ),
    probes=(
        Probe("few runs of few steps", _small, SHORT),
        Probe("a single run", lambda rng: _small(rng, runs=1, steps=5), SHORT),
        Probe("one state", lambda rng: _small(rng, states=1), SHORT),
        Probe("four states and twenty runs", lambda rng: _small(rng, 20, 4, 30), SHORT),
    ),
    may_round=False,
    begins=(
        "Which mean do the NEES of a consistent filter with two states have, and which mean has "
        "its NIS?",
        "Which distribution has the sum of ten independent squares of standard normal numbers?",
    ),
)
