"""Task 09-end: the intersection of a beam with a wall, with its covariance."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.task import Probe, Task
from course.exercises.ex06_ekf_slam.beliefs import T, either_sign
from course.exercises.ex09_slam_with_walls.calls import CALLS
from course.exercises.ex09_slam_with_walls.merge.task import ANGLES, beliefs
from course.exercises.surveyed import EXACT, FAR, differences, vague
from slamlab.geometry import wrap


def ends(rng, rows=8, walls=3, slant=(0.3, 1.1)):
    """Prior states, and beams that meet one of their walls.
    slant : angle between beam and normal [rad]; the text promises less than 80°.
    """
    x, P = beliefs(rng, rows, walls)
    j = np.arange(rows) % walls
    alpha = x[np.arange(rows), 4 + 2 * j]
    beta = wrap(alpha - x[:, 2] + either_sign(rng, *slant, rows))
    return {"x": x, "P": P, "j": j, "beta": beta, "sigma": rng.uniform(0.01, 0.05, rows)}


def _origin(rng):
    found = ends(rng, 3, 1)
    found["x"] = np.array([[0, 0, 0, 2, 0], [0, 0, 0, 1, np.pi / 2], [0, 0, 0, 3.0, -np.pi / 2]])
    found["beta"] = np.array([np.pi / 4, np.pi / 3, -np.pi / 4])
    return found


def _behind(rng):
    found = ends(rng, 4, 2)
    found["beta"] = np.pi * np.array([1, -1, 1, -1]) - [0.05, -0.05, 0.2, -0.2]
    rows = np.arange(4)
    found["x"][rows, 4 + 2 * found["j"]] = wrap(found["x"][:, 2] + found["beta"] + 0.4)
    c, s = (f(found["x"][rows, 4 + 2 * found["j"]]) for f in (np.cos, np.sin))
    found["x"][rows, 3 + 2 * found["j"]] = found["x"][:, 0] * c + found["x"][:, 1] * s + 2
    return found


def _carried_off(inputs):
    """Turn robot and walls so that the normal of wall j is the x-axis, and move them along it."""
    x, far = inputs["x"].copy(), 3 * FAR
    along = x[np.arange(len(x)), 4 + 2 * inputs["j"]]
    c, s = np.cos(along), np.sin(along)
    x[:, :2] = np.column_stack([far + c * x[:, 0] + s * x[:, 1], c * x[:, 1] - s * x[:, 0]])
    x[:, ANGLES] = wrap(x[:, ANGLES] - along[:, None])
    x[:, 3::2] += far * np.cos(x[:, 4::2])
    return inputs | {"x": x}


def _geometry(inputs):
    """Normals, directions of beams and ranges, row by row."""
    rows, x = np.arange(len(inputs["x"])), inputs["x"]
    rho, alpha = x[rows, 3 + 2 * inputs["j"]], x[rows, 4 + 2 * inputs["j"]]
    phi = x[:, 2] + inputs["beta"]
    n, beam = (np.column_stack([np.cos(a), np.sin(a)]) for a in (alpha, phi))
    r = (rho - (n * x[:, :2]).sum(axis=1)) / (n * beam).sum(axis=1)
    return n, beam, r


def want(inputs):
    """The end and its covariances. With m perpendicular to the beam and t along the wall,
    n·p = ρ and m·p = m·(x, y) give n·dp = dρ − (t·p) dα and m·dp = m·(dx, dy) + r (dθ + dβ).
    """
    (n, beam, r), x = _geometry(inputs), inputs["x"]
    t, m = (v[:, ::-1] * [-1, 1] for v in (n, beam))
    p, rows = x[:, :2] + r[:, None] * beam, np.arange(len(x))
    B = np.zeros((len(x), 2, x.shape[1]))
    B[rows, 0, 3 + 2 * inputs["j"]] = 1
    B[rows, 0, 4 + 2 * inputs["j"]] = -(t * p).sum(axis=1)
    B[:, 1, :2], B[:, 1, 2] = m, r
    back = np.linalg.inv(np.stack([n, m], axis=1))
    J, by_beam = back @ B, back[:, :, 1] * r[:, None]
    by_beam = by_beam * inputs["sigma"][:, None]
    X = J @ inputs["P"]
    return {"p": p, "C": X @ T(J) + by_beam[:, :, None] * by_beam[:, None], "X": X, "J": J}


def _only(name):
    return lambda inputs: {name: want(inputs)[name]}


def _parts(inputs, outputs):
    far = 1 + np.abs(inputs["x"][:, :1])  # a fingerprint has few digits
    return {"p": outputs["p"] / far, "C": outputs["C"], "X": outputs["X"]}


def _on_the_way(inputs):
    return {"J": want(inputs)["J"]}


def _changed(rows=2, **factors):
    def inputs(rng):
        found = ends(rng, rows, 2)
        return found | {name: found[name] * by for name, by in factors.items()}

    return inputs


def _promised(inputs):
    """Whether the angle between beam and normal is less than 80°, and r positive."""
    n, beam, r = _geometry(inputs)
    return ((n * beam).sum(axis=1) > np.cos(np.radians(80))) & (r > 0)


FAR_OFF = "a robot 3000 km from the origin"

END_POINT = Task(
    id="09-end",
    title="The end of a wall",
    call=CALLS["09-end"],
    inputs=ends,
    probes=(
        Probe("a beam perpendicular to the wall", lambda rng: ends(rng, 2, 2, slant=(0.0, 0.0))),
        Probe("an angle of incidence of 75°", lambda rng: ends(rng, 4, 2, slant=(1.3, 1.3))),
        Probe("beams that point backwards", _behind),
        Probe("a robot at the origin and walls parallel to the axes", _origin),
        Probe("a map of one wall", lambda rng: ends(rng, 2, 1)),
        Probe("a map of six walls", lambda rng: ends(rng, 6, 6)),
        Probe("a beam whose direction is known exactly", _changed(sigma=0.0)),
        Probe("uncorrelated errors", _changed(P=np.eye(7))),
        Probe(FAR_OFF, lambda rng: vague(_carried_off(ends(rng, 6, 3)), ["P"], ["sigma"])),
    ),
    diagnoses=(differences(lambda inputs: {name: want(inputs)[name] for name in "CX"}, FAR_OFF),),
    parts=_parts,
    shapes=lambda inputs: {
        "p": (len(inputs["x"]), 2),
        "C": (len(inputs["x"]), 2, 2),
        "X": (len(inputs["x"]), 2, inputs["x"].shape[1]),
    },
    laws=(
        equals(
            "place",
            0.5,
            "p lies on the wall and on the beam",
            _only("p"),
            asks="At which r does the point (a, b) on the beam satisfy a cos α + b sin α = ρ?",
            step=lambda inputs: {"the range": _geometry(inputs)[2]},
        ),
        equals(
            "C",
            3,
            "C is the covariance of p, propagated from P and from sigma",
            _only("C"),
            tolerance=EXACT,
            asks="p is a function of six quantities. How does p change with each of them?",
            step=_on_the_way,
            after=("place",),
        ),
        equals(
            "X",
            1.5,
            "X is the cross-covariance of p with the whole state",
            _only("X"),
            tolerance=EXACT,
            asks="The beam meets one wall only. Why is p correlated with the other walls, too?",
            step=_on_the_way,
            after=("place",),
        ),
    ),
    may_round=_promised,
    begins=(
        "A robot at the origin has the heading 0. A wall has ρ = 2 m and α = 0. At "
        "which point does a beam with β = 45° meet it?",
        "On which of the quantities x, y, θ, ρ, α and β does this point depend?",
    ),
)
