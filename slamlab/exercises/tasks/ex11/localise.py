"""Task 11-localise: one step of Monte Carlo localisation, over drives of some steps."""

import itertools

import numpy as np

from slamlab.exercises.drives.ex11 import DRIVES
from slamlab.exercises.law import Diagnosis, Law, once
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex11 import runs
from slamlab.geometry import wrap

# over all runs and steps of a set, means of right solutions stray by 0.03 (0.074 at most, over 500
# runs by comb and by tickets), and spreads by 1 % (4 % at most)
MEAN_BAND, SPREAD_BAND = 0.12, 0.1
SAME = 1e-6  # of a weight's growth; of a place, where the wheels err by ``runs.SURE``


def strays(i, o):
    """How far means lie off the exact ones, in deviations, and what share of P is there."""
    (mean, spread), (x, P) = runs.moments(o["rows"], o["weights"]), runs.exact(i)
    off = mean - x
    off[..., 2] = wrap(off[..., 2])
    white = np.linalg.solve(np.linalg.cholesky(P), off[..., None])
    share = np.trace(np.linalg.solve(P, spread), axis1=-2, axis2=-1) / 3
    return np.sqrt((white**2).mean()), share[:, 1:].mean()


def _sums_off(o):
    """(k, t) by how much the weights' sums are off."""
    return np.abs(o["weights"].sum(axis=-1) - 1)


def _grown(i, o, likelihoods=runs.log_likelihoods):
    """(k, t, n) the logarithms of weights less that of the sample that should weigh most, as they
    are and as they should be, and whether they are so; (k, t, 1) where a step has drawn anew.
    """
    w, before = o["weights"], runs.begun(i, o)[1]
    drawn = np.ptp(w, axis=-1, keepdims=True) < 1e-9 / w.shape[-1]
    want = np.log(before) + likelihoods(i, o["rows"])
    best = want.argmax(axis=-1, keepdims=True)
    want = want - np.take_along_axis(want, best, -1)
    got = np.log(w) - np.log(np.take_along_axis(w, best, -1))
    same = np.abs(got - want) < SAME * (1 + np.abs(want))
    nothing = (w < 1e-250) & (want < -550)  # a float's last ones have few digits
    return got, want, same | nothing | drawn, drawn


def _weights_right(i, o):
    *_, right, _ = _grown(i, o)
    return right.all(axis=(1, 2)) & (_sums_off(o) < 1e-9).all(axis=1)


def _why_weights(i, o):
    off = np.argwhere(_sums_off(o) >= 1e-9)
    if len(off):
        k, t = off[0]
        total = o["weights"][k, t].sum()
        return f"The weights that call {t}, counted from 0, returned sum to {total:.6g}."
    got, want, right, _ = _grown(i, o)
    k, t, _ = np.argwhere(~right)[0]
    n = np.where(right, 0, np.nan_to_num(np.abs(got - want), nan=np.inf))[k, t].argmax()
    most = want[k, t].argmax()
    return (
        f"In call {t}, counted from 0, sample {most} should weigh most, by what it weighed before "
        f"and its likelihood. The logarithm of the weight of sample {n} should be less than that "
        f"of sample {most} by {-want[k, t, n]:.4g}, and is by {-got[k, t, n]:.4g}."
    )


def _worth(o):
    """(k, t) effective sizes."""
    w = o["weights"]
    return w.sum(axis=-1) ** 2 / (w**2).sum(axis=-1)


def _in_time(i, o):
    return (_worth(o) > o["weights"].shape[-1] / 2 - 1e-6).all(axis=1)


@once
def _objections(i, o):
    """What is wrong with each run where each sample can be recognised, a sentence; "" if nothing.

    Of its calls the first one that is wrong is told.
    """
    before, w = runs.begun(i, o)
    (d, turn), (x, y, theta) = np.moveaxis(i["us"][:, :, None], -1, 0), np.moveaxis(before, -1, 0)
    moved = np.stack([x + d * np.cos(theta), y + d * np.sin(theta), wrap(theta + turn)], axis=-1)
    want = np.log(w) + runs.log_likelihoods(i, moved)
    want = np.exp(want - want.max(axis=-1, keepdims=True))
    want = want / want.sum(axis=-1, keepdims=True)
    clouds = zip(moved, want, o["rows"], o["weights"], strict=True)
    return [next(filter(None, map(_objection, itertools.count(), *run)), "") for run in clouds]


def _drawn_right(i, o):
    return np.array([not objection for objection in _objections(i, o)])


def _why_drawn(i, o):
    return next(filter(None, _objections(i, o)))


