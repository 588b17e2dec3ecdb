"""Classic mistakes in task 09-update, computed on the same sights, each with its hint."""

import numpy as np

from slamlab.exercises.law import Diagnosis
from slamlab.exercises.tasks.ex06.beliefs import T, same_block
from slamlab.exercises.tasks.ex09_update_sights import (
    DEGREES,
    ROWS,
    N,
    innovation,
    pairs_of,
    same_state,
    slopes,
)
from slamlab.geometry import wrap


def _step(inputs, H=None, P=None, v=None):
    """x and P after an update with another H, P in K and S, or innovation."""
    H = slopes(inputs) if H is None else H
    of, v = inputs["P"] if P is None else P, innovation(inputs) if v is None else v
    S = H @ of @ T(H) + inputs["R"]
    K = of @ T(H) @ np.linalg.inv(S)
    return inputs["x"] + (K @ v[..., None])[..., 0], inputs["P"] - K @ S @ T(K), K, S


def _x_is(formula):
    return lambda inputs, outputs: bool(
        same_state(outputs["x"], formula(inputs), inputs["P"]).all()
    )


def _lever(factor):
    """H with the entry ∂ρ'/∂α, the only length per angle, multiplied."""

    def formula(inputs):
        H = slopes(inputs)
        rows = np.arange(ROWS)
        H[rows, 0, 4 + 2 * inputs["j"]] *= factor
        return H

    return formula


def _robot(factor):
    def formula(inputs):
        H = slopes(inputs)
        H[:, :, :3] *= factor
        return H

    return formula


def _with_H(*formulas):
    return lambda inputs, outputs: any(
        _x_is(lambda i, f=formula: _step(i, f(i))[0])(inputs, outputs) for formula in formulas
    )


def _apart(inputs):
    owner = np.concatenate([[-1, -1, -1], np.arange(N - 3) // 2])
    return inputs["P"] * (owner[:, None] == owner)


def _unwrapped(inputs):
    # a prediction may be wrapped or not: one of the two is as the student's comes
    at = np.array([3 + 2 * j for _, j in pairs_of(inputs)])
    rows = np.arange(ROWS)
    raw = inputs["x"][rows, at + 1] - inputs["x"][:, 2]
    found = []
    for angle in (raw, wrap(raw)):
        v = innovation(inputs)
        v[:, 1] = inputs["z"][:, 1] - angle
        found.append(_step(inputs, v=v)[0])
    return found


def _not_wrapped(inputs, outputs):
    return any(_x_is(lambda i, x=x: x)(inputs, outputs) for x in _unwrapped(inputs))


def _no_pose(inputs):
    """The wall's own (ρ, α) taken for what is seen."""
    at = 3 + 2 * inputs["j"]
    rows = np.arange(ROWS)
    v = inputs["z"] - np.column_stack([inputs["x"][rows, at], inputs["x"][rows, at + 1]])
    v[:, 1] = wrap(v[:, 1])
    return _step(inputs, v=v)[0]


def _without_S(inputs):
    H = slopes(inputs)
    return inputs["x"] + (inputs["P"] @ T(H) @ innovation(inputs)[..., None])[..., 0]


def _still(name):
    return lambda inputs, outputs: np.allclose(outputs[name], inputs[name], atol=1e-12)


def _unseen_stay(inputs, outputs):
    moved = np.abs(outputs["x"] - inputs["x"])
    owner = np.concatenate([[-1, -1, -1], np.arange(N - 3) // 2])
    others = (owner >= 0) & (owner != inputs["j"][:, None])
    return moved.max() > 1e-4 and moved[others].max() < 1e-9


def _P_plus(inputs, outputs):
    _, P, _, _ = _step(inputs)
    return same_block(outputs["P"], 2 * inputs["P"] - P).all()


MISTAKES = (
    Diagnosis(
        "unwrapped",
        "The innovation's angle is not wrapped: a normal expected at 179° and seen at −179° is "
        "2° off, not 358°.",
        _not_wrapped,
    ),
    Diagnosis(
        "printed-15",
        "x is K · innovation, as printed in Smolec's (15): the old x is lost.",
        _x_is(lambda inputs: _step(inputs)[0] - inputs["x"]),
    ),
    Diagnosis(
        "sign",
        "x moves away from what was seen: the innovation is measured minus predicted.",
        _x_is(lambda inputs: 2 * inputs["x"] - _step(inputs)[0]),
    ),
    Diagnosis(
        "pose-forgotten",
        "What was seen from the robot is compared with the wall in the world. First predict "
        "what this robot should see: ρ' and α' from its pose.",
        _x_is(_no_pose),
    ),
    Diagnosis(
        "lever-missing",
        "H lacks ∂ρ'/∂α: turn a wall about the world's origin, and its distance from the robot "
        "changes, since the robot stands elsewhere.",
        _with_H(_lever(0.0)),
    ),
    Diagnosis(
        "degrees",
        "The entry ∂ρ'/∂α is 180/π too long or too short. Angles are in radians here.",
        _with_H(_lever(DEGREES), _lever(1 / DEGREES)),
    ),
    Diagnosis(
        "lever-sign",
        "∂ρ'/∂α has the wrong sign: differentiate −x cos α − y sin α once more.",
        _with_H(_lever(-1.0)),
    ),
    Diagnosis(
        "robot-sign",
        "The robot's columns of H have the wrong sign: who steps towards a wall has it nearer, "
        "who turns left sees it turn right.",
        _with_H(_robot(-1.0), _robot(np.array([-1, -1, 1])), _robot(np.array([1, 1, -1]))),
    ),
    Diagnosis(
        "robot-missing",
        "H has no entries for the pose: you took it for known. The robot errs as well.",
        _with_H(_robot(0.0)),
    ),
    Diagnosis(
        "S-missing",
        "The gain lacks S⁻¹.",
        _x_is(_without_S),
    ),
    Diagnosis(
        "kept-apart",
        "Robot and walls are taken as unrelated in S and K. Use the whole of P.",
        _x_is(lambda inputs: _step(inputs, P=_apart(inputs))[0]),
    ),
    Diagnosis(
        "x-stays",
        "x comes back as it went in: the innovation, weighed by K, has to be added.",
        _still("x"),
    ),
    Diagnosis(
        "unseen-stay",
        "The walls that were not seen learn nothing. They were placed by the same robot: all "
        "rows of K count.",
        _unseen_stay,
    ),
    Diagnosis(
        "P-stays",
        "P comes back as it went in: the robot has learned something and does not know it.",
        _still("P"),
    ),
    Diagnosis(
        "P-sign",
        "P grew: seeing something makes nobody less sure. Look at the sign of K S Kᵀ.",
        _P_plus,
    ),
)
