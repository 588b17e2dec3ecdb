"""Classic mistakes in two updates of a covariance, most of them printed in the MAK thesis, 4.3.

Each is the wrong formula, computed on the same inputs.
"""

import numpy as np

from slamlab.exercises.law import Diagnosis
from slamlab.exercises.tasks.ex07_laws import T, close, mistake

ROBOT, FIRST, SECOND = slice(0, 3), slice(3, 5), slice(5, 7)
BLOCKS = ROBOT, FIRST, SECOND


def uncorrelated(P, blocks=BLOCKS):
    """Covariances without what these blocks share with each other."""
    kept = P.copy()
    for one in blocks:
        for other in blocks:
            if one != other:
                kept[:, one, other] = 0
    return kept


def _S(P, H, R):
    return H @ P @ T(H) + R


def right(P, H, R):
    K = P @ T(H) @ np.linalg.inv(_S(P, H, R))
    return P - K @ _S(P, H, R) @ T(K)


def gain_without_S(P, H, R):
    K = P @ T(H)
    return P - K @ _S(P, H, R) @ T(K)


def gain_without_S_short(P, H, R):
    return P - P @ T(H) @ H @ P


def sandwich_of_inverse(P, H, R):
    S = np.linalg.inv(_S(P, H, R))
    K = P @ T(H) @ S
    return P - K @ S @ T(K)


def noise_forgotten(P, H, R):
    return right(P, H, 0 * R)


def shares_ignored(P, H, R):
    """S as if robot and landmark did not err together."""
    S = H @ uncorrelated(P) @ T(H) + R
    return P - P @ T(H) @ np.linalg.inv(S) @ H @ P


def added(P, H, R):
    return 2 * P - right(P, H, R)


def joseph_without_noise(P, H, R):
    left = np.eye(7) - P @ T(H) @ np.linalg.inv(_S(P, H, R)) @ H
    return left @ P @ T(left)


def landmarks_unlinked(P, H, R):
    return uncorrelated(right(P, H, R), (FIRST, SECOND))


def all_unlinked(P, H, R):
    return uncorrelated(right(P, H, R))


def others_untouched(P, H, R):
    """The landmark that is not seen keeps its rows and columns."""
    after, unseen = right(P, H, R), SECOND if np.any(H[:, :, FIRST]) else FIRST
    after[:, unseen], after[:, :, unseen] = P[:, unseen], P[:, :, unseen]
    return after


def own_block_untouched(P, H, R):
    """The landmark that is not seen keeps its own block, its cross blocks follow."""
    after, unseen = right(P, H, R), SECOND if np.any(H[:, :, FIRST]) else FIRST
    after[:, unseen, unseen] = P[:, unseen, unseen]
    return after


def _once(formula):
    return lambda i: formula(i["P"], i["H_1"], i["R"])


def _twice(formula, then):
    return lambda i: then(_once(formula)(i), i["H_2"], i["R"])


def _prior_twice(inputs):
    return right(inputs["P"], inputs["H_2"], inputs["R"])


def _old_gain(formula):
    """The gain (and S) of the covariance before the first update, used after it."""

    def mixed(inputs):
        P, H, R = inputs["P"], inputs["H_2"], inputs["R"]
        S = _S(P, H, R)
        return formula(_once(right)(inputs), P @ T(H) @ np.linalg.inv(S), S, H)

    return mixed


def _both_forms(*formulas):
    """A mistake of the update: made in the first one, in the second one, or between the two."""

    def matches(inputs, outputs):
        return any(
            close(outputs["P_first"], _once(formula)(inputs)).all()
            or close(outputs["P_both"], _twice(right, formula)(inputs)).all()
            or close(outputs["P_both"], _twice(formula, right)(inputs)).all()
            for formula in formulas
        )

    return matches


def _overwritten(inputs, outputs):
    """Whether both are the covariance after both, as when P was changed in place."""
    both = _twice(right, right)(inputs)
    return bool((close(outputs["P_first"], both) & close(outputs["P_both"], both)).all())


ERRATA = (
    Diagnosis(
        "overwritten",
        "P_first was overwritten: it equals P_both. P -= … changes the array itself, and P_first "
        "is that array. Write P = P − …, or keep a copy.",
        _overwritten,
    ),
    Diagnosis(
        "gain-without-S",
        "The gain lacks S⁻¹, as in (4.19) of the thesis: K = P Hᵀ S⁻¹. P Hᵀ alone says how "
        "state and innovation err together; divided by how far the innovation errs, it is "
        "a gain.",
        _both_forms(gain_without_S, gain_without_S_short),
    ),
    Diagnosis(
        "inverse-in-the-sandwich",
        "This is P − K S⁻¹ Kᵀ, as in (4.22) of the thesis. Two S⁻¹ are in K Kᵀ already: "
        "between them S stands, not its inverse.",
        _both_forms(sandwich_of_inverse),
    ),
    Diagnosis(
        "noise-forgotten",
        "S holds no R: these observations would have no noise. What the innovation is unsure "
        "of is H P Hᵀ + R.",
        _both_forms(noise_forgotten),
    ),
    Diagnosis(
        "shares-ignored-in-S",
        "S leaves out what robot and landmark share. As long as P_rp = 0 this goes unnoticed; "
        "S = H P Hᵀ + R with the whole H and the whole P is always right.",
        _both_forms(shares_ignored),
    ),
    Diagnosis(
        "added",
        "K S Kᵀ was added. To see something makes more certain: P gets smaller.",
        _both_forms(added),
    ),
    Diagnosis(
        "joseph-without-noise",
        "(I − K H) P (I − K H)ᵀ is only half of Joseph's form: the noise that the gain lets in "
        "is missing, + K R Kᵀ.",
        _both_forms(joseph_without_noise),
    ),
    Diagnosis(
        "unlinked",
        "Cross blocks are zero that should not be. Both landmarks were seen from the same "
        "unsure robot: where it errs, both err with it. This is what the thesis' example is "
        "about.",
        _both_forms(landmarks_unlinked, all_unlinked),
    ),
    Diagnosis(
        "unseen-untouched",
        "The landmark that is not seen was left as it was. It shares an error with the robot, "
        "so what is learned of the robot is learned of it: K has rows for all of the state.",
        _both_forms(others_untouched, own_block_untouched),
    ),
    mistake(
        "covariance-before-the-first",
        "The second update works with the covariance from before the first one, as (4.37) "
        "of the thesis does for P_12. The second observation meets a robot that has "
        "seen p1: take P_first, for S and K as well.",
        _prior_twice,
        _old_gain(lambda P, K, S, H: P - K @ S @ T(K)),
        _old_gain(lambda P, K, S, H: P - K @ H @ P),
        output="P_both",
    ),
    mistake(
        "one-landmark-twice",
        "The second update uses H_1 again: p1 was seen twice, p2 never.",
        lambda i: right(_once(right)(i), i["H_1"], i["R"]),
        output="P_both",
    ),
    mistake(
        "second-first",
        "P_first is the covariance after seeing p2. The order does not matter for P_both, but "
        "P_first is asked for after p1.",
        lambda i: right(i["P"], i["H_2"], i["R"]),
        output="P_first",
    ),
)