def _objection(call, moved, want, rows, weights):
    n, begin = len(rows), f"In call {call}, counted from 0,"
    same, parents = _near(moved, moved), _near(rows, moved)
    due, got = n * same @ want, n * weights @ parents
    if not parents.any(axis=1).all():
        return f"{begin} some rows are not where any of the samples has moved to."
    if np.ptp(weights) > 1e-9 / n:
        kept = np.abs(got - due).max() < SAME * n
        return "" if kept else f"{begin} samples do not have the weight that is their due."
    worth = 1 / np.sum(want**2)
    # copies of one sample are the same cloud, drawn anew or not, but for what the wheels err
    if np.ptp(want) > 1e-9 / n and not same.all() and worth > n / 2 * (1 + SAME):
        return f"{begin} you drew, though the weighed cloud was worth {worth:.1f} of {n} samples."
    # Poisson at most: seven deviations, and some for those that are hardly ever drawn
    if (np.abs(got - due) < 7 * np.sqrt(due) + 7).all():
        return ""
    return f"{begin} samples have far more copies, or fewer, than their weights ask for."


def _near(a, b):
    """(n, n) whether samples of one cloud stand where those of another one do."""
    off = a[:, None] - b
    return (np.abs(off[..., :2]).max(axis=-1) < SAME) & (np.abs(wrap(off[..., 2])) < SAME)


def _why_off(i, o):
    off, share = strays(i, o)
    return (
        f"The clouds' means are off by {off:.2f} of their deviations ({MEAN_BAND} is allowed), "
        f"and they are {share:.2f} times as wide, in variances, as they should be."
    )


def _why_worth(i, o):
    return (
        f"After some step the cloud is worth {_worth(o).min():.1f} of {o['rows'].shape[2]} samples."
    )


# ---- mistakes of those who draw in another way than the solution ----------------------------


def _before_moving(i, o):
    """Whether the weights are those of the samples where they stood before the drive."""
    before = runs.begun(i, o)[0]
    *_, right, drawn = _grown(i, o, lambda i, rows: runs.log_likelihoods(i, before))
    return right.all() and not drawn.all()


EXACT = ("weights", "worth", "drawn")
LOCALISE = Task(
    id="11-localise",
    title="Localise: move, weigh, draw",
    drive=DRIVES["11-localise"],
    inputs=runs.runs,
    shapes=lambda i: {
        "rows": (*i["us"].shape[:2], *i["rows"].shape[1:]),
        "weights": (*i["us"].shape[:2], i["rows"].shape[1]),
    },
    laws=(
        Law(
            "mean",
            1,
            "the cloud's mean is the Kalman filter's, where that is exact",
            lambda i, o: strays(i, o)[0] < MEAN_BAND,
            why=_why_off,
            asks="What has the robot done before it sees: where are the samples by then?",
        ),
        Law(
            "spread",
            1,
            "so is its covariance",
            lambda i, o: abs(strays(i, o)[1] - 1) < SPREAD_BAND,
            why=_why_off,
            asks="By what else than the likelihood might your weights have been multiplied? How "
            "often does one scan count?",
        ),
        Law(
            "weights",
            1,
            "a weight grows by the likelihood of the scan; all sum to one",
            _weights_right,
            why=_why_weights,
            asks="What did the samples weigh before this step, and is that still in your weights?",
        ),
        Law(
            "worth",
            1,
            "after a step the cloud is worth half its samples or more",
            _in_time,
            why=_why_worth,
            asks="When do you draw, and what do the drawn samples weigh?",
            alone=False,
        ),
        Law(
            "drawn",
            1,
            "where wheels do not err, the samples are the moved ones, drawn by their weights, and "
            "only if the cloud is worth less than half",
            _drawn_right,
            why=_why_drawn,
            asks="When do you draw, and by which weights? What if all likelihoods are smaller "
            "than the smallest float?",
            main=False,
        ),
    ),
    diagnoses=(
        Diagnosis(
            "not-normalised",
            "The weights do not sum to one: normalise them.",
            lambda i, o: _sums_off(o).max() >= 1e-9,
        ),
        Diagnosis(
            "weighed-before-moving",
            "The scan is seen after the drive, but you weigh the samples where they were before "
            "it. Move first, then weigh the moved ones.",
            _before_moving,
        ),
        Diagnosis(
            "never-drawn",
            "The weights are right, but the cloud is worth less than half its samples after a "
            "step: draw when 1/Σ w² falls below n/2.",
            lambda i, o: _weights_right(i, o).all() and not _in_time(i, o).all(),
        ),
    ),
    needs=("11-weigh", "11-draw"),
    probes=(
        Probe("wheels whose errors go together", runs.related_wheels, ("mean", "spread")),
        Probe("wheels that hardly err", runs.sure_wheels, EXACT),
        Probe("one landmark", lambda r: runs.sure_wheels(r, marks=1), EXACT),
        Probe("a cloud that is metres off", lambda r: runs.sure_wheels(r, (0.3,), off=4.0), EXACT),
        Probe("seven samples", lambda r: runs.sure_wheels(r, samples=7), EXACT),
        Probe("one sample", lambda r: runs.sure_wheels(r, samples=1), EXACT),
    ),
    rounds=False,
)
