"""Task 06-augment: a landmark seen for the first time, and whom it is related to."""

import numpy as np

from slamlab import models
from slamlab.exercises.drives.ex06 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex06_beliefs import ROBOT, TOLERANCE, T, beliefs, covariance_mistake, covariances, either_sign, moments, same_block, same_mean
from slamlab.models import jacobians

ROWS, LANDMARKS = 8, 2
N = 3 + 2 * LANDMARKS
OLD, MAP, NEW = slice(0, N), slice(3, N), slice(N, N + 2)


def sights(rng):
    """Beliefs, and a range and bearing at which something new was seen, with its noise."""
    x, P = beliefs(rng, ROWS, LANDMARKS)
    z = np.column_stack([rng.uniform(2, 6, ROWS), either_sign(rng, 0.4, 2.6, ROWS)])
    sigma = np.column_stack([rng.uniform(0.05, 0.15, ROWS), rng.uniform(0.02, 0.04, ROWS)])
    return {"x": x, "P": P, "z": z, "R": covariances(rng, sigma)}


def _place(states, z):
    p = models.g(states[:3].T, z.T)
    return np.vstack([states + 0 * z[:1], p.T])


def truth(inputs):
    """Means (k, n + 2) and covariances (k, n + 2, n + 2) of the state with the new landmark."""
    found = [moments(_place, (x, z), P, R) for x, P, z, R in zip(*inputs.values(), strict=True)]
    return np.array([x for x, _ in found]), np.array([P for _, P in found])


def _old(inputs, outputs):
    want, P = truth(inputs)
    same = same_mean(outputs["x"], want, P, OLD)
    return same & same_block(outputs["P"], P, OLD, OLD)


def _placed(inputs, outputs):
    want, P = truth(inputs)
    return same_mean(outputs["x"], want, P, NEW)


def _block(rows, columns):
    return lambda inputs, outputs: same_block(outputs["P"], truth(inputs)[1], rows, columns)


# ---- mistakes: the wrong formula, computed on the same beliefs -------------------------------


def _jacobians(inputs):
    pairs = list(zip(inputs["x"], inputs["z"], strict=True))
    J_xr = np.array([jacobians.J_xr(x, z) for x, z in pairs])
    return J_xr, np.array([jacobians.J_z(x, z) for x, z in pairs])


def _grown(inputs, row=None, corner=None):
    """P with a new landmark, made of some new rows (k, 2, n) and corner (k, 2, 2)."""
    P = np.zeros((ROWS, N + 2, N + 2))
    P[:, OLD, OLD] = inputs["P"]
    P[:, NEW, OLD] = 0 if row is None else row
    P[:, OLD, NEW] = T(P[:, NEW, OLD])
    P[:, NEW, NEW] = 0 if corner is None else corner
    return P


def _corner(of_pose, of_noise):
    """A formula for P_nn from its two terms, each a function of a Jacobian and a covariance."""

    def formula(inputs):
        J_xr, J_z = _jacobians(inputs)
        P_rr = inputs["P"][:, ROBOT, ROBOT]
        return _grown(inputs, corner=of_pose(J_xr, P_rr) + of_noise(J_z, inputs["R"]))

    return formula


def _row(J):
    """A formula for the new rows: some J (k, 2, 3) times the robot's rows."""
    return lambda inputs: _grown(inputs, J(_jacobians(inputs)[0]) @ inputs["P"][:, ROBOT])


def _blocks_turned(inputs):
    row = _jacobians(inputs)[0] @ inputs["P"][:, ROBOT]
    for first in range(3, N, 2):
        row[:, :, first : first + 2] = T(row[:, :, first : first + 2])
    return _grown(inputs, row)


def _spread(J, P):
    return J @ P @ T(J)


def _none(J, P):
    return 0


def _heading_dropped(J):
    return J * [1, 1, 0]


def _right(inputs):
    return truth(inputs)[1]


def _mistake(name, hint, *wrong, part):
    return covariance_mistake(name, hint, _right, *wrong, part=part)


def _old_changed(inputs, outputs):
    return not _old(inputs, outputs).all()


def _elsewhere(*places):
    """Whether the new landmark stands where one of these formulas puts it."""

    def matches(inputs, outputs):
        got, sigma = outputs["x"][:, NEW], 0.05
        poses, z = inputs["x"][:, :3], inputs["z"]
        return any((np.abs(got - place(poses, z)) <= TOLERANCE * sigma).all() for place in places)

    return matches


def _polar(angle, origin=1):
    def place(poses, z):
        direction = angle(poses[:, 2], z[:, 1])
        way = z[:, :1] * np.column_stack([np.cos(direction), np.sin(direction)])
        return origin * poses[:, :2] + way

    return place


