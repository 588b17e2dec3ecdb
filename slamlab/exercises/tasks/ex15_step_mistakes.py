"""Classic mistakes in a step of Gauss and Newton, computed on the same graphs, with their hints."""

import numpy as np

from slamlab.exercises.law import Diagnosis
from slamlab.exercises.tasks.ex15_graphs import best, each
from slamlab.geometry import compose, wrap
from slamlab.posegraph.edge_error import error, information
from slamlab.posegraph.edge_jacobians import J_i, J_j

TOLERANCE = 1e-4
"""Share of the largest step: one-sided differences and a strong prior on pose 0 pass."""


def moved(inputs, outputs):
    """(g, n, 3) by how much each pose was moved, headings wrapped."""
    step = outputs["result"] - inputs["poses"]
    step[..., 2] = wrap(step[..., 2])
    return step


def same(got, want):
    """(g,) whether steps agree."""
    error, size = (np.abs(a).max(axis=(1, 2)) for a in (got - want, want))
    return error <= TOLERANCE * size


def right_terms(A, B, L, e):
    """What an edge adds to the blocks ii, ij, ji, jj of H and to i, j of b."""
    return A.T @ L @ A, A.T @ L @ B, B.T @ L @ A, B.T @ L @ B, A.T @ L @ e, B.T @ L @ e


def normal(poses, pairs, measured, information, terms=right_terms, overwrite=False):
    """H (n, n, 3, 3) and b (n, 3) with what a mistake makes of an edge's terms."""
    n = len(poses)
    H, b = np.zeros((n, n, 3, 3)), np.zeros((n, 3))
    for (i, j), z, L in zip(pairs, measured, information, strict=True):
        at = poses[i], poses[j], z
        ii, ij, ji, jj, b_i, b_j = terms(J_i(*at), J_j(*at), L, error(*at))
        keep = 0.0 if overwrite else 1.0
        for row, column, block in ((i, i, ii), (i, j, ij), (j, i, ji), (j, j, jj)):
            H[row, column] = keep * H[row, column] + block
        b[i], b[j] = keep * b[i] + b_i, keep * b[j] + b_j
    return H, b


def solved(H, b, fixed=0):
    """(n, 3) the step that H and b tell, one pose held."""
    n = len(b)
    free = [k for k in range(n) if k != fixed]
    small = H[np.ix_(free, free)].transpose(0, 2, 1, 3).reshape(3 * n - 3, -1)
    step = np.zeros((n, 3))
    step[free] = -np.linalg.solve(small, b[free].ravel()).reshape(-1, 3)
    return step


def _by(terms=right_terms, overwrite=False, fixed=0):
    """A formula of steps."""

    def formula(inputs):
        return each(lambda *g: solved(*normal(*g, terms, overwrite), fixed), inputs)

    return formula


def _is(*formulas):
    """Whether the poses were moved as one of the formulas says."""

    def matches(inputs, outputs):
        step = moved(inputs, outputs)
        wanted = (np.array(formula(inputs)) for formula in formulas)
        for want in wanted:
            want[..., 2] = wrap(want[..., 2])
            if same(step, want).all():
                return True
        return False

    return matches


def _sign(inputs):
    return -each(best, inputs)


def _to(poses):
    """The formula of a step, from that of the poses after it."""
    return lambda inputs: poses(inputs) - inputs["poses"]


def _least_norm(*graph):
    H, b = normal(*graph)
    n = len(b)
    return -np.linalg.lstsq(H.transpose(0, 2, 1, 3).reshape(3 * n, -1), b.ravel(), rcond=1e-10)[
        0
    ].reshape(-1, 3)


def _anchor_moved(inputs, outputs):
    return np.abs(moved(inputs, outputs)[:, 0]).max() > 1e-6


def _another_pose_held(inputs, outputs):
    step = np.abs(moved(inputs, outputs)).max(axis=-1)
    return (step.min(axis=1) < 1e-9).all() and (step[:, 0] > 1e-6).any()


def _not_wrapped(inputs, outputs):
    return same(moved(inputs, outputs), each(best, inputs)).all()


def _turned_again(inputs, forth):
    """The step where each Λ was taken for the inverse of the covariance of z, and turned by θ_z."""
    z = forth * inputs["measured"]
    again = information(z, np.linalg.inv(inputs["information"]))
    return each(best, inputs | {"information": again})


def _no_information(A, B, L, e):
    return right_terms(A, B, np.eye(3), e)


def _covariance(A, B, L, e):
    return right_terms(A, B, np.linalg.inv(L), e)


def _b_without(A, B, L, e):
    return (*right_terms(A, B, L, e)[:4], A.T @ e, B.T @ e)


def _H_without(A, B, L, e):
    return (*right_terms(A, B, np.eye(3), e)[:4], *right_terms(A, B, L, e)[4:])


def _b_not_transposed(A, B, L, e):
    return (*right_terms(A, B, L, e)[:4], A @ L @ e, B @ L @ e)


def _H_not_transposed(A, B, L, e):
    return A @ L @ A, A @ L @ B, B @ L @ A, B @ L @ B, A.T @ L @ e, B.T @ L @ e


