"""Task 03-capacitor: F, Q and H of a capacitor and its source, whose voltage is a random walk."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.task import Probe, Task
from course.exercises.ex03_kalman_filter.calls import CALLS

ROWS = 10


def inputs(rng, steps=(0.2, 1.5)):
    """Circuits and steps; ``steps``: (least, largest) dt in units of ohms · farads."""
    ohms, farads = rng.uniform(0.3, 4, ROWS), rng.uniform(0.3, 3, ROWS)
    dt = rng.uniform(*steps, ROWS) * ohms * farads
    return {"dt": dt, "ohms": ohms, "farads": farads, "sigma": rng.uniform(0.1, 2, ROWS)}


def stepped(i, state, jump=0.0):
    """The state (rows, 2) after a step: the source jumps, then the capacitor follows."""
    volts, source = state[:, 0], state[:, 1] + jump
    left = np.exp(-i["dt"] / (i["ohms"] * i["farads"]))
    return np.stack([source + (volts - source) * left, source], axis=1)


def read(i, state):
    """Voltmeter and ammeter, (rows, 2)."""
    return np.stack([state[:, 0], (state[:, 1] - state[:, 0]) / i["ohms"]], axis=1)


def _columns(i, function):
    rows = len(i["dt"])
    return np.stack([function(i, np.tile(unit, (rows, 1))) for unit in np.eye(2)], axis=2)


def moved(i):
    """F, from the effect of one step on each unit state."""
    return {"F": _columns(i, stepped)}


def scattered(i):
    """Q, from two samples of the jump, ±1 σ."""
    deviation, rest = i["sigma"] * np.sqrt(i["dt"]), np.zeros((len(i["dt"]), 2))
    ends = np.stack([stepped(i, rest, sign * deviation) for sign in (1, -1)])
    return {"Q": np.einsum("sri,srj->rij", ends, ends) / 2}


def seen(i):
    """H, from the readings of each unit state."""
    return {"H": _columns(i, read)}


def _left(i):
    return {
        "remaining fraction of the difference after dt": np.exp(-i["dt"] / i["ohms"] / i["farads"])[
            0
        ]
    }


def _current(i):
    return {"current if the source is 1 V above the capacitor [A]": 1 / i["ohms"][:1]}


CAPACITOR = Task(
    id="03-capacitor",
    title="A capacitor and its source",
    call=CALLS["03-capacitor"],
    inputs=inputs,
    shapes=lambda i: dict.fromkeys(("F", "Q", "H"), (len(i["dt"]), 2, 2)),
    laws=(
        equals(
            "motion",
            1.5,
            "the columns of F are the effects of a step on 1 V of the capacitor and on 1 V of the "
            "source",
            moved,
            asks="Charge the capacitor to 1 V and set the source to 0 V: which voltages do both "
            "have after dt? Then set the source to 1 V and the capacitor to 0 V, and answer again.",
            step=_left,
        ),
        equals(
            "slip",
            2,
            "Q is the covariance of the effect of the source's jumps on both voltages",
            scattered,
            asks="The source jumps by 1 V at the beginning of the step. How large is the error of "
            "each of the two voltages at the end of the step? Multiply the vector of both errors "
            "by its transpose.",
            step=_left,
        ),
        equals(
            "meters",
            1.5,
            "H maps the two voltages to the readings of voltmeter and ammeter",
            seen,
            asks="Which voltage lies across the resistor, and what does the ammeter show when both "
            "voltages are equal?",
            step=_current,
        ),
    ),
    probes=(
        Probe("a step of zero duration (dt = 0)", lambda rng: inputs(rng, (0, 0))),
        Probe("very short steps", lambda rng: inputs(rng, (1e-4, 1e-3))),
        Probe("very long steps", lambda rng: inputs(rng, (20, 30))),
        Probe(
            "a source of constant voltage (sigma = 0)",
            lambda rng: inputs(rng) | {"sigma": np.zeros(ROWS)},
        ),
        Probe(
            "whole numbers",
            lambda rng: {
                name: np.full(2, value)
                for name, value in {"dt": 2.0, "ohms": 3.0, "farads": 1.0, "sigma": 2.0}.items()
            },
        ),
    ),
    begins=(
        "The capacitor is at 0 V and the source at 1 V. Which voltage does the "
        "capacitor approach, and how fast?",
        "Which of the two voltages changes by a random jump?",
    ),
)
