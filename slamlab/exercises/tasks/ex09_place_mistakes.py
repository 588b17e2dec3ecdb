"""Classic mistakes in task 09-place, computed on the same sights, each with its hint."""

import numpy as np

from slamlab.exercises.law import Diagnosis
from slamlab.exercises.tasks.ex06.beliefs import T, sigmas
from slamlab.exercises.tasks.ex09_place_sights import (
    DEGREES,
    PARTS,
    ROWS,
    same_line,
    same_part,
    truth,
)


def _elsewhere(*formulas):
    def matches(inputs, outputs):
        s = sigmas(truth(inputs)[1])[:, 3:]
        x, z = inputs["x"].T, inputs["z"].T
        lines = (np.column_stack(formula(x, z)) for formula in formulas)
        return any(same_line(outputs["line"], line, s).all() for line in lines)

    return matches


def _at(angle, sign=1):
    """ρ and α with some direction of the normal, and the pose's share of ρ."""

    def line(x, z):
        alpha = angle(x[2], z[1])
        return z[0] + sign * (x[0] * np.cos(alpha) + x[1] * np.sin(alpha)), alpha

    return line


def _rho_in_robot_frame(x, z):
    return z[0] + x[0] * np.cos(z[1]) + x[1] * np.sin(z[1]), x[2] + z[1]


def _turned(inputs, outputs):
    """Whether lines with ρ < 0, and only those, came back with their normal turned."""
    want, P = truth(inputs)
    flip = np.where(want[:, :1] < 0, [[-1, 1]], [[1, 1]]) * want
    flip[:, 1] += np.pi * (want[:, 0] < 0)
    return same_line(outputs["line"], flip, sigmas(P)[:, 3:]).all()


def _foot(inputs, outputs):
    rho, alpha = truth(inputs)[0].T
    return np.allclose(outputs["line"], np.column_stack([rho * np.cos(alpha), rho * np.sin(alpha)]))


def _spread(J_lever=1.0, noise_lever=1.0, pose=1, noise=1, of=lambda theta, a: theta + a, R=None):
    """C and X with slips: factors on the lever arms, terms left out, another direction."""

    def formula(inputs):
        x, z = inputs["x"], inputs["z"]
        alpha = of(x[:, 2], z[:, 1])
        c, s = np.cos(alpha), np.sin(alpha)
        lever = -x[:, 0] * s + x[:, 1] * c
        J_x, J_z = np.zeros((ROWS, 2, 3)), np.zeros((ROWS, 2, 2))
        J_x[:, 0], J_x[:, 1, 2] = np.column_stack([c, s, J_lever * lever]), 1
        J_z[:, 0, 0], J_z[:, 0, 1], J_z[:, 1, 1] = 1, noise_lever * lever, 1
        spread = inputs["R"] if R is None else R(inputs["R"])
        C = pose * J_x @ inputs["P"] @ T(J_x) + noise * J_z @ spread @ T(J_z)
        return {"C": C, "X": J_x @ inputs["P"]}

    return formula


def _is(name, *formulas):
    rows, columns = PARTS[name]

    def matches(inputs, outputs):
        s = sigmas(truth(inputs)[1])
        return any(
            same_part(outputs[name], formula(inputs)[name], rows, columns, s).all()
            for formula in formulas
        )

    return matches


def _either(*claims):
    return lambda inputs, outputs: any(claim(inputs, outputs) for claim in claims)


def _sandwich(inputs):
    x, z = inputs["x"], inputs["z"]
    alpha = x[:, 2] + z[:, 1]
    J_z = np.tile(np.eye(2), (ROWS, 1, 1))
    J_z[:, 0, 1] = -x[:, 0] * np.sin(alpha) + x[:, 1] * np.cos(alpha)
    return {"C": _spread(noise=0)(inputs)["C"] + T(J_z) @ inputs["R"] @ J_z}


