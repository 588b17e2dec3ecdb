"""Task 08-corner: the intersection of two lines, and its covariance from n·p = ρ."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.task import Probe, Task
from course.exercises.ex08_landmarks_from_scans.calls import CALLS
from course.exercises.ex08_landmarks_from_scans.lines import across, covariances, direction
from course.exercises.surveyed import EXACT, FAR, differences

NARROWEST = np.radians(15)  # between walls; the text promises 10°


def pairs(rng, n=14, rho=(0.8, 4), apart=(0.7, 1.3), **errors):
    """Pairs of lines with covariances; (low, high) of rho [m] and of the angle between them
    [rad]."""
    errors = {"rho": (0.008, 0.03), "alpha": (0.006, 0.02)} | errors
    first = np.column_stack([rng.uniform(*rho, n), rng.uniform(-np.pi, np.pi, n)])
    turn = rng.choice([-1.0, 1.0], n) * rng.uniform(*apart, n)
    second = np.column_stack([rng.uniform(*rho, n), first[:, 1] + turn])
    R1, R2 = covariances(rng, (n,), **errors), covariances(rng, (n,), **errors)
    return {"z1": first, "R1": R1, "z2": second, "R2": R2}


def _one_exact(rng):
    found = pairs(rng, 2)
    found["R1"][0] = found["R2"][1] = 0
    return found


def _square(rng):
    found = pairs(rng, 4)
    found["z1"] = np.array([[2.0, 0.0], [1.0, np.pi / 2], [3.0, np.pi], [2.0, -np.pi / 2]])
    found["z2"] = np.array([[1.0, np.pi / 2], [4.0, 0.0], [1.0, np.pi / 2], [5.0, np.pi]])
    return found


FAR_OFF = "a corner far from the origin, near the foot of the first wall"


def _far(rng):
    """Corners 2 to 4 m beside the foot of the first wall; the second wall's angle is known best."""
    found = pairs(rng, 6, rho=(FAR, 2 * FAR))
    aside = np.array([-1, 1, -1, 1, -1, 1]) * rng.uniform(2, 4, 6)
    n, m = np.moveaxis(_normals(found), 1, 0)
    p = found["z1"][:, :1] * n + aside[:, None] * across(n)
    found["z2"][:, 0] = np.sum(m * p, axis=1)
    sharp = np.diag([1, 1 / FAR])
    return found | {"R2": sharp @ found["R2"] @ sharp}


def _parts(inputs, outputs):
    far = 1 + np.abs(inputs["z1"][:, :1])  # a fingerprint has few digits
    return {"p": outputs["p"] / far, "P": outputs["P"] / far[..., None] ** 2}


def _normals(inputs):
    return np.stack([direction(inputs[name][:, 1]) for name in ("z1", "z2")], axis=1)


def meeting(inputs):
    """{"p": (n, 2)}, the intersections."""
    rho = np.stack([inputs["z1"][:, 0], inputs["z2"][:, 0]], axis=-1)
    return {"p": np.linalg.solve(_normals(inputs), rho[..., None])[..., 0]}


def slopes(inputs):
    """Derivatives of p by the first line and by the second, (n, 2, 2) each."""
    N, p = _normals(inputs), meeting(inputs)["p"]
    back, lever = np.linalg.inv(N), np.einsum("nki,ni->nk", across(N), p)
    ways = np.stack([np.ones_like(lever), -lever], axis=-1)
    return tuple(back[:, :, k, None] * ways[:, k, None, :] for k in (0, 1))


def spread(inputs):
    """{"P": (n, 2, 2)}, both lines' covariances propagated to the corner."""
    first, second = slopes(inputs)
    parts = (J @ R @ J.mT for J, R in ((first, inputs["R1"]), (second, inputs["R2"])))
    return {"P": sum(parts)}


def _on_the_way(inputs):
    first, second = slopes(inputs)
    return {"∂p/∂(ρ₁, α₁)": first, "∂p/∂(ρ₂, α₂)": second}


def _promised(inputs):
    return np.abs(np.linalg.det(_normals(inputs))) > np.sin(np.radians(10))


CORNER = Task(
    id="08-corner",
    title="Corner of two walls",
    call=CALLS["08-corner"],
    inputs=pairs,
    shapes=lambda inputs: {"p": (len(inputs["z1"]), 2), "P": (len(inputs["z1"]), 2, 2)},
    laws=(
        equals(
            "place",
            1,
            "p lies on both lines",
            meeting,
            asks="n₁·p = ρ₁ and n₂·p = ρ₂ are two equations with two unknowns. Write them as N p "
            "= ρ. What are the rows of N?",
            step=lambda inputs: {"N": _normals(inputs)},
        ),
        equals(
            "covariance",
            2.5,
            "P is the covariance of p that follows from the covariances R1 and R2 of the lines",
            spread,
            tolerance=EXACT,
            asks="If only the first line changes, by dρ₁ and dα₁, what are n₁·dp and n₂·dp? "
            "Which dp satisfies both equations?",
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
        Probe(FAR_OFF, _far),
    ),
    diagnoses=(differences(spread, FAR_OFF),),
    parts=_parts,
    may_round=_promised,
    begins=(
        "Two walls have (ρ, α) = (2 m, 0°) and (1 m, 90°). At which point do they meet?",
        "How does this point move if ρ of the first wall becomes 2.1 m?",
    ),
)
