"""Task 09-place: a wall seen from the robot, put into the world with its doubts."""

import numpy as np

from slamlab.checks.drives.ex09 import DRIVES
from slamlab.checks.task import Diagnosis, Law, Task
from slamlab.checks.tasks.ex06_beliefs import T, covariances, either_sign, moments, sigmas
from slamlab.geometry import wrap

ROWS, BEYOND = 8, 2  # the last BEYOND walls stand between the robot and the world's origin
CLOSE = 1e-3  # in standard deviations, and of covariances in two of them
DEGREES = 180 / np.pi


def sights(rng):
    """Poses with their covariance, and walls seen from there; nothing stands at a right angle."""
    z = np.column_stack([rng.uniform(1, 4, ROWS), either_sign(rng, 0.4, 2.6, ROWS)])
    theta = either_sign(rng, 0.3, 2.8, ROWS)
    ahead = rng.uniform(0.5, 3, ROWS)
    ahead[-BEYOND:] = -z[-BEYOND:, 0] - rng.uniform(0.5, 2, BEYOND)
    aside, alpha = either_sign(rng, 0.8, 3, ROWS), theta + z[:, 1]
    c, s = np.cos(alpha), np.sin(alpha)
    x = np.column_stack([ahead * c - aside * s, ahead * s + aside * c, theta])
    pose_sigma = np.column_stack(
        [rng.uniform(0.05, 0.15, (ROWS, 2)), rng.uniform(0.03, 0.06, ROWS)]
    )
    wall_sigma = np.column_stack([rng.uniform(0.15, 0.3, ROWS), rng.uniform(0.08, 0.15, ROWS)])
    return {"x": x, "P": covariances(rng, pose_sigma), "z": z, "R": covariances(rng, wall_sigma)}


def on_the_wall(states, z):
    """Pose and line, the line from a point on it and its normal: no formula of ρ is consulted."""
    (x, y, theta), (rho, alpha) = states, z
    normal = np.cos(theta + alpha), np.sin(theta + alpha)
    a, b = x + rho * normal[0], y + rho * normal[1]
    return np.vstack([states, a * normal[0] + b * normal[1], theta + alpha])


def truth(inputs):
    """(k, 2) lines and (k, 5, 5) covariances of pose and line together."""
    found = [
        moments(on_the_wall, (x, z), P, R) for x, P, z, R in zip(*inputs.values(), strict=True)
    ]
    return np.array([x[3:] for x, _ in found]), np.array([P for _, P in found])


def _same_line(got, want, s):
    off = got - want
    off[:, 1] = wrap(off[:, 1])
    return (np.abs(off) <= CLOSE * s).all(axis=1)


def _line(inputs, outputs):
    want, P = truth(inputs)
    return _same_line(outputs["line"], want, sigmas(P)[:, 3:])


def _same_block(got, want, rows, columns, s):
    scale = s[:, rows, None] * s[:, None, columns]
    return (np.abs(got - want) <= CLOSE * scale).all(axis=(1, 2))


PARTS = {"C": (slice(3, 5), slice(3, 5)), "X": (slice(3, 5), slice(0, 3))}


def _block(name):
    rows, columns = PARTS[name]

    def holds(inputs, outputs):
        _, P = truth(inputs)
        return _same_block(outputs[name], P[:, rows, columns], rows, columns, sigmas(P))

    return holds


# ---- mistakes: the wrong formula, computed on the same sights ---------------------------------


def _elsewhere(*formulas):
    def matches(inputs, outputs):
        s = sigmas(truth(inputs)[1])[:, 3:]
        x, z = inputs["x"].T, inputs["z"].T
        lines = (np.column_stack(formula(x, z)) for formula in formulas)
        return any(_same_line(outputs["line"], line, s).all() for line in lines)

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
    return _same_line(outputs["line"], flip, sigmas(P)[:, 3:]).all()


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
            _same_block(outputs[name], formula(inputs)[name], rows, columns, s).all()
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


PLACE = Task(
    id="09-place",
    title="Place: a wall into the world",
    drive=DRIVES["09-place"],
    inputs=sights,
    shapes={"line": (ROWS, 2), "C": (ROWS, 2, 2), "X": (ROWS, 2, 3)},
    laws=(
        Law(
            "line",
            2,
            "the line holds the points of the wall, its normal away from the robot",
            _line,
        ),
        Law(
            "C",
            2,
            "C is the covariance of the lines that poses and sights in error give",
            _block("C"),
        ),
        Law("X", 2, "X is what those lines share with the pose's own errors", _block("X")),
    ),
    diagnoses=(
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
    ),
)
