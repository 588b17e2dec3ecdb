"""Task 08-corner: the point on both lines, and its covariance by differentiating n·p = ρ."""

import numpy as np

from slamlab.exercises.drives.ex08 import DRIVES
from slamlab.exercises.law import equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex08.lines import across, covariances, direction

NARROWEST = np.radians(15)  # between walls; the text promises 10°


def pairs(rng, n=14, rho=(0.8, 4), apart=(0.7, 1.3), **errors):
    """Pairs of lines with their covariances.

    Parameters
    ----------
    rng : numpy.random.Generator
    n : int
    rho : (low, high) [m]
    apart : (low, high) of the angle between the two [rad]
    errors : of :func:`covariances`
    """
    errors = {"rho": (0.008, 0.03), "alpha": (0.006, 0.02)} | errors
    first = np.column_stack([rng.uniform(*rho, n), rng.uniform(-np.pi, np.pi, n)])
    turn = rng.choice([-1.0, 1.0], n) * rng.uniform(*apart, n)
    second = np.column_stack([rng.uniform(*rho, n), first[:, 1] + turn])
    R1, R2 = covariances(rng, (n,), **errors), covariances(rng, (n,), **errors)
    return {"z1": first, "R1": R1, "z2": second, "R2": R2}


def _one_exact(rng):
    """The first line is known exactly in one row, the second in the other."""
    found = pairs(rng, 2)
    found["R1"][0] = found["R2"][1] = 0
    return found


def _square(rng):
    """Walls along x and y: α is a multiple of π/2, ρ a whole number."""
    found = pairs(rng, 4)
    found["z1"] = np.array([[2.0, 0.0], [1.0, np.pi / 2], [3.0, np.pi], [2.0, -np.pi / 2]])
    found["z2"] = np.array([[1.0, np.pi / 2], [4.0, 0.0], [1.0, np.pi / 2], [5.0, np.pi]])
    return found


def _normals(inputs):
    """(n, 2, 2): a row for each of the two lines."""
    return np.stack([direction(inputs[name][:, 1]) for name in ("z1", "z2")], axis=1)


def meeting(inputs):
    """{"p": (n, 2)} where the lines meet."""
    rho = np.stack([inputs["z1"][:, 0], inputs["z2"][:, 0]], axis=-1)
    return {"p": np.linalg.solve(_normals(inputs), rho[..., None])[..., 0]}


def slopes(inputs):
    """(n, 2, 2), (n, 2, 2): the derivatives of p by the first line and by the second."""
    N, p = _normals(inputs), meeting(inputs)["p"]
    back, lever = np.linalg.inv(N), np.einsum("nki,ni->nk", across(N), p)
    ways = np.stack([np.ones_like(lever), -lever], axis=-1)
    return tuple(back[:, :, k, None] * ways[:, k, None, :] for k in (0, 1))


def spread(inputs):
    """{"P": (n, 2, 2)}: both lines' errors, carried to the corner."""
    first, second = slopes(inputs)
    parts = (J @ R @ J.mT for J, R in ((first, inputs["R1"]), (second, inputs["R2"])))
    return {"P": sum(parts)}


def _on_the_way(inputs):
    first, second = slopes(inputs)
    return {"∂p/∂(ρ₁, α₁)": first, "∂p/∂(ρ₂, α₂)": second}


def _promised(inputs):
    """(n,) whether walls are 10° from parallel."""
    return np.abs(np.linalg.det(_normals(inputs))) > np.sin(np.radians(10))


CORNER = Task(
    id="08-corner",
    title="Where two walls meet",
    drive=DRIVES["08-corner"],
    inputs=pairs,
    shapes=lambda inputs: {"p": (len(inputs["z1"]), 2), "P": (len(inputs["z1"]), 2, 2)},
    laws=(
        equals(
            "place",
            1,
            "p lies on both lines",
            meeting,
            asks="n₁·p = ρ₁ and n₂·p = ρ₂ are two equations for two numbers. As N p = …, what are "
            "the "
            "rows of N?",
            step=lambda inputs: {"N": _normals(inputs)},
        ),
        equals(
            "covariance",
            2.5,
            "P is the covariance of p when both lines err as R1 and R2 say",
            spread,
            asks="When only the first line moves, by dρ₁ and dα₁, what is n₁·dp, and what is "
            "n₂·dp? "
            "Which dp obeys both?",
            step=_on_the_way,
            after=("place",),
        ),
    ),
    probes=(
        Probe("walls along x and y", _square),
        Probe("walls nearly parallel", lambda rng: pairs(rng, 3, apart=(NARROWEST, 0.3))),
        Probe("a negative ρ", lambda rng: pairs(rng, 3, rho=(-4, -0.5))),
        Probe("walls through the origin", lambda rng: pairs(rng, 3, rho=(0.0, 0.0))),
        Probe("a line that is known exactly", _one_exact),
        Probe("R1 and R2 diagonal", lambda rng: pairs(rng, 3, tie=(0, 0))),
        Probe("large errors", lambda rng: pairs(rng, 1, alpha=(0.2, 0.3))),
    ),
    parts=lambda inputs, outputs: {name: outputs[name] for name in ("p", "P")},
    rounds=_promised,
)
