"""Task 09-end: where a wall ends, of a beam's direction and the line, and how sure that is."""

import numpy as np

from slamlab.exercises.drives.ex09 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex06.beliefs import T, either_sign
from slamlab.exercises.tasks.ex09.update import beliefs
from slamlab.geometry import wrap

DIFFERENCES = 1e-4
"""Share of a matrix's largest entry: one-sided differences of 1e-6 pass at a slant of 75°, where
the slopes are steep; no wrong form does."""


def ends(rng, rows=8, walls=3, slant=(0.3, 1.1)):
    """Beliefs, and beams that meet one of their walls.

    Parameters
    ----------
    rng : numpy.random.Generator
    rows, walls : int
    slant : (low, high) of the angle between beam and normal; the text promises 80° at most
    """
    x, P = beliefs(rng, rows, walls)
    j = np.arange(rows) % walls
    alpha = x[np.arange(rows), 4 + 2 * j]
    beta = wrap(alpha - x[:, 2] + either_sign(rng, *slant, rows))
    return {"x": x, "P": P, "j": j, "beta": beta, "sigma": rng.uniform(0.01, 0.05, rows)}


def _origin(rng):
    """A robot at the origin that looks along x at walls along x and y."""
    found = ends(rng, 3, 1)
    found["x"] = np.array([[0, 0, 0, 2, 0], [0, 0, 0, 1, np.pi / 2], [0, 0, 0, 3.0, -np.pi / 2]])
    found["beta"] = np.array([np.pi / 4, np.pi / 3, -np.pi / 4])
    return found


def _behind(rng):
    """Beams that leave the robot backwards, on both sides of ±π."""
    found = ends(rng, 4, 2)
    found["beta"] = np.pi * np.array([1, -1, 1, -1]) - [0.05, -0.05, 0.2, -0.2]
    rows = np.arange(4)
    found["x"][rows, 4 + 2 * found["j"]] = wrap(found["x"][:, 2] + found["beta"] + 0.4)
    c, s = (f(found["x"][rows, 4 + 2 * found["j"]]) for f in (np.cos, np.sin))
    found["x"][rows, 3 + 2 * found["j"]] = found["x"][:, 0] * c + found["x"][:, 1] * s + 2
    return found


def _geometry(inputs):
    """Unit vectors along the normals and the beams, the lines' ρ and the ranges, row by row."""
    rows, x = np.arange(len(inputs["x"])), inputs["x"]
    rho, alpha = x[rows, 3 + 2 * inputs["j"]], x[rows, 4 + 2 * inputs["j"]]
    phi = x[:, 2] + inputs["beta"]
    n, beam = (np.column_stack([np.cos(a), np.sin(a)]) for a in (alpha, phi))
    r = (rho - (n * x[:, :2]).sum(axis=1)) / (n * beam).sum(axis=1)
    return n, beam, r


def want(inputs):
    """The end, its covariance, and what it shares with the state.

    With m across the beam: n·p = ρ and m·p = m·(x, y). Differentiated, these are two equations for
    dp: n·dp = dρ − (t·p) dα and m·dp = m·(dx, dy) + r (dθ + dβ).
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


def _on_the_way(inputs):
    return {"J": want(inputs)["J"]}


def _changed(rows=2, **factors):
    def inputs(rng):
        found = ends(rng, rows, 2)
        return found | {name: found[name] * by for name, by in factors.items()}

    return inputs


def _promised(inputs):
    """(n,) whether beam and normal are less than 80° apart, and r is positive."""
    n, beam, r = _geometry(inputs)
    return ((n * beam).sum(axis=1) > np.cos(np.radians(80))) & (r > 0)


END_POINT = Task(
    id="09-end",
    title="Where a wall ends",
    drive=DRIVES["09-end"],
    inputs=ends,
    probes=(
        Probe("a beam square on the wall", lambda rng: ends(rng, 2, 2, slant=(0.0, 0.0))),
        Probe("a beam at a slant of 75°", lambda rng: ends(rng, 4, 2, slant=(1.3, 1.3))),
        Probe("beams that leave the robot backwards", _behind),
        Probe("a robot at the origin, and walls along x and y", _origin),
        Probe("a map of one wall", lambda rng: ends(rng, 2, 1)),
        Probe("a map of six walls", lambda rng: ends(rng, 6, 6)),
        Probe("a beam whose direction is known exactly", _changed(sigma=0.0)),
        Probe("errors that share nothing", _changed(P=np.eye(7))),
    ),
    shapes=lambda inputs: {
        "p": (len(inputs["x"]), 2),
        "C": (len(inputs["x"]), 2, 2),
        "X": (len(inputs["x"]), 2, inputs["x"].shape[1]),
    },
    laws=(
        equals(
            "place",
            0.5,
            "p lies on the wall, and on the beam",
            _only("p"),
            asks="How far must you go along the beam until a cos α + b sin α is ρ?",
            step=lambda inputs: {"the range": _geometry(inputs)[2]},
        ),
        equals(
            "C",
            3,
            "C is the covariance of p when state and beam err as P and sigma say",
            _only("C"),
            tolerance=DIFFERENCES,
            asks="Of which six numbers is p a function? How does it move when one of them does?",
            step=_on_the_way,
            after=("place",),
        ),
        equals(
            "X",
            1.5,
            "X is what p shares with all of the state",
            _only("X"),
            tolerance=DIFFERENCES,
            asks="Walls that are not met stand in X as well. What ties p to them?",
            step=_on_the_way,
            after=("place",),
        ),
    ),
    rounds=_promised,
)
