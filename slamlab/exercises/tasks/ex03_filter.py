"""Exercise 03, the whole filter: equal to least squares over everything, and right about itself."""

import numpy as np

from slamlab.exercises.drives.ex03 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks import ex03_laws as law
from slamlab.exercises.tasks.ex03_laws import whitener
from slamlab.exercises.tasks.ex03_slips import MISTAKES
from slamlab.evaluation import band, nees

DRIVEN, STEPS = 60, 10
HONEST = 1 - 5e-7
"""How often NEES lies in its band when P is true."""


def drives(rng):
    """Many drives that begin with the same belief; only the measurements of each are told."""
    P, Q = law.covariances(rng, law.STATES, 0.6, 1.6, 1)[0], law.noises(rng, law.STATES, 1)[0]
    F, H = law.motions(rng, 1)[0], law.sensors(rng, 1)[0]
    R = law.noises(rng, law.MEASURED, 1)[0]
    F *= 1.05 / np.linalg.norm(F, 2)  # neither explodes nor dies within ten steps
    x = rng.choice([-1.0, 1.0], law.STATES) * rng.uniform(1, 4, law.STATES)
    truth, z = rng.multivariate_normal(x, P, DRIVEN), []
    for _ in range(STEPS):
        truth = truth @ F.T + rng.multivariate_normal(np.zeros(law.STATES), Q, DRIVEN)
        noise = rng.multivariate_normal(np.zeros(law.MEASURED), R, DRIVEN)
        z.append(truth @ H.T + noise)
    return {"x": x, "P": P, "F": F, "Q": Q, "H": H, "R": R, "z": np.stack(z, axis=1)}


def batch(i, steps):
    """Least squares over the start, all slips and the first measurements, for all drives at once.

    Parameters
    ----------
    i : inputs
    steps : int, how many measurements to take

    Returns
    -------
    (drives, n), (n, n) : the last state and its covariance
    """
    n, m = law.STATES, law.MEASURED
    start, slip, seen = (whitener(i[name]) for name in ("P", "Q", "R"))
    A = np.zeros((n + steps * (n + m), (steps + 1) * n))
    y = np.zeros((len(A), len(i["z"])))
    A[:n, :n], y[:n] = start, (start @ i["x"])[:, None]
    for k in range(steps):
        row, old, new = n + k * (n + m), slice(k * n, k * n + n), slice(k * n + n, k * n + 2 * n)
        A[row : row + n, old], A[row : row + n, new] = -slip @ i["F"], slip
        A[row + n : row + n + m, new] = seen @ i["H"]
        y[row + n : row + n + m] = seen @ i["z"][:, k].T
    states = np.linalg.lstsq(A, y, rcond=None)[0]
    return states[-n:].T, np.linalg.inv(A.T @ A)[-n:, -n:]


def _estimates(i, o):
    after = [batch(i, k + 1)[0] for k in range(STEPS)]
    return law.close(o["x"], np.stack(after, axis=1))


def _covariances(i, o):
    after = [batch(i, k + 1)[1] for k in range(STEPS)]
    return law.close(o["P"], np.broadcast_to(after, o["P"].shape))


def true_ends(i):
    """Where each drive ended, drawn from what all its measurements leave open.

    To draw the truth last, given the measurements, is as good as to draw it first, and it is in
    nobody's hands before. The draw hangs on the measurements alone, never on an answer.
    """
    mean, P = batch(i, STEPS)
    rng = np.random.default_rng(np.frombuffer(i["z"].tobytes()[:64], dtype="<u4"))
    return rng.multivariate_normal(np.zeros(law.STATES), P, DRIVEN) + mean


def _honest(i, o):
    low, high = band(law.STATES, DRIVEN, HONEST)
    return low <= nees(o["x"][:, -1] - true_ends(i), o["P"][:, -1]).mean() <= high


FILTER = Task(
    id="03-filter",
    title="The whole filter",
    drive=DRIVES["03-filter"],
    inputs=drives,
    shapes={
        "x": (DRIVEN, STEPS, law.STATES),
        "P": (DRIVEN, STEPS, law.STATES, law.STATES),
    },
    laws=(
        Law(
            "estimates",
            2,
            "after each measurement x is what least squares over all so far says",
            _estimates,
        ),
        Law(
            "covariances",
            1,
            "after each measurement P is the covariance of that estimate's error",
            _covariances,
        ),
        Law(
            "honest",
            1,
            f"the errors at the end of {DRIVEN} drives are as large as P says: NEES in its band",
            _honest,
        ),
    ),
    diagnoses=MISTAKES,
    needs=("03-predict", "03-update"),
)
