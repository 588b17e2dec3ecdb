"""Task 02-ray-wall: one beam and one wall."""

import numpy as np

from slamlab.exercises.drives.ex02 import DRIVES
from slamlab.exercises.law import Diagnosis, Law, once
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex02.walls import as_outputs, crossing, distance_is, unit

# so many that one who mistakes an argument for another meets some wall, too
AHEAD, BEHIND, BESIDE, PARALLEL = 44, 10, 16, 4
KINDS = ("ahead", "behind", "beside", "parallel")
HAIR = 1e-12  # [rad]
FARTHEST = 1e3  # no wall is farther [m]; where parallel lines would meet hangs on rounding


def beams(
    rng,
    t=(0.7, 5),
    length=(1, 4),
    counts=(AHEAD, BEHIND, BESIDE, PARALLEL),
    turns=0,
    slant=(0.05, 1.4),
):
    """Beams and walls, most of which meet, and three ways of not meeting.

    Parameters
    ----------
    rng : numpy.random.Generator
    t, length : (low, high), the way to the wall and the wall's length [m]
    counts : how many walls stand ahead, behind, beside, along
    turns : int, whole turns added to phi
    slant : (low, high), angle between beam and wall [rad]
    """
    kind = np.repeat(KINDS, counts)
    n = len(kind)
    # where on the wall's line the beam's line crosses it, and how far along
    s, way = rng.uniform(0.02, 0.98, n), rng.uniform(*t, n)
    way[kind == "behind"] *= -1
    beside = np.flatnonzero(kind == "beside")
    s[beside] = np.where(beside % 2, rng.uniform(-1.2, -0.03, len(beside)), 2 - s[beside])
    p, phi = rng.uniform(-2, 2, (n, 2)), rng.uniform(-np.pi, np.pi, n)
    across = phi + rng.uniform(*slant, n) * rng.choice([-1, 1], n)
    across += np.pi * rng.integers(0, 2, n)  # walls are drawn from either side
    w = rng.uniform(*length, (n, 1)) * unit(across)
    begin = p + way[:, None] * unit(phi) - s[:, None] * w
    along = kind == "parallel"  # but for a hair, so that no last bit decides what is computed
    hair = HAIR * (-1.0) ** np.arange(along.sum())
    w[along] = np.hypot(*w[along].T)[:, None] * unit(phi[along] + hair)
    begin[along] = p[along] + unit(phi[along] + rng.uniform(0.3, 1.2, along.sum()))
    return {"p": p, "phi": phi + 2 * np.pi * turns, "wall": np.hstack([begin, begin + w])}


def _squarely(rng):
    """Beams along x and y, walls along y and x; ahead, behind, beside."""
    towards = np.array([0, np.pi / 2, np.pi, -np.pi / 2])
    phi, n = np.tile(towards, 3), 12
    t, s = rng.uniform(1, 4, n), rng.uniform(0.1, 0.9, n)
    t[4:8] *= -1
    s[8:] += [1, -1, 1, -1]
    p, u, w = rng.uniform(-2, 2, (n, 2)), np.round(unit(phi)), 2 * np.round(unit(phi + np.pi / 2))
    w *= rng.choice([-1, 1], (n, 1))
    begin = p + t[:, None] * u - s[:, None] * w
    end = begin + w
    for k in range(n):
        end[k, k % 2] = begin[k, k % 2]  # to the last bit
    return {"p": p, "phi": phi, "wall": np.hstack([begin, end])}


def _along(rng):
    """Beams along x, walls along x: beside the beam, and on its own line."""
    p, x = rng.uniform(-2, 2, (4, 2)), rng.uniform(0.5, 2, (4, 2))
    y = p[:, 1] + [0.7, -0.4, 0, 0]
    x1, x2 = p[:, 0] + x[:, 0], p[:, 0] + x.sum(axis=1)
    turned = np.array([False, True, False, True])
    x1, x2 = np.where(turned, x2, x1), np.where(turned, x1, x2)
    return {"p": p, "phi": np.zeros(4), "wall": np.column_stack([x1, y, x2, y])}


