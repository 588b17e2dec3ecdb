"""Task 13-line-step: a correction by point-to-line residuals and odometry."""

from dataclasses import replace

import numpy as np

from classroom.exercises.correctness_laws import equals
from classroom.exercises.function_calls.run_and_pack import MAIN
from classroom.exercises.references import Reference
from classroom.exercises.task import Probe, Task
from course.exercises.ex13_scan_matching.calls import CALLS
from course.exercises.ex13_scan_matching.motions import carried, either_sign, motion
from course.exercises.surveyed import EXACT, NAME, ORIGIN, differences, vague

ROUNDED = (
    1e-13  # largest error of P, relative to it, its condition number and the largest entry of T
)
TURN = np.array([[0.0, -1.0], [1.0, 0.0]])  # by 90° to the left


def pairs(rng, rows=6, n=14, spread=np.pi, off=1.0, tie=(0.3, 0.7)):
    """Source, target, normals (k, n, 2), sigma (k, n), T, Q (k, 3, 3).
    spread : of the walls' directions [rad], 0 for a corridor; off : error of T in units of 10 cm
    and 4°; tie : size of the correlations of this error.
    """
    T = motion(*either_sign(rng, 0.5, 3, (2, rows)), either_sign(rng, 0.5, 2.7, rows))
    x, y, turn = off * either_sign(rng, 0.05, 0.1, (3, rows))
    true = T @ motion(x, y, 0.7 * turn)
    way = rng.uniform(-np.pi, np.pi, (rows, 1)) + rng.uniform(-spread, spread, (rows, n))
    normals = either_sign(rng, 1, 1, (rows, n, 1)) * np.stack([np.cos(way), np.sin(way)], axis=-1)
    sigma = rng.uniform(0.005, 0.03, (rows, n))
    target = true[:, None, :2, 2] + either_sign(rng, 0.5, 3, (rows, n, 2))
    seen = target + off * normals @ TURN * rng.uniform(-0.1, 0.1, (rows, n, 1))
    seen = seen + off * (sigma * rng.normal(size=(rows, n)))[..., None] * normals
    one, two, three = either_sign(rng, *tie, (3, rows))
    L = np.zeros((rows, 3, 3))
    L[:, range(3), range(3)], L[:, 1, 0], L[:, 2, 0], L[:, 2, 1] = 1, one, two, three
    L *= rng.uniform(0.6, 1.4, (rows, 3, 1)) * np.array([0.1, 0.08, 0.06])[:, None]
    return {
        "source": carried(np.linalg.inv(true), seen),
        "target": target,
        "normals": normals,
        "sigma": sigma,
        "T": T,
        "Q": L @ L.mT,
    }


def _whole(rng):
    inputs = pairs(rng, 3, 8)
    source = rng.integers(-4, 5, (3, 8, 2))
    normals = np.resize([[1, 0], [0, 1], [-1, 0], [0, -1]], (3, 8, 2))
    target = source + rng.integers(-1, 2, (3, 8, 2))
    inputs["T"][0] = np.eye(3)
    return inputs | {"source": source, "target": target, "normals": normals}


def _far(rng):
    inputs = vague(pairs(rng, 4, off=10), ["Q"], ["sigma"])  # rounding is small beside e
    inputs["T"][:, :2, 2] += ORIGIN
    inputs["target"] += ORIGIN
    return inputs


def linearised(inputs):
    """Residuals e (k, n) and Jacobians J (k, n, 3)."""
    T, a, n = inputs["T"], inputs["source"], inputs["normals"]
    e = np.sum(n * (carried(T, a) - inputs["target"]), axis=-1)
    seen = n @ T[:, :2, :2]  # the normals as the robot sees them
    lever = a[..., 0] * seen[..., 1] - a[..., 1] * seen[..., 0]
    return e, np.concatenate([seen, lever[..., None]], axis=-1)


def want(inputs):
    """Least squares of walls and odometry, stacked and solved without JᵀJ."""
    e, J = linearised(inputs)
    whitening = np.linalg.inv(np.linalg.cholesky(inputs["Q"]))  # of the error of T
    rows = np.concatenate([J / inputs["sigma"][..., None], whitening], axis=1)
    wanted = np.concatenate([-e / inputs["sigma"], np.zeros((len(e), 3))], axis=1)
    q, upper = np.linalg.qr(rows)
    back = np.linalg.inv(upper)
    return {"delta": (back @ (q.mT @ wanted[..., None]))[..., 0], "P": back @ back.mT}


def _on_the_way(inputs):
    e, J = linearised(inputs)
    return {"e": e, "J": J}


def _exact(law, name, limit, scale):
    """Require, besides a law, that an output has no larger errors than those of rounding."""

    def holds(inputs, outputs):
        right = want(inputs)
        off = _largest(outputs[name] - right[name])
        far = np.maximum(_largest(inputs["T"]), _largest(inputs["target"]))
        allowed = limit * np.linalg.cond(right["P"]) * far * scale(right)
        return law.holds(inputs, outputs) & (off <= allowed)

    return replace(law, holds=holds)


def _largest(array):
    return np.abs(array.reshape(len(array), -1)).max(axis=1, initial=0.0)


STEP = equals(
    "step",
    2.5,
    "δ minimises the sum of squares of walls and odometry",
    lambda inputs: {"delta": want(inputs)["delta"]},
    tolerance=2e-8,
    asks="The robot rotates by dθ about itself. By how much does this move the point a, in "
    "the robot's frame? What is the normal n in this frame?",
    step=_on_the_way,
)
COVARIANCE = _exact(
    equals(
        "covariance",
        2.5,
        "P is the inverse of the information matrix of walls and odometry together",
        lambda inputs: {"P": want(inputs)["P"]},
        tolerance=EXACT,
        asks="Without any correspondence, which matrix is P? What does each correspondence add "
        "to the inverse of P?",
        step=_on_the_way,
    ),
    "P",
    1e-13,
    lambda right: _largest(right["P"]),
)

LINE_STEP = Task(
    id="13-line-step",
    title="A point-to-line step and its covariance",
    call=CALLS["13-line-step"],
    inputs=pairs,
    shapes=lambda i: {"delta": (len(i["T"]), 3), "P": (len(i["T"]), 3, 3)},
    laws=(_exact(STEP, "delta", 3e-14, lambda right: 1.0), COVARIANCE),
    probes=(
        Probe("a corridor", lambda rng: pairs(rng, 3, 10, spread=0)),
        Probe("no correspondences", lambda rng: pairs(rng, 2, 0)),
        Probe("one correspondence", lambda rng: pairs(rng, 2, 1)),
        Probe("forty correspondences", lambda rng: pairs(rng, 1, 40)),
        Probe("residuals of zero", lambda rng: pairs(rng, 2, 6, off=0)),
        Probe("a diagonal Q", lambda rng: pairs(rng, 2, 5, tie=(0, 0))),
        Probe("walls along x and y, integer coordinates", _whole),
        Probe(NAME, _far),
    ),
    diagnoses=tuple(differences(COVARIANCE.want, on, law=COVARIANCE) for on in (NAME, MAIN)),
    parts=lambda inputs, outputs: {name: outputs[name] for name in ("delta", "P")},
    may_round=False,
    references=(Reference("line_step", "source target normals sigma T Q", want, "delta P"),),
    begins=(
        "A point is 10 cm before the wall, and its normal points along x of the "
        "robot. By which motion of the robot does the residual become zero?",
        "Which matrix of weights belongs to the residuals, and which one to δ?",
    ),
)
