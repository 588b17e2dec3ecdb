"""Exercise 03, the prediction: what a step makes of samples of the belief."""

import numpy as np

from slamlab.exercises.drives.ex03 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks import ex03_laws as law
from slamlab.exercises.tasks.ex03_laws import DEVIATION, misread, mistake, times, turned


def _before_step(rng):
    return {
        **law.beliefs(rng),
        "F": law.motions(rng),
        "Q": law.noises(rng, law.STATES),
    }


def _stepped(i):
    """Mean and covariance of samples of the belief, moved by F and shaken by q."""
    errors, slips = law.samples(i["P"], i["Q"])
    return law.moments((i["x"][:, None] + errors) @ turned(i["F"]) + slips)


def _shaken(i, o):
    """Whether x is off F x, by no more than Q allows."""
    slip = times(law.whitener(i["Q"]), o["x"] - times(i["F"], i["x"]))
    return (np.abs(slip).max(axis=1) > law.TOLERANCE).all() and np.abs(slip).max() < 5


def _carried(i, F=None, P=None):
    """F P Fᵀ."""
    F, P = i["F"] if F is None else F, i["P"] if P is None else P
    return F @ P @ turned(F)


PREDICT = Task(
    id="03-predict",
    title="Prediction",
    drive=DRIVES["03-predict"],
    inputs=_before_step,
    shapes={"x": (law.ROWS, law.STATES), "P": (law.ROWS, law.STATES, law.STATES)},
    laws=(
        Law(
            "mean",
            1,
            "x is the mean of samples of the belief that were moved by F",
            lambda i, o: law.close(o["x"], _stepped(i)[0]),
        ),
        Law(
            "covariance",
            2,
            "P is the covariance of samples that were moved by F and shaken by Q",
            lambda i, o: law.close(o["P"], _stepped(i)[1]),
        ),
    ),
    diagnoses=(
        mistake(
            "x-not-moved",
            "x has stayed where it was. The cart moves on, and F says how.",
            "x",
            lambda i: i["x"],
        ),
        mistake(
            "x-transposed",
            "x was multiplied by Fᵀ: x @ F is the product from the other side. A state is a "
            "column, so it is F @ x.",
            "x",
            lambda i: times(turned(i["F"]), i["x"]),
        ),
        Diagnosis(
            "x-shaken",
            "x is F x plus something of the slip's size. The slip q is not known, and 0 on "
            "average: x stays F x, and only P grows, by Q.",
            _shaken,
        ),
        mistake(
            "Q-forgotten",
            "Q is missing: your belief grows no wider by slipping wheels. What does each step add?",
            "P",
            _carried,
        ),
        mistake(
            "P-not-carried",
            "P has not been carried along by F. An error of the speed becomes one of the position: "
            "write the new error, F x̃ + q, and multiply it by its transpose.",
            "P",
            lambda i: i["P"] + i["Q"],
            lambda i: i["P"],
            lambda i: i["Q"],
        ),
        mistake(
            "transposed",
            "The transpose stands on the wrong side: Fᵀ P F. The new error is F x̃; times its "
            "transpose, that is F x̃ x̃ᵀ Fᵀ.",
            "P",
            lambda i: _carried(i, turned(i["F"])) + i["Q"],
        ),
        mistake(
            "transpose-missing",
            "A covariance takes F from the left and Fᵀ from the right. Look at your P: is it "
            "symmetric?",
            "P",
            lambda i: i["F"] @ i["P"] @ i["F"] + i["Q"],
            lambda i: i["F"] @ i["P"] + i["Q"],
            lambda i: i["P"] @ i["F"] + i["Q"],
            lambda i: i["P"] @ turned(i["F"]) + i["Q"],
        ),
        mistake(
            "Q-subtracted",
            "Q has the wrong sign: slipping makes no belief narrower.",
            "P",
            lambda i: _carried(i) - i["Q"],
        ),
        mistake(
            "Q-carried",
            "Q went through F as well. The slip is added after the step: it is not moved by it.",
            "P",
            lambda i: _carried(i, P=i["P"] + i["Q"]),
        ),
        mistake("Q-deviation", f"Q {DEVIATION}", "P", *misread("Q", lambda i, Q: _carried(i) + Q)),
    ),
)
