"""The symbolic derivation by sympy equals the code."""

import subprocess
import sys

import numpy as np
import pytest
import sympy as sp
from hypothesis import assume, given
from hypothesis import strategies as st

from slamlab import models
from slamlab.models import jacobians, motion, observation, symbolic
from tests.laws import (
    angles,
    bases,
    odometry_controls,
    periods,
    points,
    poses,
    same_angle,
    sightings,
    steered_controls,
)

ODOMETRY = (symbolic.pose, symbolic.u_odometry)
STEERED = (symbolic.pose, symbolic.u_steered, symbolic.B, symbolic.T)
SEEN = (symbolic.pose, symbolic.p)
PLACED = (symbolic.pose, symbolic.z)
LINE_SEEN = (symbolic.pose, symbolic.line)
LINE_PLACED = (symbolic.pose, symbolic.z_line)
ARGUMENTS = {
    "f_odometry": ODOMETRY,
    "A_odometry": ODOMETRY,
    "W_odometry": ODOMETRY,
    "f_steered": STEERED,
    "A_steered": STEERED,
    "W_steered": STEERED,
    "h": SEEN,
    "H_robot": SEEN,
    "H_landmark": SEEN,
    "g": PLACED,
    "J_xr": PLACED,
    "J_z": PLACED,
    "h_line": LINE_SEEN,
    "H_robot_line": LINE_SEEN,
    "H_line": LINE_SEEN,
    "g_line": LINE_PLACED,
    "J_xr_line": LINE_PLACED,
    "J_z_line": LINE_PLACED,
}
NUMBERS = {
    ODOMETRY: st.tuples(poses, odometry_controls),
    STEERED: st.tuples(poses, steered_controls, bases, periods),
    SEEN: st.tuples(poses, points),
    PLACED: st.tuples(poses, sightings),
    LINE_SEEN: st.tuples(poses, sightings),
    LINE_PLACED: st.tuples(poses, sightings),
}
ANGULAR = {"f_odometry": 2, "f_steered": 2, "h": 1, "h_line": 1, "g_line": 1}


@pytest.mark.parametrize("name", ARGUMENTS)
@given(data=st.data())
def test_the_derivation_equals_the_code(name, data):
    numbers = data.draw(NUMBERS[ARGUMENTS[name]])
    if ARGUMENTS[name] is SEEN:
        assume(np.hypot(*(numbers[1] - numbers[0][:2])) > 1e-3)
    derived = symbolic.numeric(getattr(symbolic, name), *ARGUMENTS[name])(*numbers)
    coded = getattr(models, name)(*numbers)
    assert derived.shape == coded.shape
    if name in ANGULAR:
        row = ANGULAR[name]
        assert same_angle(derived[row], coded[row])
        derived, coded = np.delete(derived, row), np.delete(coded, row)
    np.testing.assert_allclose(derived, coded, rtol=1e-9, atol=1e-9)


def test_every_model_and_jacobian_has_its_derivation():
    coded = {
        name
        for module in (motion, observation, jacobians)
        for name, value in vars(module).items()
        if callable(value) and value.__module__ == module.__name__
    }
    assert coded == set(ARGUMENTS)


def test_h_of_g_is_the_sighting_by_algebra():
    x, y = symbolic.g
    distance = symbolic.h[0].subs({symbolic.p_x: x, symbolic.p_y: y})
    assert sp.simplify(distance - symbolic.r) == 0


def test_the_landmarks_part_of_H_is_minus_the_robots():
    difference = symbolic.H_landmark + symbolic.H_robot[:, :2]
    assert sp.simplify(difference) == sp.zeros(2, 2)


@given(angles)
def test_numeric_takes_scalars_as_well_as_vectors(value):
    row = symbolic.numeric(sp.Matrix([[symbolic.theta**2, 1]]), symbolic.theta)
    np.testing.assert_allclose(row(value), [[value**2, 1]])


def test_the_package_and_its_models_are_imported_without_sympy_matplotlib_or_filterpy():
    modules = "slamlab, slamlab.models, slamlab.models.jacobians, slamlab.sources.simulated_robot"
    heavy = {"sympy", "matplotlib", "filterpy"}
    code = f"import sys, {modules}; print(sorted({heavy} & set(sys.modules)))"
    shown = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert shown.stdout.strip() == "[]"
