"""Classic mistakes in an update, computed on the same beliefs, each with its hint."""

import numpy as np

from slamlab.exercises.law import Diagnosis
from slamlab.exercises.tasks.ex06_beliefs import T, covariance_mistake, same_block, same_mean
from slamlab.exercises.tasks.ex06_h import by_differences, columns
from slamlab.exercises.tasks.ex06_sights import innovation, truth, wrapped


def _step(inputs, P=None, H=None):
    """K, S, H, v of an update, with another P or H where given."""
    P = inputs["P"] if P is None else P
    H = by_differences(inputs) if H is None else H
    S = H @ P @ T(H) + inputs["R"]
    return P @ T(H) @ np.linalg.inv(S), S, H, wrapped(innovation(inputs))


def _moves(inputs, K, v):
    return (K @ v[..., None])[..., 0]


def _mean_is(formula):
    """Whether x equals what a formula gives, in units of the deviations."""

    def matches(inputs, outputs):
        return same_mean(outputs["x"], formula(inputs), inputs["P"]).all()

    return matches


def _without_S(inputs):
    _, _, H, v = _step(inputs)
    return inputs["x"] + _moves(inputs, inputs["P"] @ T(H), v)


def _printed_15(inputs):
    K, _, _, v = _step(inputs)
    return _moves(inputs, K, v)


def _sign(inputs):
    K, _, _, v = _step(inputs)
    return inputs["x"] - _moves(inputs, K, v)


def _unwrapped(inputs):
    K, *_ = _step(inputs)
    return inputs["x"] + _moves(inputs, K, innovation(inputs))


def _without_R(inputs):
    _, S, H, v = _step(inputs)
    K = inputs["P"] @ T(H) @ np.linalg.inv(S - inputs["R"])
    return inputs["x"] + _moves(inputs, K, v)


def _cross_ignored(inputs):
    n = inputs["x"].shape[1]
    owner = np.concatenate([[-1, -1, -1], np.arange(n - 3) // 2])
    return inputs["P"] * (owner[:, None] == owner)


def _apart(inputs):
    K, _, _, v = _step(inputs, _cross_ignored(inputs))
    return inputs["x"] + _moves(inputs, K, v)


def _apart_S(inputs):
    """P Hᵀ whole, and S without what robot and landmark share."""
    _, S, H, v = _step(inputs, _cross_ignored(inputs))
    return inputs["x"] + _moves(inputs, inputs["P"] @ T(H) @ np.linalg.inv(S), v)


def _some_rows_only(inputs, outputs):
    """Whether some of robot, landmark seen and others stayed, while some moved."""
    moved = np.abs(outputs["x"] - inputs["x"])
    parts = [moved[columns(inputs, which)].max() for which in ("robot", "seen", "others")]
    return max(parts) > 1e-4 and min(parts) < 1e-9


def _still(name):
    return lambda inputs, outputs: np.allclose(outputs[name], inputs[name], atol=1e-12)


def _P(formula):
    def made(inputs):
        K, S, H, _ = _step(inputs)
        return formula(inputs["P"], K, S, H)

    return made


def _before(inputs):
    return inputs["P"]


def _mistake(name, hint, *formulas):
    return covariance_mistake(name, hint, _before, *(_P(formula) for formula in formulas))


def _P_in_part(inputs, outputs):
    """Whether some entries of P are untouched, and others are not."""
    same = np.abs(outputs["P"] - inputs["P"]) < 1e-12
    return 0.05 < same.mean() < 1 and not same_block(outputs["P"], truth(inputs)[1]).all()


def _cross_zero(inputs, outputs):
    """Whether blocks between robot and landmarks, or between two landmarks, are exactly zero."""
    cross = _cross_ignored({"x": inputs["x"], "P": 1.0}) == 0
    return (outputs["P"][:, cross] == 0).any(axis=1).all()


MISTAKES = (
    Diagnosis(
        "printed-15",
        "x is K · innovation, as printed in Smolec's (15): the old x is lost. The innovation "
        "corrects what was believed.",
        _mean_is(_printed_15),
    ),
    Diagnosis(
        "sign",
        "x moves away from what was seen: the innovation is measured minus predicted, and is "
        "added.",
        _mean_is(_sign),
    ),
    Diagnosis(
        "S-missing",
        "The gain lacks S⁻¹: P Hᵀ v would move the state by more the larger the innovation's "
        "own uncertainty.",
        _mean_is(_without_S),
    ),
    Diagnosis(
        "R-missing",
        "S lacks R: the sight was taken for exact.",
        _mean_is(_without_R),
    ),
    Diagnosis(
        "kept-apart",
        "S (or K too) was made without the blocks between robot and landmarks. Both errors are "
        "in the innovation, and what they share decides how much is to be learned from it: use "
        "the whole of P.",
        lambda i, o: _mean_is(_apart)(i, o) or _mean_is(_apart_S)(i, o),
    ),
    Diagnosis(
        "x-stays",
        "x comes back as it went in: the innovation, weighed by K, has to be added.",
        _still("x"),
    ),
    Diagnosis(
        "some-rows-only",
        "Some parts of the state learned nothing. No block of K is zero: robot, the landmark "
        "seen and all the others are corrected, by all rows of K.",
        _some_rows_only,
    ),
    Diagnosis(
        "unwrapped",
        "The innovation's bearing is not wrapped: a landmark predicted at 179° and seen at "
        "−179° is 2° off, not 358°.",
        _mean_is(_unwrapped),
    ),
    Diagnosis(
        "P-stays",
        "P comes back as it went in: the robot has learned something and does not know it. "
        "P ← P − K S Kᵀ.",
        _still("P"),
    ),
    _mistake(
        "P-sign",
        "P grew: seeing something makes nobody less sure. Look at the sign of K S Kᵀ.",
        lambda P, K, S, H: P + K @ S @ T(K),
    ),
    _mistake(
        "S-inverse",
        "Not S⁻¹ stands between K and Kᵀ, but S: look at the units of K S Kᵀ.",
        lambda P, K, S, H: P - K @ np.linalg.inv(S) @ T(K),
        lambda P, K, S, H: P - K @ T(K),
    ),
    _mistake(
        "half-of-joseph",
        "(I − K H) P (I − K H)ᵀ alone leaves out the sight's own noise: Joseph's form adds K R Kᵀ.",
        lambda P, K, S, H: P - K @ H @ P - T(K @ H @ P) + K @ H @ P @ T(H) @ T(K),
    ),
    Diagnosis(
        "cross-zero",
        "Blocks of P beside the diagonal are zero. One sight corrects robot and landmarks "
        "together, so they share what is left of the error: keep all of P − K S Kᵀ.",
        _cross_zero,
    ),
    Diagnosis(
        "P-in-part",
        "Some blocks of P are as they were. K S Kᵀ has no zero block: the covariance of the "
        "unseen landmarks, and what they share, shrinks as well.",
        _P_in_part,
    ),
)
