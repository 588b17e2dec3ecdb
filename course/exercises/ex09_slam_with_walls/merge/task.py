"""Task 09-merge: two landmarks that represent the same wall become one."""

import numpy as np

from classroom.exercises.correctness_laws import equals, once
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex06_ekf_slam.beliefs import T, covariances, either_sign
from course.exercises.ex09_slam_with_walls.calls import CALLS
from slamlab import models
from slamlab.geometry import wrap

ANGLES = slice(2, None, 2)  # of a state: θ, and each wall's α


def beliefs(rng, rows, walls):
    """Prior states x (rows, n) of a robot with walls around it, and a full P."""
    x = np.empty((rows, 3 + 2 * walls))
    x[:, :2] = either_sign(rng, 1, 4, (rows, 2))
    x[:, 2] = np.where(np.arange(rows) % 2, 1, -1) * rng.uniform(0.3, 2.8, rows)  # both signs
    seen = np.stack(
        [rng.uniform(1, 4, (rows, walls)), either_sign(rng, 0.3, 2.8, (rows, walls))], axis=-1
    )
    for pose, around in zip(x, seen, strict=True):
        pose[3:] = models.g_line(pose[:3], around).ravel()
    sigma = rng.uniform(0.05, 0.15, x.shape)
    sigma[:, ANGLES] = rng.uniform(0.03, 0.06, sigma[:, ANGLES].shape)
    return x, covariances(rng, sigma)


def pairs(rng, rows=8, walls=4, opposite=False, rho=(1, 4), alpha=(0.4, 2.6), turn=(0.03, 0.08)):
    """Prior states, and two of their walls that are nearly the same line.
    opposite : whether their normals are; rho, alpha, turn : magnitudes of ρ_i, α_i and α_j − α_i.
    """
    x, P = beliefs(rng, rows, walls)
    both = [(i, j) for i in range(walls) for j in range(walls) if i != j]
    i, j = np.array([both[7 * k % len(both)] for k in range(rows)]).T
    line = np.column_stack([either_sign(rng, *rho, rows), either_sign(rng, *alpha, rows)])
    size = np.column_stack([rng.uniform(0.05, 0.15, rows), rng.uniform(*turn, rows)])
    out = np.where(np.arange(rows) % 2, -1, 1)[:, None]  # towards zero in every second row
    other = line + out * np.sign(line) * size
    if opposite:
        other = other * [-1, 1] + [0, np.pi]
    for row, place in ((i, line), (j, other)):
        at = np.arange(rows), 3 + 2 * row
        x[at], x[at[0], at[1] + 1] = place[:, 0], wrap(place[:, 1])
    return {"x": x, "P": P, "i": i, "j": j}


def _equal(rng):
    inputs = pairs(rng, 2, 3)
    for x, i, j in zip(inputs["x"], inputs["i"], inputs["j"], strict=True):
        x[3 + 2 * j : 5 + 2 * j] = x[3 + 2 * i : 5 + 2 * i]
    return inputs


def _far_apart(rng):
    inputs = pairs(rng, 2, 3)
    inputs["x"][np.arange(2), 3 + 2 * inputs["j"]] += 3.3  # more than π: ρ is not to be wrapped
    larger = np.diag([1.0] * 3 + [4.0, 1.0] * 3)  # so that the opposite normal is improbable
    return inputs | {"P": larger @ inputs["P"] @ larger}


def _uncorrelated(rng):
    inputs = pairs(rng, 2, 3)
    return inputs | {"P": inputs["P"] * np.eye(9)}


def _lines(inputs):
    """Both lines (k, 2): that of wall i, and that of wall j with the normal nearer to wall i's,
    its angle within π of α_i; and the factor of ρ_j, 1 or −1.
    """
    rows, x = np.arange(len(inputs["x"])), inputs["x"]
    line, other = (
        np.column_stack([x[rows, 3 + 2 * inputs[of]], x[rows, 4 + 2 * inputs[of]]]) for of in "ij"
    )
    side = np.where(np.cos(other[:, 1] - line[:, 1]) > 0, 1, -1)
    turned = wrap(other[:, 1] - line[:, 1] + np.where(side < 0, np.pi, 0))
    return line, np.column_stack([side * other[:, 0], line[:, 1] + turned]), side


@once
def want(inputs):
    """Least squares over the maps in which both walls are the same line; d² is its cost."""
    (_, other, side), n = _lines(inputs), inputs["x"].shape[1]
    found = {"d2": [], "x": [], "P": []}
    for k, (x, P) in enumerate(zip(inputs["x"], inputs["P"], strict=True)):
        kept, gone = 3 + 2 * inputs["i"][k], 3 + 2 * inputs["j"][k]
        M, x = np.eye(n), x.copy()
        M[gone : gone + 2] = M[kept : kept + 2]
        M[gone] *= side[k]  # the state, from the merged one
        x[gone : gone + 2] = other[k] * [side[k], 1]
        M, W = np.delete(M, [gone, gone + 1], axis=1), np.linalg.inv(P)
        found["P"].append(np.linalg.inv(M.T @ W @ M))
        found["x"].append(found["P"][-1] @ M.T @ W @ x)
        residual = x - M @ found["x"][-1]
        found["d2"].append(residual @ W @ residual)
    return {name: np.array(values) for name, values in found.items()}


