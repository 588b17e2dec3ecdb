"""04-moments: the pose after a motion with a heading that is too uncertain for
linearisation."""

import numpy as np

from classroom.exercises.correctness_laws import Law
from classroom.exercises.task import Probe, Task
from course.exercises.ex04_models_and_jacobians.calls import CALLS
from course.exercises.ex04_models_and_jacobians.generic import covariances, poses
from course.exercises.ex04_models_and_jacobians.moments.scatter import (
    MISTAKES,
    SLIP,
    allowed,
    ends,
    lost,
)
from slamlab.geometry import wrap

ROWS, EACH = 20, 20
LIMITS = (3.0, 0.1, 0.01)
"""Largest median losses [nat]: linearisation loses 11, second order and sigma points 0.1 to 0.6, a
hundred samples 0.1, two thousand 0.002."""
EXACTLY = 1e-5
"""Largest loss of any motion [nat]: 100 000 samples lose 1e-4, an exact method nothing."""


def _drives(rng, n, heading, wheels=1.0):
    noise = wheels * np.column_stack([rng.uniform(0.05, 0.2, n), rng.uniform(0.02, 0.1, n)])
    return {
        "x": poses(rng, n),
        "P": covariances(rng, np.column_stack([rng.uniform(0.05, 0.3, (n, 2)), heading])),
        "u": np.column_stack([rng.uniform(2, 6, n), rng.uniform(-1, 1, n)]),
        "C": covariances(rng, noise),
    }


def _random(rng):
    return _drives(rng, ROWS, rng.permutation(np.linspace(0.3, 0.8, ROWS)))


def _certain(rng):
    inputs = _drives(rng, EACH, np.full(EACH, 0.01), wheels=3.0)
    return inputs | {"P": inputs["P"] * 0.01}


def _slipping(rng):
    inputs = _drives(rng, EACH, np.full(EACH, 0.8), wheels=3.0)
    return inputs | {"u": inputs["u"] * [0.1, 1]}


def _times(rng, share):
    inputs = _drives(rng, EACH, rng.uniform(0.3, 0.8, EACH))
    return inputs | {"u": inputs["u"] * [share, 1]}


def _turned(rng):
    inputs = _drives(rng, EACH, rng.uniform(0.3, 0.8, EACH))
    inputs["x"][:, 2] = np.resize([np.pi, -np.pi, 3.1], EACH)
    return inputs


def _why(inputs, outputs):
    own, (mean, best) = outputs["covariance"][:1], ends(inputs)
    if not allowed(own)[0]:
        return "that is no covariance: it must be symmetric, with positive eigenvalues"
    off = outputs["mean"][0] - mean[0]
    off[2] = wrap(off[2])
    values, vectors = np.linalg.eig(np.linalg.solve(own[0], best[0] + np.outer(off, off)))
    direction = np.real(vectors[:, np.argmax(np.abs(np.log(np.abs(values))))])
    yours, sigma = (np.sqrt(direction @ S @ direction) for S in (own[0], best[0]))
    lines = (
        f"its loss is {lost(inputs, outputs)[0]:.3g} nats; the true mean is {_short(mean[0])};",
        f"along {_short(direction)} [m, m, rad] the true σ is {sigma:.3f}, yours is {yours:.3f},",
        f"and your mean has an error of {abs(direction @ off):.3f} in this direction",
    )
    return "\n    ".join(lines)


def _short(vector):
    return np.array2string(vector, precision=2, suppress_small=True)


def _step(inputs):
    theta, less = inputs["x"][:, 2], np.exp(-inputs["P"][:, 2, 2] / 2)
    means = np.column_stack([less * np.cos(theta), less * np.sin(theta)])
    return {"E[cos θ], E[sin θ] at the start": means}


def _half(name, points, limit, asks):
    """A law: the loss of half of the inputs is at most the limit [nat]."""

    def holds(inputs, outputs):
        nats = lost(inputs, outputs)
        return (nats <= limit) | (np.median(nats) <= limit)

    says = f"the median loss of each set of motions is at most {limit:g} nat"
    return Law(name, points, says, holds, why=_why, asks=asks, step=_step)


def _shapes(inputs):
    n = len(inputs["x"])
    return {"mean": (n, 3), "covariance": (n, 3, 3)}


def _parts(inputs, outputs):
    S, mean = outputs["covariance"], outputs["mean"].copy()
    mean[:, 2] = np.sin(mean[:, 2])  # wrapped or not
    cross = np.stack([S[:, :2, 2], S[:, 2, :2]])
    return {"mean": mean, "place": S[:, :2, :2], "cross": cross, "heading": S[:, 2, 2]}


def _promised(inputs):
    P, C = (np.einsum("nii->ni", inputs[name]) for name in ("P", "C"))
    near, most = np.abs(inputs["u"][:, 0]) <= 6, np.square([0.601, 0.301])
    return near & (P[:, 2] < 0.801**2) & (most > C).all(axis=1)


TASK = Task(
    id="04-moments",
    title="A prediction with an uncertain heading",
    call=CALLS["04-moments"],
    inputs=_random,
    shapes=_shapes,
    laws=(
        _half(
            "one-nat",
            0.5,
            LIMITS[0],
            "Does a robot drive along its old or its new heading? Some drive more to the left than "
            "estimated, some more to the right: is the mean of their end points nearer to the "
            "start than f(x, u), or farther from it?",
        ),
        _half(
            "tenth",
            0.5,
            LIMITS[1],
            "What does your method use of cos θ: its value, its derivatives, or its values at many "
            "headings?",
        ),
        _half(
            "hundredth",
            1,
            LIMITS[2],
            "If you draw samples: how does the error of a covariance decrease with the number of "
            "samples? If you choose points: do you have enough points at headings far from the "
            "mean?",
        ),
        Law(
            "every-drive",
            2,
            f"in every motion the loss is at most {EXACTLY:g} nat",
            lambda inputs, outputs: lost(inputs, outputs) <= EXACTLY,
            why=_why,
            asks="For a given heading, all other variables are Gaussian, and f is linear in them. "
            "Over which variables must you still average?",
            step=_step,
        ),
    ),
    diagnoses=MISTAKES,
    probes=(
        Probe("headings with σ = 0.001 rad and large control noise", _certain),
        Probe(SLIP, _slipping),
        Probe("negative distances", lambda rng: _times(rng, -1)),
        Probe("turns on the spot", lambda rng: _times(rng, 0)),
        Probe("headings near ±π", _turned),
    ),
    parts=_parts,
    may_round=_promised,
    begins=(
        "Two robots have the headings +0.5 and −0.5 and drive 1 m. Where is the mean "
        "of their end points?",
        "If the heading were known exactly, would the linearised prediction be exact?",
    ),
)
