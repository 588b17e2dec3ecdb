"""The task of exercise 07 about SLAM in one dimension: correlations kept, judged by NEES."""

import numpy as np

from slamlab.exercises.drives.ex07 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex07_laws import close
from slamlab.evaluation import band, nees

RUNS, STEPS = 90, 24
DOORS = np.array([2.0, 5.0, 9.0])  # where they truly are [m]; a linear filter errs alike anywhere
PRIOR = 2.0  # standard deviation of what is known of the doors at first [m]
SURE = 1 - 2e-7
"""How often a right filter's NEES lies inside the band."""


def walks(rng):
    """Walks to and fro along a corridor whose doors are hardly known, one door seen each step."""
    q, r = rng.uniform(0.02, 0.15, (RUNS, STEPS)) ** 2, rng.uniform(0.03, 0.1, (RUNS, STEPS)) ** 2
    way = truth()
    d = np.diff(way, prepend=0) + np.sqrt(q) * rng.standard_normal((RUNS, STEPS))
    doors = rng.integers(1, 4, (RUNS, STEPS))
    doors[:, :3] = rng.permuted(np.tile([1, 2, 3], (RUNS, 1)), axis=1)
    z = DOORS[doors - 1] - way + np.sqrt(r) * rng.standard_normal((RUNS, STEPS))
    x = np.column_stack([np.zeros(RUNS), DOORS + PRIOR * rng.standard_normal((RUNS, 3))])
    P = np.tile(np.diag([0, PRIOR**2, PRIOR**2, PRIOR**2]), (RUNS, 1, 1))
    return {"x": x, "P": P, "d": d, "q": q, "i": doors.astype(float), "z": z, "r": r}


def truth():
    """(steps,) where the robot truly is after each step [m]: to and fro."""
    return 4 + 4 * np.sin(np.arange(1, STEPS + 1) * 0.7 - 0.9)


def batch(inputs):
    """Robot's end and doors from all drives and sights at once, by weighted least squares.

    Unknown are the positions after each step and the doors; a row for each thing that was told.

    Returns
    -------
    x (runs, 4), P (runs, 4, 4)
    """
    k, told, of_doors = np.arange(STEPS), 2 * STEPS + 3, STEPS - 1 + inputs["i"].astype(int)
    J, y = np.zeros((RUNS, told, STEPS + 3)), np.zeros((RUNS, told))
    J[:, k, k], J[:, k[1:], k[:-1]] = 1, -1
    y[:, :STEPS] = inputs["d"]
    J[:, STEPS + k, k] = -1
    J[np.arange(RUNS)[:, None], STEPS + k, of_doors] = 1
    y[:, STEPS : 2 * STEPS] = inputs["z"]
    J[:, [-3, -2, -1], [-3, -2, -1]] = 1
    y[:, -3:] = inputs["x"][:, 1:]
    prior = np.diagonal(inputs["P"], axis1=1, axis2=2)[:, 1:]
    weight = 1 / np.concatenate([inputs["q"], inputs["r"], prior], axis=1)
    P = np.linalg.inv(J.transpose(0, 2, 1) @ (weight[:, :, None] * J))
    x = (P @ (J.transpose(0, 2, 1) @ (weight * y)[:, :, None]))[:, :, 0]
    end = slice(STEPS - 1, None)
    return x[:, end], P[:, end, end]


def _mean(inputs, outputs):
    return close(outputs["x"], batch(inputs)[0])


def _covariance(inputs, outputs):
    return close(outputs["P"], batch(inputs)[1])


def _nees(inputs, outputs):
    low, high = band(4, RUNS, SURE)
    errors = outputs["x"] - np.array([truth()[-1], *DOORS])
    return low <= nees(errors, outputs["P"]).mean() <= high


# ---- mistakes: a wrong filter, run on the same walks ----------------------------------------


ROBOT = np.array([1, 0, 0, 0])
_ONE_ENTRY = np.diag(ROBOT)


def same(variance):
    return variance