def _only(*names):
    return lambda inputs: {name: want(inputs)[name] for name in names}


def _on_the_way(inputs):
    (line, other, side), rows = _lines(inputs), np.arange(len(inputs["x"]))
    H = np.zeros((len(rows), 2, inputs["x"].shape[1]))
    for k in (0, 1):
        H[rows, k, 3 + 2 * inputs["i"] + k] = -1
        H[rows, k, 3 + 2 * inputs["j"] + k] = np.where(k, 1, side)
    return {"difference of the lines": other - line, "its covariance": H @ inputs["P"] @ T(H)}


def _turned_round(inputs):
    return {"ρ_j and α_j for the normal of wall i": _lines(inputs)[1]}


def _parts(inputs, outputs):
    """The outputs, with other names for opposite normals and for an angle that jumps: a mistake
    there does not hide another one.
    """
    x, (line, _, side) = outputs["x"].copy(), _lines(inputs)
    x[:, ANGLES] = wrap(x[:, ANGLES])
    kind = "reversed " if min(side) < 0 else "wrapped " if max(abs(line[:, 1])) > 3 else ""
    return {kind + "d2": outputs["d2"], kind + "x": x, kind + "P": outputs["P"]}


def _promised(inputs):
    """Whether P is positive definite and the normals are nearly parallel."""
    line, other, _ = _lines(inputs)
    definite = np.linalg.eigvalsh(inputs["P"])[:, 0] > 1e-6
    return definite & (np.abs(other - line)[:, 1] < np.radians(30))


GIVEN = {"turn": (0.35, 0.5)}
OPPOSITE, JUMP = ("reversed",), ("wrapped",)
ALL = {"angles": {"x": ANGLES}, "main": False, "after": ("d2", "mean", "P")}

MERGE = Task(
    id="09-merge",
    title="Landmark merging: one wall, two landmarks",
    call=CALLS["09-merge"],
    inputs=pairs,
    probes=(
        Probe("opposite normals", lambda rng: pairs(rng, 6, 4, True), OPPOSITE),
        Probe(
            "opposite normals, of a wall near the world's origin",
            lambda rng: pairs(rng, 4, 3, True, rho=(0.01, 0.04)),
            OPPOSITE,
        ),
        Probe(
            "opposite normals, where the angle jumps",
            lambda rng: pairs(rng, 4, 3, True, alpha=(3.1, 3.13)),
            OPPOSITE,
        ),
        Probe(
            "opposite normals but for 25°", lambda rng: pairs(rng, 4, 3, True, **GIVEN), OPPOSITE
        ),
        Probe("α near π and −π", lambda rng: pairs(rng, 4, 3, alpha=(3.12, 3.13)), JUMP),
        Probe("a wall near the world's origin", lambda rng: pairs(rng, 4, 3, rho=(0.01, 0.04))),
        Probe("normals that differ by 25°", lambda rng: pairs(rng, 4, 3, **GIVEN)),
        Probe("a map of two walls", lambda rng: pairs(rng, 2, 2)),
        Probe("a map of six walls", lambda rng: pairs(rng, 6, 6)),
        Probe("two equal lines", _equal),
        Probe("walls 3.3 m apart", _far_apart),
        Probe("uncorrelated errors", _uncorrelated),
    ),
    shapes=lambda inputs: {
        "d2": (len(inputs["x"]),),
        "x": (len(inputs["x"]), inputs["x"].shape[1] - 2),
        "P": (len(inputs["x"]), inputs["x"].shape[1] - 2, inputs["x"].shape[1] - 2),
    },
    parts=_parts,
    may_round=_promised,
    laws=(
        equals(
            "d2",
            1,
            "d2 is the squared Mahalanobis distance of the two lines",
            _only("d2"),
            asks="The errors of both walls contain the same error of the pose. Does the difference "
            "of the two lines contain it, too?",
            step=_on_the_way,
        ),
        equals(
            "mean",
            1,
            "x is the least squares estimate in which both walls are the same line",
            _only("x"),
            angles={"x": ANGLES},
            asks="The difference of the two lines is measured: it is zero. What are v and R of "
            "this measurement, and which entries of the state does it correct?",
            step=_on_the_way,
        ),
        equals(
            "P",
            1,
            "P is the covariance of this estimate",
            _only("P"),
            asks="Which variances decrease if the robot learns that two of its walls are one?",
            step=_on_the_way,
        ),
        equals(
            "wrapped",
            0.5,
            "all three are also right if α_i is near π and α_j near −π",
            _only("d2", "x", "P"),
            asks="The normal of wall i has the direction 179°, that of wall j −179°. By how much "
            "do they differ?",
            step=_on_the_way,
            **ALL,
        ),
        equals(
            "reversed",
            1.5,
            "all three are also right if the two normals are opposite",
            _only("d2", "x", "P"),
            asks="A wall is the line x = 2. Which ρ and α has it with the normal along x, and "
            "which with the opposite normal?",
            step=_turned_round,
            **ALL,
        ),
    ),
    references=(Reference("merge", "x P i j", want, "d2 x P"),),
    begins=(
        "Wall i is ρ = 2, α = 0, and wall j is ρ = −2.1, α = π. Where is each of the lines, and "
        "how far apart are they?",
        "How does the difference of the two lines depend on the entries of x? Which H is this?",
        "Which entries of x and P belong to wall j, and when may you remove them?",
    ),
)
