"""Task 13-best-motion: the rotation and shift that lay paired points over each other."""

import numpy as np

from slamlab.exercises.drives.ex13 import DRIVES
from slamlab.exercises.law import ROUNDING, TOLERANCE, Law, equals
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex13 import motions
from slamlab.exercises.tasks.ex13.motions import carried, either_sign, motion

LINE = 1e-9  # share of |M|² that det M is of points on a line
TURN = np.s_[:2, :2]
MIRROR = "mirror", "shift"  # laws that are judged where a mirror fits as well


def paired(rng, rows=6, n=9, noise=0.05, turn=(0.5, 2.6), far=2.0):
    """Pairs that fit up to some noise [m]."""
    source = rng.uniform(-2, 2, (rows, n, 2)) + either_sign(rng, far / 2, far, (rows, 1, 2))
    T = motion(*either_sign(rng, 0.25 * far, 1.5 * far, (2, rows)), either_sign(rng, *turn, rows))
    return {"source": source, "target": carried(T, source) + noise * rng.normal(size=source.shape)}


def _walls(rng, rows=6, n=10, across=0.02):
    """One straight wall seen twice, its noise such that a mirror would fit it best."""
    along = rng.uniform(-1.2, 1.2, (rows, n))
    walls = np.stack(np.broadcast_arrays(along, across * rng.normal(size=(2, rows, n))), axis=-1)
    first, second = (w - w.mean(axis=1, keepdims=True) for w in walls)
    # turning one wall's noise over turns the determinant's sign
    walls[1, np.linalg.det(first.mT @ second) > 0, :, 1] *= -1
    places = either_sign(rng, 0.5, 2.8, (3, 2, rows))
    source, target = carried(motion(*places), walls)
    return {"source": source, "target": target}


def _inside_out(rng):
    """Pairs that a mirror alone lays over each other."""
    inputs = paired(rng, 3, 7)
    return inputs | {"target": inputs["target"] * [1, -1]}


def _on_a_line(rng, ends=((-1, 2), (3, 2))):
    """Points along a wall parallel to an axis, seen without an error."""
    share = rng.uniform(0, 1, (2, 6, 1))
    source = share * ends[0] + (1 - share) * np.array(ends[1])
    T = motion(*either_sign(rng, 0.5, 3, (2, 2)), either_sign(rng, 0.5, 2.6, 2))
    return {"source": source, "target": carried(T, source)}


def _whole(rng):
    """Whole numbers, as int."""
    source = rng.integers(-4, 5, (3, 6, 2))
    quarter = np.array([[0, -1], [1, 0]])
    target = source @ quarter.T + rng.integers(-3, 4, (3, 1, 2)) + rng.integers(0, 2, (3, 6, 2))
    return {"source": source, "target": target}


def want(inputs):
    """The best motions, by an arctangent and not by a decomposition."""
    return {"result": motions.fit(inputs["source"], inputs["target"])}


def _carries_the_centroid(inputs, outputs):
    """(n,) whether T, with its own Rot, lays centroid on centroid and is a motion's matrix."""
    T = outputs["result"]
    a, b = (inputs[name].mean(axis=1) for name in ("source", "target"))
    off = np.abs((T[:, :2, :2] @ a[..., None])[..., 0] + T[:, :2, 2] - b).max(axis=1)
    allowed = ROUNDING + TOLERANCE * np.abs([a, b]).max(axis=(0, 2))
    return (off <= allowed) & (np.abs(T[:, 2] - [0, 0, 1]).max(axis=1) <= TOLERANCE)


def _on_the_way(inputs):
    a, b = inputs["source"], inputs["target"]
    p, q = (c - c.mean(axis=1, keepdims=True) for c in (a, b))
    return {"mean of source": a.mean(axis=1), "mean of target": b.mean(axis=1), "M": p.mT @ q}


def _parts(inputs, outputs):
    """Rot, t and the last row where M says which way round; on a line rounding alone decides it."""
    M = _on_the_way(inputs)["M"]
    T = outputs["result"][np.abs(np.linalg.det(M)) > LINE * np.square(M).sum(axis=(1, 2))]
    return {"Rot": T[:, :2, :2], "t": T[:, :2, 2], "last row": T[:, 2]}


def _promised(inputs):
    """(n,) whether one turn is best: no cloud is a single place, nor do all turns fit alike."""
    clouds = (inputs[name] @ [1, 1j] for name in ("source", "target"))
    a, b = (cloud - cloud.mean(axis=1, keepdims=True) for cloud in clouds)
    size = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1)
    return (size > 0) & (np.abs((a.conj() * b).sum(axis=1)) > 0.01 * size)


BEST_MOTION = Task(
    id="13-best-motion",
    title="The best motion of paired points",
    drive=DRIVES["13-best-motion"],
    inputs=paired,
    shapes={"result": (3, 3)},
    laws=(
        equals(
            "turn",
            2,
            "Rot is the rotation with the least sum of squares",
            want,
            parts={"result": TURN},
            asks="Take three points that are only turned by 90°. What are M, U and V, and which "
            "product of the two turns by +90°?",
            step=_on_the_way,
        ),
        Law(
            "shift",
            1,
            "t lays the turned source's centroid on the target's, and the last row is 0 0 1",
            _carries_the_centroid,
            want=want,
            alone=False,
            asks="Where does T carry the centroid of the source, and where should it?",
            step=_on_the_way,
        ),
        equals(
            "mirror",
            1,
            "Rot stays the best rotation where a mirror would fit better, or as well",
            want,
            parts={"result": TURN},
            asks="What is det(V Uᵀ) here? There is one column that costs least to turn over: whose "
            "singular value is the least?",
            step=_on_the_way,
            main=False,
            after=("turn",),
        ),
    ),
    probes=(
        Probe("a wall that would fit best inside out", _walls, MIRROR),
        Probe("pairs that only a mirror lays over each other", _inside_out, MIRROR),
        Probe("two pairs", lambda rng: paired(rng, 4, 2), MIRROR),
        Probe("forty pairs", lambda rng: paired(rng, 1, 40)),
        Probe("pairs that lie on each other", lambda rng: paired(rng, 2, 5, 0, (0, 0), 0)),
        Probe("half a turn", lambda rng: paired(rng, 2, 5, 0, (np.pi, np.pi))),
        Probe("points along a line", _on_a_line, MIRROR),
        Probe("clouds a hundred metres away", lambda rng: paired(rng, 2, 8, far=100)),
        Probe("whole numbers", _whole),
    ),
    parts=_parts,
    rounds=_promised,
)
