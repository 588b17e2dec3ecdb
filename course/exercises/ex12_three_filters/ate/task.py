"""Task 12-ate: absolute and relative trajectory error."""

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.task import Probe, Task
from course.exercises.ex12_three_filters.calls import CALLS
from slamlab.geometry import between, compose, wrap


def runs(rng, count=8, poses=25, noise=0.1, turn=0.25, steps=None):
    """Trajectories of ``count`` runs, each in a frame of its own: estimate, truth (count, poses, 3)
    [m, m, rad], steps (count,). noise : σ of the drift [m, rad]; turn : of the robot [rad].
    """
    drawn = rng.integers(2, poses // 3, count) if steps is None else np.full(count, steps)
    found = {"estimate": [], "truth": [], "steps": drawn}
    for _ in range(count):
        motions = np.column_stack([rng.uniform(0.2, 0.6, (poses, 2)) * [1, 0.2], np.zeros(poses)])
        motions[:, 2] = turn * rng.standard_normal(poses)
        errors = noise * rng.standard_normal((poses, 3)) * [1, 1, 0.5]
        for name, added in (("truth", 0.0), ("estimate", errors)):
            frame = np.append(rng.uniform(-5, 5, 2), rng.uniform(-np.pi, np.pi))
            found[name].append(_along(frame, motions + added))
    return {name: np.array(each) for name, each in found.items()}


def _along(frame, motions):
    poses = [frame]
    for motion in motions[1:]:
        poses.append(compose(poses[-1], motion))
    return np.array(poses)


def _centred(poses):
    return poses[..., :2] - poses[..., :2].mean(axis=1, keepdims=True)


def _alignment(inputs):
    """Angles (m,) of the best rotation, and the centred positions (m, n, 2) before it."""
    a, b = _centred(inputs["estimate"]), _centred(inputs["truth"])
    # the rotation of complex numbers that maximises the real part of the sum of products
    products = np.sum((a[..., 0] - 1j * a[..., 1]) * (b[..., 0] + 1j * b[..., 1]), axis=1)
    return np.angle(products), a, b


def _rms(vectors):
    return np.sqrt(np.mean(np.sum(vectors**2, axis=-1), axis=-1))


def want(inputs):
    angle, a, b = _alignment(inputs)
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    aligned = np.stack([c * a[..., 0] - s * a[..., 1], s * a[..., 0] + c * a[..., 1]], axis=-1)
    return {"ate": _rms(aligned - b), "rpe": np.array([_rms(e[:, :2]) for e in _relative(inputs)])}


def _relative(inputs):
    for estimate, truth, k in zip(*inputs.values(), strict=True):
        k = int(k)
        m = between(truth[:-k], truth[k:])
        yield between(m, between(estimate[:-k], estimate[k:]))


def _rotation(inputs):
    a, b = (inputs[name][:, :, :2].mean(axis=1) for name in ("estimate", "truth"))
    angle, *_ = _alignment(inputs)
    return {"best rotation [rad]": angle, "centroid of the estimate": a, "of the truth": b}


def _motions(inputs):
    k = int(inputs["steps"][0])
    return {
        name: between(inputs[of][0, :-k], inputs[of][0, k:])[0]
        for name, of in (("first true motion", "truth"), ("first estimated motion", "estimate"))
    }


def _still(rng):
    inputs = runs(rng, 3, 6, steps=2)
    inputs["truth"][:, :, :2] = inputs["truth"][:, :1, :2]
    return inputs


def _mirrored(rng):
    """Straight runs whose errors across would vanish by a reflection."""
    inputs = runs(rng, 3, 9, noise=0.0, turn=0.0, steps=3)
    across = 0.05 * rng.standard_normal((3, 9))
    for name, side in (("estimate", 1), ("truth", -1)):
        motion = np.stack([np.zeros((3, 9)), side * across, np.zeros((3, 9))], axis=-1)
        inputs[name] = compose(inputs[name], motion)
    return inputs


def _far(rng):
    inputs = runs(rng, 3, 12, steps=4)
    inputs["truth"][:, :, :2] += 1e4
    return inputs


def _many_turns(rng):
    inputs = runs(rng, 3, 12, turn=2.0, steps=1)
    return inputs | {name: np.dstack([inputs[name][..., :2], wrap(inputs[name][..., 2])])
                     for name in ("estimate", "truth")}  # fmt: skip


ATE = Task(
    id="12-ate",
    title="Absolute and relative trajectory error",
    call=CALLS["12-ate"],
    inputs=runs,
    shapes={"ate": (None,), "rpe": (None,)},
    laws=(
        equals(
            "ate",
            3,
            "the ATE is the rms position error after the best rotation and translation",
            lambda inputs: {"ate": want(inputs)["ate"]},
            asks="Which translation makes the mean of all position errors zero? After it, which "
            "angle makes the sum of their squares smallest?",
            step=_rotation,
        ),
        equals(
            "rpe",
            2,
            "the RPE is the rms position error of the motions over `steps` poses",
            lambda inputs: {"rpe": want(inputs)["rpe"]},
            asks="In which frame is a motion from pose i to pose i + k? How many such motions does "
            "a run of n poses have?",
            step=_motions,
        ),
    ),
    probes=(
        Probe("two poses", lambda rng: runs(rng, 3, 2, steps=1)),
        Probe("an estimate with errors of 1 mm", lambda rng: runs(rng, 3, 9, 1e-3, steps=2)),
        Probe("one motion, from the first pose to the last", lambda rng: runs(rng, 3, 9, steps=8)),
        Probe("a robot that stands still", _still),
        Probe("straight runs with opposite errors", _mirrored),
        Probe("frames that are 14 km apart", _far),
        Probe("motions of one step, with large turns", _many_turns),
    ),
    may_round=False,
    begins=(
        "Both trajectories are the same triangle, in two frames. Which steps bring one onto the "
        "other?",
        "What are the true and the estimated motion from pose 0 to pose k, in the frame of pose 0?",
    ),
)