def _other_transposed(A, B, L, e):
    return A @ L @ A.T, A @ L @ B.T, B @ L @ A.T, B @ L @ B.T, A.T @ L @ e, B.T @ L @ e


def _never_transposed(A, B, L, e):
    return (*_H_not_transposed(A, B, L, e)[:4], A @ L @ e, B @ L @ e)


def _both_other(A, B, L, e):
    return (*_other_transposed(A, B, L, e)[:4], A @ L @ e, B @ L @ e)


def _diagonal_only(A, B, L, e):
    ii, ij, ji, jj, b_i, b_j = right_terms(A, B, L, e)
    return ii, 0 * ij, 0 * ji, jj, b_i, b_j


def _one_side(A, B, L, e):
    ii, ij, ji, jj, b_i, b_j = right_terms(A, B, L, e)
    return ii, ij, 0 * ji, jj, b_i, b_j


def _other_side(A, B, L, e):
    ii, ij, ji, jj, b_i, b_j = right_terms(A, B, L, e)
    return ii, 0 * ij, ji, jj, b_i, b_j


def _cross_exchanged(A, B, L, e):
    ii, ij, ji, jj, b_i, b_j = right_terms(A, B, L, e)
    return ii, ji, ij, jj, b_i, b_j


def _b_exchanged(A, B, L, e):
    ii, ij, ji, jj, b_i, b_j = right_terms(A, B, L, e)
    return ii, ij, ji, jj, b_j, b_i


TRANSPOSED = (
    "A transpose is missing or on the wrong side. H is the sum of JᵀΛJ and b that of JᵀΛe: the "
    "*first* J of each is transposed."
)
MISTAKES = (
    Diagnosis(
        "sign-of-b",
        "The poses move away from the best ones: H δ = −b, with a minus. χ² would grow.",
        _is(_sign),
    ),
    Diagnosis(
        "step-alone",
        "What came back is δ, the step. Add it to the poses.",
        _is(_to(lambda i: each(best, i))),
    ),
    Diagnosis(
        "composed",
        "The step was put on with ⊕. A and B are slopes by x, y and θ themselves: add δ to the "
        "numbers, then wrap.",
        _is(_to(lambda i: compose(i["poses"], each(best, i)))),
    ),
    Diagnosis(
        "another-pose-held",
        "A pose stays, but not pose 0: strike out the *first* three rows and columns.",
        _another_pose_held,
    ),
    Diagnosis(
        "gauge-free",
        "Pose 0 moved. Edges tell where poses lie to each other, not where all of them lie: H is "
        "singular, and what solves it is one of many. Hold pose 0: leave out its three rows and "
        "columns.",
        _is(lambda i: each(_least_norm, i)),
    ),
    Diagnosis(
        "not-wrapped",
        "The step is right, but a heading went beyond π: wrap the headings after adding δ.",
        _not_wrapped,
    ),
    Diagnosis(
        "information-ignored",
        "Λ was not used: every edge counts alike, metres as much as radians.",
        _is(_by(_no_information)),
    ),
    Diagnosis(
        "covariance-for-information",
        "Λ was inverted: it is the information, the inverse of the covariance, already. A sure "
        "edge has a large Λ and pulls hard.",
        _is(_by(_covariance)),
    ),
    Diagnosis(
        "information-turned",
        "Λ was turned by θ_z. It is the information of e already: who made the edge has turned it.",
        _is(lambda i: _turned_again(i, 1), lambda i: _turned_again(i, -1)),
    ),
    Diagnosis(
        "information-in-one",
        "Λ stands in one of H and b only. Both come from eᵀΛe: H has JᵀΛJ, b has JᵀΛe.",
        _is(_by(_b_without), _by(_H_without)),
    ),
    Diagnosis(
        "transpose",
        TRANSPOSED,
        _is(
            _by(_b_not_transposed),
            _by(_H_not_transposed),
            _by(_other_transposed),
            _by(_never_transposed),
            _by(_both_other),
        ),
    ),
    Diagnosis(
        "overwritten",
        "Each edge replaces what the edges before it wrote. A pose hangs on several edges: their "
        "parts are added, += for =.",
        _is(_by(overwrite=True)),
    ),
    Diagnosis(
        "no-cross-blocks",
        "The blocks between the poses are missing. An edge ties i and j: AᵀΛB stands in rows i, "
        "columns j, and BᵀΛA in rows j, columns i.",
        _is(_by(_diagonal_only)),
    ),
    Diagnosis(
        "half-of-cross",
        "Only one of the two blocks between i and j is there: H is symmetric, AᵀΛB in rows i, "
        "columns j and its transpose in rows j, columns i.",
        _is(_by(_one_side), _by(_other_side)),
    ),
    Diagnosis(
        "cross-exchanged",
        "Blocks have changed places: rows of i take Aᵀ, rows of j take Bᵀ.",
        _is(_by(_cross_exchanged), _by(_b_exchanged)),
    ),
    Diagnosis(
        "pose-0-moved",
        "Pose 0 moved. Edges tell where poses lie to each other, not where all of them lie: H is "
        "singular. Hold pose 0: leave out its three rows and columns.",
        _anchor_moved,
    ),
)
