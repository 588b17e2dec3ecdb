"""Task 03-capacitor: F, Q and H of a capacitor that is charged by a source that wanders."""

import numpy as np

from slamlab.exercises.drives.ex03 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task

ROWS = 10


def inputs(rng, steps=(0.2, 1.5)):
    """Circuits and steps; ``steps``: least and largest dt as shares of ohms · farads."""
    ohms, farads = rng.uniform(0.3, 4, ROWS), rng.uniform(0.3, 3, ROWS)
    dt = rng.uniform(*steps, ROWS) * ohms * farads
    return {"dt": dt, "ohms": ohms, "farads": farads, "sigma": rng.uniform(0.1, 2, ROWS)}


def stepped(i, state, jump=0.0):
    """The state (rows, 2) after a step: first the source jumps, then the capacitor follows it."""
    volts, source = state[:, 0], state[:, 1] + jump
    left = np.exp(-i["dt"] / (i["ohms"] * i["farads"]))
    return np.stack([source + (volts - source) * left, source], axis=1)


def read(i, state):
    """What the voltmeter and the ammeter show (rows, 2)."""
    return np.stack([state[:, 0], (state[:, 1] - state[:, 0]) / i["ohms"]], axis=1)


def _columns(i, function):
    """The matrix of a linear function: what it makes of each unit state."""
    rows = len(i["dt"])
    return np.stack([function(i, np.tile(unit, (rows, 1))) for unit in np.eye(2)], axis=2)


def moved(i):
    """F, from what a step makes of each volt."""
    return {"F": _columns(i, stepped)}


def scattered(i):
    """Q, from two samples of the jump, one σ up and one σ down."""
    deviation, rest = i["sigma"] * np.sqrt(i["dt"]), np.zeros((len(i["dt"]), 2))
    ends = np.stack([stepped(i, rest, sign * deviation) for sign in (1, -1)])
    return {"Q": np.einsum("sri,srj->rij", ends, ends) / 2}


def seen(i):
    """H, from what the meters show of each volt."""
    return {"H": _columns(i, read)}


def _left(i):
    return {
        "share of the difference that is left after dt": np.exp(-i["dt"] / i["ohms"] / i["farads"])[
            0
        ]
    }


CAPACITOR = Task(
    id="03-capacitor",
    title="A capacitor and its source",
    drive=DRIVES["03-capacitor"],
    inputs=inputs,
    shapes=lambda i: dict.fromkeys(("F", "Q", "H"), (len(i["dt"]), 2, 2)),
    laws=(
        equals(
            "motion",
            1.5,
            "F says what a step makes of one volt on the capacitor, and of one volt of the source",
            moved,
            asks="Charge the capacitor to 1 V and switch the source off: what is left after dt? "
            "Then empty it and set the source to 1 V: what has it got after dt?",
            step=_left,
        ),
        equals(
            "slip",
            2,
            "Q is the covariance of what the source's jumps make of both voltages",
            scattered,
            asks="The source jumps by 1 V at the beginning of the step. By how much are the two "
            "voltages off at its end? What is that vector times its transpose?",
        ),
        equals(
            "meters",
            1.5,
            "H says what voltmeter and ammeter show of each of the two voltages",
            seen,
            asks="Which voltage drives the current through the resistor, and what does the ammeter "
            "show when both voltages are the same?",
        ),
    ),
    probes=(
        Probe("no time at all (dt = 0)", lambda rng: inputs(rng, (0, 0))),
        Probe("very short steps", lambda rng: inputs(rng, (1e-4, 1e-3))),
        Probe("very long steps", lambda rng: inputs(rng, (20, 30))),
        Probe(
            "a source that is steady (sigma = 0)",
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
)
