"""Task 08-fit-line: total least squares."""

import numpy as np

from classroom.exercises.correctness_laws import Diagnosis, Law
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex08_landmarks_from_scans.calls import CALLS
from course.exercises.ex08_landmarks_from_scans.lines import across, direction, scatter, total

SLACK = 1e-4
"""Share of the least sum of squares: who searches for α to 1e-4 rad instead of solving passes."""
EXACT = 1e-12  # m² a point: the sum of squares of points that lie on a line


def walls(rng, alpha, k, rho=(0.8, 4), half=1.0, noise=0.04):
    """(n, k, 2) points of walls with normals alpha (n,), off to one side of the normal."""
    n = len(alpha)
    along = half * (rng.uniform(-1, 1, (n, k)) + rng.choice([-1.0, 1.0], (n, 1)))
    along[:, :2] = along.mean(axis=1, keepdims=True) + np.array(
        [-half, half]
    )  # never all in one place
    off = rng.uniform(*rho, (n, 1)) + noise * rng.standard_normal((n, k))
    normal = direction(alpha)[:, None]
    return {"points": off[..., None] * normal + along[..., None] * across(normal)}


def round_about(rng):
    alpha = np.linspace(-np.pi, np.pi, 18, endpoint=False) + rng.uniform(0.05, 0.25, 18)
    return walls(rng, alpha, 12)


def ahead(rng):
    # points with nearly the same x
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
    return f"ρ = {rho:.3g} m, but a distance is not negative: turn the normal by π if ρ < 0"


def _parts(inputs, outputs):
    rho, alpha = outputs["result"].T
    # by its cosine and sine: −π and π are one direction
    return {"rho": rho, "normal": direction(alpha)}


def _opposite(inputs, outputs):
    right, alpha = total(inputs["points"]).T
    rho, got = outputs["result"].T
    off = np.abs(np.sin(got - alpha)) < 1e-3
    return (np.abs(rho - right) < 1e-3).all() and off.all() and (np.cos(got - alpha) < 0).any()


HALF_TURN = Diagnosis(  # which of its two signs a normal has is the library's own choice
    "half-turn",
    "For some walls α is wrong by π. If ρ is negative, you must change its sign *and* add π to α. "
    "You do only one of the two.",
    _opposite,
    asks="A wall has ρ = 2 m and α = 30°, and your normal points the other way. What "
    "are your ρ and α before and after the correction?",
)


def _promised(inputs):
    """(n,) whether a best line exists, is unique and misses the origin."""
    least, most = np.linalg.eigvalsh(scatter(inputs["points"])).T
    return (most > 0) & (least < 0.9 * most) & (total(inputs["points"])[:, 0] > 0.01)


FIT_LINE = Task(
    id="08-fit-line",
    title="Line of a wall by total least squares",
    call=CALLS["08-fit-line"],
    inputs=round_about,
    shapes={"result": (2,)},
    laws=(
        Law(
            "least",
            2,
            "no other line has a smaller sum of squared distances",
            _is_least,
            want=_wanted,
            asks="In which direction do you measure the distance of a point from the line? Has "
            "your α the direction of the line, or that of its normal?",
            step=_on_the_way,
        ),
        Law(
            "vertical",
            1,
            "the same holds for walls ahead, behind and beside, where all points have equal x or "
            "equal y",
            _is_least,
            want=_wanted,
            asks="Does your code divide by Σ(x − x̄)² or by Σ(y − ȳ)²?",
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
            asks="Which two normals does a line have? For which of them is ρ ≥ 0?",
            alone=False,
            step=_on_the_way,
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
    may_round=_promised,
    references=(Reference("fit_line", "points", _wanted),),
    begins=(
        "Five points have p_x = 2 m, and p_y from −1 to 1 m. What are ρ and α of their wall?",
        "In which direction is the variance of these points smallest?",
    ),
)