def _one_side(inputs, outputs):
    right = _right(inputs)[:, NEW, OLD]
    sides = outputs["P"][:, NEW, OLD], T(outputs["P"][:, OLD, NEW])
    return sum(np.allclose(side, right, atol=1e-7) for side in sides) == 1


CROSS = np.s_[NEW, OLD]
CORNER = np.s_[NEW, NEW]

AUGMENT = Task(
    id="06-augment",
    title="Augment: a new landmark and its relatives",
    drive=DRIVES["06-augment"],
    inputs=sights,
    shapes={"x": (ROWS, N + 2), "P": (ROWS, N + 2, N + 2)},
    laws=(
        Law("old", 1, "what was in the state before stays as it was, in x and in P", _old),
        Law("place", 1, "the new landmark is appended where g puts it", _placed),
        Law(
            "P_nn",
            1,
            "P_nn is the covariance of the places that poses that err and sights that err give",
            _block(NEW, NEW),
        ),
        Law(
            "P_nr",
            1,
            "P_nr, with its mirror image, is what they share with the pose",
            _block(NEW, ROBOT),
        ),
        Law(
            "P_ni",
            1,
            "P_ni, with its mirror image, is what they share with the old landmarks",
            _block(NEW, MAP),
        ),
    ),
    diagnoses=(
        Diagnosis(
            "old-changed",
            "Something that was in the state before has changed. Seeing a new landmark tells "
            "nothing about pose or map: append to x and P, and leave the rest.",
            _old_changed,
        ),
        Diagnosis(
            "elsewhere",
            "The new landmark stands elsewhere than g puts it. g takes a pose (the first three "
            "numbers of x) and a z = [r, β] in the robot's frame, and gives a place in the world.",
            _elsewhere(
                _polar(lambda theta, beta: beta),
                _polar(lambda theta, beta: theta),
                _polar(lambda theta, beta: theta - beta),
                _polar(lambda theta, beta: beta, 0),
                _polar(lambda theta, beta: theta + beta, 0),
                lambda poses, z: z,
            ),
        ),
        _mistake(
            "born-alone",
            "The new rows are zero: this landmark would share nothing with anyone. But the robot "
            "placed it, with the error the robot has. Which Jacobian hands that on?",
            _grown,
            part=CROSS,
        ),
        _mistake(
            "only-robot",
            "P_nr is right, and P_ni is zero. The robot's error is in the new landmark; whatever "
            "shares in that error (P_ri) now shares in the landmark too.",
            _grown,
            part=np.s_[NEW, MAP],
        ),
        Diagnosis(
            "one-side",
            "The new rows are right on one side of the diagonal only: P is symmetric, so the new "
            "columns are the new rows transposed.",
            _one_side,
        ),
        _mistake(
            "heading-dropped",
            "The new rows are the robot's x and y rows: as if the landmark were carried along, but "
            "never swung. What does an error of θ do to a landmark some metres away?",
            _row(_heading_dropped),
            part=CROSS,
        ),
        _mistake(
            "blocks-turned",
            "P_ni is transposed in its 2×2 blocks, as in Smolec's (18). They are square here, so "
            "both multiply: P_ni = J_xr P_ri, with P_ri from the robot's rows of P.",
            _blocks_turned,
            part=np.s_[NEW, MAP],
        ),
        _mistake(
            "noise-not-carried",
            "R was added as it is, but it is in range and bearing while P_nn is in x and y: J_z "
            "turns one into the other.",
            _corner(_spread, lambda J, R: R),
            part=CORNER,
        ),
        _mistake(
            "noise-missing",
            "P_nn holds the pose's error only. The sight errs too: R says how much, J_z carries "
            "it.",
            _corner(_spread, _none),
            part=CORNER,
        ),
        _mistake(
            "pose-missing",
            "P_nn holds the sight's error only. It was measured from a pose that errs as well: "
            "J_xr carries that.",
            _corner(_none, _spread),
            part=CORNER,
        ),
        _mistake(
            "sandwich-reversed",
            "J_zᵀ R J_z has the shape of J_z R J_zᵀ, and another meaning: R must meet the side of "
            "J_z that is made for range and bearing.",
            _corner(_spread, lambda J, R: T(J) @ R @ J),
            part=CORNER,
        ),
        _mistake(
            "standard-deviation",
            "R holds variances already: look whether you take a root or a square of it.",
            _corner(_spread, lambda J, R: _spread(J, R @ R)),
            _corner(_spread, lambda J, R: _spread(J, R**2)),
            _corner(_spread, lambda J, R: _spread(J, np.sqrt(np.abs(R)))),
            part=CORNER,
        ),
    ),
)
