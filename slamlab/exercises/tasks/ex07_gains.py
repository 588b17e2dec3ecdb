"""Classic mistakes in the fusion of two estimates that share an error, each with its hint."""

import numpy as np

from slamlab.exercises.law import Diagnosis
from slamlab.exercises.tasks.ex07_laws import TOLERANCE, T, close


def gained(C, S, claim=None):
    """x = a + K (b − a), K = C S⁻¹, and P = P_a − K S Kᵀ; C and S are made from P_a, P_b, P_ab.

    Returns
    -------
    inputs -> x (cases, samples, 2); inputs -> P (cases, 2, 2)
    """

    def gain(i):
        blocks = i["P_a"], i["P_b"], i["P_ab"]
        return C(*blocks) @ np.linalg.inv(S(*blocks)), S(*blocks)

    def x(i):
        return i["a"] + (i["b"] - i["a"]) @ T(gain(i)[0])

    def P(i):
        K, S = gain(i)
        return i["P_a"] - K @ S @ T(K) if claim is None else claim(K, i["P_a"], i["P_b"], i["P_ab"])

    return x, P


def _S(a, b, ab):
    return a + b - ab - T(ab)


def _C(a, b, ab):
    return a - ab


RIGHT = gained(_C, _S)
IGNORED = gained(lambda a, b, ab: a, lambda a, b, ab: a + b)
STANDARD = gained(_C, _S, lambda K, a, b, ab: a - K @ a)
BLIND = gained(_C, _S, lambda K, a, b, ab: (np.eye(2) - K) @ a @ T(np.eye(2) - K) + K @ b @ T(K))
PLUS = [
    gained(lambda a, b, ab: a + ab, lambda a, b, ab: a + b + ab + T(ab)),
    gained(_C, lambda a, b, ab: a + b + ab + T(ab)),
    gained(lambda a, b, ab: a + ab, _S),
]
HALF = [
    gained(_C, lambda a, b, ab: a + b),
    gained(lambda a, b, ab: a, _S),
    gained(_C, lambda a, b, ab: a + b - ab),
    gained(_C, lambda a, b, ab: a + b - T(ab)),
]
UNTURNED = [
    gained(_C, lambda a, b, ab: a + b - 2 * ab),
    gained(_C, lambda a, b, ab: a + b - 2 * T(ab)),
    gained(lambda a, b, ab: a - T(ab), _S),
    gained(lambda a, b, ab: a - T(ab), lambda a, b, ab: a + b - 2 * ab),
]


def _says(x=None, P=None):
    """Whether the answer holds this estimate and this covariance; None: any."""

    def matches(inputs, outputs):
        return (x is None or close(outputs["x"], x(inputs)).all()) and (
            P is None or close(outputs["P"][:, 0], P(inputs)).all()
        )

    return matches


def _either(pairs):
    """Whether the answer's estimate is that of one of the wrong gains."""
    return lambda inputs, outputs: any(_says(x)(inputs, outputs) for x, _ in pairs)


def _swapped(i):
    return i["a"] + i["b"] - RIGHT[0](i)


def _away(i):
    return 2 * i["a"] - RIGHT[0](i)


def _averaged(i):
    return (i["a"] + i["b"]) / 2


def _intersected(inputs, outputs):
    """P⁻¹ = ω P_a⁻¹ + (1 − ω) P_b⁻¹ for some ω: sure to be honest, and never the best."""
    a, b, P = (np.linalg.inv(M) for M in (inputs["P_a"], inputs["P_b"], outputs["P"][:, 0]))
    omega = np.sum((P - b) * (a - b), axis=(1, 2)) / np.sum((a - b) ** 2, axis=(1, 2))
    between = ((omega > -TOLERANCE) & (omega < 1 + TOLERANCE)).all()
    return between and close(P, b + omega[:, None, None] * (a - b)).all()


MISTAKES = (
    Diagnosis(
        "correlations-ignored",
        "a and b were fused as if independent: P_ab is not in it. What both err by together "
        "cannot be averaged away; this P claims that it was.",
        _says(*IGNORED),
    ),
    Diagnosis(
        "one-of-the-two",
        "This is one of the two estimates, the other is thrown away. Even the worse one knows "
        "something.",
        lambda i, o: _says(lambda i: i["a"])(i, o) or _says(lambda i: i["b"])(i, o),
    ),
    Diagnosis(
        "covariance-intersection",
        "This P lies between P_a and P_b, as covariance intersection puts it: the way out when "
        "P_ab is unknown. You have P_ab; use it and be surer.",
        _intersected,
    ),
    Diagnosis(
        "averaged",
        "This is the mean of a and b. The better one deserves more weight, and how much, K tells.",
        _says(_averaged),
    ),
    Diagnosis(
        "weights-swapped",
        "a and b have changed places in x. Test it: if P_a is tiny, x must be close to a.",
        _says(_swapped),
    ),
    Diagnosis(
        "gain-sign",
        "x is led away from b: the sign of S_xv. The innovation b − a errs by ã − b̃ when errors "
        "are truth less estimate, so S_xv = E[ã (ã − b̃)ᵀ] begins with + P_a.",
        _says(_away),
    ),
    Diagnosis(
        "plus-for-minus",
        "The sign of P_ab: the more a and b share, the less they differ. The innovation b − a "
        "has the covariance that task 07-relative asked for.",
        _either(PLUS),
    ),
    Diagnosis(
        "transpose-missing",
        "P_ab is turned the wrong way somewhere. E[b̃ ãᵀ] is P_abᵀ: S holds P_ab and its "
        "transpose, and E[ã (ã − b̃)ᵀ] = P_a − P_ab.",
        _either(UNTURNED),
    ),
    Diagnosis(
        "cross-in-one-place",
        "P_ab is missing in a place. It belongs into S (both P_ab and P_abᵀ) and into the "
        "covariance of the error of a with the innovation, P_a − P_ab.",
        _either(HALF),
    ),
    Diagnosis(
        "standard-formula",
        "x is the best there is, P is not its covariance. P − K H P holds where the noise of "
        "what is seen is independent of the state; here b errs together with a. Take "
        "P_a − K S Kᵀ.",
        _says(RIGHT[0], STANDARD[1]),
    ),
    Diagnosis(
        "honest-but-for-the-share",
        "x is the best there is, P forgets P_ab: (I − K) P_a (I − K)ᵀ + K P_b Kᵀ lacks the two "
        "mixed terms.",
        _says(RIGHT[0], BLIND[1]),
    ),
)
