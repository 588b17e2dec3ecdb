"""Exercise 08, classic mistakes of observing a wall, computed on the same poses and lines."""

import numpy as np

from slamlab.exercises.tasks.ex04_mistakes import matrix, mistake, sign_mistake
from slamlab.geometry import wrap


def _parts(inputs):
    x, y, theta = inputs["x"].T
    rho, alpha = inputs["line"].T
    return x, y, theta, rho, alpha


def _seen(rho_seen, alpha_seen):
    return np.stack([rho_seen, alpha_seen], axis=-1)


def _distance(inputs, sign=-1):
    x, y, _, rho, alpha = _parts(inputs)
    return rho + sign * (x * np.cos(alpha) + y * np.sin(alpha))


def _away(inputs):
    rho_seen, alpha_seen = _distance(inputs), _ahead(inputs)
    back = rho_seen < 0
    return _seen(np.abs(rho_seen), wrap(alpha_seen + np.pi * back))


def _with_turn(inputs, turn):
    return _seen(_distance(inputs), wrap(turn))


def _in_robots_frame(inputs):
    x, y, theta, rho, alpha = _parts(inputs)
    seen = alpha - theta
    return _seen(rho - x * np.cos(seen) - y * np.sin(seen), wrap(seen))


def _sine_and_cosine(inputs):
    x, y, theta, rho, alpha = _parts(inputs)
    return _seen(rho - x * np.sin(alpha) - y * np.cos(alpha), wrap(alpha - theta))


def _ahead(inputs):
    _, _, theta, _, alpha = _parts(inputs)
    return alpha - theta


def _robots(inputs, normal=None, heading=-1.0):
    *_, alpha = _parts(inputs)
    normal = alpha if normal is None else normal
    return matrix([[-np.cos(normal), -np.sin(normal), 0], [0, 0, heading]])


def _lines(inputs, cross):
    return matrix([[1, cross], [0, 1]])


def _cross(inputs, sign=1):
    x, y, _, _, alpha = _parts(inputs)
    return sign * (x * np.sin(alpha) - y * np.cos(alpha))


Z = {"output": "z"}
H_R = {"output": "H_r"}
H_P = {"output": "H_p"}

DIAGNOSES = (
    mistake(
        "unwrapped",
        "α′ = α − θ is right, but leaves (−π, π]: wrap it.",
        lambda i: _seen(_distance(i), _ahead(i)),
        **Z,
    ),
    mistake(
        "outward",
        "ρ′ ≥ 0 is the rule when a line is fitted. Here the normal keeps its side: for a robot "
        "that has gone through the wall ρ′ is negative, and α′ does not jump.",
        _away,
        **Z,
    ),
    mistake(
        "distance-only",
        "The absolute value of ρ′ is another wall, on the other side of the robot, unless α′ "
        "turns with it. Leave the sign.",
        lambda i: _seen(np.abs(_distance(i)), wrap(_ahead(i))),
        **Z,
    ),
    mistake(
        "heading-added",
        "α′ has the wrong sign of θ: the robot turns left, and the world turns right.",
        lambda i: _with_turn(i, i["line"][:, 1] + i["x"][:, 2]),
        lambda i: _with_turn(i, -_ahead(i)),
        **Z,
    ),
    mistake(
        "heading-forgotten",
        "α′ is the world's α: the robot measures from its own heading.",
        lambda i: _with_turn(i, i["line"][:, 1]),
        **Z,
    ),
    mistake(
        "moved-away",
        "ρ′ grows where it should shrink: a step along the normal, towards the wall, takes from ρ.",
        lambda i: _seen(_distance(i, 1), wrap(_ahead(i))),
        **Z,
    ),
    mistake(
        "not-moved",
        "ρ′ is the world's ρ: the robot's place does not matter in it. Step towards the wall "
        "and see.",
        lambda i: _seen(i["line"][:, 0], wrap(_ahead(i))),
        **Z,
    ),
    mistake(
        "mixed-frames",
        "x and y are of the world, so the normal beside them is the world's too: α, not α′.",
        _in_robots_frame,
        **Z,
    ),
    mistake(
        "sine-for-cosine",
        "Sine and cosine have changed places in ρ′: the normal is (cos α, sin α).",
        _sine_and_cosine,
        **Z,
    ),
    mistake(
        "mixed-frames-H",
        "H_r has the normal of the robot's frame in it. x and y are of the world: −cos α, −sin α.",
        lambda i: _robots(i, _ahead(i)),
        **H_R,
    ),
    mistake(
        "heading-missing",
        "α′ does not change with θ in your H_r: turn the robot on the spot.",
        lambda i: _robots(i, heading=0.0),
        **H_R,
    ),
    sign_mistake(
        "H_r-sign",
        "Every entry of H_r has the right size, and a sign is wrong: does ρ′ grow or shrink "
        "with a step along the normal? And α′, when the robot turns left?",
        _robots,
        **H_R,
    ),
    mistake(
        "xy-exchanged",
        "The columns of x and y are exchanged in H_r.",
        lambda i: _robots(i)[:, :, [1, 0, 2]],
        sizes_only=True,
        **H_R,
    ),
    mistake(
        "lever-missing",
        "H_p is not the identity: turn a wall about the origin, and its distance from a robot "
        "that stands elsewhere changes. Differentiate ρ′ by α, too.",
        lambda i: _lines(i, np.array(0.0)),
        **H_P,
    ),
    mistake(
        "lever-is-normal",
        "The derivative of cos α by α is −sin α: what stands beside the 1 in H_p is along the "
        "wall.",
        lambda i: _lines(i, -(i["line"][:, 0] - _distance(i))),
        lambda i: _lines(i, i["line"][:, 0] - _distance(i)),
        **H_P,
    ),
    mistake(
        "transposed",
        "H_p is transposed: a row per component of what is seen, a column per component of the "
        "line.",
        lambda i: _lines(i, _cross(i)).transpose(0, 2, 1),
        **H_P,
    ),
    sign_mistake(
        "H_p-sign",
        "Every entry of H_p has the right size, and a sign is wrong. −cos α differentiated by "
        "α is +sin α.",
        lambda i: _lines(i, _cross(i)),
        **H_P,
    ),
)
