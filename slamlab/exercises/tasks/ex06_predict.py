"""Task 06-predict: the robot moves, the map does not, and P knows it."""

import numpy as np

from slamlab import models
from slamlab.exercises.drives.ex06 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex06_beliefs import ROBOT, T, beliefs, covariance_mistake, covariances, either_sign, moments, same_block, same_mean
from slamlab.models import jacobians

ROWS, LANDMARKS = 8, 2
MAP = slice(3, None)


def drives(rng):
    """Beliefs, and drives (distance, turn) with what is wrong about them."""
    x, P = beliefs(rng, ROWS, LANDMARKS)
    u = np.column_stack([rng.uniform(0.8, 2.5, ROWS), either_sign(rng, 0.3, 0.9, ROWS)])
    sigma = np.column_stack([rng.uniform(0.08, 0.16, ROWS), rng.uniform(0.03, 0.06, ROWS)])
    return {"x": x, "P": P, "u": u, "C": covariances(rng, sigma)}


def _drive(states, u):
    moved = states + 0 * u[:1]
    moved[:3] = models.f_odometry(states[:3], u)
    return moved


def truth(inputs):
    """Means (k, n) and covariances (k, n, n) of the state after the drive."""
    found = [moments(_drive, (x, u), P, C) for x, P, u, C in zip(*inputs.values(), strict=True)]
    return np.array([x for x, _ in found]), np.array([P for _, P in found])


def _mean(inputs, outputs):
    want, P = truth(inputs)
    return same_mean(outputs["x"], want, P)


def _block(rows, columns):
    return lambda inputs, outputs: same_block(outputs["P"], truth(inputs)[1], rows, columns)


# ---- mistakes: the wrong formula, computed on the same beliefs -------------------------------


def _jacobians(inputs, x=None):
    pairs = list(zip(inputs["x"] if x is None else x, inputs["u"], strict=True))
    A = np.array([jacobians.A_odometry(pose, u) for pose, u in pairs])
    return A, np.array([jacobians.W_odometry(pose, u) for pose, u in pairs])


def _made(inputs, A, Q, cross=None):
    """P after a drive, made of some A and Q; the cross blocks A P_ri unless they are given."""
    P = inputs["P"].copy()
    P[:, ROBOT, MAP] = A @ P[:, ROBOT, MAP] if cross is None else cross
    P[:, MAP, ROBOT] = T(P[:, ROBOT, MAP])
    P[:, ROBOT, ROBOT] = A @ P[:, ROBOT, ROBOT] @ T(A) + Q
    return P


def _after_motion(both):
    def formula(inputs):
        W = _jacobians(inputs)[1]
        A_late, W_late = _jacobians(inputs, truth(inputs)[0])
        W = W_late if both else W
        return _made(inputs, A_late, W @ inputs["C"] @ T(W))

    return formula


def _with(A=lambda A: A, C=lambda C: C):
    def formula(inputs):
        A_right, W = _jacobians(inputs)
        return _made(inputs, A(A_right), W @ C(inputs["C"]) @ T(W))

    return formula


def _cross_transposed(inputs):
    A, W = _jacobians(inputs)
    return _made(inputs, A, W @ inputs["C"] @ T(W), T(A) @ inputs["P"][:, ROBOT, MAP])


def _C_in_place(rows):
    def formula(inputs):
        Q = np.zeros((ROWS, 3, 3))
        Q[:, *np.ix_(rows, rows)] = inputs["C"]
        return _made(inputs, _jacobians(inputs)[0], Q)

    return formula


def _right(inputs):
    return truth(inputs)[1]


def _mistake(name, hint, *wrong, part=np.s_[ROBOT, ROBOT]):
    return covariance_mistake(name, hint, _right, *wrong, part=part)


def _pose_stays(inputs, outputs):
    return np.allclose(outputs["x"], inputs["x"], atol=1e-9)


def _landmarks_moved(inputs, outputs):
    return np.abs(outputs["x"] - inputs["x"])[:, MAP].max() > 1e-6


def _map_changed(inputs, outputs):
    return not same_block(outputs["P"], inputs["P"], MAP, MAP).all()


