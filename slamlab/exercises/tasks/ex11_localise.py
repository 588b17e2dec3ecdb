"""Exercise 11, localise: a run so nearly linear that the Kalman filter's belief is exact.

Bands are wider than seven standard deviations of what clouds of right solutions stray, measured
over 700 seeds each for draws by comb and by independent numbers.
"""

import numpy as np

from slamlab.exercises.drives.ex11 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex11_move import driven
from slamlab.geometry import wrap
from slamlab.models.jacobians import A_odometry, H_robot, W_odometry
from slamlab.models.motion import f_odometry
from slamlab.models.observation import g, h

RUNS, STEPS, MARKS, SAMPLES = 4, 3, 4, 2000
MEAN_BAND, SPREAD_BAND = 0.1, 0.1


def runs(rng):
    """Drives among landmarks, from weighted samples; some steps must draw, some need not."""
    parts = [_run(rng, blunt) for blunt in (0.7, 0.7, 3.0, 3.0)]
    return {name: np.array([part[name] for part in parts]) for name in parts[0]}


def _run(rng, blunt):
    x = np.array([*rng.uniform(-3, 3, 2), rng.uniform(-3, 3)])
    P = np.diag([0.08, 0.08, 0.04]) ** 2
    white = rng.standard_normal((SAMPLES, 3))
    rows = x + white * np.sqrt(np.diag(P))
    # weights that tilt a Gaussian shift its mean and leave its covariance
    tilt = rng.choice([-1, 1], 3) * rng.uniform(0.25, 0.33, 3)
    weights = np.exp(white @ tilt)
    x = x + tilt * np.sqrt(np.diag(P))
    C = np.diag([rng.uniform(0.08, 0.09), rng.uniform(0.04, 0.045)]) ** 2
    R = np.diag([blunt * rng.uniform(0.2, 0.25), blunt * rng.uniform(0.1, 0.12)]) ** 2
    r, bearing = rng.uniform(3, 6, MARKS), np.arange(MARKS) * np.pi / 2 + rng.uniform(0.2, 1.2)
    p, us, zs = g(x, np.column_stack([r, bearing])), [], []
    # less noise than the filter is told of: no scan is so unlikely that few samples explain it
    truth = rng.multivariate_normal(x, P / 4)
    for _ in range(STEPS):
        u = np.array([rng.uniform(0.2, 0.4), rng.choice([-1, 1]) * rng.uniform(0.1, 0.3)])
        truth = f_odometry(truth, rng.multivariate_normal(u, C / 4))
        z = h(truth, p) + rng.multivariate_normal([0, 0], R / 4, MARKS)
        zs.append(np.column_stack([z[:, 0], wrap(z[:, 1])]))
        us.append(u)
    seed = float(rng.integers(1, 2**31))
    known = dict(us=np.array(us), C=C, p=p, zs=np.array(zs), R=R, seed=seed)
    return dict(rows=rows, weights=weights / weights.sum(), **known)


# ---- laws -----------------------------------------------------------------------------------


def exact(i, C=1.0, see=True, weighted=True):
    """(k, t, 3), (k, t, 3, 3) beliefs of the Kalman filter, or of a mistaken one."""
    return tuple(
        np.array(part)
        for part in zip(*(_filtered(i, k, C, see, weighted) for k in range(RUNS)), strict=True)
    )


def _filtered(i, k, C, see, weighted):
    rows, p = i["rows"][k], i["p"][k]
    w = i["weights"][k] if weighted else np.full(SAMPLES, 1 / SAMPLES)
    x = w @ rows
    P, means, covariances = ((rows - x) * w[:, None]).T @ (rows - x), [], []
    for u, z in zip(i["us"][k], i["zs"][k], strict=True):
        A, W = A_odometry(x, u), W_odometry(x, u)
        x, P = f_odometry(x, u), A @ P @ A.T + C * W @ i["C"][k] @ W.T
        if see:
            H = H_robot(x, p).reshape(-1, 3)
            v = z - h(x, p)
            v[:, 1] = wrap(v[:, 1])
            S = H @ P @ H.T + np.kron(np.eye(MARKS), i["R"][k])
            K = np.linalg.solve(S, H @ P).T
            x, P = x + K @ v.ravel(), P - K @ H @ P
        means.append(x)
        covariances.append(P)
    return np.array(means), np.array(covariances)