def filtered(
    inputs, q=same, r=same, v=1, keep=1, shares=1, moved=ROBOT, noisy=_ONE_ENTRY, stays=""
):
    """A filter that can be made wrong, all runs at once.

    Parameters
    ----------
    q, r : what is made of these variances
    v : float, factor of the innovation
    keep : (4, 4), 0 where P is forgotten after each step
    shares : float, share of P_ri in S
    moved : (4,) what a drive moves
    noisy : (4, 4) where a drive makes less certain
    stays : "x" or "xP", what of the doors out of sight a sight does not change

    Returns
    -------
    x (runs, 4), P (runs, 4, 4)
    """
    x, P, each = inputs["x"].copy(), inputs["P"].copy(), np.arange(RUNS)
    for k in range(STEPS):
        i = inputs["i"][:, k].astype(int)
        x += moved * inputs["d"][:, k, None]
        P += q(inputs["q"][:, k])[:, None, None] * noisy
        PH = P[each, :, i] - P[:, :, 0]
        S = P[each, i, i] + P[:, 0, 0] - 2 * shares * P[each, 0, i] + r(inputs["r"][:, k])
        K = PH / S[:, None]
        seen = np.eye(4)[i] + ROBOT
        correction = v * K * (inputs["z"][:, k] - x[each, i] + x[:, 0])[:, None]
        x += seen * correction if "x" in stays else correction
        lost = K[:, :, None] * PH[:, None, :]
        P -= seen[:, :, None] * seen[:, None, :] * lost if "P" in stays else lost
        P *= keep
    return x, P


def _runs_as(*filters):
    """Whether the answer is what one of these filters makes of the walks."""

    def matches(inputs, outputs):
        found = (one(inputs) for one in filters)
        alike = (close(outputs["x"], x) & close(outputs["P"], P) for x, P in found)
        # what is no covariance any more may blow rounding up, in a run or two
        return any(runs.mean() > 0.9 for runs in alike)

    return matches


def _as(**wrong):
    return lambda inputs: filtered(inputs, **wrong)


_DOORS_APART = np.eye(4)
_DOORS_APART[0] = _DOORS_APART[:, 0] = 1
_ROBOT_APART = np.ones((4, 4))
_ROBOT_APART[0, 1:] = _ROBOT_APART[1:, 0] = 0

CORRIDOR = Task(
    id="07-corridor",
    title="SLAM in a corridor",
    drive=DRIVES["07-corridor"],
    inputs=walks,
    shapes={"x": (RUNS, 4), "P": (RUNS, 4, 4)},
    laws=(
        Law("mean", 1, "x is what least squares makes of all drives and sights at once", _mean),
        Law("covariance", 1, "P is the covariance of that least-squares solution", _covariance),
        Law("nees", 2, f"over {RUNS} runs the mean NEES of the end lies in its band", _nees),
    ),
    diagnoses=(
        Diagnosis(
            "forgotten",
            "Correlations are forgotten after a step. The next sight then counts as fresh news "
            "what came from the same error, and the filter is too sure: this is what NEES shows.",
            _runs_as(_as(keep=np.eye(4)), _as(keep=_DOORS_APART), _as(keep=_ROBOT_APART)),
        ),
        Diagnosis(
            "others-not-moved",
            "Only the robot and the door in sight learn from a sight. The other doors err together "
            "with the robot: K has an entry for each of them.",
            _runs_as(_as(stays="xP"), _as(stays="x")),
        ),
        Diagnosis(
            "innovation-sign",
            "x walks away from what is seen: the innovation is what is seen less what was "
            "expected, z − (x_i − x_0), and H has −1 for the robot and 1 for the door.",
            _runs_as(_as(v=-1)),
        ),
        Diagnosis(
            "not-moved",
            "A drive moves the robot by d and leaves the doors where they are.",
            _runs_as(_as(moved=np.zeros(4)), _as(moved=np.ones(4)), _as(moved=-ROBOT)),
        ),
        Diagnosis(
            "drive-noise-missing",
            "A drive makes the robot less certain: q is added to P_rr, once each step.",
            _runs_as(_as(q=np.zeros_like)),
        ),
        Diagnosis(
            "doors-made-noisy",
            "q was added to more than the robot's variance. Doors do not move when the robot "
            "drives, so a drive does not make them less certain.",
            _runs_as(_as(noisy=np.eye(4)), _as(noisy=np.ones((4, 4)))),
        ),
        Diagnosis(
            "sight-noise-missing",
            "S holds no r: sights would have no noise. S = H P Hᵀ + r.",
            _runs_as(_as(r=np.zeros_like)),
        ),
        Diagnosis(
            "standard-deviation",
            "q and r are variances already: look whether you take a square or a root of one.",
            _runs_as(
                _as(q=np.square, r=np.square),
                _as(q=np.sqrt, r=np.sqrt),
                _as(q=np.square),
                _as(q=np.sqrt),
                _as(r=np.square),
                _as(r=np.sqrt),
            ),
        ),
        Diagnosis(
            "shares-ignored-in-S",
            "S = P_rr + P_ii + r leaves out what robot and door share: H P Hᵀ = P_rr − 2 P_ri + "
            "P_ii.",
            _runs_as(_as(shares=0)),
        ),
    ),
)
