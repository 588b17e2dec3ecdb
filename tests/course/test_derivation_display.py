"""What is shown of a derivation: what is new in a line is marked, and lines are revealed."""

import os
import re
import subprocess
import sys

import numpy as np
import pytest
import sympy as sp
from hypothesis import assume, given
from hypothesis import strategies as st

from classroom.derivation import derive, differentiate, partials, symmetric
from classroom.derivation.changes import change, parts
from classroom.derivation.marked_latex import COLOUR, marked_latex
from course.source import ROOT
from tests.course.test_derivation import H, P, d, expressions, f, few, pose, r, theta, x, y

fresh = sp.Symbol("fresh", real=True)


def marked(new, old):
    return change(new, old).marked()


@few
@given(expressions, expressions)
def test_something_is_marked_in_a_line_that_changed_and_nothing_in_one_that_did_not(new, old):
    for other in (new, old):
        found = change(new, other)
        assert bool(found.marked()) == (new != other)
        assert (COLOUR in marked_latex(found)) == (new != other)


@few
@given(expressions, st.data())
def test_one_new_symbol_is_marked_and_nothing_else(expression, data):
    symbols = sorted(expression.free_symbols, key=str)
    single = [s for s in symbols if len(list(places(expression, s))) == 1]
    assume(single and len(parts(expression)) > 1)
    new = expression.subs(data.draw(st.sampled_from(single)), fresh)
    assert marked(new, expression) == [fresh]


def places(expression, symbol):
    if expression == symbol:
        yield expression
    for part in parts(expression):
        yield from places(part, symbol)


@few
@given(expressions)
def test_without_its_marks_a_line_is_typeset_as_if_all_were_old(expression):
    new = change(expression + fresh, expression)
    assert new.marked() == [fresh]
    tex = marked_latex(new)
    mark = r"\{\\color\{#0072b2\}\{(.*?)\\(?:underline|boxed)\{(.*?)\}\}\}"
    plain = re.sub(mark, r"\1\2", tex)
    old = marked_latex(change(*[expression + fresh] * 2))
    assert re.sub(r"[\s{}]", "", plain) == re.sub(r"[\s{}]", "", old)


@pytest.mark.parametrize("place", [(0, 0), (0, 2), (1, 1)])
def test_one_new_entry_of_a_matrix_is_marked_and_no_other(place):
    old = f.jacobian(pose).as_immutable()
    new = old.as_mutable()
    new[place] = fresh
    assert marked(new.as_immutable(), old) == [fresh]
    new[place] = 0 if old[place] else 1  # stands elsewhere in the matrix, too
    found = change(new.as_immutable(), old)
    assert [part.is_new for part in found.parts] == [each == place for each in np.ndindex(2, 3)]
    assert marked_latex(found).count(COLOUR) == 1


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        (x + y, x - y, [-y]),
        (x + y, x, [x]),
        (sp.sin(theta), sp.sin(theta + x), [x]),
        (x / d, x / r, [r]),
        (x, x / d, [d]),
        (H * P, H * P * H.T, [H.T]),
        (P * H.T, P.T * H.T, []),
    ],
)
def test_what_is_new_is_marked_where_it_stands(old, new, expected):
    assert marked(new, old) == expected
    assert marked_latex(change(new, old)).count(COLOUR) == len(expected)


def test_the_robot_is_a_roman_r_and_a_range_an_italic_one():
    P_ri, P_rr = sp.MatrixSymbol("P_ri", 3, 2), symmetric("P_rr", 3)
    P_r1 = sp.MatrixSymbol("P_r1", 3, 3)
    steps = derive("P_nr", P_ri.T * P_rr * P_r1 * sp.Symbol("sigma_r"), "so")
    shown = steps._repr_mimebundle_()["text/html"]
    robots = r"P_{n\mathrm{r}} =", r"P_{\mathrm{r}i}^{T}", r"P_{\mathrm{rr}}", r"P_{\mathrm{r}1}"
    for each in (*robots, r"\sigma_{r}"):
        assert each in shown


def shown():
    wrong = sp.Matrix([[1, 0, d * sp.sin(theta)], [0, 1, d * sp.cos(theta)]])
    steps = derive("A", partials(f, pose)).step("a < b & c", differentiate(x, y))
    return steps.step("all", differentiate()).step("wrong", wrong).step("last", sp.simplify)


def test_every_line_after_the_first_can_be_revealed_by_itself():
    html = shown()._repr_mimebundle_()["text/html"]
    assert html.count('class="slamlab-step"') == 4
    assert html.count("<li ") == 5
    assert "a &lt; b &amp; c" in html
    assert re.search(r'class="slamlab-start">by definition<br>\$\\displaystyle A =', html)
    assert html.count(r"\phantom{A} =") == 3  # aligned; the last was not reached
    assert html.count("✓") == 2 and html.count("✗") == 1


@pytest.mark.slow
def test_displays_are_the_same_in_every_process():
    code = f"from {__name__} import shown; print(shown()._repr_mimebundle_())"
    for seed in ("1", "2"):
        environment = os.environ | {"PYTHONHASHSEED": seed}
        printed = subprocess.check_output(
            [sys.executable, "-c", code], cwd=ROOT, env=environment, text=True
        )
        assert printed == f"{shown()._repr_mimebundle_()}\n"
