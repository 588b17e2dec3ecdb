"""Exercise 05, localise: a whole run in a known map, judged by whether its errors fit its P.

Many robots drive the same way, each with errors of its own. The errors are whitened: over all runs
they have exactly the covariances that the filters are told. Then NEES is 3 on average, not by
chance but up to the model's curvature, and the truth is the mean of what the runs were told.
"""

import numpy as np

from slamlab import jacobians, models
from slamlab.checks.drives.ex05 import DRIVES
from slamlab.checks.task import Diagnosis, Law, Task
from slamlab.checks.tasks.ex05_batch import (
    SHARE,
    covariances,
    deviations,
    each,
    gain,
    innovation,
    off_pose,
    same_covariance,
    sandwich,
    times,
)
from slamlab.evaluation import nees
from slamlab.geometry import wrap

RUNS, STEPS, LANDMARKS = 40, 8, 4
UNSEEN = (0, 3)  # steps that see nothing
WHEELS = np.array([0.04, 0.02])  # standard deviations of d [m] and Δθ [rad]
EYES = np.array([0.05, 0.02])  # of r [m] and β [rad]
NEES = 3.0
NEES_OFF = 0.3  # what curvature may do to the mean over runs
WORSE = 1.1  # times the error of a filter that does all it can


def runs(rng):
    """One way driven by many robots, each with its own errors in start, wheels and sightings."""
    turns = rng.choice([-1.0, 1.0]) * rng.uniform(0.2, 0.5, STEPS)
    drives = np.column_stack([rng.uniform(0.4, 0.7, STEPS), turns])
    start = np.array([*rng.uniform(-5, 5, 2), rng.uniform(-3, 3)])
    path = driven(start, drives)
    landmarks, ids = _around(rng, path.mean(axis=0)), rng.integers(0, LANDMARKS, STEPS)
    ids[list(UNSEEN)] = -1
    seen = ids >= 0
    P = covariances(rng, np.array([[0.1, 0.1, 0.04]]))[0]
    white = whitened(rng, RUNS, 3 + 2 * STEPS + 2 * int(seen.sum()))
    of_start, of_wheels, of_eyes = np.split(white, [3, 3 + 2 * STEPS], axis=1)
    zs = np.zeros((RUNS, STEPS, 2))
    zs[:, seen] = each(models.h, path[seen], landmarks[ids[seen]])
    zs[:, seen] += of_eyes.reshape(RUNS, -1, 2) * EYES
    zs[..., 1] = wrap(zs[..., 1])
    x = start + of_start @ np.linalg.cholesky(P).T
    x[:, 2] = wrap(x[:, 2])

    def shared(a):
        return np.repeat(a[None], RUNS, axis=0)

    return {
        "x": x,
        "P": shared(P),
        "drives": drives + of_wheels.reshape(RUNS, STEPS, 2) * WHEELS,
        "ids": shared(ids),
        "zs": zs,
        "landmarks": shared(landmarks),
        "C": shared(np.diag(WHEELS**2)),
        "R": shared(np.diag(EYES**2)),
    }


def whitened(rng, count, size):
    """Samples (count, size) whose mean is 0 and whose covariance is 1, exactly."""
    white = rng.standard_normal((count, size))
    white -= white.mean(axis=0)
    return white @ np.linalg.inv(np.linalg.cholesky(white.T @ white / count)).T


def driven(x, drives):
    """The poses (n, 3) after each of the drives (n, 2)."""
    poses = []
    for u in drives:
        x = models.f_odometry(x, u)
        poses.append(x)
    return np.array(poses)


def _around(rng, centre):
    """Landmarks 3.5 to 5 m off the middle of the way, all the way round."""
    angle = (np.arange(LANDMARKS) + 0.6 * rng.random(LANDMARKS)) * 2 * np.pi / LANDMARKS
    r = rng.uniform(3.5, 5, LANDMARKS)
    return centre[:2] + np.column_stack([r * np.cos(angle), r * np.sin(angle)])


# ---- laws -----------------------------------------------------------------------------------


def truth(inputs):
    """The poses (n, 3) that were driven: the errors of all runs have mean zero."""
    first = inputs["x"][0]
    start = first + off_pose(inputs["x"], first).mean(axis=0)
    return driven(start, inputs["drives"].mean(axis=0))


def errors(inputs, xs):
    """(m, n, 3) estimates minus truth, headings wrapped."""
    return off_pose(xs, truth(inputs)[None])


def _unseen(inputs, outputs):
    before = np.concatenate([inputs["x"][:, None], outputs["xs"][:, :-1]], axis=1)
    blind = inputs["ids"][0] < 0
    moved = [
        each(models.f_odometry, before[:, k], inputs["drives"][:, k]) for k in np.flatnonzero(blind)
    ]
    off = off_pose(outputs["xs"][:, blind], np.swapaxes(moved, 0, 1))
    return np.abs(off).max(axis=(1, 2)) < 1e-6


def _close(inputs, outputs):
    far = np.square(errors(inputs, outputs["xs"])[..., :2]).sum(axis=-1).mean(axis=0)
    best, _ = filtered(inputs)
    near = np.square(errors(inputs, best)[..., :2]).sum(axis=-1).mean(axis=0)
    return np.sqrt(far) <= WORSE * np.sqrt(near)


