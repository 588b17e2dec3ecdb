"""Task 12-odometry: ticks of two encoders to a motion, judged by many little steps."""

import numpy as np

from slamlab.exercises.drives.ex12 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.geometry import wrap

NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)


def encoders(rng, count=12, d=(0.15, 0.5), turn=(0.7, 2.6), tick=(1e-4, 4e-4), base=(0.08, 0.16)):
    """Ticks of drives of either hand, forwards and backwards.

    Parameters
    ----------
    rng : numpy.random.Generator
    count : int
    d, turn, tick, base : (least, most) way [m], turn [rad], way of a tick [m], base [m]

    Returns
    -------
    dict of left, right, tick, base, (count,) each
    """
    d, turn = rng.choice([-1, 1], (2, count)) * [rng.uniform(*d, count), rng.uniform(*turn, count)]
    tick, base = rng.uniform(*tick, count), rng.uniform(*base, count)
    left, right = (np.rint((d + s * turn * base / 2) / tick) for s in (-1, 1))
    return {"left": left, "right": right, "tick": tick, "base": base}


def stepped(i):
    """Where even wheels lead to: the little steps summed by quadrature."""
    left, right = i["left"] * i["tick"], i["right"] * i["tick"]
    turn = (right - left) / i["base"]
    heading = turn[:, None] * (1 + NODES) / 2
    x, y = ((left + right) / 4 * (trig(heading) @ WEIGHTS) for trig in (np.cos, np.sin))
    return {"result": np.column_stack([x, y, turn])}


def _law(name, points, says, at, asks, **more):
    def step(i):
        left, right = i["left"] * i["tick"], i["right"] * i["tick"]
        turn = (right - left) / i["base"]
        return {"way of the middle [m]": (left + right) / 2, "half the turn [rad]": turn / 2}

    more |= {"parts": {"result": at}, "angles": {"result": 2}, "asks": asks, "step": step}
    return equals(name, points, says, stepped, **more)


def _with(rng, **changes):
    given = encoders(rng, 6)
    return given | {name: change(given) for name, change in changes.items()}


PROBES = (
    Probe(
        "as many ticks left as right", lambda r: _with(r, right=lambda g: g["left"]), ("straight",)
    ),
    Probe(
        "one tick more on one side",
        lambda r: _with(r, right=lambda g: g["left"] + np.resize([1, -1], 6)),
        ("straight",),
    ),
    Probe(
        "wheels that stand still",
        lambda r: _with(r, left=lambda g: 0 * g["left"], right=lambda g: 0 * g["left"]),
    ),
    Probe("ticks against each other", lambda r: _with(r, right=lambda g: -g["left"])),
    Probe("one wheel that stands still", lambda r: _with(r, left=lambda g: 0 * g["left"])),
    Probe("more than a whole round", lambda rng: encoders(rng, 6, turn=(6.5, 10))),
    Probe("a large robot", lambda rng: encoders(rng, 6, (4, 9), tick=(0.01, 0.03), base=(1, 2))),
    Probe("one drive", lambda rng: encoders(rng, 1)),
    Probe(
        "one tick more of a fine encoder",
        lambda r: _with(r, tick=lambda g: g["tick"] / 10, right=lambda g: g["left"] + 1),
        ("straight",),
    ),
)

ODOMETRY = Task(
    id="12-odometry",
    title="From ticks to a motion",
    drive=DRIVES["12-odometry"],
    inputs=encoders,
    shapes={"result": (3,)},
    laws=(
        _law(
            "curves",
            3,
            "x and y are where many little steps of even wheels lead",
            np.s_[:2],
            "The heading grows evenly from 0 to Δθ. Which heading has the robot half way, and how "
            "long is the straight line from the arc's begin to its end?",
        ),
        _law(
            "turn",
            1,
            "θ is by how much the robot has turned (whole turns do not matter)",
            np.s_[2],
            "The left wheel stands still and the right one rolls: round which point does the robot "
            "turn, and how far is the right wheel from it?",
        ),
        _law(
            "straight",
            1,
            "as many ticks left as right: straight on; one tick more: hardly a curve",
            np.s_[:],
            "What is sin(Δθ/2) / (Δθ/2) when Δθ is tiny, and what does the computer say of 0 / 0?",
            main=False,
            after=("curves", "turn"),
        ),
    ),
    probes=PROBES,
    parts=lambda i, o: {
        "place": o["result"][:, :2],
        "turn": np.round(wrap(o["result"][:, 2]), 9),
    },
)
