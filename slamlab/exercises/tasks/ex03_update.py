"""Exercise 03, the update: what belief and measurement together say, by least squares."""

import numpy as np

from slamlab.exercises.drives.ex03 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks import ex03_laws as law
from slamlab.exercises.tasks.ex03_gain import gain_for, inverse, seen, shared
from slamlab.exercises.tasks.ex03_laws import DEVIATION, before_measurement, misread, mistake, times, turned


def _S(i):
    return seen(i) + i["R"]


def _K(i):
    return gain_for(i, _S(i))


def _v(i):
    return i["z"] - times(i["H"], i["x"])


def _corrected(i, K, v=None):
    return i["x"] + times(K, _v(i) if v is None else v)


def _KH(i):
    return _K(i) @ i["H"]


def _rest(i):
    return np.eye(law.STATES) - _KH(i)


def _learned(i, middle=None):
    """K S Kᵀ, or with something else between the gains."""
    K = _K(i)
    return K @ (_S(i) if middle is None else middle) @ turned(K)


def _afterwards(i):
    """The inputs with P as it is after the update."""
    return {**i, "P": i["P"] - _learned(i)}


UPDATE = Task(
    id="03-update",
    title="The update",
    drive=DRIVES["03-update"],
    inputs=before_measurement,
    shapes={"x": (law.ROWS, law.STATES), "P": (law.ROWS, law.STATES, law.STATES)},
    laws=(
        Law(
            "estimate",
            2,
            "x is the weighted least squares estimate from belief and measurement",
            lambda i, o: law.close(o["x"], law.least_squares(i)[0]),
        ),
        Law(
            "covariance",
            2,
            "P is the covariance of that estimate's error",
            lambda i, o: law.close(o["P"], law.least_squares(i)[1]),
        ),
    ),
    diagnoses=(
        mistake(
            "x-lost",
            "x itself is missing: K v is the correction alone. The new estimate is the old one "
            "plus the correction (a misprint, X = K · innovation, stands in one of the theses).",
            "x",
            lambda i: times(_K(i), _v(i)),
        ),
        mistake(
            "x-unchanged",
            "x has not been corrected. By how much, and in which direction, says K v.",
            "x",
            lambda i: i["x"],
        ),
        mistake(
            "sign",
            "The correction goes the wrong way: look at the sign of the innovation (measured minus "
            "expected) and at the one before K v.",
            "x",
            lambda i: _corrected(i, -_K(i)),
        ),
        mistake(
            "z-for-v",
            "K is multiplied by the measurement. Only what is new in it, the innovation z − H x, "
            "corrects.",
            "x",
            lambda i: _corrected(i, _K(i), i["z"]),
        ),
        mistake(
            "S-missing",
            "The gain lacks S⁻¹: P Hᵀ alone over-corrects wherever innovations are large anyway.",
            "x",
            lambda i: _corrected(i, shared(i)),
        ),
        mistake(
            "S-not-inverted",
            "The gain multiplies by S where it has to divide by it: K = P Hᵀ S⁻¹.",
            "x",
            lambda i: _corrected(i, shared(i) @ _S(i)),
        ),
        mistake(
            "R-forgotten",
            "R is missing in S: this update takes the measurement for exact.",
            "x",
            lambda i: _corrected(i, gain_for(i, seen(i))),
        ),
        mistake(
            "R-deviation",
            f"R {DEVIATION}",
            "x",
            *misread("R", lambda i, R: _corrected(i, gain_for(i, seen(i) + R))),
        ),
        mistake(
            "P-too-early",
            "x was corrected with a gain made of the new P. Gain and innovation belong to the "
            "belief before the measurement: compute both before you change x or P.",
            "x",
            lambda i: _corrected(i, gain_for(_afterwards(i), _S(i))),
            lambda i: _corrected(i, _K(_afterwards(i))),
        ),
        mistake(
            "P-unchanged",
            "P has not been updated. After a measurement the robot knows more: P must say so.",
            "P",
            lambda i: i["P"],
        ),
        mistake(
            "P-grew",
            "P has grown. A measurement never makes a belief wider: look at the sign.",
            "P",
            lambda i: i["P"] + _learned(i),
            lambda i: (np.eye(law.STATES) + _KH(i)) @ i["P"],
        ),
        mistake(
            "P-factor-lost",
            "I − K H is only what is left of P, as a factor. It has to be multiplied by P.",
            "P",
            _rest,
            lambda i: i["P"] - _KH(i),
        ),
        mistake(
            "P-other-side",
            "I − K H stands on the wrong side of P, or K H is transposed. Look at your P: is it "
            "symmetric?",
            "P",
            lambda i: i["P"] @ _rest(i),
            lambda i: turned(_rest(i)) @ i["P"],
        ),
        mistake(
            "S-inverted-in-P",
            "P − K S⁻¹ Kᵀ: S is inverted once too often (so it is printed in the MAK thesis, "
            "4.22). Its inverse is in K already; between the gains stands S itself.",
            "P",
            lambda i: i["P"] - _learned(i, inverse(_S(i))),
        ),
        mistake(
            "R-in-P",
            "P − K R Kᵀ: what was learned is the share of the whole innovation, S, not of the "
            "noise alone.",
            "P",
            lambda i: i["P"] - _learned(i, i["R"]),
        ),
        mistake(
            "noise-lost",
            "K R Kᵀ is missing in Joseph's form: with the correction the measurement's noise comes "
            "into the estimate.",
            "P",
            lambda i: _rest(i) @ i["P"] @ turned(_rest(i)),
        ),
        mistake(
            "only-the-learned",
            "This is what was learned, K S Kᵀ. P is what is still unknown: subtract.",
            "P",
            _learned,
        ),
    ),
)