def _consistent(inputs, outputs):
    mean = nees(errors(inputs, outputs["xs"]), outputs["Ps"]).mean(axis=0)
    return np.abs(mean - NEES) < NEES_OFF


# ---- mistakes: a filter over all runs at once, and what can be done wrong in its loop ----------


def filtered(inputs, step=None):
    """Estimates (m, n, 3) and covariances (m, n, 3, 3) of all runs.

    Parameters
    ----------
    inputs : of the task
    step : (x, P, k, drive, look) -> x, P, what is done in a step; None: drive, then look
    """
    landmarks, R, x, P, history = inputs["landmarks"], inputs["R"], inputs["x"], inputs["P"], []

    def drive(x, P, k):
        u = inputs["drives"][:, k]
        A, W = each(jacobians.A_odometry, x, u), each(jacobians.W_odometry, x, u)
        return each(models.f_odometry, x, u), sandwich(A, P) + sandwich(W, inputs["C"])

    def look(x, P, k, always=False):
        id = inputs["ids"][0, k]
        if id < 0 and not always:
            return x, P
        p, z = landmarks[:, id], inputs["zs"][:, k]
        K, S = gain(P, each(jacobians.H_robot, x, p), R)
        return x + times(K, innovation(x, p, z)), P - sandwich(K, S)

    for k in range(STEPS):
        x, P = step(x, P, k, drive, look) if step else look(*drive(x, P, k), k)
        history.append((x, P))
    xs, Ps = zip(*history, strict=True)
    return np.stack(xs, axis=1), np.stack(Ps, axis=1)


def _loop(name, hint, step):
    """A diagnosis: the run is what another loop makes of it."""

    def matches(inputs, outputs):
        xs, Ps = filtered(inputs, lambda *given: step(inputs, *given))
        near = np.abs(off_pose(outputs["xs"], xs)) <= SHARE * deviations(Ps)
        return near.all() and same_covariance(outputs["Ps"], Ps).all()

    return Diagnosis(name, hint, matches)


def _keeps_P_of_drive(inputs, x, P, k, drive, look):
    x, P = drive(x, P, k)
    return look(x, P, k)[0], P


def _one_behind(inputs, outputs):
    xs, _ = filtered(inputs)
    late = np.concatenate([inputs["x"][:, None], xs[:, :-1]], axis=1)
    return np.abs(off_pose(outputs["xs"], late)).max() < 1e-5


LOCALISE = Task(
    id="05-localise",
    title="Localise: a whole run",
    drive=DRIVES["05-localise"],
    inputs=runs,
    shapes={"xs": (RUNS, STEPS, 3), "Ps": (RUNS, STEPS, 3, 3)},
    laws=(
        Law("unseen", 1, "where nothing is seen, the pose goes where f takes it", _unseen),
        Law("close", 1, "the error is no larger than the sightings allow", _close),
        Law(
            "consistent",
            2,
            f"x̃ᵀ P⁻¹ x̃ is {NEES:.0f} on average over {RUNS} robots, after every step",
            _consistent,
        ),
    ),
    diagnoses=(
        Diagnosis(
            "one-behind",
            "Each entry is one step late: xs[0] is the start. Append after the drive and the "
            "sighting, not before.",
            _one_behind,
        ),
        _loop(
            "look-first",
            "You look, then drive. Sighting k was made after drive k: predict first.",
            lambda i, x, P, k, drive, look: drive(*look(x, P, k), k),
        ),
        _loop(
            "drives-only",
            "The sightings are not used: this is odometry, with an honest P that grows and grows.",
            lambda i, x, P, k, drive, look: drive(x, P, k),
        ),
        _loop(
            "minus-one-seen",
            "Where ids[k] is −1 nothing was seen, but you update all the same: landmarks[-1] is "
            "the last landmark to Python, without a complaint.",
            lambda i, x, P, k, drive, look: look(*drive(x, P, k), k, always=True),
        ),
        _loop(
            "blind-drive-lost",
            "Where nothing is seen, the drive is skipped, too. The robot moves with its eyes shut: "
            "predict in every step.",
            lambda i, x, P, k, drive, look: (
                look(*drive(x, P, k), k) if i["ids"][0, k] >= 0 else (x, P)
            ),
        ),
        _loop(
            "covariance-restarted",
            "Every step starts from the first P. Each step's P is made from the one before: hand "
            "it on as you do with x.",
            lambda i, x, P, k, drive, look: look(*drive(x, i["P"], k), k),
        ),
        _loop(
            "pose-restarted",
            "Every step starts from the first pose and P: hand both on.",
            lambda i, x, P, k, drive, look: look(*drive(i["x"], i["P"], k), k),
        ),
        _loop(
            "sighting-keeps-P",
            "The sighting corrects x, and its P is thrown away: x, P = locate(...).",
            _keeps_P_of_drive,
        ),
        _loop(
            "drive-keeps-P",
            "The drive moves x, and its P is thrown away: x, P = predict(...).",
            lambda i, x, P, k, drive, look: look(drive(x, P, k)[0], P, k),
        ),
    ),
    needs=("05-predict", "05-locate"),
)
