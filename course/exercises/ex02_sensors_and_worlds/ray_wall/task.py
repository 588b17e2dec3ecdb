"""Task 02-ray-wall: one beam and one wall."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law, once
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex02_sensors_and_worlds.calls import CALLS
from course.exercises.ex02_sensors_and_worlds.walls import as_outputs, crossing, distance_is, unit

# so many that one who mistakes an argument for another meets some wall, too
AHEAD, BEHIND, BESIDE, PARALLEL = 44, 10, 16, 4
KINDS = ("ahead", "behind", "beside", "parallel")
HAIR = 1e-12  # [rad]
ENDS = np.tile([[1e-5, 0.9995], [5e-4, 1 - 1e-5]], 4)  # share of the wall: least, largest
FARTHEST = 1e3  # no wall is farther [m]; where parallel lines would meet hangs on rounding


def beams(
    rng,
    t=(0.7, 5),
    length=(1, 4),
    counts=(AHEAD, BEHIND, BESIDE, PARALLEL),
    turns=0,
    slant=(0.05, 1.4),
    share=(0.02, 0.98),
):
    """Beams and walls; ``counts`` of them ahead, behind, beside, parallel; pairs are (low,
    high)."""
    kind = np.repeat(KINDS, counts)
    n = len(kind)
    # where on the wall's line the beam's line crosses it, and how far along
    s, way = rng.uniform(*share, n), rng.uniform(*t, n)
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
    p, x = rng.uniform(-2, 2, (4, 2)), rng.uniform(0.5, 2, (4, 2))
    y = p[:, 1] + [0.7, -0.4, 0, 0]
    x1, x2 = p[:, 0] + x[:, 0], p[:, 0] + x.sum(axis=1)
    turned = np.array([False, True, False, True])
    x1, x2 = np.where(turned, x2, x1), np.where(turned, x1, x2)
    return {"p": p, "phi": np.zeros(4), "wall": np.column_stack([x1, y, x2, y])}


@once
def kinds(inputs):
    p, phi, wall = inputs["p"], inputs["phi"], inputs["wall"]
    w = wall[:, 2:] - wall[:, :2]
    with np.errstate(all="ignore"):
        t, s = crossing(p, phi, wall)
    sine = abs(unit(phi)[:, 0] * w[:, 1] - unit(phi)[:, 1] * w[:, 0]) / np.hypot(*w.T)
    conditions = [sine < 1e-9, (s < 0) | (s > 1), t < 0]
    return np.select(conditions, ["parallel", "beside", "behind"], "ahead")


def far(inputs):
    """Length of each beam, (n,); infinity if it meets no wall."""
    with np.errstate(all="ignore"):
        t, _ = crossing(inputs["p"], inputs["phi"], inputs["wall"])
    return np.where(kinds(inputs) == "ahead", t, np.inf)


def _on_the_way(inputs):
    t, s = crossing(inputs["p"], inputs["phi"], inputs["wall"])
    return {"r": t, "τ": s}


def _determinant(inputs):
    phi, wall = inputs["phi"], inputs["wall"]
    along = wall[:, 2:] - wall[:, :2]
    return {"determinant": np.cos(phi) * along[:, 1] - np.sin(phi) * along[:, 0]}


def _law(kind, points, says, asks):
    def holds(inputs, outputs):
        return (kinds(inputs) != kind) | distance_is(inputs, outputs, far(inputs))

    name = "reached" if kind == "ahead" else kind
    step = _determinant if kind == "parallel" else _on_the_way
    want = lambda inputs: as_outputs(far(inputs))  # noqa: E731
    return Law(name, points, says, holds, want=want, asks=asks, step=step)


def _parts(inputs, outputs):
    kind = kinds(inputs)
    both = np.column_stack([outputs["met"], np.clip(outputs["distance"], -FARTHEST, FARTHEST)])
    return {name: both[kind == name] for name in KINDS}


NEVER_MET = Diagnosis(
    "never-met",
    "Your function gives inf also for walls straight ahead of the sensor. Check the signs. The "
    "vector to the first end of the wall goes from p to (x1, y1).",
    lambda inputs, outputs: not outputs["met"].any(),
    asks="A beam along +x starts at the origin, and a wall stands at x = 2. Which r "
    "and which τ does your code give?",
)


def _promised(inputs):
    w = inputs["wall"][:, 2:] - inputs["wall"][:, :2]
    t, s = crossing(inputs["p"], inputs["phi"], inputs["wall"])
    clear = (np.minimum(abs(s), abs(s - 1)) > 9e-6) & (abs(t) > 0.001)
    return (np.hypot(*w.T) > 0.001) & (clear | (kinds(inputs) == "parallel"))


RAY_WALL = Task(
    id="02-ray-wall",
    title="Ray casting with one beam and one wall",
    call=CALLS["02-ray-wall"],
    inputs=beams,
    shapes=lambda inputs: {"met": inputs["phi"].shape, "distance": inputs["phi"].shape},
    laws=(
        _law(
            "ahead",
            2,
            "if the beam meets the wall, the point at the returned range lies on the beam and "
            "between the ends of the wall",
            "How does (02.1) change if the beam starts at p? For which r and τ are both sides of "
            "the equation the same point? Is your result this r, also for beams along +y and −x?",
        ),
        _law(
            "behind",
            1,
            "for a wall behind the sensor the result is inf",
            "Which of your numbers shows on which side of the sensor the lines intersect?",
        ),
        _law(
            "beside",
            1,
            "if the beam passes beside the wall the result is inf",
            "Which of your numbers shows where on the wall the lines intersect, and which values "
            "does it have at the two ends?",
        ),
        _law(
            "parallel",
            1,
            "for a wall parallel to the beam the result is inf",
            "By which number do you divide, and when is this number zero?",
        ),
    ),
    probes=(
        Probe("beams and walls along x and y", _squarely),
        Probe("a wall parallel to the beam", _along, ("parallel",)),
        Probe("posts of a few centimetres", lambda rng: beams(rng, length=(0.02, 0.08))),
        Probe("walls nearer than a metre", lambda rng: beams(rng, t=(0.005, 0.9))),
        Probe("long walls far away", lambda rng: beams(rng, (40, 90), (50, 99), (6, 3, 4, 2))),
        Probe("a direction beyond a whole turn", lambda rng: beams(rng, turns=-2)),
        Probe("beams just beside an end", lambda rng: beams(rng, counts=(8, 0, 0, 0), share=ENDS)),
        Probe(
            "posts of a few centimetres, almost parallel to the beam",
            lambda rng: beams(rng, length=(0.02, 0.08), slant=(0.004, 0.02)),
        ),
    ),
    diagnoses=(NEVER_MET,),
    parts=_parts,
    may_round=_promised,
    references=(Reference("ray_wall", "p phi wall", lambda inputs: {"result": far(inputs)}),),
    begins=(
        "Write the point at range r on the beam, and the point at the fraction τ of "
        "the wall. When are both the same point?",
        "For which values of r does a point lie ahead of the sensor, and for which "
        "values of τ does it lie on the wall?",
    ),
)
