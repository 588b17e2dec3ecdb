"""Exercise 03, the gain: none leaves smaller errors of samples of the belief."""

import numpy as np

from slamlab.exercises.drives.ex03 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks import ex03_laws as law
from slamlab.exercises.tasks.ex03_laws import DEVIATION, before_measurement, misread, mistake, turned


def _for_gain(rng):
    made = before_measurement(rng)
    return {name: made[name] for name in ("P", "H", "R")}


def _trace_left(i, K):
    """Mean square of the errors that a correction with K leaves of samples of the belief."""
    errors, noise = law.samples(i["P"], i["R"])
    innovations = errors @ turned(i["H"]) + noise
    left = errors - innovations @ turned(K)
    return np.square(left).sum(axis=-1).mean(axis=-1)


def _lowest(i, o):
    K, size = o["result"], law.STATES * law.MEASURED
    steps = 0.01 * np.eye(size).reshape(size, law.STATES, law.MEASURED)
    # the trace is a parabola over each entry: the central difference is its exact slope
    slopes = [(_trace_left(i, K + step) - _trace_left(i, K - step)) / 0.02 for step in steps]
    return np.abs(slopes).max(axis=0) < law.TOLERANCE * np.abs(i["P"]).max(axis=(1, 2))


# ---- formulas, to build the wrong ones of ----------------------------------------------------


def seen(i):
    """H P Hᵀ."""
    return i["H"] @ i["P"] @ turned(i["H"])


def shared(i):
    """P Hᵀ."""
    return i["P"] @ turned(i["H"])


def gain_for(i, S):
    """P Hᵀ S⁻¹ for whatever stands in S's place."""
    return shared(i) @ inverse(S)


inverse = np.linalg.inv


GAIN = Task(
    id="03-gain",
    title="The gain",
    drive=DRIVES["03-gain"],
    inputs=_for_gain,
    shapes={"result": (law.STATES, law.MEASURED)},
    laws=(
        Law(
            "lowest",
            3,
            "no small change of any entry of K lowers the mean square error that is left",
            _lowest,
        ),
    ),
    diagnoses=(
        mistake(
            "S-missing",
            "S⁻¹ is missing. P Hᵀ is what error and innovation share; how large innovations are "
            "anyway must be divided out. Try the units: what does K make of metres?",
            "result",
            shared,
        ),
        mistake(
            "S-not-inverted",
            "You multiply by S where you have to divide by it: K = P Hᵀ S⁻¹.",
            "result",
            lambda i: shared(i) @ (seen(i) + i["R"]),
        ),
        mistake(
            "one-over",
            "1 / S and S ** -1 take each entry alone. The inverse of a matrix is np.linalg.inv(S).",
            "result",
            lambda i: shared(i) @ (1 / (seen(i) + i["R"])),
        ),
        mistake(
            "P-missing",
            "P is missing. How far the state is to be corrected depends on how wrong it may be.",
            "result",
            lambda i: turned(i["H"]) @ inverse(seen(i) + i["R"]),
        ),
        mistake(
            "R-forgotten",
            "R is missing in S: this gain takes every measurement for exact.",
            "result",
            lambda i: gain_for(i, seen(i)),
            lambda i: np.linalg.pinv(i["H"]),
        ),
        mistake(
            "R-for-S",
            "R stands where S belongs: an innovation scatters by the sensor's noise and by the "
            "belief's own doubt.",
            "result",
            lambda i: gain_for(i, i["R"]),
        ),
        mistake(
            "R-deviation",
            f"R {DEVIATION}",
            "result",
            *misread("R", lambda i, R: gain_for(i, seen(i) + R)),
        ),
        mistake(
            "R-subtracted",
            "R has the wrong sign in S: covariances of unrelated errors add.",
            "result",
            lambda i: gain_for(i, seen(i) - i["R"]),
        ),
        mistake(
            "sign",
            "K has the wrong sign: it is added, x + K v, and an innovation above zero says "
            "that x is too small.",
            "result",
            lambda i: -gain_for(i, seen(i) + i["R"]),
        ),
    ),
)
