"""Task of exercise 07: two observations, which correlate landmarks (MAK 4.3.3)."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.task import Probe, Task
from course.exercises.ex07_correlations.beliefs import EXACT, T, covariances
from course.exercises.ex07_correlations.calls import CALLS
from slamlab.models import jacobians

ROBOT, FIRST, SECOND = BLOCKS = slice(0, 3), slice(3, 5), slice(5, 7)
ROWS = 8


def _strangers(P):
    return sum(_only(P, block) for block in BLOCKS)


def _only(P, block):
    kept = np.zeros_like(P)
    kept[:, block, block] = P[:, block, block]
    return kept


def _observations(rng, directions, distances):
    """(n, 2, 7) Jacobians by the whole state, of p1 and of p2."""
    H = np.zeros((2, len(directions), 2, 7))
    places = distances[..., None] * np.stack([np.cos(directions), np.sin(directions)], axis=-1)
    for row, pair in enumerate(places):
        for which, block in enumerate((FIRST, SECOND)):
            H_r = jacobians.H_robot(np.zeros(3), pair[which])
            H[which, row, :, ROBOT], H[which, row, :, block] = H_r, -H_r[:, :2]
    return {"H_1": H[0], "H_2": H[1]}


def _drawn(rng, n=ROWS, strangers=False, noise=1.0, directions=None):
    low = np.array([0.1, 0.1, 0.03, 0.2, 0.2, 0.2, 0.2])
    P = covariances(rng, low * rng.uniform(1, 3, (n, 7)))
    if directions is None:
        directions = rng.uniform(-np.pi, np.pi, (n, 2))
    sigmas = noise * np.column_stack([rng.uniform(0.05, 0.15, n), rng.uniform(0.02, 0.06, n)])
    seen = _observations(rng, directions, rng.uniform(0.8, 4, (n, 2)))
    return {"P": _strangers(P) if strangers else P, **seen, "R": covariances(rng, sigmas)}


def observations(rng):
    """Block-diagonal covariances, as in the thesis, and full ones."""
    halves = _drawn(rng, ROWS // 2, strangers=True), _drawn(rng, ROWS // 2)
    return {name: np.concatenate([half[name] for half in halves]) for name in halves[0]}


def _along_axes(rng):
    return _drawn(rng, 3, directions=np.array([[0, np.pi], [0, np.pi / 2], [-np.pi / 2, np.pi]]))


def _millimetres(rng):
    # lengths in mm, angles in mrad
    inputs = _drawn(rng, 2)
    return {
        "P": 1e6 * inputs["P"],
        **{n: inputs[n] for n in ("H_1", "H_2")},
        "R": 1e6 * inputs["R"],
    }


def _informed(inputs, *seen):
    """(P⁻¹ + Σ Hᵀ R⁻¹ H)⁻¹, least squares of everything at once."""
    weight = np.linalg.inv(inputs["R"])
    information = np.linalg.inv(inputs["P"])
    return np.linalg.inv(information + sum(T(inputs[H]) @ weight @ inputs[H] for H in seen))


def _first(inputs):
    return {"P_first": _informed(inputs, "H_1")}


def _both(inputs):
    return {"P_both": _informed(inputs, "H_1", "H_2")}


def _innovation(H, before):
    def step(inputs):
        P = inputs["P"] if before is None else before(inputs)["P_first"]
        S = inputs[H] @ P @ T(inputs[H]) + inputs["R"]
        return {f"S of {H}": S, f"P {H}ᵀ": P @ T(inputs[H])}

    return step


TWO_UPDATES = Task(
    id="07-two-updates",
    title="Two landmarks, two measurements",
    call=CALLS["07-two-updates"],
    inputs=observations,
    shapes={"P_first": (None, 7, 7), "P_both": (None, 7, 7)},
    probes=(
        Probe("robot and landmarks uncorrelated", lambda rng: _drawn(rng, 2, strangers=True)),
        Probe("landmarks straight ahead, behind and at the side", _along_axes),
        Probe("very accurate measurements", lambda rng: _drawn(rng, 2, noise=0.05)),
        Probe("very inaccurate measurements", lambda rng: _drawn(rng, 2, noise=50)),
        Probe("numbers in mm and mrad", _millimetres),
    ),
    laws=(
        equals(
            "first",
            1.5,
            "P_first⁻¹ = P⁻¹ + H_1ᵀ R⁻¹ H_1: information adds up",
            _first,
            tolerance=EXACT,
            asks="What is the innovation covariance S, and which rows does the gain have?",
            step=_innovation("H_1", None),
        ),
        equals(
            "both",
            1.5,
            "P_both⁻¹ = P⁻¹ + H_1ᵀ R⁻¹ H_1 + H_2ᵀ R⁻¹ H_2",
            _both,
            tolerance=EXACT,
            asks="Which covariance is the prior of the second update?",
            step=_innovation("H_2", _first),
            after=("first",),
        ),
        equals(
            "linked",
            1.5,
            "in P_both the cross-covariance of the two landmarks agrees with least squares",
            _both,
            parts={"P_both": np.s_[FIRST, SECOND]},
            tolerance=EXACT,
            asks="If the pose has an error of 10 cm, which errors do the two landmarks have?",
            after=("both",),
            step=_innovation("H_2", _first),
        ),
    ),
    begins=(
        "What is the covariance S of the innovation of a measurement with the Jacobian H_1?",
        "Which covariance is the prior of the second update?",
    ),
)
