"""Tasks 06-h and 06-update: a landmark is seen again, and everyone learns."""

import numpy as np

from slamlab import jacobians, models
from slamlab.checks.drives.ex06 import DRIVES
from slamlab.checks.task import Diagnosis, Law, Task
from slamlab.checks.tasks.ex06_beliefs import (
    T,
    beliefs,
    covariance_mistake,
    covariances,
    either_sign,
    same_block,
    same_mean,
)
from slamlab.geometry import wrap

STEP = 1e-6  # [m] or [rad]
CLOSE = 1e-4  # of an entry of H, whose entries are of order 1

H_ROWS, H_LANDMARKS = 8, 4
ROWS, LANDMARKS, BEHIND = 10, 3, 4  # the last BEHIND sights cross the bearing ±π


def states(rng):
    """States, and which landmark is seen: one with neighbours on both sides."""
    x, _ = beliefs(rng, H_ROWS, H_LANDMARKS)
    return {"x": x, "j": 1 + np.arange(H_ROWS) % 2}


def by_differences(inputs):
    """(k, 2, n) ∂h/∂x of the landmark that is seen, by differences of the model itself."""
    return np.array([_differences(x, j) for x, j in zip(inputs["x"], inputs["j"], strict=True)])


def _differences(x, j):
    steps = STEP * np.eye(len(x))
    off = np.array([_seen(x + e, j) - _seen(x - e, j) for e in steps])
    off[:, 1] = wrap(off[:, 1])
    return off.T / (2 * STEP)


def _seen(x, j):
    return models.h(x[:3], x[3 + 2 * j : 5 + 2 * j])


