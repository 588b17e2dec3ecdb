"""Task of exercise 07: fusion of two correlated estimates."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, equals
from classroom.exercises.task import Probe, Task
from course.exercises.ex07_correlations.beliefs import EXACT, T, covariances
from course.exercises.ex07_correlations.calls import CALLS


def _drawn(rng, n=10, unit=1.0, shared=True):
    joint = covariances(rng, unit * rng.uniform(0.1, 0.4, (n, 4)), surplus=1)
    if not shared:
        joint[:, :2, 2:] = joint[:, 2:, :2] = 0
    errors = (np.linalg.cholesky(joint) @ rng.standard_normal((n, 4, 1)))[:, :, 0]
    place = unit * rng.uniform(1, 6, (n, 2)) * rng.choice([-1, 1], (n, 2))
    return _named(place + errors[:, :2], place + errors[:, 2:], joint)


def _named(a, b, joint):
    ours, theirs = slice(0, 2), slice(2, 4)
    P_a, P_b, P_ab = joint[:, ours, ours], joint[:, theirs, theirs], joint[:, ours, theirs]
    return {"a": a, "P_a": P_a, "b": b, "P_b": P_b, "P_ab": P_ab}


def _nearly_one(rng, n=3):
    # hardly a tenth of each error is its own
    common = covariances(rng, rng.uniform(0.2, 0.4, (n, 2)))
    own = covariances(rng, rng.uniform(0.02, 0.04, (2 * n, 2))).reshape(2, n, 2, 2)
    return _drawn(rng, n) | {"P_a": common + own[0], "P_b": common + own[1], "P_ab": common}


def _worse_copy(rng, n=3):
    # b is a plus independent noise: it has no information that a lacks
    P_a, own = covariances(rng, rng.uniform(0.1, 0.4, (2 * n, 2))).reshape(2, n, 2, 2)
    a = rng.uniform(-5, 5, (n, 2))
    return {"a": a, "P_a": P_a, "b": a + 0.3, "P_b": P_a + own, "P_ab": P_a}


def _opposed(rng, n=3):
    # negatively correlated errors
    inputs = _drawn(rng, n)
    joint = covariances(rng, rng.uniform(0.2, 0.3, (n, 2)))
    return inputs | {"P_a": joint, "P_b": 1.5 * joint, "P_ab": -0.9 * joint}


def _best(inputs):
    """Least squares: x = (Jᵀ W J)⁻¹ Jᵀ W (a, b), with J = (I, I)."""
    P_ab = inputs["P_ab"]
    joint = np.block([[inputs["P_a"], P_ab], [T(P_ab), inputs["P_b"]]])
    J = np.vstack([np.eye(2), np.eye(2)])
    JW = np.linalg.solve(joint, np.broadcast_to(J, (len(P_ab), 4, 2)))
    P = np.linalg.inv(T(JW) @ J)
    told = np.concatenate([inputs["a"], inputs["b"]], axis=1)[:, :, None]
    return {"x": (P @ T(JW) @ told)[:, :, 0], "P": P}


def _innovation(inputs):
    S = inputs["P_a"] + inputs["P_b"] - inputs["P_ab"] - T(inputs["P_ab"])
    return {"S": S, "S_xv": inputs["P_a"] - inputs["P_ab"]}


def _promised(inputs):
    P_ab = inputs["P_ab"]
    found = np.linalg.eigvalsh(np.block([[inputs["P_a"], P_ab], [T(P_ab), inputs["P_b"]]]))
    return found[:, 0] > 1e-5 * found[:, 3]


def _between(inputs, outputs):
    """Whether all P⁻¹ = w P_a⁻¹ + (1 − w) P_b⁻¹ with 0 ≤ w ≤ 1, not all w equal."""
    P_a, P_b, P = (
        np.linalg.pinv(M).reshape(-1, 4) for M in (inputs["P_a"], inputs["P_b"], outputs["P"])
    )
    way, gone = P_a - P_b, P - P_b
    w = (gone * way).sum(axis=1) / (way**2).sum(axis=1)
    off = np.linalg.norm(gone - w[:, None] * way, axis=1) / np.linalg.norm(way, axis=1)
    return (off < 1e-6).all() and w.min() > -1e-6 and w.max() < 1 + 1e-6 and np.ptp(w) > 1e-6


FUSE = Task(
    id="07-fuse",
    title="Fusion of correlated estimates",
    call=CALLS["07-fuse"],
    inputs=_drawn,
    shapes={"x": (None, 2), "P": (None, 2, 2)},
    probes=(
        Probe("uncorrelated errors", lambda rng: _drawn(rng, 3, shared=False)),
        Probe("errors with a correlation of nearly 1", _nearly_one),
        Probe("b is a plus independent noise", _worse_copy),
        Probe("negatively correlated errors", _opposed),
        Probe("large numbers", lambda rng: _drawn(rng, 3, unit=1e3)),
    ),
    laws=(
        equals(
            "best",
            2,
            "x is the least squares estimate from a and b, which has the smallest covariance",
            lambda inputs: {"x": _best(inputs)["x"]},
            tolerance=EXACT,
            asks="S is the covariance of one random vector, S_xv the cross-covariance of two. "
            "Which vectors are these? Expand E[(ã − b̃)(ã − b̃)ᵀ] and E[ã (ã − b̃)ᵀ].",
            step=_innovation,
        ),
        equals(
            "honest",
            2,
            "P is the covariance of the error of the best x",
            lambda inputs: {"P": _best(inputs)["P"]},
            tolerance=EXACT,
            asks="The error of x is ã − K (ã − b̃). What is its covariance?",
            step=_innovation,
        ),
    ),
    diagnoses=(
        Diagnosis(  # the w that is best hangs on how it was sought, so no program is like another
            "covariance-intersection",
            "Your P lies between P_a and P_b. It is the P of covariance intersection, a method "
            "for unknown P_ab. You know P_ab, and with it you get a smaller covariance.",
            _between,
            asks="How does your P change if P_ab changes?",
        ),
    ),
    may_round=_promised,
    begins=(
        "What is the error of a + K (b − a), expressed by the errors of a and b?",
        "Which K makes the covariance of this error smallest?",
    ),
)