MISTAKES = (
    Diagnosis(
        "foot",
        "That is the foot of the perpendicular. The landmark is the line itself, (ρ, α).",
        _foot,
    ),
    Diagnosis(
        "turned",
        "Where ρ is negative you turned the normal (−ρ, α + π). It keeps pointing away from "
        "the robot that saw it: turned, the wall would look quite different from what is seen.",
        _turned,
    ),
    Diagnosis(
        "heading",
        "α' is counted from the robot's heading. In the world the normal points to θ + α'.",
        _elsewhere(
            _at(lambda theta, a: a),
            _at(lambda theta, a: theta - a),
            _at(lambda theta, a: a - theta),
        ),
    ),
    Diagnosis(
        "not-moved",
        "ρ is the distance from the robot still. How far is the world's origin from the wall? "
        "The robot's own place along the normal is to be added.",
        _elsewhere(lambda x, z: (z[0], x[2] + z[1])),
    ),
    Diagnosis(
        "sign",
        "The robot's place along the normal comes with the wrong sign: who walks away from the "
        "wall has it farther off, and the wall stands where it stood.",
        _elsewhere(_at(lambda theta, a: theta + a, -1)),
    ),
    Diagnosis(
        "two-frames",
        "ρ mixes two frames: x and y are in the world, so the normal they are projected on is "
        "to be in the world, too (α, not α').",
        _elsewhere(_rho_in_robot_frame),
    ),
    Diagnosis(
        "cross-missing",
        "X is zero: the wall would share nothing with the robot that placed it.",
        lambda inputs, outputs: np.allclose(outputs["X"], 0),
    ),
    Diagnosis(
        "lever-missing",
        "An error of θ turns the wall only, and does not shift it. But it is turned about the "
        "robot, so its distance from the origin changes: differentiate ρ by θ, cos α included.",
        _is("X", _spread(0.0)),
    ),
    Diagnosis(
        "degrees",
        "A lever arm (metres per angle) is 180/π too long or too short: angles are in radians "
        "here, and no factor belongs there.",
        _either(
            _is("X", _spread(DEGREES), _spread(1 / DEGREES)),
            _is("C", _spread(1, DEGREES), _spread(1, 1 / DEGREES)),
        ),
    ),
    Diagnosis(
        "lever-sign",
        "∂ρ/∂α has the wrong sign: the derivative of x cos α + y sin α is −x sin α + y cos α.",
        _either(_is("X", _spread(-1.0)), _is("C", _spread(1, -1.0))),
    ),
    Diagnosis(
        "jacobian-in-robot-frame",
        "The Jacobian is taken at α' instead of α: the normal in it is the one in the world.",
        _is("X", _spread(of=lambda theta, a: a)),
    ),
    Diagnosis(
        "noise-missing",
        "C holds the pose's error only. The sight errs as well: R, carried by ∂line/∂z.",
        _is("C", _spread(noise=0)),
    ),
    Diagnosis(
        "pose-missing",
        "C holds the sight's error only. It was seen from a pose that errs, too: P, carried by "
        "∂line/∂x.",
        _is("C", _spread(pose=0), lambda inputs: {"C": inputs["R"]}),
    ),
    Diagnosis(
        "noise-not-carried",
        "R was added as it is. It is about (ρ', α'); an error of α' also changes ρ, by the "
        "lever from the robot's place: ∂line/∂z is not the identity.",
        _is("C", _spread(1, 0.0)),
    ),
    Diagnosis(
        "sandwich-reversed",
        "J_zᵀ R J_z has the shape of J_z R J_zᵀ, and another meaning.",
        _is("C", _sandwich),
    ),
    Diagnosis(
        "standard-deviation",
        "R holds variances already: look whether you square it or take a root.",
        _is(
            "C",
            _spread(R=lambda R: R @ R),
            _spread(R=lambda R: R**2),
            _spread(R=lambda R: np.sqrt(np.abs(R))),
        ),
    ),
)
