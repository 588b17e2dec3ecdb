"""The task of exercise 07 about the vector from one landmark to another (MAK thesis, 4.3.5)."""

import numpy as np

from slamlab.exercises.drives.ex07 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex07_laws import T, close, covariances, mistake, samples, spread

N = 12
OWN, SHIFTED = slice(0, N), slice(N, 2 * N)


def maps(rng):
    """Robots with three landmarks; the same once more, all of it lying less surely in the world."""
    x = rng.uniform(-6, 6, (N, 9))
    x[:, 2] /= 2
    P = covariances(rng, np.array([0.1, 0.1, 0.03, *6 * [0.2]]) * rng.uniform(1, 3, (N, 9)))
    shift = np.zeros((9, 2))
    shift[[0, 3, 5, 7], 0] = shift[[1, 4, 6, 8], 1] = 1
    common = shift @ covariances(rng, rng.uniform(1, 2, (N, 2))) @ shift.T
    i, j = np.array([rng.permutation(3)[:2] for _ in range(N)]).T
    i[:3], j[:3] = rng.permutation([[0, 1, 2], [1, 2, 0]], axis=0)
    both = {"x": np.concatenate([x, x]), "P": np.concatenate([P, P + common])}
    return both | {"i": np.tile(i, 2).astype(float), "j": np.tile(j, 2).astype(float)}


def _block(inputs, one, other, before=3):
    """The block of P that two landmarks share, of the first N maps."""
    rows = (before + 2 * inputs[one][OWN].astype(int))[:, None, None] + np.array([[0], [1]])
    columns = (before + 2 * inputs[other][OWN].astype(int))[:, None, None] + np.array([[0, 1]])
    return inputs["P"][np.arange(N)[:, None, None], rows, columns]


def _place(inputs, one, before=3):
    """Where a landmark is believed to be."""
    columns = (before + 2 * inputs[one][OWN].astype(int))[:, None] + np.arange(2)
    return inputs["x"][np.arange(N)[:, None], columns]


def _vector(inputs, outputs):
    want = _place(inputs, "j") - _place(inputs, "i")
    return np.concatenate([close(outputs["delta"][part], want) for part in (OWN, SHIFTED)])


def _spread(inputs, outputs):
    errors = samples(inputs["P"][OWN])
    landmarks = errors[:, :, 3:].reshape(N, -1, 3, 2)
    each = np.arange(N)
    i, j = (inputs[name][OWN].astype(int) for name in "ij")
    return close(outputs["P_delta"][OWN], spread(landmarks[each, :, j] - landmarks[each, :, i]))


def _common(inputs, outputs):
    return close(outputs["P_delta"][SHIFTED], outputs["P_delta"][OWN])


# ---- mistakes -------------------------------------------------------------------------------


def _blocks(formula, before=3):
    """A formula of P_ii, P_jj and P_ij, on these inputs."""

    def wrong(inputs):
        P_ii, P_jj = _block(inputs, "i", "i", before), _block(inputs, "j", "j", before)
        return formula(P_ii, P_jj, _block(inputs, "i", "j", before))

    return wrong


def _right(P_ii, P_jj, P_ij):
    return P_ii - P_ij - T(P_ij) + P_jj


def _one_row_up(inputs, outputs):
    """Rows counted as if the robot had none, or as if landmarks counted from 1."""
    for before in (0, 1, 2):
        want = _place(inputs, "j", before) - _place(inputs, "i", before)
        if close(outputs["delta"][OWN], want).all():
            return True
        if close(outputs["P_delta"][OWN], _blocks(_right, before)(inputs)).all():
            return True
    return False


def _of_P(name, hint, *formulas):
    return mistake(name, hint, *map(_blocks, formulas), output="P_delta", rows=OWN)


RELATIVE = Task(
    id="07-relative",
    title="From one landmark to another",
    drive=DRIVES["07-relative"],
    inputs=maps,
    shapes={"delta": (2 * N, 2), "P_delta": (2 * N, 2, 2)},
    laws=(
        Law("vector", 1, "Δp is the way from landmark i to landmark j", _vector),
        Law("spread", 2, "P_Δ is the covariance of Δp over samples of the whole state", _spread),
        Law("common", 1, "an error that all landmarks share does not change P_Δ", _common),
    ),
    diagnoses=(
        Diagnosis(
            "wrong-rows",
            "These are other rows of the state. The robot's x, y, θ come first, and landmarks "
            "count from 0: landmark i begins at row 3 + 2 i.",
            _one_row_up,
        ),
        mistake(
            "vector-sign",
            "This is the way back, from j to i: Δp = p_j − p_i.",
            lambda i: _place(i, "i") - _place(i, "j"),
            output="delta",
            rows=OWN,
        ),
        mistake(
            "vector-sum",
            "Δp is a difference of two places: p_j − p_i.",
            lambda i: _place(i, "i") + _place(i, "j"),
            lambda i: _place(i, "j"),
            output="delta",
            rows=OWN,
        ),
        _of_P(
            "correlations-ignored",
            "P_ii + P_jj would be right were the errors independent. They are not: what both "
            "landmarks err by together drops out of their difference.",
            lambda P_ii, P_jj, P_ij: P_ii + P_jj,
        ),
        _of_P(
            "cross-signs",
            "The signs of the cross blocks: write the error of Δp as ẽ_j − ẽ_i and multiply out "
            "its square.",
            lambda P_ii, P_jj, P_ij: P_ii + P_ij + T(P_ij) + P_jj,
        ),
        _of_P(
            "transpose-missing",
            "P_ij was taken twice, and P_Δ is not symmetric. The other cross block is P_ji, "
            "which is P_ij transposed.",
            lambda P_ii, P_jj, P_ij: P_ii - 2 * P_ij + P_jj,
            lambda P_ii, P_jj, P_ij: P_ii - 2 * T(P_ij) + P_jj,
        ),
        _of_P(
            "cross-once",
            "Only one of the two cross blocks is there. The square of a difference has two mixed "
            "terms: P_ij and P_ji.",
            lambda P_ii, P_jj, P_ij: P_ii - P_ij + P_jj,
            lambda P_ii, P_jj, P_ij: P_ii - T(P_ij) + P_jj,
        ),
        _of_P(
            "subtracted",
            "The vectors are subtracted, their doubts are not: variances of a difference add up. "
            "Is this P_Δ positive definite?",
            lambda P_ii, P_jj, P_ij: P_jj - P_ii,
            lambda P_ii, P_jj, P_ij: P_ii - P_jj,
            lambda P_ii, P_jj, P_ij: P_ii - P_ij - T(P_ij) - P_jj,
            lambda P_ii, P_jj, P_ij: P_jj - P_ij - T(P_ij) - P_ii,
            lambda P_ii, P_jj, P_ij: -_right(P_ii, P_jj, P_ij),
        ),
        _of_P(
            "diagonal-only",
            "Only the variances are right: Δx and Δy err together as well, and their covariance "
            "stands beside the diagonal.",
            lambda P_ii, P_jj, P_ij: _right(P_ii, P_jj, P_ij) * np.eye(2),
        ),
    ),
)
