"""04-wheels: the EKF prediction of a robot with two wheels."""

from dataclasses import replace

import numpy as np

from classroom.exercises.correctness_laws import TOLERANCE, equals, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex04_models_and_jacobians.calls import CALLS
from course.exercises.ex04_models_and_jacobians.generic import covariances, poses
from course.exercises.surveyed import EXACT, NAME, differences, rounded, surveyed

ROWS = 20
LEAST_TURN = 0.01
"""A robot that does not drive straight ahead turns by at least this angle [rad]."""
FULL_TURNS = 2e5
"""Headings [rad] whose last digit is so large that differences of sines are not exact."""
SIZES = "robots of a millimetre and of a thousand kilometres"


def _driven(rng, distance, turn, size=1.0):
    """Inputs with these distances [m] and turns [rad], each (n,), of robots with sizes [m]."""
    n, B = len(distance), size * rng.uniform(0.2, 0.6, len(distance))
    distance, half = size * distance, B * turn / 2
    sigmas = rng.uniform(0.02, 0.06, (n, 3)) * _units(size * np.ones(n))
    return {
        "x": poses(rng, n),
        "P": covariances(rng, sigmas),
        "s": np.column_stack([distance - half, distance + half]),
        "B": B,
        "k": rng.uniform(0.02, 0.06, n) * np.sqrt(size),
    }


def _units(length):
    """Units (n, 3) of a pose of robots with these sizes [m]."""
    return np.column_stack([length, length, np.ones(len(length))])


def _sides(rng, n, least, most):
    return rng.choice([-1, 1], n) * rng.uniform(least, most, n)


def _random(rng):
    return _driven(rng, _sides(rng, ROWS, 0.3, 1.5), _sides(rng, ROWS, 0.3, 2.5))


def _straight(rng):
    return _driven(rng, _sides(rng, 4, 0.3, 1.5), np.zeros(4))


def _at_rest(rng):
    inputs = _driven(rng, np.ones(4), _sides(rng, 4, 0.3, 1))
    inputs["s"] *= [[0, 1], [1, 0], [0, 0], [0, 0]]
    return inputs


def _sized(rng):
    sides = _sides(rng, 6, 0.3, 1.5), _sides(rng, 6, 0.5, 2.5)
    return _driven(rng, *sides, np.repeat([2e-3, 2e6], 3))


def _far(rng):
    inputs = _driven(rng, _sides(rng, 6, 0.3, 1.5), _sides(rng, 6, 0.5, 2.5))
    inputs["x"][:, 2] += FULL_TURNS
    return surveyed(inputs, "x")


def _chord(inputs):
    """Distance, turn, chord divided by arc and its derivative with respect to the turn; the two
    are the means of cos and of −t sin over t from −1/2 to 1/2, by Gauss–Legendre quadrature."""
    distance, turn = inputs["s"].mean(axis=1), np.diff(inputs["s"])[:, 0] / inputs["B"]
    t, weights = np.polynomial.legendre.leggauss(40)
    t, weights = t / 2, weights / 2
    ratio, slope = np.cos(np.outer(turn, t)), -t * np.sin(np.outer(turn, t))
    return distance, turn, ratio @ weights, slope @ weights


@once
def _right(inputs):
    distance, turn, ratio, slope = _chord(inputs)
    direction = inputs["x"][:, 2] + turn / 2
    along = np.column_stack([np.cos(direction), np.sin(direction)])
    across = along[:, ::-1] * [-1, 1]
    moved = (distance * ratio)[:, None]
    A = np.tile(np.eye(3), (len(turn), 1, 1))
    A[:, :2, 2] = moved * across
    by_turn = (distance * slope)[:, None] * along + moved / 2 * across
    V = np.zeros((len(turn), 3, 2))  # by distance and turn
    V[:, :2, 0], V[:, :2, 1], V[:, 2, 1] = ratio[:, None] * along, by_turn, 1
    x = inputs["x"] + np.column_stack([moved * along, turn])
    W = V @ _by_wheels(inputs)
    return {"x": x, "P": _predicted(inputs, A, W), "A": A, "W": W}


def _by_wheels(inputs):
    """Derivatives of distance and turn with respect to both wheels, (n, 2, 2)."""
    rows = [[0.5 + 0 * inputs["B"]] * 2, [-1 / inputs["B"], 1 / inputs["B"]]]
    return np.moveaxis(np.array(rows), 2, 0)


def _noise(inputs):
    return inputs["k"][:, None, None] ** 2 * np.abs(inputs["s"])[:, :, None] * np.eye(2)


def _predicted(inputs, A, W):
    return A @ inputs["P"] @ A.swapaxes(1, 2) + W @ _noise(inputs) @ W.swapaxes(1, 2)


def _of(*names):
    return lambda inputs: {name: _right(inputs)[name] for name in names}


