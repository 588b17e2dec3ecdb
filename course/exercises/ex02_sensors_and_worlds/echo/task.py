"""Task 02-echo: the nearest point of all walls within a cone of sound."""
# The judge cuts each wall at the two rims of the cone, as half-planes.

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law, once
from classroom.exercises.task import Probe, Task
from course.exercises.ex02_sensors_and_worlds.calls import CALLS
from course.exercises.ex02_sensors_and_worlds.walls import as_outputs, cross, distance_is, unit
from slamlab.geometry import wrap

WAYS = ("foot", "end", "rim", "none")
# ends of walls as distance and bearing off the axis of a cone of half = 0.4
RADIAL = [((1.5, 0.1), (3, 0.1)), ((3, -0.2), (1.2, -0.2)), ((2, 0.6), (3, 0.6))]
ACROSS = [((2, 0.9), (2, -0.7)), ((5, -1.1), (1, 0.8)), ((1, -1.2), (6, 0.6)), ((9, -1.2), (1, 1))]
BEHIND = [
    *[((2, 2.5), (2, -2.4)), ((2, 0.2), (2, 2.5)), ((1, 3.1), (3, 0.1)), ((1, -2), (2, 0.7))],
    *[((1, 2), (4, -0.9)), ((2, 1.8), (2, 2.4)), ((1, 3.1), (2, 2.8)), ((3, -2.9), (3, -0.1))],
]
SURE = 0.01  # how far from a rim ends and feet lie [rad]: rounding decides nothing


def cones(rng, n=40, walls=3, half=(0.1, 1.2), phi=(-np.pi, np.pi), length=(0.3, 5)):
    """Cones and walls, drawn until no point lies just on a rim; pairs are (low, high)."""
    found = []
    while len(found) < n:
        p, at, wide = rng.uniform(-2, 2, 2), rng.uniform(*phi), rng.uniform(*half)
        middle = rng.uniform(1, 6, walls)[:, None] * unit(at + rng.uniform(-1.5, 1.5, walls) * wide)
        reach = rng.uniform(*length, (walls, 1)) / 2 * unit(rng.uniform(-np.pi, np.pi, walls))
        wall = np.hstack([p + middle - reach, p + middle + reach])
        row = {"p": p, "phi": at, "half": wide, "walls": wall}
        if _sure({name: np.array([value]) for name, value in row.items()}):
            found.append(row)
    return {name: np.array([row[name] for row in found]) for name in ("p", "phi", "half", "walls")}


def _aimed(ends, half=0.4):
    def inputs(rng):
        n = len(ends)
        p, phi = rng.uniform(-2, 2, (n, 2)), rng.uniform(-np.pi, np.pi, n)
        (a, b), (c, d) = np.moveaxis(np.array(ends, dtype=float), 0, -1)
        walls = [r[:, None] * unit(phi + beta) + p for r, beta in ((a, b), (c, d))]
        return {"p": p, "phi": phi, "half": np.full(n, half), "walls": np.hstack(walls)[:, None]}

    return inputs


def _far(rng):
    inputs = cones(rng, 12, walls=1, half=(0.5, 1.2), length=(3, 9))
    p = np.tile(inputs["p"], 2)[:, None]
    return inputs | {"walls": p + 100 * (inputs["walls"] - p)}


def _squarely(rng):
    quarter, square = np.arange(4), np.array([[2, -3, 2, 3], [2, 3, -4, 3], [-4, 3, -4, -3]])
    phi = quarter * np.pi / 2
    return {
        "p": np.zeros((4, 2)),
        "phi": phi,
        "half": np.array([0.3, 0.7, 0.5, 0.2]),
        "walls": np.tile(square.astype(float), (4, 1, 1)),
    }


def _sure(inputs):
    a, b, foot, s = _places(inputs)
    within = np.clip(s, 0, 1)[..., None]
    near = np.hypot(*np.moveaxis(a + within * (b - a), -1, 0)).min(initial=9)
    axis = inputs["phi"][:, None]
    bearings = [wrap(np.arctan2(q[..., 1], q[..., 0]) - axis) for q in (a, b, foot)]
    off = np.abs(np.abs(bearings) - inputs["half"][:, None]).min(initial=9)
    return near > 0.1 and off > SURE


def _places(inputs):
    """From the sensor: (n, w, 2) both ends, the foot of the perpendicular, and its s (n, w)."""
    a, b = (inputs["walls"][..., k : k + 2] - inputs["p"][:, None] for k in (0, 2))
    w = b - a
    s = -(a * w).sum(axis=-1) / (w * w).sum(axis=-1)
    return a, b, a + s[..., None] * w, s


def _nearest(inputs):
    """Per wall (n, w) the least distance within the cone, and which of ``WAYS``."""
    a, b, _, s = _places(inputs)
    w, low, high = b - a, np.zeros_like(s), np.ones_like(s)
    for side in (1, -1):  # inside is to the left of the right rim, and to the right of the left one
        rim = unit(inputs["phi"] - side * inputs["half"])[:, None]
        start, slope = side * cross(rim, a), side * cross(rim, w)
        with np.errstate(all="ignore"):
            at = -start / slope
        low = np.where(slope > 0, np.maximum(low, at), low)
        high = np.where(slope < 0, np.minimum(high, at), high)
        high = np.where((slope == 0) & (start < 0), -1, high)
    best = np.clip(s, low, np.maximum(low, high))
    right = np.where(low <= high, np.hypot(*np.moveaxis(a + best[..., None] * w, -1, 0)), np.inf)
    kind = np.where(best == s, "foot", np.where((best == 0) | (best == 1), "end", "rim"))
    return right, np.where(np.isfinite(right), kind, "none")


