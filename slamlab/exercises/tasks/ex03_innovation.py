"""Exercise 03, the innovation: what samples of the belief make one expect to measure."""

import numpy as np

from slamlab.exercises.drives.ex03 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks import ex03_laws as law
from slamlab.exercises.tasks.ex03_gain import inverse, seen
from slamlab.exercises.tasks.ex03_laws import DEVIATION, before_measurement, misread, mistake, times, turned


def _measured(i):
    """Mean and covariance of what samples of the belief would measure."""
    errors, noise = law.samples(i["P"], i["R"])
    return law.moments((i["x"][:, None] + errors) @ turned(i["H"]) + noise)


INNOVATION = Task(
    id="03-innovation",
    title="The innovation and its covariance",
    drive=DRIVES["03-innovation"],
    inputs=before_measurement,
    shapes={"v": (law.ROWS, law.MEASURED), "S": (law.ROWS, law.MEASURED, law.MEASURED)},
    laws=(
        Law(
            "innovation",
            1,
            "v is the measurement less what samples of the belief measure on average",
            lambda i, o: law.close(o["v"], i["z"] - _measured(i)[0]),
        ),
        Law(
            "covariance",
            2,
            "S is the covariance of what samples of the belief measure, noise included",
            lambda i, o: law.close(o["S"], _measured(i)[1]),
        ),
    ),
    diagnoses=(
        mistake(
            "sign",
            "The innovation has the wrong sign: it is measured minus expected, what is new in z.",
            "v",
            lambda i: times(i["H"], i["x"]) - i["z"],
        ),
        mistake(
            "no-difference",
            "The innovation is a difference, of what was measured and what the belief makes you "
            "expect, H x.",
            "v",
            lambda i: i["z"],
            lambda i: times(i["H"], i["x"]),
        ),
        mistake(
            "absolute",
            "The innovation has lost its sign: too far and too near must be told apart.",
            "v",
            lambda i: np.abs(i["z"] - times(i["H"], i["x"])),
        ),
        mistake(
            "R-forgotten",
            "R is missing in S: even if x were exact, measurements would scatter.",
            "S",
            seen,
        ),
        mistake(
            "P-forgotten",
            "P is missing in S: even if the sensor were exact, innovations would scatter, for x "
            "is not.",
            "S",
            lambda i: i["R"],
            lambda i: i["H"] @ turned(i["H"]) + i["R"],
        ),
        mistake("R-deviation", f"R {DEVIATION}", "S", *misread("R", lambda i, R: seen(i) + R)),
        mistake(
            "R-subtracted",
            "R has the wrong sign: v = H x̃ + r is made of two unrelated errors, and their "
            "covariances add.",
            "S",
            lambda i: seen(i) - i["R"],
        ),
        mistake(
            "inverted",
            "This is S⁻¹. It will be needed in the gain; here S itself is asked for.",
            "S",
            lambda i: inverse(seen(i) + i["R"]),
        ),
        mistake(
            "one-innovation",
            "v vᵀ is what this one innovation happened to be. S says what to expect before "
            "measuring: it is made of H, P and R.",
            "S",
            lambda i: np.einsum("ni,nj->nij", *[i["z"] - times(i["H"], i["x"])] * 2),
        ),
    ),
)
