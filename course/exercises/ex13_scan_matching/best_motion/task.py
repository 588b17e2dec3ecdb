"""Task 13-best-motion: the rigid alignment of corresponding points."""

import numpy as np

from classroom.exercises.correctness_laws import ROUNDING, TOLERANCE, Law, equals
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex13_scan_matching import motions
from course.exercises.ex13_scan_matching.calls import CALLS
from course.exercises.ex13_scan_matching.motions import carried, either_sign, motion

LINE = 1e-9  # share of |M|² that det M is of points on a line
TURN = np.s_[:2, :2]
MIRROR = "mirror", "shift"  # laws that are judged where a reflection fits as well


def paired(rng, rows=6, n=9, noise=0.05, turn=(0.5, 2.6), far=2.0):
    """Point clouds with known correspondences and noise [m]."""
    source = rng.uniform(-2, 2, (rows, n, 2)) + either_sign(rng, far / 2, far, (rows, 1, 2))
    T = motion(*either_sign(rng, 0.25 * far, 1.5 * far, (2, rows)), either_sign(rng, *turn, rows))
    return {"source": source, "target": carried(T, source) + noise * rng.normal(size=source.shape)}


def _walls(rng, rows=6, n=10, across=0.02):
    """Two scans of one straight wall whose noise a reflection fits best."""
    along = rng.uniform(-1.2, 1.2, (rows, n))
    walls = np.stack(np.broadcast_arrays(along, across * rng.normal(size=(2, rows, n))), axis=-1)
    first, second = (w - w.mean(axis=1, keepdims=True) for w in walls)
    # mirroring the noise of one scan changes the sign of the determinant
    walls[1, np.linalg.det(first.mT @ second) > 0, :, 1] *= -1
    places = either_sign(rng, 0.5, 2.8, (3, 2, rows))
    source, target = carried(motion(*places), walls)
    return {"source": source, "target": target}


def _inside_out(rng):
    inputs = paired(rng, 3, 7)
    return inputs | {"target": inputs["target"] * [1, -1]}


def _on_a_line(rng, ends=((-1, 2), (3, 2))):
    share = rng.uniform(0, 1, (2, 6, 1))
    source = share * ends[0] + (1 - share) * np.array(ends[1])
    T = motion(*either_sign(rng, 0.5, 3, (2, 2)), either_sign(rng, 0.5, 2.6, 2))
    return {"source": source, "target": carried(T, source)}


def _whole(rng):
    source = rng.integers(-4, 5, (3, 6, 2))
    quarter = np.array([[0, -1], [1, 0]])
    target = source @ quarter.T + rng.integers(-3, 4, (3, 1, 2)) + rng.integers(0, 2, (3, 6, 2))
    return {"source": source, "target": target}


def want(inputs):
    """The best motions, by an arctangent and not by an SVD."""
    return {"result": motions.fit(inputs["source"], inputs["target"])}


def _carries_the_centroid(inputs, outputs):
    """(n,) whether T, with its own Rot, maps centroid to centroid and its last row is 0 0 1."""
    T = outputs["result"]
    a, b = (inputs[name].mean(axis=1) for name in ("source", "target"))
    off = np.abs((T[:, :2, :2] @ a[..., None])[..., 0] + T[:, :2, 2] - b).max(axis=1)
    allowed = ROUNDING + TOLERANCE * np.abs([a, b]).max(axis=(0, 2))
    return (off <= allowed) & (np.abs(T[:, 2] - [0, 0, 1]).max(axis=1) <= TOLERANCE)


def _on_the_way(inputs):
    a, b = inputs["source"], inputs["target"]
    p, q = (c - c.mean(axis=1, keepdims=True) for c in (a, b))
    return {
        "centroid of the source": a.mean(axis=1),
        "centroid of the target": b.mean(axis=1),
        "M": p.mT @ q,
    }


def _parts(inputs, outputs):
    # only where M determines the rotation: for points on a line it depends on rounding
    M = _on_the_way(inputs)["M"]
    T = outputs["result"][np.abs(np.linalg.det(M)) > LINE * np.square(M).sum(axis=(1, 2))]
    return {"Rot": T[:, :2, :2], "t": T[:, :2, 2], "last row": T[:, 2]}


def _promised(inputs):
    """One rotation is best: the points of a cloud are not all equal; the cost depends on Rot."""
    clouds = (inputs[name] @ [1, 1j] for name in ("source", "target"))
    a, b = (cloud - cloud.mean(axis=1, keepdims=True) for cloud in clouds)
    size = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1)
    return (size > 0) & (np.abs((a.conj() * b).sum(axis=1)) > 0.01 * size)


BEST_MOTION = Task(
    id="13-best-motion",
    title="Rigid alignment with known correspondences",
    call=CALLS["13-best-motion"],
    inputs=paired,
    shapes={"result": (3, 3)},
    laws=(
        equals(
            "turn",
            2,
            "Rot is the rotation that minimises the sum of squares",
            want,
            parts={"result": TURN},
            asks="Rotate three points by +90°, without noise. Which rotation does your formula "
            "give? With noise, on which of the points does it depend, and how much on each?",
            step=_on_the_way,
        ),
        Law(
            "shift",
            1,
            "T maps the centroid of the source to that of the target, and its last row is 0 0 1",
            _carries_the_centroid,
            want=want,
            alone=False,
            asks="To which point does T map the centroid of the source? To which point should it?",
            step=_on_the_way,
        ),
        equals(
            "mirror",
            1,
            "Rot is the best rotation also where a reflection fits better, or equally well",
            want,
            parts={"result": TURN},
            asks="What is the determinant of your rotation here? A rotation has +1, a reflection "
            "−1. Which rotation has the smallest sum of squares?",
            step=_on_the_way,
            main=False,
            after=("turn",),
        ),
    ),
    probes=(
        Probe("a wall that a reflection fits best", _walls, MIRROR),
        Probe("a target that is a reflection of the source", _inside_out, MIRROR),
        Probe("two correspondences", lambda rng: paired(rng, 4, 2), MIRROR),
        Probe("forty correspondences", lambda rng: paired(rng, 1, 40)),
        Probe("a source that equals the target", lambda rng: paired(rng, 2, 5, 0, (0, 0), 0)),
        Probe("a rotation by 180°", lambda rng: paired(rng, 2, 5, 0, (np.pi, np.pi))),
        Probe("points on a line", _on_a_line, MIRROR),
        Probe("clouds a hundred metres from the origin", lambda rng: paired(rng, 2, 8, far=100)),
        Probe("integer coordinates", _whole),
    ),
    parts=_parts,
    may_round=_promised,
    references=(Reference("best_motion", "source target", want),),
    begins=(
        "Two source points are (0, 0) and (1, 0), and their target points are (2, 0) "
        "and (2, 1). Which rotation and which translation align them?",
        "To which point must the centroid of the source be transformed?",
    ),
)