def _way(inputs):
    distance, turn, *_ = _chord(inputs)
    return {"distance of the middle [m]": distance, "turn [rad]": turn}


def _from_own_jacobians(law):
    """Accept also a covariance that is right for the student's own A and W, judged before."""

    def holds(inputs, outputs):
        own = _predicted(inputs, outputs["A"], outputs["W"])
        off = np.abs(outputs["P"] - own).max(axis=(1, 2))
        return law.holds(inputs, outputs) | (off <= TOLERANCE * np.abs(own).max(axis=(1, 2)))

    return replace(law, holds=holds)


def _parts(inputs, outputs):
    """Outputs in units of the robot's size, the motion in place of the end pose."""
    units = _units(inputs["B"])
    moved = outputs["x"] - inputs["x"]
    moved[:, 2] = np.remainder(moved[:, 2] + np.pi, 2 * np.pi)
    return {
        "x": moved / units,
        "P": outputs["P"] / (units[:, :, None] * units[:, None, :]),
        "A": outputs["A"] / units[:, :, None] * units[:, None, :],
        "W": outputs["W"] * inputs["B"][:, None, None] / units[:, :, None],
    }


def _nearly_right(inputs, outputs):
    """Whether A and W have errors, and only small ones."""
    found, right = _parts(inputs, outputs), _parts(inputs, _right(inputs))
    largest = max(np.abs(found[name] - right[name]).max() for name in ("A", "W"))
    return 1e-7 < largest < 0.03


def _promised(inputs):
    turn, heading = np.abs(np.diff(inputs["s"])[:, 0]), np.abs(inputs["x"][:, 2])
    least = np.where(heading < 100, LEAST_TURN, 0.3)  # a large heading has fewer decimal places
    return (inputs["B"] > 0) & ((turn == 0) | (turn >= least * inputs["B"]))


TASK = Task(
    id="04-wheels",
    title="The prediction of a robot with two wheels",
    call=CALLS["04-wheels"],
    inputs=_random,
    shapes=lambda inputs: {
        name: (len(inputs["x"]), *shape)
        for name, shape in {"x": (3,), "P": (3, 3), "A": (3, 3), "W": (3, 2)}.items()
    },
    laws=(
        equals(
            "mean",
            1,
            "x is the pose at the end of the arc",
            _of("x"),
            angles={"x": 2},
            asks="Both wheels and the middle of the axle move on circles about one centre. Where "
            "is this centre, and in which direction from the start does the end of the arc lie?",
            step=_way,
        ),
        rounded(
            equals(
                "A",
                1,
                "A contains the derivatives of the end pose with respect to the start pose",
                _of("A"),
                tolerance=EXACT,
                asks="Turn the start pose a little on the spot. How does the whole arc move, and "
                "in which direction does its end move?",
                step=lambda inputs: {"end minus start": _right(inputs)["x"] - inputs["x"]},
            ),
            _of("A"),
        ),
        equals(
            "W",
            1,
            "W contains the derivatives of the end pose with respect to the distances of the left "
            "and the right wheel",
            _of("W"),
            tolerance=EXACT,
            asks="Let only the right wheel roll 1 mm farther. By how much do the distance of the "
            "middle and the turn change, and how does each of these changes move the end?",
            step=lambda inputs: {"distance and turn by left and right wheel": _by_wheels(inputs)},
        ),
        _from_own_jacobians(
            equals(
                "P",
                1,
                "P is the covariance of the prediction, with your A and W",
                _of("P"),
                asks="Which errors does the end pose contain, and which matrix propagates each of "
                "them? Which variance has each wheel's error?",
                step=lambda inputs: {"C": _noise(inputs)},
            )
        ),
    ),
    probes=(
        Probe("both wheels rolling equally far", _straight),
        Probe(
            "a turn on the spot", lambda rng: _driven(rng, np.zeros(4), _sides(rng, 4, 0.3, 2.5))
        ),
        Probe("one wheel or both at rest", _at_rest),
        Probe(
            "small turns",
            lambda rng: _driven(rng, _sides(rng, 4, 0.3, 1.5), _sides(rng, 4, 0.01, 0.03)),
        ),
        Probe(
            "more than a full turn",
            lambda rng: _driven(rng, _sides(rng, 4, 2, 3), _sides(rng, 4, 6.5, 9)),
        ),
        Probe(SIZES, _sized),
        Probe(NAME, _far),
    ),
    parts=_parts,
    diagnoses=tuple(
        replace(differences(_right, name), matches=_nearly_right) for name in (NAME, SIZES)
    ),
    may_round=_promised,
    begins=(
        "Which angle of the turn and which radius does the circle of the middle have, if the left "
        "wheel rolls 19 cm and the right one 21 cm?",
        "On which numbers does the end pose depend? Which of them have errors?",
    ),
)