def moments(o):
    """(k, t, 3), (k, t, 3, 3) mean and covariance of the clouds, by weights made to sum to one."""
    w = o["weights"] / o["weights"].sum(axis=-1, keepdims=True)
    off = o["rows"] - o["rows"][:, :, :1]
    off[..., 2] = wrap(off[..., 2])
    mean = np.einsum("ktn,ktna->kta", w, off)
    off = off - mean[:, :, None]
    spread = np.einsum("ktn,ktna,ktnb->ktab", w, off, off)
    return o["rows"][:, :, 0] + mean, spread


def strays(i, o, belief):
    """How far means lie off a belief, in its deviations, and what share of its covariance is there.

    Both over all runs and steps: the more clouds, the less chance.
    """
    (mean, spread), (x, P) = moments(o), belief
    off = mean - x
    off[..., 2] = wrap(off[..., 2])
    white = np.linalg.solve(np.linalg.cholesky(P), off[..., None])
    share = np.trace(np.linalg.solve(P, spread), axis1=-2, axis2=-1) / 3
    return np.sqrt((white**2).mean()), share[:, 1:].mean()


def _mean_right(i, o):
    return strays(i, o, exact(i))[0] < MEAN_BAND


def _spread_right(i, o):
    return abs(strays(i, o, exact(i))[1] - 1) < SPREAD_BAND


def _worth(o):
    """(k, t) effective sizes."""
    w = o["weights"]
    return w.sum(axis=-1) ** 2 / (w**2).sum(axis=-1)


def _drawn_in_time(i, o):
    return (_worth(o) > SAMPLES / 2 - 1e-6).all(axis=1)


def _gains(i, o):
    """(k, t, n) by what the logarithm of each weight grew beyond a constant, and (k, t) where not.

    Where all weights are equal the step has drawn: these tell nothing.
    """
    w = o["weights"]
    with np.errstate(divide="ignore"):
        gain = np.diff(np.log(np.concatenate([i["weights"][:, None], w], axis=1)), axis=1)
    return gain - gain[..., :1], np.ptp(w, axis=-1) < 1e-9 / SAMPLES


def _scan(i, rows):
    """(k, t, n) log likelihoods of the scans, given samples."""
    v = i["zs"][:, :, None] - h(rows[:, :, :, None], i["p"][:, None, None])
    v[..., 1] = wrap(v[..., 1])
    inverse = np.linalg.inv(i["R"])
    logs = -0.5 * np.einsum("ktnma,kab,ktnmb->ktn", v, inverse, v)
    return logs - logs[..., :1]


def _same_gain(gain, want, drawn):
    return (np.abs(gain - want) < 1e-6 * (1 + np.abs(want))).all(axis=-1) | drawn


def _weighed_right(i, o):
    one = np.abs(o["weights"].sum(axis=-1) - 1) < 1e-9
    return _same_gain(_gains(i, o)[0], _scan(i, o["rows"]), _gains(i, o)[1]) & one


# ---- mistakes -------------------------------------------------------------------------------


def _gained(name, hint, wrong):
    """The weights grew by something else, wherever nothing was drawn."""

    def matches(i, o):
        gain, drawn = _gains(i, o)
        return not drawn.all() and _same_gain(gain, wrong(i, o), drawn).all()

    return Diagnosis(name, hint, matches)


def _believes(name, hint, *others):
    """The clouds are those of another filter, and not those of the right one."""

    def matches(i, o):
        for other in others:
            off, share = strays(i, o, exact(i, **other))
            if off < MEAN_BAND and abs(share - 1) < SPREAD_BAND:
                return True
        return False

    return Diagnosis(name, hint, matches)


def _before(i, o):
    """(k, t, n, 3) the samples that each step began with."""
    return np.concatenate([i["rows"][:, None], o["rows"][:, :-1]], axis=1)