@once
def first_echo(inputs):
    """Least distance of all walls (n,), and which of ``WAYS``."""
    right, kind = _nearest(inputs)
    if not right.shape[1]:
        return np.full(len(right), np.inf), np.full(len(right), "none")
    first = right.argmin(axis=1)[:, None]
    return np.take_along_axis(right, first, 1)[:, 0], np.take_along_axis(kind, first, 1)[:, 0]


def _on_the_way(inputs):
    a, b, _, s = _places(inputs)
    axis = inputs["phi"][:, None]
    ends = [wrap(np.arctan2(q[..., 1], q[..., 0]) - axis) for q in (a, b)]
    return {"τ of each foot": s, "bearings of the ends from the axis": np.stack(ends, axis=-1)}


def _law(name, points, says, ways, asks, **more):
    def holds(inputs, outputs):
        right, kind = first_echo(inputs)
        return ~np.isin(kind, ways) | distance_is(inputs, outputs, right)

    want = lambda inputs: as_outputs(first_echo(inputs)[0])  # noqa: E731
    return Law(name, points, says, holds, want=want, asks=asks, step=_on_the_way, **more)


def _heard_at_all(inputs, outputs):
    return outputs["met"] == np.isfinite(first_echo(inputs)[0])


def _beams(inputs, outputs):
    # sampled beams miss the foot of the perpendicular
    right, kind = first_echo(inputs)
    foot = (kind == "foot") & (outputs["met"] == 1)
    off = outputs["distance"][foot] - right[foot]
    share = off / right[foot]
    uneven = foot.any() and min(np.ptp(off), np.ptp(share)) > 1e-6  # no factor, nor a summand
    most = np.mean(share > 1e-9) > 0.5  # a beam hardly ever meets a foot
    return uneven and most and (share > -1e-12).all() and (share < 0.05).all()


FAN = Diagnosis(
    "a-fan-of-beams",
    "If the foot of the perpendicular is the nearest point, your result is a little too large, "
    "because the foot lies between the beams or points that you try. A whole post may also lie "
    "there. Which points of a wall can be the nearest?",
    _beams,
    asks="The nearest point of a wall lies between two of your beams. By how much is "
    "your result then wrong?",
)


def _parts(inputs, outputs):
    _, kind = first_echo(inputs)
    both = np.column_stack([outputs["met"], outputs["distance"]])
    return {name: both[kind == name] for name in WAYS}


def _promised(inputs):
    w = inputs["walls"][..., 2:] - inputs["walls"][..., :2]
    return (np.hypot(w[..., 0], w[..., 1]) > 0.001).all() and _sure(inputs)


ECHO = Task(
    id="02-echo",
    title="The first echo of an ultrasonic sensor",
    call=CALLS["02-echo"],
    inputs=cones,
    shapes=lambda inputs: {"met": inputs["phi"].shape, "distance": inputs["phi"].shape},
    laws=(
        _law(
            "foot",
            1,
            "the distance is right if the nearest point lies between the ends of a wall",
            ["foot"],
            "Which point of an infinitely long wall is the nearest, and what is its τ? Does your "
            "cone contain this point, and do you compare it with those of all other walls?",
        ),
        _law(
            "end",
            1.5,
            "the distance is right if the nearest point is the end of a wall",
            ["end"],
            "If the foot of the perpendicular is not on the wall, which point of the wall is "
            "nearest?",
        ),
        _law(
            "rim",
            2,
            "the distance is also right if a wall crosses an edge of the cone at its nearest point",
            ["foot", "rim"],  # beams along both edges find rims, and no foot
            "Suppose that a wall begins outside the cone and enters the cone. Which of its points "
            "inside the cone is the nearest?",
            after=("foot",),
        ),
        Law(
            "heard",
            0.5,
            "the result is inf if no point of any wall lies in the cone, and only then",
            _heard_at_all,
            want=lambda inputs: as_outputs(first_echo(inputs)[0]),
            asks="Can a wall be in the cone although no beam that you try meets the wall?",
            step=_on_the_way,
        ),
    ),
    probes=(
        Probe("no walls", lambda rng: cones(rng, 2, walls=0)),
        Probe("a single wall", lambda rng: cones(rng, 24, walls=1)),
        Probe("ten walls", lambda rng: cones(rng, 5, walls=10, half=(0.1, 0.3))),
        Probe("a cone along −x", lambda rng: cones(rng, 16, phi=(3.1, 3.2))),
        Probe("a direction beyond a whole turn", lambda rng: cones(rng, 8, phi=(7, 12))),
        Probe("a cone of a few degrees", lambda rng: cones(rng, 16, half=(0.02, 0.06))),
        Probe("a cone of nearly half a turn", lambda rng: cones(rng, 16, half=(1.3, 1.39))),
        Probe("thin posts", lambda rng: cones(rng, 12, walls=1, length=(0.005, 0.01))),
        Probe("walls that point at the sensor", _aimed(RADIAL)),
        Probe("walls across the whole cone", _aimed(ACROSS)),
        Probe("walls at a hundred metres and more", _far),
        Probe("walls that extend behind the sensor", _aimed(BEHIND)),
        Probe("walls along x and y", _squarely),
    ),
    diagnoses=(FAN,),
    parts=_parts,
    needs=("02-ray-wall",),
    may_round=_promised,
    begins=(
        "Which point of a straight wall is nearest to the sensor, if the whole wall "
        "lies in the cone?",
        "Which points of a wall can be the nearest if only a part of the wall lies in the cone?",
    ),
)
