"""Task 12-odometry: the motion of a differential-drive robot from the ticks of its encoders."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.task import Probe, Task
from course.exercises.ex12_three_filters.calls import CALLS
from slamlab.geometry import wrap

NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)


def encoders(rng, count=12, d=(0.15, 0.5), turn=(0.7, 2.6), tick=(1e-4, 4e-4), base=(0.08, 0.16)):
    """Ticks of turns to either side, forwards and backwards: left, right, tick, base (count,).
    d, turn, tick, base : distance [m], turn [rad], distance per tick [m], base [m].
    """
    d, turn = rng.choice([-1, 1], (2, count)) * [rng.uniform(*d, count), rng.uniform(*turn, count)]
    tick, base = rng.uniform(*tick, count), rng.uniform(*base, count)
    left, right = (np.rint((d + s * turn * base / 2) / tick) for s in (-1, 1))
    return {"left": left, "right": right, "tick": tick, "base": base}


def stepped(i):
    """The integrals (12.3) at constant wheel speeds, by quadrature."""
    left, right = i["left"] * i["tick"], i["right"] * i["tick"]
    turn = (right - left) / i["base"]
    heading = turn[:, None] * (1 + NODES) / 2
    x, y = ((left + right) / 4 * (trig(heading) @ WEIGHTS) for trig in (np.cos, np.sin))
    return {"result": np.column_stack([x, y, turn])}


def _law(name, points, says, at, asks, **more):
    def step(i):
        left, right = i["left"] * i["tick"], i["right"] * i["tick"]
        turn = (right - left) / i["base"]
        return {"distance of the middle [m]": (left + right) / 2, "half the turn [rad]": turn / 2}

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
        "two wheels at rest",
        lambda r: _with(r, left=lambda g: 0 * g["left"], right=lambda g: 0 * g["left"]),
    ),
    Probe(
        "wheels that roll equally far in opposite directions",
        lambda r: _with(r, right=lambda g: -g["left"]),
    ),
    Probe("one wheel at rest", lambda r: _with(r, left=lambda g: 0 * g["left"])),
    Probe("more than a full turn", lambda rng: encoders(rng, 6, turn=(6.5, 10))),
    Probe("a large robot", lambda rng: encoders(rng, 6, (4, 9), tick=(0.01, 0.03), base=(1, 2))),
    Probe("small turns", lambda r: encoders(r, 12, turn=(0.02, 0.05)), ("curves",)),
    Probe("a single motion", lambda rng: encoders(rng, 1)),
    Probe(
        "one tick more of a fine encoder",
        lambda r: _with(r, tick=lambda g: g["tick"] / 10, right=lambda g: g["left"] + 1),
        ("straight",),
    ),
)

ODOMETRY = Task(
    id="12-odometry",
    title="Odometry from encoder ticks",
    call=CALLS["12-odometry"],
    inputs=encoders,
    shapes={"result": (3,)},
    laws=(
        _law(
            "curves",
            3,
            "x and y are the end of the arc that constant wheel speeds give",
            np.s_[:2],
            "The heading changes from 0 to Δθ at a constant rate. What is the heading halfway, and "
            "how long is the straight line from the start to the end of the arc?",
        ),
        _law(
            "turn",
            1,
            "θ is the angle by which the robot has turned (modulo 2π)",
            np.s_[2],
            "The left wheel is at rest and the right one rolls: about which point does the robot "
            "turn, and how far is the right wheel from this point?",
        ),
        _law(
            "straight",
            1,
            "equal ticks give a straight line, and one tick more gives a slight curve",
            np.s_[:],
            "What is the limit of sin(Δθ/2) / (Δθ/2) for Δθ → 0? What does a computer obtain for "
            "0/0?",
            main=False,
            after=("curves", "turn"),
        ),
    ),
    probes=PROBES,
    parts=lambda i, o: {
        "place": o["result"][:, :2],
        "turn": np.round(wrap(o["result"][:, 2]), 9),
    },
    begins=(
        "The left wheel rolls by 0.1 m and the right wheel by 0.2 m. How far does the "
        "middle of the robot move along its arc?",
        "By which angle does the robot turn if one wheel is at rest?",
    ),
)
