"""Task 12-odometry: ticks of two encoders to a motion, judged by many little steps."""

import numpy as np

from slamlab.exercises.drives.ex12 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

CURVED, STRAIGHT, SPOT = slice(0, 12), slice(12, 15), slice(15, 18)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(30)


def encoders(rng, count=18):
    """Curves of either hand, forwards and backwards; then straight ways, then turns on the spot."""
    sign = rng.choice([-1, 1], (2, count))
    d, turn = sign * [rng.uniform(0.15, 0.5, count), rng.uniform(0.7, 2.6, count)]
    d[SPOT], turn[STRAIGHT] = 0, 0
    tick, base = rng.uniform(1e-4, 4e-4, count), rng.uniform(0.08, 0.16, count)
    left, right = (np.rint((d + s * turn * base / 2) / tick) for s in (-1, 1))
    left[SPOT] = -right[SPOT]
    return {"left": left, "right": right, "tick": tick, "base": base}


def ways(inputs):
    """Way of the middle d [m] and turn Δθ [rad], (n,) each."""
    left, right = inputs["left"] * inputs["tick"], inputs["right"] * inputs["tick"]
    return (left + right) / 2, (right - left) / inputs["base"]


def stepped(inputs):
    """(n, 3) where even wheels lead to: the little steps summed by quadrature."""
    d, turn = ways(inputs)
    heading = turn[:, None] * (1 + NODES) / 2
    x, y = (d / 2 * (trig(heading) @ WEIGHTS) for trig in (np.cos, np.sin))
    return np.column_stack([x, y, turn])


def same(a, b):
    """(n,) whether motions are the same, up to whole turns."""
    off = a - b
    turned = np.abs(np.exp(1j * a[:, 2]) - np.exp(1j * b[:, 2]))
    return (np.abs(off[:, :2]).max(axis=1) < 1e-6) & (turned < 1e-6)


def _holds(rows):
    return lambda inputs, outputs: same(outputs["result"], stepped(inputs))[rows]


# ---- mistakes: other motions of the same ticks ------------------------------------------------


def assembled(x, y, turn):
    return np.column_stack([x, y, turn])


def straight_then_turn(inputs):
    d, turn = ways(inputs)
    return assembled(d, 0 * d, turn)


def turn_then_straight(inputs):
    d, turn = ways(inputs)
    return assembled(d * np.cos(turn), d * np.sin(turn), turn)


def way_for_chord(inputs):
    d, turn = ways(inputs)
    return assembled(d * np.cos(turn / 2), d * np.sin(turn / 2), turn)


def swapped(inputs):
    return stepped(inputs | {"left": inputs["right"], "right": inputs["left"]})


def with_base(factor):
    return lambda inputs: stepped(inputs | {"base": factor * inputs["base"]})


def not_halved(inputs):
    return stepped(inputs) * [2, 2, 1]


def in_degrees(inputs):
    motion = stepped(inputs)
    return assembled(*motion[:, :2].T, np.degrees(motion[:, 2]))


def ticks_for_metres(inputs):
    d, turn = ways(inputs | {"tick": np.ones_like(inputs["tick"])})
    chord = d * np.sinc(turn / 2 / np.pi)  # too many turns for the little steps
    return assembled(chord * np.cos(turn / 2), chord * np.sin(turn / 2), turn)


def mirrored(inputs):
    return stepped(inputs) * [1, -1, 1]


def _answers(*formulas):
    """Whether the curves are what one of these formulas makes of them."""

    def matches(inputs, outputs):
        got = outputs["result"]
        return any(same(got, wrong(inputs))[CURVED].all() for wrong in formulas)

    return matches


def _undone(inputs, outputs):
    """Whether all is right but the straight ways."""
    right = same(outputs["result"], stepped(inputs))
    return right[CURVED].all() and right[SPOT].all() and not right[STRAIGHT].any()


ODOMETRY = Task(
    id="12-odometry",
    title="From ticks to a motion",
    drive=DRIVES["12-odometry"],
    inputs=encoders,
    shapes={"result": (3,)},
    laws=(
        Law("curves", 3, "it is where many little steps of even wheels lead", _holds(CURVED)),
        Law("straight", 1, "as many ticks left as right: straight on", _holds(STRAIGHT)),
        Law("spot", 1, "as many ticks against each other: it turns where it is", _holds(SPOT)),
    ),
    diagnoses=(
        Diagnosis(
            "straight-then-turn",
            "This robot drives the whole way straight on and turns at the end. It turns all the "
            "while: the chord of an arc points half the turn to the side.",
            _answers(straight_then_turn),
        ),
        Diagnosis(
            "turn-then-straight",
            "This robot turns first and drives the whole way then. It turns all the while: the "
            "chord points *half* the turn to the side.",
            _answers(turn_then_straight),
        ),
        Diagnosis(
            "way-for-chord",
            "The direction is right, the length is that of the arc. The chord is shorter: by "
            "sin(Δθ/2) / (Δθ/2).",
            _answers(way_for_chord),
        ),
        Diagnosis(
            "swapped",
            "Left and right have changed places: a faster right wheel turns the robot to the "
            "left, which is counted positive.",
            _answers(swapped),
        ),
        Diagnosis(
            "half-base",
            "The turn is twice as large as it should be. The wheels are a whole base apart: "
            "Δθ = (r − l) / base.",
            _answers(with_base(0.5)),
        ),
        Diagnosis(
            "double-base",
            "The turn is half as large as it should be: Δθ = (r − l) / base, not / (2 base).",
            _answers(with_base(2.0)),
        ),
        Diagnosis(
            "not-halved",
            "The robot's middle drives the *mean* of the two ways, (l + r) / 2, not their sum.",
            _answers(not_halved),
        ),
        Diagnosis(
            "degrees", "The turn is in degrees; it belongs in radians.", _answers(in_degrees)
        ),
        Diagnosis(
            "ticks-for-metres",
            "Ticks were taken for metres. A wheel rolls ticks · tick metres.",
            _answers(ticks_for_metres),
        ),
        Diagnosis(
            "mirrored",
            "y has the wrong sign: who turns to the left (counter-clockwise) comes out on the "
            "left, at y > 0, when driving forwards.",
            _answers(mirrored),
        ),
        Diagnosis(
            "no-straight-way",
            "Curves are right, straight ways are not: with Δθ = 0 the radius is infinite and "
            "sin(Δθ/2) / (Δθ/2) is 0/0. Its limit is 1; `np.sinc` knows it, else ask first.",
            _undone,
        ),
    ),
)
