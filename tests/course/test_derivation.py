"""Derivations: equal lines are accepted, others refused at their position."""

import pytest
import sympy as sp
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from classroom.derivation import blockwise, derive, differentiate, expectation, partials, symmetric
from slamlab.models import symbolic

x, y, theta = sp.symbols("x y theta", real=True)
d, r = sp.symbols("d r", positive=True)
dx, dy = sp.symbols("Δx Δy", real=True)
f = sp.Matrix([x + d * sp.cos(theta), y + d * sp.sin(theta)])
pose = [x, y, theta]

few = settings(max_examples=30, deadline=None)
leaves = st.sampled_from([x, y, theta, d, sp.Integer(2), sp.Rational(1, 3)])


def grown(inner):
    """Sums, products, powers and functions of smaller expressions."""
    pairs = st.tuples(inner, inner)
    return st.one_of(
        pairs.map(lambda pair: pair[0] + pair[1]),
        pairs.map(lambda pair: pair[0] * pair[1]),
        inner.map(lambda e: e**2),
        inner.map(sp.sin),
        inner.map(lambda e: 1 / (2 + e**2)),
    )


expressions = st.recursive(leaves, grown, max_leaves=5)
rewritings = st.sampled_from([sp.expand, sp.together, lambda e: e.subs(x, 2 * x).subs(x, x / 2)])


def number(expression, point):
    return complex(expression.subs(point).evalf())


def words(derivation):
    return repr(derivation)


# what is equal, and what is not


@few
@given(expressions, rewritings)
def test_a_true_step_is_accepted(expression, rewriting):
    assert not derive("e", expression).step("rewritten", rewriting).broken


@few
@given(expressions, expressions)
def test_a_false_step_is_refused_with_a_point_where_the_lines_differ(expression, extra):
    assume(sp.simplify(extra) != 0)
    wrong = expression + extra
    broken = derive("e", expression).step("same", sp.expand).step("wrong", wrong)
    assert broken.broken == 3
    point = broken.lines[2].verdict.point
    assert abs(number(expression, point) - number(wrong, point)) > 1e-9


@pytest.mark.parametrize("place", [(0, 2), (1, 2)])
def test_a_wrong_sign_is_refused_at_its_very_entry(place):
    A = f.jacobian(pose)
    wrong = A.copy()
    wrong[place] = -wrong[place]
    broken = derive("A", partials(f, pose)).step("all", differentiate()).step("by hand", wrong)
    row, column = place
    assert broken.broken == 3
    assert f"✗ line 3 does not follow: in row {row + 1}, column {column + 1} " in words(broken)
    point = broken.lines[2].verdict.point
    assert abs(number(A[place], point) - number(wrong[place], point)) > 1e-9


def test_a_transposed_matrix_is_refused():
    turn = sp.Matrix([[sp.cos(theta), -sp.sin(theta)], [sp.sin(theta), sp.cos(theta)]])
    assert derive("R", turn).step("transposed", turn.T).broken == 2
    assert "a 2×3 matrix became a 3×2 matrix" in words(
        derive("A", f.jacobian(pose)).step("transposed", lambda A: A.T)
    )


P, H, S = symmetric("P", 3), sp.MatrixSymbol("H", 2, 3), symmetric("S", 2)
before = P - P * H.T * S.I * S * (P * H.T * S.I).T


def test_products_of_matrices_are_checked_with_what_is_symmetric():
    assert not derive("P'", before).step("S⁻¹ S", P - P * H.T * S.I * H * P).broken
    free = sp.MatrixSymbol("F", 3, 3)
    assert derive("F", free + P).step("P is symmetric, F is not", free.T + P.T).broken


@pytest.mark.parametrize(
    "wrong",
    [P + P * H.T * S.I * H * P, P - P * H.T * S * H * P, P - P * H.T * S.I * H],
    ids=["sign", "not inverted", "missing P"],
)
def test_a_wrong_product_of_matrices_is_refused(wrong):
    broken = derive("P'", before).step("wrong", wrong)
    assert broken.broken == 2
    point = broken.lines[1].verdict.point
    assert set(point) >= {P, H, S}
    values = [line.xreplace(point).doit().as_explicit() for line in (before, wrong)]
    assert values[0] != values[1]
    assert point[P] == point[P].T


def test_block_matrices_are_multiplied_out_and_checked():
    a, b, c = symmetric("a", 2), sp.MatrixSymbol("b", 2, 3), symmetric("c", 3)
    M = sp.BlockMatrix([[a, b], [b.T, c]])
    square = derive("M²", M * M)
    assert not square.step("block by block", blockwise).broken
    right = [[a * a + b * b.T, a * b + b * c], [b.T * a + c * b.T, b.T * b + c * c]]
    assert not square.step("by hand", sp.BlockMatrix(right)).broken
    right[0][1] = a * b
    assert square.step("a term is missing", sp.BlockMatrix(right)).broken == 2


def test_what_is_assumed_of_a_symbol_is_respected():
    assert not derive("e", sp.sqrt(d**2)).step("d is positive", d).broken
    broken = derive("e", sp.exp(sp.log(x**2) / 2)).step("x is not", x)
    assert broken.broken == 2
    assert broken.lines[1].verdict.point[x] < 0


def test_where_algebra_does_not_decide_the_display_shows_at_how_many_points_it_holds():
    long = sp.expand((x + y + sp.sin(theta) + d) ** 12)
    folded = (x + y + sp.sin(theta) + d) ** 12
    assert "✓ equal at 4 random points" in words(derive("e", long).step("folded", folded))