def _motion(i, o):
    """(k, t, n) logarithm of p(x_t | x_{t−1}, u), where samples stayed in their rows."""
    before = _before(i, o)
    noise = driven(before, o["rows"], before[..., 2])[..., :2] - i["us"][:, :, None]
    logs = -0.5 * np.einsum("ktna,kab,ktnb->ktn", noise, np.linalg.inv(i["C"]), noise)
    return logs - logs[..., :1]


def _forgotten(i, o):
    """The first step's weights are the likelihood alone, those before it forgotten."""
    gain, drawn = _gains(i, o)
    before = np.log(i["weights"])
    want = _scan(i, o["rows"])[:, 0] - (before - before[:, :1])
    return not drawn[:, 0].all() and _same_gain(gain[:, 0], want, drawn[:, 0]).all()


def _one_place(i, o):
    return (np.ptp(o["rows"], axis=2).max(axis=-1) < 1e-9).any()


def _unsummed(i, o):
    return (np.abs(o["weights"].sum(axis=-1) - 1) > 1e-6).any()


MOTION_TWICE = (
    "p(x_t | x_{t−1}, u) is in the weight: an erratum of the thesis. Where the robot is likely to "
    "go there are many samples already; the weight is the likelihood alone."
)
LOCALISE = Task(
    id="11-localise",
    title="Localise: move, weigh, draw",
    drive=DRIVES["11-localise"],
    inputs=runs,
    shapes={"rows": (RUNS, STEPS, SAMPLES, 3), "weights": (RUNS, STEPS, SAMPLES)},
    laws=(
        Law("mean", 1, "the cloud's mean is the Kalman filter's, where that is exact", _mean_right),
        Law("spread", 1, "so is its covariance", _spread_right),
        Law("weights", 1, "a weight grows by the likelihood; all sum to one", _weighed_right),
        Law("worth", 1, "after a step the cloud is worth half its samples or more", _drawn_in_time),
    ),
    diagnoses=(
        Diagnosis(
            "not-moved",
            "The samples stand where they stood: move them first.",
            lambda i, o: np.isin(o["rows"][:, 0, :, 0], i["rows"][..., 0]).all(),
        ),
        Diagnosis(
            "one-place",
            "All samples stand on one place: one sample was copied n times. Draw by weight.",
            _one_place,
        ),
        Diagnosis(
            "not-normalised",
            "The weights do not sum to one: normalise them.",
            _unsummed,
        ),
        _gained(
            "weighed-before-moving",
            "The scan is seen after the drive, but you weigh the samples where they were before "
            "it. Move first, then weigh the moved ones.",
            lambda i, o: _scan(i, _before(i, o)),
        ),
        _gained(
            "motion-in-the-weight", MOTION_TWICE, lambda i, o: _scan(i, o["rows"]) + _motion(i, o)
        ),
        Diagnosis(
            "weights-forgotten",
            "The new weights are the likelihoods alone: what the samples weighed before is lost. "
            "Where nothing was drawn the weights carry what was seen: multiply (add logarithms).",
            _forgotten,
        ),
        _gained(
            "twice",
            "The scan counts twice: the likelihood is multiplied in more than once.",
            lambda i, o: 2 * _scan(i, o["rows"]),
        ),
        Diagnosis(
            "weights-kept",
            "After drawing, the samples have their old weights, too: what is likely counts twice. "
            "The drawn samples are all worth 1/n.",
            lambda i, o: not _weighed_right(i, o).all() and not _drawn_in_time(i, o).all(),
        ),
        Diagnosis(
            "never-drawn",
            "The cloud is worth less than half its samples after a step: draw when 1/Σ w² falls "
            "below n/2.",
            lambda i, o: _weighed_right(i, o).all() and not _drawn_in_time(i, o).all(),
        ),
        _believes("motion-in-the-weight", MOTION_TWICE, dict(C=0.5)),
        _believes(
            "blind",
            "The scans make no difference: this is odometry, with a cloud that grows and grows. "
            "Are the weights made equal without drawing?",
            dict(see=False),
            dict(see=False, weighted=False),
        ),
    ),
    needs=("11-move", "11-weigh", "11-normalise", "11-draw"),
)
