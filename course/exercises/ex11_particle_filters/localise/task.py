"""Task 11-localise: one step of Monte Carlo localisation."""

import itertools

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex11_particle_filters.calls import CALLS
from course.exercises.ex11_particle_filters.localise import runs
from slamlab.geometry import wrap

# over all runs and steps of a set, means of right solutions err by 0.03 (0.074 at most, over 500
# runs with systematic and multinomial resampling), and variances by 1 % (4 % at most)
MEAN_BAND, SPREAD_BAND = 0.12, 0.1
SAME = 1e-6  # of a weight's factor; of a position, where odometry errs by ``runs.SURE``


def strays(i, o):
    """The means' error [standard deviations], and the share of P."""
    (mean, spread), (x, P) = runs.moments(o["rows"], o["weights"]), runs.exact(i)
    off = mean - x
    off[..., 2] = wrap(off[..., 2])
    white = np.linalg.solve(np.linalg.cholesky(P), off[..., None])
    share = np.trace(np.linalg.solve(P, spread), axis1=-2, axis2=-1) / 3
    return np.sqrt((white**2).mean()), share[:, 1:].mean()


def _sums_off(o):
    return np.abs(o["weights"].sum(axis=-1) - 1)


def _grown(i, o, likelihoods=runs.log_likelihoods):
    """(k, t, n) log weights minus that of the particle of largest weight: actual, right, whether
    equal; (k, t, 1) resampled.
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
        return f"Call {t}, counted from 0, returned weights whose sum is {total:.6g}."
    got, want, right, _ = _grown(i, o)
    k, t, _ = np.argwhere(~right)[0]
    n = np.where(right, 0, np.nan_to_num(np.abs(got - want), nan=np.inf))[k, t].argmax()
    most = want[k, t].argmax()
    return (
        f"In call {t}, counted from 0, particle {most} should have the largest product of old "
        f"weight and likelihood. The logarithm of the weight of particle {n} should be less than "
        f"that of particle {most} by {-want[k, t, n]:.4g}, but it is less by {-got[k, t, n]:.4g}."
    )


def _worth(o):
    w = o["weights"]
    return w.sum(axis=-1) ** 2 / (w**2).sum(axis=-1)


def _in_time(i, o):
    return (_worth(o) > o["weights"].shape[-1] / 2 - 1e-6).all(axis=1)


@once
def _objections(i, o):
    """The first objection to each run of recognisable particles, or ""."""
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
        return f"{begin} some rows are not poses of moved particles."
    worth = 1 / np.sum(want**2)
    if np.ptp(weights) > 1e-9 / n:
        if np.abs(got - due).max() >= SAME * n:
            return f"{begin} some particles have wrong weights."
        late = worth < n / 2 * (1 - SAME)
        return f"{begin} you did not resample: n_eff was {worth:.1f} of {n}." if late else ""
    # copies of one particle are the same set, resampled or not, except for the odometry noise
    if np.ptp(want) > 1e-9 / n and not same.all() and worth > n / 2 * (1 + SAME):
        return f"{begin} you resampled, although n_eff was {worth:.1f} of {n} particles."
    # multinomial at most; drawing twice by the same weights is in 6 of 10 cases above the limit
    excess = ((got - due) ** 2 - 3 * due) / (due + 1) / same.sum(axis=1)
    if excess.sum() < 6:
        return ""
    return f"{begin} some numbers of copies differ strongly from n times the weight."


def _near(a, b):
    """(n, n) whether particles of two sets coincide."""
    off = a[:, None] - b
    return (np.abs(off[..., :2]).max(axis=-1) < SAME) & (np.abs(wrap(off[..., 2])) < SAME)


def _why_off(i, o):
    off, share = strays(i, o)
    return (
        f"The means err by {off:.2f} standard deviations ({MEAN_BAND} is allowed). The variances "
        f"are {share:.2f} times the right ones on average (within {SPREAD_BAND} of 1 is allowed)."
    )


def _why_worth(i, o):
    return (
        f"After some step n_eff, the effective sample size, is {_worth(o).min():.1f} of "
        f"{o['rows'].shape[2]} particles."
    )


# ---- mistakes of answers that draw in another way than the solution ----------------------------


def _before_moving(i, o):
    before = runs.begun(i, o)[0]
    *_, right, drawn = _grown(i, o, lambda i, rows: runs.log_likelihoods(i, before))
    return right.all() and not drawn.all()


def _moved_wrongly(i, o):
    """Whether weights are right, but not the rows, in runs without resampling."""
    calm = ~_grown(i, o)[3].any(axis=(1, 2))
    if not calm.any() or not _weights_right(i, o).all():
        return False
    own = {name: o[name][calm] for name in ("rows", "weights")}
    off, share = strays({name: a[calm] for name, a in i.items()}, own)
    return off > 2 * MEAN_BAND or abs(share - 1) > 2 * SPREAD_BAND


EXACT = ("weights", "worth", "drawn")


def _worth_given(i):
    weights = i["weights"][0]
    return {
        "effective sample size of the given weights": 1 / np.sum(weights[None] ** 2, axis=1),
        "n/2": np.array([len(weights) / 2]),
    }


LOCALISE = Task(
    id="11-localise",
    title="Monte Carlo localisation",
    call=CALLS["11-localise"],
    inputs=runs.runs,
    shapes=lambda i: {
        "rows": (*i["us"].shape[:2], *i["rows"].shape[1:]),
        "weights": (*i["us"].shape[:2], i["rows"].shape[1]),
    },
    laws=(
        Law(
            "mean",
            1,
            "the weighted mean is the Kalman filter's, where that is exact",
            lambda i, o: strays(i, o)[0] < MEAN_BAND,
            why=_why_off,
            asks="Where is each particle when the robot measures? By which factor does the scan "
            "change its weight, if the scan contains several landmarks?",
            step=_worth_given,
        ),
        Law(
            "spread",
            1,
            "the covariance is the Kalman filter's, where that is exact",
            lambda i, o: abs(strays(i, o)[1] - 1) < SPREAD_BAND,
            why=_why_off,
            asks="Do you multiply the weights by the likelihood once, and by no other factor? "
            "Does each particle move with its own noise, and by nothing else?",
            step=_worth_given,
        ),
        Law(
            "weights",
            1,
            "each weight is multiplied by the likelihood of the scan; the sum is one",
            _weights_right,
            why=_why_weights,
            asks="Which factors has the new weight of a particle? Is its own old weight one of "
            "them? Does the likelihood use all of R, and each landmark with its own measurement?",
            step=_worth_given,
        ),
        Law(
            "worth",
            1,
            "after a step the effective sample size is at least n/2",
            _in_time,
            why=_why_worth,
            asks="Which weights do you use for n_eff, and which ones follow resampling?",
            alone=False,
            step=_worth_given,
        ),
        Law(
            "drawn",
            1,
            "if odometry is nearly exact, the rows are the moved particles, resampled by their "
            "weights only if the effective sample size is less than n/2",
            _drawn_right,
            why=_why_drawn,
            asks="When do you resample? From which particles do you draw, and with which weights?",
            main=False,
            step=_worth_given,
        ),
    ),
    diagnoses=(
        Diagnosis(
            "not-normalised",
            "The weights do not sum to one. Normalise them.",
            lambda i, o: _sums_off(o).max() >= 1e-9,
            asks="What is the sum of your weights?",
        ),
        Diagnosis(
            "weighed-before-moving",
            "The scan is measured after the motion, but you weight the particles at their poses "
            "before the motion. Move the particles first, then compute the likelihoods.",
            _before_moving,
            asks="Where are the particles when you compute the likelihood of the scan?",
        ),
        Diagnosis(
            "moved-wrongly",
            "Your weights belong to the rows that you return, but without resampling these rows "
            "are not distributed as odometry states. Does each particle get its own noise of u, "
            "with the covariance C: variances, not standard deviations, and their correlation?",
            _moved_wrongly,
            asks="Many particles start at the same pose. How far do they spread in one step, and "
            "how far should they spread by C?",
        ),
        Diagnosis(
            "never-drawn",
            "The weights are right, but after a step the effective sample size is less than n/2. "
            "Resample when 1/Σ w² falls below n/2.",
            lambda i, o: _weights_right(i, o).all() and not _in_time(i, o).all(),
            asks="How large is 1/Σ w² of the weights that you return?",
        ),
    ),
    # not apart: which particles are drawn depends on the weights
    parts=lambda i, o: {"step": np.concatenate([o["rows"], o["weights"][..., None]], axis=-1)},
    needs=("11-draw",),
    probes=(
        Probe("odometry errors that are correlated", runs.related_wheels, ("mean", "spread")),
        Probe("odometry that is nearly exact", runs.sure_wheels, EXACT),
        Probe("one landmark", lambda r: runs.sure_wheels(r, marks=1), EXACT),
        Probe("particles metres off", lambda r: runs.sure_wheels(r, (0.3,), off=4.0), EXACT),
        Probe("seven particles", lambda r: runs.sure_wheels(r, samples=7), EXACT),
        Probe("one particle", lambda r: runs.sure_wheels(r, samples=1), EXACT),
    ),
    may_round=False,
    begins=(
        "Which functions of this exercise move particles, weight them, and draw them?",
        "In which order do motion and scan happen in one step?",
    ),
)
