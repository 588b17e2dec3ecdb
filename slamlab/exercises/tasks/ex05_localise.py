"""Exercise 05, localise: a whole run in a known map, judged by whether its errors fit its P."""

import numpy as np

from slamlab import models
from slamlab.evaluation import nees
from slamlab.exercises.drives.ex05 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex05_batch import (
    SHARE,
    deviations,
    each,
    gain,
    innovation,
    off_pose,
    same_covariance,
    sandwich,
    times,
)
from slamlab.exercises.tasks.ex05_runs import RUNS, STEPS, errors, runs
from slamlab.models import jacobians

NEES = 3.0
NEES_OFF = 0.3  # what curvature may do to the mean over runs
WORSE = 1.1  # times the error, and the σ, of a filter that does all it can


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
    # who does not look is honest, too, with a large P: that alone earns nothing
    sigma, least = (deviations(Ps).mean(axis=0) for Ps in (outputs["Ps"], filtered(inputs)[1]))
    return (np.abs(mean - NEES) < NEES_OFF) & (sigma <= WORSE * least).all(axis=-1)


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

    def look(x, P, k, when=lambda id: id >= 0, row=lambda k, id: k):
        id = inputs["ids"][0, k]
        if not when(id):
            return x, P
        p, z = landmarks[:, id], inputs["zs"][:, row(k, id)]
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


def _skipped(inputs, outputs):
    moved = [
        each(models.f_odometry, outputs["xs"][:, k - 1], inputs["drives"][:, k])
        for k in range(1, STEPS)
    ]
    off = off_pose(outputs["xs"][:, 1:], np.swapaxes(moved, 0, 1))
    return (np.abs(off).max(axis=(0, 2)) < 1e-6)[inputs["ids"][0, 1:] >= 0].any()


def _aliased(inputs, outputs):
    return (outputs["xs"][:, 1:] == outputs["xs"][:, :-1]).all(axis=(0, 2)).any()


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
            f"x̃ᵀ P⁻¹ x̃ is {NEES:.0f} on average over {RUNS} robots, after every step, and P is no "
            "larger than the sightings allow",
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
            lambda i, x, P, k, drive, look: look(*drive(x, P, k), k, when=lambda id: True),
        ),
        _loop(
            "zero-skipped",
            "Landmark 0 is a landmark like the others, row 0 of landmarks. You skip its sightings: "
            "only −1 says that nothing was seen.",
            lambda i, x, P, k, drive, look: look(*drive(x, P, k), k, when=lambda id: id > 0),
        ),
        _loop(
            "id-as-truth",
            "if id: takes −1 for true and 0 for false. Nothing was seen where ids[k] is −1, and 0 "
            "is a landmark.",
            lambda i, x, P, k, drive, look: look(*drive(x, P, k), k, when=lambda id: id != 0),
        ),
        _loop(
            "z-by-id",
            "You take row ids[k] of zs. zs has a row for each step, landmarks one for each id: "
            "zs[k] and landmarks[ids[k]].",
            lambda i, x, P, k, drive, look: look(*drive(x, P, k), k, row=lambda k, id: id),
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
        Diagnosis(
            "aliased",
            "Entries of xs are equal, though the robot moves in every step. Did you append one and "
            "the same array and change it in place? Append a copy.",
            _aliased,
        ),
        Diagnosis(
            "sighting-skipped",
            "After a sighting the pose is just where f takes it: that sighting is not used. Update "
            "in every step where ids[k] is not −1.",
            _skipped,
        ),
    ),
    needs=("05-predict", "05-locate"),
)
