"""The symbolic derivation by sympy equals the code."""

import importlib
import subprocess
import sys
from functools import cache

import numpy as np
import pytest
import sympy as sp
from hypothesis import assume, given
from hypothesis import strategies as st

from slamlab import models
from slamlab.extras import ExtraMissing
from slamlab.models import jacobians, motion, observation, symbolic
from tests.property_testing import (
    angles,
    bases,
    observation_vectors,
    odometry_controls,
    periods,
    points,
    poses,
    same_angle,
    steered_controls,
)

ODOMETRY = (symbolic.pose, symbolic.u_odometry)
STEERED = (symbolic.pose, symbolic.u_steered, symbolic.B, symbolic.T)
SEEN = (symbolic.pose, symbolic.p)
PLACED = (symbolic.pose, symbolic.z)
LINE_SEEN = (symbolic.pose, symbolic.line)
LINE_PLACED = (symbolic.pose, symbolic.z_line)
ARGUMENTS = {
    name: arguments
    for arguments, names in (
        (ODOMETRY, "f_odometry A_odometry W_odometry"),
        (STEERED, "f_steered A_steered W_steered"),
        (SEEN, "h H_robot H_landmark"),
        (PLACED, "g J_xr J_z"),
        (LINE_SEEN, "h_line H_robot_line H_line"),
        (LINE_PLACED, "g_line J_xr_line J_z_line"),
    )
    for name in names.split()
}
NUMBERS = {
    ODOMETRY: st.tuples(poses, odometry_controls),
    STEERED: st.tuples(poses, steered_controls, bases, periods),
    SEEN: st.tuples(poses, points),
    PLACED: st.tuples(poses, observation_vectors),
    LINE_SEEN: st.tuples(poses, observation_vectors),
    LINE_PLACED: st.tuples(poses, observation_vectors),
}
ANGULAR = {"f_odometry": 2, "f_steered": 2, "h": 1, "h_line": 1, "g_line": 1}


@cache
def derived_function(name):
    return symbolic.numeric(getattr(symbolic, name), *ARGUMENTS[name])


@pytest.mark.parametrize("name", ARGUMENTS)
@given(data=st.data())
def test_the_derivation_equals_the_code(name, data):
    numbers = data.draw(NUMBERS[ARGUMENTS[name]])
    if ARGUMENTS[name] is SEEN:
        assume(np.hypot(*(numbers[1] - numbers[0][:2])) > 1e-3)
    derived = derived_function(name)(*numbers)
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


@pytest.mark.parametrize("module", ["slamlab.models.symbolic", "slamlab.posegraph.edge_symbolic"])
def test_without_sympy_a_derivation_states_in_one_line_what_to_install(monkeypatch, module):
    monkeypatch.setitem(sys.modules, "sympy", None)
    monkeypatch.delitem(sys.modules, module, raising=False)
    with pytest.raises(ExtraMissing, match=r'^sympy is not .* "slam-course-lab\[symbolic\]"$'):
        importlib.import_module(module)