def _columns(inputs, which):
    """(k, n) bool: the columns of the robot, of the landmark seen, or of all others."""
    n = inputs["x"].shape[1]
    owner = np.concatenate([[-1, -1, -1], np.arange(n - 3) // 2])
    robot, seen = owner < 0, owner == inputs["j"][:, None]
    return {"robot": robot | (seen & False), "seen": seen, "others": ~robot & ~seen}[which]


def _part(which):
    def holds(inputs, outputs):
        off = np.abs(outputs["H"] - by_differences(inputs)).max(axis=1)
        return (np.where(_columns(inputs, which), off, 0) <= CLOSE).all(axis=1)

    return holds


def _placed(robot=lambda j: 0, landmark=lambda j: 3 + 2 * j, of=0, H_r=1, H_p=1):
    """A formula for H with its parts put somewhere.

    Parameters
    ----------
    robot, landmark : j -> first column of the part
    of : the Jacobians are those of landmark j + of
    H_r, H_p : factors of the two parts
    """

    def formula(inputs):
        H = np.zeros((H_ROWS, 2, inputs["x"].shape[1]))
        for k, (x, j) in enumerate(zip(inputs["x"], inputs["j"], strict=True)):
            p = x[3 + 2 * (j + of) : 5 + 2 * (j + of)]
            at, to = robot(j), landmark(j)
            H[k, :, at : at + 3] = H_r * jacobians.H_robot(x, p)
            H[k, :, to : to + 2] = H_p * jacobians.H_landmark(x, p)
        return H

    return formula


def _looks(*formulas):
    def matches(inputs, outputs):
        return any((np.abs(outputs["H"] - formula(inputs)) <= CLOSE).all() for formula in formulas)

    return matches


def _other_than(which, *formulas):
    """Whether only some columns equal a formula's."""

    def matches(inputs, outputs):
        there = _columns(inputs, which)[:, None]
        return any(
            (np.abs(np.where(there, outputs["H"] - formula(inputs), 0)) <= CLOSE).all()
            for formula in formulas
        )

    return matches


H_FULL = Task(
    id="06-h",
    title="H over the whole state",
    drive=DRIVES["06-h"],
    inputs=states,
    shapes={"H": (H_ROWS, 2, 3 + 2 * H_LANDMARKS)},
    laws=(
        Law("robot", 1, "the first three columns are how h changes with the pose", _part("robot")),
        Law("seen", 1, "the seen landmark's two columns are how h changes with it", _part("seen")),
        Law("others", 1, "all other columns are zero: h does not know them", _part("others")),
    ),
    diagnoses=(
        Diagnosis(
            "printed-4-9",
            "H_r stands right before the landmark's part, as the MAK thesis prints it in (4.9): "
            "[0 0 H_r H_p 0 …]. The state begins with the robot, whichever landmark is seen.",
            _looks(_placed(robot=lambda j: 2 * j)),
        ),
        Diagnosis(
            "off-by-one",
            "The landmark's part is not where it belongs. Landmarks are counted from 0, and "
            "the robot takes three columns: where does landmark j begin?",
            _looks(
                *(_placed(landmark=lambda j: 5 + 2 * j, of=of) for of in (0, 1)),
                *(_placed(landmark=lambda j: 1 + 2 * j, of=of) for of in (0, -1)),
            ),
        ),
        Diagnosis(
            "robot-not-counted",
            "The landmark's part begins too far to the left: the robot's three columns come first, "
            "and each landmark takes two.",
            _looks(
                _placed(landmark=lambda j: 2 * j),
                _placed(landmark=lambda j: 2 + 2 * j),
                _placed(landmark=lambda j: 3 + j),
            ),
        ),
        Diagnosis(
            "sign",
            "The landmark's part has the sign of the robot's. When the landmark moves away, does "
            "the range grow? And when the robot moves that way?",
            _looks(_placed(H_p=-1)),
        ),
        Diagnosis(
            "landmark-missing",
            "Only the robot's part is there: this is H of a known map (lesson 05). In SLAM the "
            "landmark's own error is in the innovation as well.",
            _looks(_placed(H_p=0)),
        ),
        Diagnosis(
            "robot-missing",
            "Only the landmark's part is there: this is H of a known pose (lesson 05). In SLAM the "
            "robot's error is in the innovation as well.",
            _looks(_placed(H_r=0)),
        ),
        Diagnosis(
            "wrong-landmark",
            "Another landmark's place is in the Jacobians: which two numbers of x are those of "
            "landmark j?",
            _other_than("robot", _placed(of=1), _placed(of=-1)),
        ),
    ),
)


# ---- update ---------------------------------------------------------------------------------


def sights(rng):
    """Beliefs, a landmark that is seen again, and how; some of them behind the robot."""
    x, P = beliefs(rng, ROWS, LANDMARKS)
    j, R = np.arange(ROWS) % LANDMARKS, covariances(rng, rng.uniform(0.03, 0.06, (ROWS, 2)))
    side = either_sign(rng, 1, 1, ROWS)
    z = np.empty((ROWS, 2))
    for k in range(ROWS):
        r = rng.uniform(2, 5)
        behind = k >= ROWS - BEHIND
        bearing = side[k] * (np.pi - rng.uniform(0.01, 0.04) if behind else rng.uniform(0.3, 2.2))
        x[k, 3 + 2 * j[k] : 5 + 2 * j[k]] = models.g(x[k], np.array([r, bearing]))
        beyond = side[k] * rng.uniform(0.06, 0.1)
        z[k] = r + either_sign(rng, 0.1, 0.2), wrap(bearing + beyond)
    return {"x": x, "P": P, "z": z, "j": j, "R": R}


def _innovation(inputs):
    v = inputs["z"] - np.array([_seen(x, j) for x, j in zip(inputs["x"], inputs["j"], strict=True)])
    return v


def _wrapped(v):
    return np.column_stack([v[:, 0], wrap(v[:, 1])])


def truth(inputs):
    """Least squares: the x that fits belief and sight best, and the inverse of its information."""
    H, v = by_differences(inputs), _wrapped(_innovation(inputs))
    before, weight = np.linalg.inv(inputs["P"]), np.linalg.inv(inputs["R"])
    P = np.linalg.inv(before + T(H) @ weight @ H)
    return inputs["x"] + (P @ T(H) @ weight @ v[..., None])[..., 0], P


def _mean(rows):
    def holds(inputs, outputs):
        want, _ = truth(inputs)
        return same_mean(outputs["x"], want, inputs["P"])[rows]

    return holds


def _covariance(inputs, outputs):
    return same_block(outputs["P"], truth(inputs)[1])


# ---- mistakes: the wrong formula, computed on the same beliefs -------------------------------


def _step(inputs, P=None, H=None):
    """K, S, H, v of an update, with another P or H where given."""
    P = inputs["P"] if P is None else P
    H = by_differences(inputs) if H is None else H
    S = H @ P @ T(H) + inputs["R"]
    return P @ T(H) @ np.linalg.inv(S), S, H, _wrapped(_innovation(inputs))


def _moves(inputs, K, v):
    return (K @ v[..., None])[..., 0]


def _mean_is(formula):
    """Whether x equals what a formula gives, in units of the deviations."""

    def matches(inputs, outputs):
        return same_mean(outputs["x"], formula(inputs), inputs["P"]).all()

    return matches


def _without_S(inputs):
    _, _, H, v = _step(inputs)
    return inputs["x"] + _moves(inputs, inputs["P"] @ T(H), v)


def _printed_15(inputs):
    K, _, _, v = _step(inputs)
    return _moves(inputs, K, v)


def _sign(inputs):
    K, _, _, v = _step(inputs)
    return inputs["x"] - _moves(inputs, K, v)


def _unwrapped(inputs):
    K, *_ = _step(inputs)
    return inputs["x"] + _moves(inputs, K, _innovation(inputs))


def _without_R(inputs):
    _, S, H, v = _step(inputs)
    K = inputs["P"] @ T(H) @ np.linalg.inv(S - inputs["R"])
    return inputs["x"] + _moves(inputs, K, v)


def _concerned(inputs):
    """(k, n) bool: the robot's rows and those of the landmark seen."""
    return ~_columns(inputs, "others")


def _cross_ignored(inputs):
    n = inputs["x"].shape[1]
    owner = np.concatenate([[-1, -1, -1], np.arange(n - 3) // 2])
    return inputs["P"] * (owner[:, None] == owner)


def _apart(inputs):
    K, _, _, v = _step(inputs, _cross_ignored(inputs))
    return inputs["x"] + _moves(inputs, K, v)


def _apart_S(inputs):
    """P Hᵀ whole, and S without what robot and landmark share."""
    _, S, H, v = _step(inputs, _cross_ignored(inputs))
    return inputs["x"] + _moves(inputs, inputs["P"] @ T(H) @ np.linalg.inv(S), v)


def _nobody_else(inputs, outputs):
    """Whether the unseen landmarks' means stayed, while robot and landmark moved."""
    moved = np.abs(outputs["x"] - inputs["x"])
    there = _concerned(inputs)
    return moved[~there].max() < 1e-9 and moved[there].max() > 1e-4


def _some_rows_only(inputs, outputs):
    """Whether some of robot, landmark seen and others stayed, while some moved."""
    moved = np.abs(outputs["x"] - inputs["x"])
    parts = [moved[_columns(inputs, which)].max() for which in ("robot", "seen", "others")]
    return max(parts) > 1e-4 and min(parts) < 1e-9


def _still(name):
    return lambda inputs, outputs: np.allclose(outputs[name], inputs[name], atol=1e-12)


def _P(formula):
    def made(inputs):
        K, S, H, _ = _step(inputs)
        return formula(inputs["P"], K, S, H)

    return made


def _before(inputs):
    return inputs["P"]


def _mistake(name, hint, *formulas):
    return covariance_mistake(name, hint, _before, *(_P(formula) for formula in formulas))


UPDATE = Task(
    id="06-update",
    title="Update: a landmark is seen again",
    drive=DRIVES["06-update"],
    inputs=sights,
    shapes={"x": (ROWS, 3 + 2 * LANDMARKS), "P": (ROWS, 3 + 2 * LANDMARKS, 3 + 2 * LANDMARKS)},
    laws=(
        Law(
            "mean",
            2,
            "x fits belief and sight best: no other state has a smaller sum of squares",
            _mean(np.s_[:-BEHIND]),
        ),
        Law(
            "wrapped",
            1,
            "the same for landmarks behind the robot, where bearings jump from π to −π",
            _mean(np.s_[-BEHIND:]),
        ),
        Law(
            "P",
            2,
            "P holds what belief and sight know together: its inverse is P⁻¹ + Hᵀ R⁻¹ H",
            _covariance,
        ),
    ),
    diagnoses=(
        Diagnosis(
            "printed-15",
            "x is K · innovation, as printed in Smolec's (15): the old x is lost. The innovation "
            "corrects what was believed.",
            _mean_is(_printed_15),
        ),
        Diagnosis(
            "sign",
            "x moves away from what was seen: the innovation is measured minus predicted, and is "
            "added.",
            _mean_is(_sign),
        ),
        Diagnosis(
            "S-missing",
            "The gain lacks S⁻¹: P Hᵀ v would move the state by more the larger the innovation's "
            "own uncertainty.",
            _mean_is(_without_S),
        ),
        Diagnosis(
            "R-missing",
            "S lacks R: the sight was taken for exact.",
            _mean_is(_without_R),
        ),
        Diagnosis(
            "kept-apart",
            "S (or K too) was made without the blocks between robot and landmarks. Both errors are "
            "in the innovation, and what they share decides how much is to be learned from it: use "
            "the whole of P.",
            lambda i, o: _mean_is(_apart)(i, o) or _mean_is(_apart_S)(i, o),
        ),
        Diagnosis(
            "x-stays",
            "x comes back as it went in: the innovation, weighed by K, has to be added.",
            _still("x"),
        ),
        Diagnosis(
            "some-rows-only",
            "Some parts of the state learned nothing. No block of K is zero: robot, the landmark "
            "seen and all the others are corrected, by all rows of K.",
            _some_rows_only,
        ),
        Diagnosis(
            "unwrapped",
            "The innovation's bearing is not wrapped: a landmark predicted at 179° and seen at "
            "−179° is 2° off, not 358°.",
            _mean_is(_unwrapped),
        ),
        Diagnosis(
            "P-stays",
            "P comes back as it went in: the robot has learned something and does not know it. "
            "P ← P − K S Kᵀ.",
            _still("P"),
        ),
        _mistake(
            "P-sign",
            "P grew: seeing something makes nobody less sure. Look at the sign of K S Kᵀ.",
            lambda P, K, S, H: P + K @ S @ T(K),
        ),
        _mistake(
            "S-inverse",
            "Not S⁻¹ stands between K and Kᵀ, but S: look at the units of K S Kᵀ.",
            lambda P, K, S, H: P - K @ np.linalg.inv(S) @ T(K),
            lambda P, K, S, H: P - K @ T(K),
        ),
        _mistake(
            "half-of-joseph",
            "(I − K H) P (I − K H)ᵀ alone leaves out the sight's own noise: Joseph's form adds "
            "K R Kᵀ.",
            lambda P, K, S, H: P - K @ H @ P - T(K @ H @ P) + K @ H @ P @ T(H) @ T(K),
        ),
        Diagnosis(
            "P-in-part",
            "Some blocks of P are as they were. K S Kᵀ has no zero block: the covariance of the "
            "unseen landmarks, and what they share, shrinks as well.",
            lambda i, o: not _covariance(i, o).all() and _some_blocks_stay(i["P"], o["P"]),
        ),
    ),
    needs=("06-h",),
)


def _some_blocks_stay(before, after):
    """Whether some entries of P are untouched, and others are not."""
    same = np.abs(after - before) < 1e-12
    return 0.05 < same.mean() < 1