def _one_side(inputs, outputs):
    P = outputs["P"]
    upper, lower = P[:, ROBOT, MAP], T(P[:, MAP, ROBOT])
    right = _right(inputs)[:, ROBOT, MAP]
    good = [np.allclose(side, right, atol=1e-7) for side in (upper, lower)]
    return sum(good) == 1


PREDICT = Task(
    id="06-predict",
    title="Predict: the robot moves, the map does not",
    drive=DRIVES["06-predict"],
    inputs=drives,
    shapes={"x": (ROWS, None), "P": (ROWS, None, None)},
    laws=(
        Law("mean", 1, "the pose goes where f_odometry leads, and no landmark moves", _mean),
        Law(
            "P_rr",
            1,
            "the robot's block is the covariance of poses that err and drives that err",
            _block(ROBOT, ROBOT),
        ),
        Law(
            "P_ri",
            1,
            "the cross blocks, above and below the diagonal, are what those poses share with the "
            "landmarks",
            _block(ROBOT, MAP),
        ),
        Law("map", 1, "the landmarks' blocks stay as they are", _block(MAP, MAP)),
    ),
    diagnoses=(
        Diagnosis(
            "pose-stays",
            "x comes back as it went in: the robot drove. Where does f_odometry lead?",
            _pose_stays,
        ),
        Diagnosis(
            "landmarks-moved",
            "Landmarks moved in x. They stand still; only the first three numbers change.",
            _landmarks_moved,
        ),
        Diagnosis(
            "map-changed",
            "A block between landmarks changed. Driving tells nothing about the map, and its noise "
            "is the robot's alone: Q belongs to the first three rows and columns.",
            _map_changed,
        ),
        Diagnosis(
            "one-side",
            "The cross blocks are right on one side of the diagonal only: P is symmetric, so "
            "P_ir is the transpose of P_ri.",
            _one_side,
        ),
        _mistake(
            "A-missing",
            "P_rr only grew by Q and P_ri stayed: an error of the heading swings the end of the "
            "step sideways. Which matrix says so?",
            _with(A=lambda A: np.broadcast_to(np.eye(3), A.shape)),
        ),
        _mistake(
            "noise-missing",
            "P_rr holds what the old pose's error became, and nothing new: the drive errs too, and "
            "C says how much. W carries it to the pose.",
            _with(C=np.zeros_like),
        ),
        _mistake(
            "after-motion",
            "A was taken at another pose than the one the robot started from. Take the Jacobians "
            "before you overwrite the pose in x.",
            _after_motion(False),
            _after_motion(True),
        ),
        _mistake(
            "A-transposed",
            "Aᵀ P A has the shape of A P Aᵀ, and another meaning: the old error comes in on A's "
            "right.",
            _with(A=T),
        ),
        _mistake(
            "noise-not-carried",
            "C was added as it is, but it is about distance and turn while P_rr is about x, y, θ. "
            "W turns one into the other: Q = W C Wᵀ.",
            _C_in_place([0, 1]),
            _C_in_place([0, 2]),
            _C_in_place([1, 2]),
        ),
        _mistake(
            "standard-deviation",
            "C holds variances already: look whether you take a root or a square of it.",
            _with(C=lambda C: C @ C),
            _with(C=lambda C: np.sqrt(np.abs(C))),
            _with(C=lambda C: C**2),
        ),
        _mistake(
            "cross-stays",
            "P_ri is as it was. What robot and landmark share is swung by the motion as well: "
            "multiply F P Fᵀ block by block and look at its first row.",
            lambda i: i["P"],
            part=np.s_[ROBOT, MAP],
        ),
        _mistake(
            "cross-zero",
            "P_ri is zero: after a drive the robot would share nothing with its own map.",
            lambda i: 0 * i["P"],
            part=np.s_[ROBOT, MAP],
        ),
        _mistake(
            "cross-transposed",
            "P_ri was multiplied by Aᵀ. In F P Fᵀ the first A stands on the left, as it is.",
            _cross_transposed,
            part=np.s_[ROBOT, MAP],
        ),
    ),
)
