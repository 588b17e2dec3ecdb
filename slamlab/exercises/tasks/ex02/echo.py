"""Task 02-echo: the nearest place of all walls that lies in a cone of sound.

The judge cuts each wall at the two rims of the cone, as half-planes, and asks what is left.
"""

import numpy as np

from slamlab.exercises.drives.ex02 import DRIVES
from slamlab.exercises.law import Diagnosis, Law, once
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex02.walls import as_outputs, cross, distance_is, unit
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
    """Cones and walls, drawn until nothing lies just on a rim.

    Parameters
    ----------
    rng : numpy.random.Generator
    n, walls : int, how many cones, and walls for each
    half, phi, length : (low, high), half the cone's angle, its direction [rad], a wall's length
    """
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
    """Walls with ends at (distance, bearing from the axis), one for each cone."""

    def inputs(rng):
        n = len(ends)
        p, phi = rng.uniform(-2, 2, (n, 2)), rng.uniform(-np.pi, np.pi, n)
        (a, b), (c, d) = np.moveaxis(np.array(ends, dtype=float), 0, -1)
        walls = [r[:, None] * unit(phi + beta) + p for r, beta in ((a, b), (c, d))]
        return {"p": p, "phi": phi, "half": np.full(n, half), "walls": np.hstack(walls)[:, None]}

    return inputs


def _squarely(rng):
    """Cones along x and y, and the walls of a square room, a whole number of metres away."""
    quarter, square = np.arange(4), np.array([[2, -3, 2, 3], [2, 3, -4, 3], [-4, 3, -4, -3]])
    phi = quarter * np.pi / 2
    return {
        "p": np.zeros((4, 2)),
        "phi": phi,
        "half": np.array([0.3, 0.7, 0.5, 0.2]),
        "walls": np.tile(square.astype(float), (4, 1, 1)),
    }


def _sure(inputs):
    """Whether no wall comes nearer than 10 cm, and no end or foot lies near a rim."""
    a, b, foot, s = _places(inputs)
    within = np.clip(s, 0, 1)[..., None]
    near = np.hypot(*np.moveaxis(a + within * (b - a), -1, 0)).min(initial=9)
    axis = inputs["phi"][:, None]
    bearings = [wrap(np.arctan2(q[..., 1], q[..., 0]) - axis) for q in (a, b, foot)]
    off = np.abs(np.abs(bearings) - inputs["half"][:, None]).min(initial=9)
    return near > 0.1 and off > SURE


def _places(inputs):
    """From the sensor: (n, w, 2) both ends and the foot of the perpendicular, and its s (n, w)."""
    a, b = (inputs["walls"][..., k : k + 2] - inputs["p"][:, None] for k in (0, 2))
    w = b - a
    s = -(a * w).sum(axis=-1) / (w * w).sum(axis=-1)
    return a, b, a + s[..., None] * w, s


def _nearest(inputs):
    """(n, w) how near each wall comes within the cone, and (n, w) which of ``WAYS`` it is."""
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
def heard(inputs):
    """(n,) how far the nearest place in the cone is, and (n,) which of ``WAYS`` it is."""
    right, kind = _nearest(inputs)
    if not right.shape[1]:
        return np.full(len(right), np.inf), np.full(len(right), "none")
    first = right.argmin(axis=1)[:, None]
    return np.take_along_axis(right, first, 1)[:, 0], np.take_along_axis(kind, first, 1)[:, 0]


def _on_the_way(inputs):
    a, b, _, s = _places(inputs)
    axis = inputs["phi"][:, None]
    ends = [wrap(np.arctan2(q[..., 1], q[..., 0]) - axis) for q in (a, b)]
    return {"τ of each foot": s, "the ends' bearings off the axis": np.stack(ends, axis=-1)}


def _law(name, points, says, ways, asks):
    def holds(inputs, outputs):
        right, kind = heard(inputs)
        return ~np.isin(kind, ways) | distance_is(inputs, outputs, right)

    want = lambda inputs: as_outputs(heard(inputs)[0])  # noqa: E731
    return Law(name, points, says, holds, want=want, asks=asks, step=_on_the_way)


