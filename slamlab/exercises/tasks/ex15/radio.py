"""Task 15-range: an edge that measures a distance only, between radios beside the centres."""

import numpy as np

from slamlab.exercises.drives.ex15 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex15.edges import sized
from slamlab.geometry import wrap

COUNT = 14
DIFFERENCES = 1e-4
"""Share of a row's largest entry: one-sided differences of 1e-5 m pass, no wrong form does."""


def ranges(rng, count=COUNT, arms=1.0, far=1.0):
    """Pairs of robots some metres apart, their radios, and the distance that was measured.

    Parameters
    ----------
    rng : numpy.random.Generator
    count : int
    arms, far : float, by how much the radios' places and the distance are larger than usual

    Returns
    -------
    dict of x_i, x_j (count, 3), r (count,), a_i, a_j (count, 2)
    """
    x_i = np.column_stack([rng.uniform(-4, 4, (count, 2)), rng.uniform(-3.1, 3.1, count)])
    way = far * sized(rng, 2, 4, (count, 2))
    x_j = np.column_stack([x_i[:, :2] + way, rng.uniform(-3.1, 3.1, count)])
    a_i, a_j = (arms * sized(rng, 0.2, 0.8, (count, 2)) for _ in range(2))
    truly = np.linalg.norm(_between(x_i, x_j, a_i, a_j), axis=1)
    return {
        "x_i": x_i,
        "x_j": x_j,
        "r": truly - sized(rng, 0.1, 0.5, count),
        "a_i": a_i,
        "a_j": a_j,
    }


def _at(x, a):
    """Places of radios, and how they move as their robots turn."""
    c, s = np.cos(x[:, 2]), np.sin(x[:, 2])
    arm = np.column_stack([c * a[:, 0] - s * a[:, 1], s * a[:, 0] + c * a[:, 1]])
    return x[:, :2] + arm, np.column_stack([-arm[:, 1], arm[:, 0]])


def _between(x_i, x_j, a_i, a_j):
    return _at(x_j, a_j)[0] - _at(x_i, a_i)[0]


def _wanted(inputs):
    x_i, x_j, r, a_i, a_j = inputs.values()
    d = _between(x_i, x_j, a_i, a_j)
    length = np.linalg.norm(d, axis=1)
    u = d / length[:, None]
    turn_i, turn_j = (np.sum(u * _at(*at)[1], axis=1) for at in ((x_i, a_i), (x_j, a_j)))
    A, B = np.column_stack([-u, -turn_i]), np.column_stack([u, turn_j])
    return {"e": length - r, "A": A, "B": B}


def _way(inputs):
    x_i, x_j, _, a_i, a_j = inputs.values()
    return {"from the radio of i to that of j": _between(x_i, x_j, a_i, a_j)}


def _parts(inputs, outputs):
    """The error, and of each row the slopes by the place and by the heading."""
    A, B = outputs["A"], outputs["B"]
    return {
        "e": outputs["e"],
        "A's place": A[:, :2],
        "A's heading": A[:, 2],
        "B's place": B[:, :2],
        "B's heading": B[:, 2],
    }


def _axes(rng):
    """Robots that look along the axes, at each other or past each other."""
    inputs = ranges(rng, 4)
    inputs["x_i"][:, 2] = [0, np.pi / 2, np.pi, -np.pi / 2]
    inputs["x_j"][:, 2] = [np.pi, 0, -np.pi / 2, np.pi / 2]
    inputs["x_j"][:, 1] = inputs["x_i"][:, 1]
    return inputs


def _one_turned(rng):
    """The same place of both centres: only the radios are apart."""
    inputs = ranges(rng, 4)
    inputs["x_j"] = inputs["x_i"] + np.array([0, 0, 1.0])
    inputs["x_j"][:, 2] = wrap(inputs["x_j"][:, 2])
    return inputs | {"a_j": -2 * inputs["a_i"]}


def _exact(rng):
    inputs = ranges(rng, 4)
    return inputs | {"r": inputs["r"] + _wanted(inputs)["e"]}


PROBES = (
    Probe("radios at the robots' centres", lambda rng: ranges(rng, 3, arms=0.0)),
    Probe("robots that look along the axes", _axes),
    Probe("both robots in one place", _one_turned),
    Probe("a distance that is exactly right", _exact),
    Probe("robots far apart", lambda rng: ranges(rng, 3, far=100.0)),
    Probe("one pair", lambda rng: ranges(rng, 1)),
)


def _promised(inputs):
    """(n,) whether the radios are 10 cm apart."""
    ends = (inputs[name] for name in ("x_i", "x_j", "a_i", "a_j"))
    return np.linalg.norm(_between(*ends), axis=1) > 0.1


RADIO = Task(
    id="15-range",
    title="An edge by radio",
    drive=DRIVES["15-range"],
    inputs=ranges,
    shapes={"e": (None,), "A": (None, 3), "B": (None, 3)},
    laws=(
        equals(
            "e",
            1,
            "e is the distance of the radios, as the poses have it, less the measured one",
            _wanted,
            parts={"e": np.s_[...]},
            asks="Where in the world is the radio of a robot that looks to the north?",
            step=_way,
        ),
        *(
            equals(
                name,
                2,
                f"{name} holds the differences of e when x_{pose} is moved a little",
                _wanted,
                parts={name: np.s_[:]},
                tolerance=DIFFERENCES,
                asks="In which direction does a radio go when its robot turns on the spot, and how "
                "much of that is along the line between the radios?",
                step=_way,
                after=("e",),
            )
            for name, pose in (("A", "i"), ("B", "j"))
        ),
    ),
    probes=PROBES,
    parts=_parts,
    rounds=_promised,
)
