"""Task 15-range: an edge that measures the distance of two radios."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.function_calls.run_and_pack import MAIN
from classroom.exercises.task import Probe, Task
from course.exercises.ex15_pose_graph_slam.calls import CALLS
from course.exercises.ex15_pose_graph_slam.edges import sized
from course.exercises.surveyed import EXACT, NAME, differences, rounded, surveyed
from slamlab.geometry import wrap

COUNT = 14


def ranges(rng, count=COUNT, arms=1.0, far=1.0):
    """Pairs of robots: x_i, x_j (count, 3), r (count,), a_i, a_j (count, 2).
    arms, far : factors of the radios' offsets and of the distance.
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
    """Positions of radios, and their derivatives with respect to the headings."""
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
    return {"d, from radio i to radio j": _between(x_i, x_j, a_i, a_j)}


def _parts(inputs, outputs):
    A, B = outputs["A"], outputs["B"]
    return {
        "e": outputs["e"],
        "A's place": A[:, :2],
        "A's heading": A[:, 2],
        "B's place": B[:, :2],
        "B's heading": B[:, 2],
    }


def _axes(rng):
    inputs = ranges(rng, 4)
    inputs["x_i"][:, 2] = [0, np.pi / 2, np.pi, -np.pi / 2]
    inputs["x_j"][:, 2] = [np.pi, 0, -np.pi / 2, np.pi / 2]
    inputs["x_j"][:, 1] = inputs["x_i"][:, 1]
    return inputs


def _one_turned(rng):
    inputs = ranges(rng, 4)
    inputs["x_j"] = inputs["x_i"] + np.array([0, 0, 1.0])
    inputs["x_j"][:, 2] = wrap(inputs["x_j"][:, 2])
    return inputs | {"a_j": -2 * inputs["a_i"]}


def _exact(rng):
    inputs = ranges(rng, 4)
    return inputs | {"r": inputs["r"] + _wanted(inputs)["e"]}


def _jacobians(inputs):
    found = _wanted(inputs)
    return {name: found[name] for name in "AB"}


PROBES = (
    Probe("radios at the robots' centres", lambda rng: ranges(rng, 3, arms=0.0)),
    Probe("headings along the axes", _axes),
    Probe("two robots at one position", _one_turned),
    Probe("a distance without error", _exact),
    Probe("robots far apart", lambda rng: ranges(rng, 3, far=100.0)),
    Probe("one pair", lambda rng: ranges(rng, 1)),
    Probe(NAME, lambda rng: surveyed(ranges(rng, 6), "x_i", "x_j")),
)


def _promised(inputs):
    """The radios are 10 cm apart."""
    ends = (inputs[name] for name in ("x_i", "x_j", "a_i", "a_j"))
    return np.linalg.norm(_between(*ends), axis=1) > 0.1


RADIO = Task(
    id="15-range",
    title="An edge that measures a distance",
    call=CALLS["15-range"],
    inputs=ranges,
    shapes={"e": (None,), "A": (None, 3), "B": (None, 3)},
    laws=(
        equals(
            "e",
            1,
            "e is the distance of the radios, computed from the poses, minus the measured distance",
            _wanted,
            parts={"e": np.s_[...]},
            asks="Suppose that a robot faces north. Where is its radio in the world frame?",
            step=_way,
        ),
        *(
            rounded(
                equals(
                    name,
                    2,
                    f"{name} is ∂e/∂x_{pose}",
                    _wanted,
                    parts={name: np.s_[:]},
                    tolerance=EXACT,
                    asks="In which direction does a radio move if its robot turns on the spot, and "
                    "what is the component of this motion along d?",
                    step=_way,
                    after=("e",),
                ),
                _wanted,
            )
            for name, pose in (("A", "i"), ("B", "j"))
        ),
    ),
    probes=PROBES,
    diagnoses=(differences(_jacobians), differences(_jacobians, MAIN)),
    parts=_parts,
    may_round=_promised,
    begins=(
        "Where is the radio of robot i in the world frame, if the robot faces north?",
        "Which vector connects the two radios, and how long is it?",
        "Move one radio by a small vector. Which component of this vector changes the distance?",
    ),
)