def _heard_at_all(inputs, outputs):
    return outputs["met"] == np.isfinite(heard(inputs)[0])


def _beams(inputs, outputs):
    """Whether walls that are met square on are told a little too far, as no beam meets the foot."""
    right, kind = heard(inputs)
    foot = (kind == "foot") & (outputs["met"] == 1)
    off = outputs["distance"][foot] - right[foot]
    share = off / right[foot]
    uneven = foot.any() and min(np.ptp(off), np.ptp(share)) > 1e-6  # no factor, nor a summand
    return uneven and (share > -1e-12).all() and (share < 0.05).all()


FAN = Diagnosis(
    "a-fan-of-beams",
    "Where a wall stands square to the cone you tell a little too far: its nearest place lies "
    "between the beams, or the places, that you try. So may a whole post. Which places of a wall "
    "can be the nearest at all?",
    _beams,
)


def _parts(inputs, outputs):
    _, kind = heard(inputs)
    both = np.column_stack([outputs["met"], outputs["distance"]])
    return {name: both[kind == name] for name in WAYS}


def _promised(inputs):
    """Whether walls have a length, and are :func:`_sure`."""
    w = inputs["walls"][..., 2:] - inputs["walls"][..., :2]
    return (np.hypot(w[..., 0], w[..., 1]) > 0.001).all() and _sure(inputs)


ECHO = Task(
    id="02-echo",
    title="The first echo",
    drive=DRIVES["02-echo"],
    inputs=cones,
    shapes=lambda inputs: {"met": inputs["phi"].shape, "distance": inputs["phi"].shape},
    laws=(
        _law(
            "foot",
            2,
            "where the nearest place lies inside a wall and inside the cone, that is how far it is",
            ["foot"],
            "From which place of an endless wall does the first echo come, and at which τ is it?",
        ),
        _law(
            "end",
            2,
            "the same where the nearest place is the end of a wall",
            ["end"],
            "When no foot of a perpendicular lies on a wall, which place of it is the nearest?",
        ),
        _law(
            "rim",
            0.5,
            "the same where it is the place at which a wall leaves the cone",
            ["rim"],
            "A wall begins outside the cone and comes in. Where is the first place that is heard?",
        ),
        Law(
            "heard",
            0.5,
            "inf is returned where no place of any wall lies in the cone, and nowhere else",
            _heard_at_all,
            want=lambda inputs: as_outputs(heard(inputs)[0]),
            asks="May a wall be in the cone although no beam that you tried meets it?",
            step=_on_the_way,
        ),
    ),
    probes=(
        Probe("no walls", lambda rng: cones(rng, 2, walls=0)),
        Probe("a single wall", lambda rng: cones(rng, 24, walls=1)),
        Probe("ten walls", lambda rng: cones(rng, 5, walls=10, half=(0.1, 0.3))),
        Probe("a cone that looks along −x", lambda rng: cones(rng, 16, phi=(3.1, 3.2))),
        Probe("a direction beyond a whole turn", lambda rng: cones(rng, 8, phi=(7, 12))),
        Probe("a cone of a few degrees", lambda rng: cones(rng, 16, half=(0.02, 0.06))),
        Probe("a cone of nearly half a turn", lambda rng: cones(rng, 16, half=(1.3, 1.39))),
        Probe("thin posts", lambda rng: cones(rng, 12, walls=1, length=(0.005, 0.01))),
        Probe("walls that point at the sensor", _aimed(RADIAL)),
        Probe("walls across the whole cone", _aimed(ACROSS)),
        Probe("walls that reach behind the sensor", _aimed(BEHIND)),
        Probe("walls along x and y", _squarely),
    ),
    diagnoses=(FAN,),
    parts=_parts,
    needs=("02-ray-wall",),
    rounds=_promised,
)
