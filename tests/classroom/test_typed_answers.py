"""A value that the reader of a lesson types is compared with the expected value."""

import numpy as np
import pytest
import sympy as sp

from classroom.checks import compare

x, y = sp.symbols("x y")


@pytest.mark.parametrize(
    ("yours", "expected"),
    [
        (1, 1.0),
        ([0.0, 2.0], np.array([1e-9, 2.0])),
        (np.zeros((0, 2)), np.zeros((0, 2))),
        (2 * x, x + x),
        (sp.ImmutableMatrix([sp.sin(x) ** 2]), sp.Matrix([1 - sp.cos(x) ** 2])),
    ],
)
def test_a_right_value_is_confirmed(yours, expected, capsys):
    compare(yours, expected)
    assert capsys.readouterr().out == "✓ Correct.\n"


@pytest.mark.parametrize(
    ("yours", "expected", "report"),
    [
        (..., 1, "Replace the dots"),
        (3, 1, "differs by 2"),
        (np.nan, 1, "not finite"),
        (None, 1, "not finite"),
        ("one", 1, "not str"),
        ([1, 2], np.eye(2), r"(2,); it should be (2, 2)"),
        ([1, 2, 5], [1, 2, 3], "1 of 3 entries differ. The largest difference is 2 at index 2"),
        (2 * np.eye(2), np.eye(2), "2 of 4 entries differ"),
        (x, y, "expressions differ"),
        ("foo(", x, "Expected an expression"),
        (sp.Matrix([x]), sp.Matrix([x, x]), "Expected an expression"),
        (sp.Matrix([x, y]), sp.Matrix([x, x]), "Entry (1, 0) differs"),
    ],
)
def test_a_wrong_value_is_reported_with_its_difference(yours, expected, report, capsys):
    compare(yours, expected)
    assert report in capsys.readouterr().out