def test_where_no_point_has_a_value_nothing_is_proved():
    nowhere = sp.log(sp.Symbol("n") - sp.Symbol("n"), evaluate=False)
    assert derive("e", nowhere * x).step("who knows", nowhere * y).broken == 2


def test_an_equation_may_change_both_sides_equally():
    start = derive("e", sp.Eq(2 * r * x, 4 * r))
    assert not start.step("divide by 2 r", sp.Eq(x, 2)).broken
    assert not start.step("the other way round", sp.Eq(0, 4 * r - 2 * r * x)).broken
    assert start.step("wrong", sp.Eq(x, 3)).broken == 2
    assert start.step("not equivalent", sp.Eq(x**2, 4)).broken == 2
    assert start.step("no equation", x).broken == 2


# what is given


def test_what_is_given_is_put_in_and_a_name_stands_for_its_meaning():
    A = derive("A", f.jacobian(pose))
    named = A.step("the step", given={dx: d * sp.cos(theta), dy: d * sp.sin(theta)})
    assert named.result == sp.ImmutableMatrix([[1, 0, -dy], [0, 1, dx]])
    ahead = A.step("straight ahead", given={theta: 0})
    assert ahead.result == sp.ImmutableMatrix([[1, 0, 0], [0, 1, d]])
    assert "where theta = 0" in words(ahead)
    assert not derive("e", x * y).step("an Eq", 2 * y, given=sp.Eq(x, 2)).broken
    assert derive("e", x * y).step("not given", 2 * y).broken


# what follows when the model changes


@few
@given(expressions, expressions)
def test_rules_follow_another_model(first, second):
    model = sp.Matrix([first, second])
    steps = derive("A", partials(model, pose)).step("x", differentiate(x))
    assert not steps.result.has(sp.Derivative(first, x))
    steps = steps.step("the others", differentiate())
    assert not steps.broken
    assert (steps.result - model.jacobian(pose)).applyfunc(sp.simplify).is_zero_matrix


def test_a_line_by_hand_breaks_when_the_model_changes_and_nothing_after_it_is_proved():
    def report(model):
        by_hand = sp.Matrix([[1, 0, -d * sp.sin(theta)], [0, 1, d * sp.cos(theta)]])
        steps = derive("A", partials(model, pose)).step("rule", differentiate())
        return steps.step("by hand", by_hand).step("after", sp.simplify)

    assert not report(f).broken
    changed = report(sp.Matrix([x + d, f[1]]))
    assert changed.broken == 3
    assert changed.result == sp.ImmutableMatrix([[1, 0, 0], [0, 1, d * sp.cos(theta)]])
    assert words(changed).count("✓") == 1
    assert "not checked: line 3 does not follow" in words(changed)


def test_a_rule_that_fails_reports_it_at_its_line():
    broken = derive("e", x).step("no column there", lambda line: line[:, 0])
    assert broken.broken == 2
    assert "✗ line 2 does not follow: cannot be done here: " in words(broken)


@pytest.mark.parametrize(
    ("step", "message"),
    [
        (dict(why="nothing"), "give the next line"),
        (dict(why="text", to="x + 1"), "a SymPy formula or a rule"),
        (dict(why="no name", given={x + y: 2}), "is not a symbol"),
    ],
)
def test_a_step_that_is_none_is_refused_at_once(step, message):
    with pytest.raises(TypeError, match=message):
        derive("e", x).step(**step)
    with pytest.raises(TypeError, match="start from a SymPy formula"):
        derive("e", "x")


@pytest.mark.parametrize(
    ("name", "model", "by"),
    [
        ("A_odometry", symbolic.f_odometry, symbolic.pose),
        ("H_robot", symbolic.h, symbolic.pose),
        ("J_z", symbolic.g, symbolic.z),
        ("W_steered", symbolic.f_steered, symbolic.u_steered),
    ],
)
def test_derivations_of_the_models_end_in_the_packages_jacobians(name, model, by):
    steps = derive(name, partials(model, by)).step("all", differentiate())
    assert not steps.broken
    assert steps.result == getattr(symbolic, name)


def test_an_expected_value_pairs_errors_and_drops_unrelated_ones():
    n, m = sp.symbols("n m", integer=True, positive=True)
    error, noise = sp.MatrixSymbol("e", n, 1), sp.MatrixSymbol("w", m, 1)
    P, R = symmetric("P", n), symmetric("R", m)
    H, K = sp.MatrixSymbol("H", m, n), sp.MatrixSymbol("K", n, m)
    E = expectation({error * error.T: P, noise * noise.T: R})
    seen = H * error + noise
    assert E(seen * seen.T) == H * P * H.T + R
    assert E(error * seen.T) == P * H.T
    after = sp.expand(error - K * seen)
    joseph = (sp.Identity(n) - K * H) * P * (sp.Identity(n) - K * H).T + K * R * K.T
    assert sp.expand(E(after * after.T) - joseph).doit().is_ZeroMatrix
    assert E(error * noise.T).is_ZeroMatrix


def test_an_expected_value_of_one_error_alone_is_refused():
    error, P = sp.MatrixSymbol("e", 2, 1), sp.MatrixSymbol("P", 2, 2)
    with pytest.raises(ValueError, match="two random columns"):
        expectation({error * error.T: P})(P * error)
