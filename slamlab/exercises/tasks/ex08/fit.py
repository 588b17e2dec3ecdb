"""Task 08-fit-line: no other line has a smaller sum of squared distances to the points."""

import numpy as np

from slamlab.exercises.drives.ex08 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex08.lines import across, direction, scatter, total

SLACK = 1e-4
"""Share of the least sum of squares: who searches for α to 1e-4 rad instead of solving passes."""
EXACT = 1e-12  # m² a point: the sum of squares of points that lie on a line


def walls(rng, alpha, k, rho=(0.8, 4), half=1.0, noise=0.04):
    """(n, k, 2) points of walls with given directions (n,), seen to one side of the normal."""
    n = len(alpha)
    along = half * (rng.uniform(-1, 1, (n, k)) + rng.choice([-1.0, 1.0], (n, 1)))
    along[:, :2] = along.mean(axis=1, keepdims=True) + np.array(
        [-half, half]
    )  # never all in one place
    off = rng.uniform(*rho, (n, 1)) + noise * rng.standard_normal((n, k))
    normal = direction(alpha)[:, None]
    return {"points": off[..., None] * normal + along[..., None] * across(normal)}


def round_about(rng):
    """Walls all the way round."""
    alpha = np.linspace(-np.pi, np.pi, 18, endpoint=False) + rng.uniform(0.05, 0.25, 18)
    return walls(rng, alpha, 12)


def ahead(rng):
    """Walls straight ahead and behind: their points have nearly the same x."""
    return walls(rng, np.array([0, np.pi, 0, np.pi]), 12)


def _exact(alpha):
    def inputs(rng):
        found = walls(rng, np.array(alpha), 6, noise=0.0)["points"]
        return {"points": np.round(found, 12)}  # cos(π/2) is not quite 0

    return inputs


def _of(k, **how):
    return lambda rng: walls(rng, rng.uniform(-np.pi, np.pi, 6), k, **how)


def _is_least(inputs, outputs):
    points, (rho, alpha) = inputs["points"], outputs["result"].T
    least = np.linalg.eigvalsh(scatter(points))[:, 0]
    off = np.einsum("nki,ni->nk", points, direction(alpha)) - rho[:, None]
    return np.square(off).sum(axis=1) <= (1 + SLACK) * least + EXACT * points.shape[1]


def _wanted(inputs):
    return {"result": total(inputs["points"])}


def _on_the_way(inputs):
    S = scatter(inputs["points"])
    return {
        "the centroid": inputs["points"].mean(axis=1),
        "S_aa, S_ab, S_bb": S[:, [0, 0, 1], [0, 1, 1]],
    }


def _negative(inputs, outputs):
    rho, _ = outputs["result"][outputs["result"][:, 0].argmin()]
    return f"ρ = {rho:.3g} m: a distance, so where the normal points away from the wall, turn it"


def _parts(inputs, outputs):
    rho, alpha = outputs["result"].T
    # by its cosine and sine: −π and π are one direction
    return {"rho": rho, "normal": direction(alpha)}


def _opposite(inputs, outputs):
    """Whether every line is right but for the side to which some normals point."""
    right, alpha = total(inputs["points"]).T
    rho, got = outputs["result"].T
    off = np.abs(np.sin(got - alpha)) < 1e-3
    return (np.abs(rho - right) < 1e-3).all() and off.all() and (np.cos(got - alpha) < 0).any()


HALF_TURN = Diagnosis(  # which of its two signs a normal has is the library's own choice
    "half-turn",
    "For some walls α is off by π: where ρ came out negative, its sign was changed, but α was not "
    "turned with it (or the other way round).",
    _opposite,
)


def _promised(inputs):
    """(n,) whether points are in several places, on no line through the origin, and one is best."""
    least, most = np.linalg.eigvalsh(scatter(inputs["points"])).T
    return (most > 0) & (least < 0.9 * most) & (total(inputs["points"])[:, 0] > 0.01)


FIT_LINE = Task(
    id="08-fit-line",
    title="A wall's line",
    drive=DRIVES["08-fit-line"],
    inputs=round_about,
    shapes={"result": (2,)},
    laws=(
        Law(
            "least",
            2,
            "no other line has a smaller sum of squared distances",
            _is_least,
            want=_wanted,
            asks="Through which point does the best line go, whatever its direction? And about "
            "which "
            "point, then, do you have to measure how the points scatter?",
            step=_on_the_way,
        ),
        Law(
            "vertical",
            1,
            "nor for walls straight ahead, behind and beside, whose points share an x or a y",
            _is_least,
            want=_wanted,
            asks="Does any division in your way there have Σ(x − x̄)² or Σ(y − ȳ)² below?",
            step=_on_the_way,
            main=False,
            after=("least",),
        ),
        Law(
            "outward",
            1,
            "ρ ≥ 0",
            lambda inputs, outputs: outputs["result"][:, 0] >= -1e-12,  # rounding
            why=_negative,
            asks="Which two normals does a line have? To which of them belongs ρ ≥ 0?",
            alone=False,
        ),
    ),
    probes=(
        Probe("walls straight ahead and behind", ahead, ("vertical", "outward")),
        Probe(
            "walls exactly along x or y",
            _exact([0, np.pi, np.pi / 2, -np.pi / 2]),
            ("vertical", "outward"),
        ),
        Probe("two points", _of(2), ("least", "outward")),
        Probe("a hundred points", _of(100, noise=0.01), ("least", "outward")),
        Probe("a wall 40 m away", _of(9, rho=(35, 45), half=4.0), ("least", "outward")),
        Probe("a wall that nearly passes through the origin", _of(10, rho=(0.1, 0.2), noise=0.01)),
    ),
    diagnoses=(HALF_TURN,),
    parts=_parts,
    rounds=_promised,
)