@once
def kinds(inputs):
    """(n,) of ``KINDS``, one for each wall."""
    p, phi, wall = inputs["p"], inputs["phi"], inputs["wall"]
    w = wall[:, 2:] - wall[:, :2]
    with np.errstate(all="ignore"):
        t, s = crossing(p, phi, wall)
    sine = abs(unit(phi)[:, 0] * w[:, 1] - unit(phi)[:, 1] * w[:, 0]) / np.hypot(*w.T)
    conditions = [sine < 1e-9, (s < 0) | (s > 1), t < 0]
    return np.select(conditions, ["parallel", "beside", "behind"], "ahead")


def far(inputs):
    """(n,) how far each beam flies; infinity where it meets nothing."""
    with np.errstate(all="ignore"):
        t, _ = crossing(inputs["p"], inputs["phi"], inputs["wall"])
    return np.where(kinds(inputs) == "ahead", t, np.inf)


def _on_the_way(inputs):
    t, s = crossing(inputs["p"], inputs["phi"], inputs["wall"])
    return {"r": t, "τ": s}


def _law(kind, points, says, asks):
    def holds(inputs, outputs):
        return (kinds(inputs) != kind) | distance_is(inputs, outputs, far(inputs))

    name = "reached" if kind == "ahead" else kind
    step = None if kind == "parallel" else _on_the_way
    want = lambda inputs: as_outputs(far(inputs))  # noqa: E731
    return Law(name, points, says, holds, want=want, asks=asks, step=step)


def _parts(inputs, outputs):
    kind = kinds(inputs)
    both = np.column_stack([outputs["met"], np.clip(outputs["distance"], -FARTHEST, FARTHEST)])
    return {name: both[kind == name] for name in KINDS}


NEVER_MET = Diagnosis(
    "never-met",
    "You say inf even of walls that stand right before the sensor. Look at the signs: the way to "
    "the wall's beginning leads from p to (x1, y1).",
    lambda inputs, outputs: not outputs["met"].any(),
)


def _promised(inputs):
    """(n,) whether walls have a length, and beams do not just touch the ends of one."""
    w = inputs["wall"][:, 2:] - inputs["wall"][:, :2]
    t, s = crossing(inputs["p"], inputs["phi"], inputs["wall"])
    clear = (np.minimum(abs(s), abs(s - 1)) > 0.002) & (abs(t) > 0.001)
    return (np.hypot(*w.T) > 0.001) & (clear | (kinds(inputs) == "parallel"))


RAY_WALL = Task(
    id="02-ray-wall",
    title="A beam and a wall",
    drive=DRIVES["02-ray-wall"],
    inputs=beams,
    shapes=lambda inputs: {"met": inputs["phi"].shape, "distance": inputs["phi"].shape},
    laws=(
        _law(
            "ahead",
            2,
            "where a wall stands in the way, the point at that distance lies on the beam and "
            "between the wall's ends",
            "What becomes of (02.1) where the beam starts at p? At which r and τ do both sides "
            "name the same place?",
        ),
        _law(
            "behind",
            1,
            "a wall behind the sensor is not met: inf",
            "Which of your numbers says on which side of the sensor the lines cross?",
        ),
        _law(
            "beside",
            1,
            "a beam that passes beside the wall does not meet it: inf",
            "Which of your numbers says where on the wall the lines cross, and what are its values "
            "at the two ends?",
        ),
        _law(
            "parallel",
            1,
            "a wall parallel to the beam is not met: inf",
            "What do you divide by, and when is that zero?",
        ),
    ),
    probes=(
        Probe("beams and walls along x and y", _squarely),
        Probe("a wall along the beam", _along, ("parallel",)),
        Probe("posts of a few centimetres", lambda rng: beams(rng, length=(0.02, 0.08))),
        Probe("walls nearer than a metre", lambda rng: beams(rng, t=(0.005, 0.9))),
        Probe("long walls far away", lambda rng: beams(rng, (40, 90), (50, 99), (6, 3, 4, 2))),
        Probe("a direction beyond a whole turn", lambda rng: beams(rng, turns=-2)),
        Probe(
            "posts of a few centimetres, almost along the beam",
            lambda rng: beams(rng, length=(0.02, 0.08), slant=(0.004, 0.02)),
        ),
    ),
    diagnoses=(NEVER_MET,),
    parts=_parts,
    rounds=_promised,
)
