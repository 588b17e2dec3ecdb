"""Quantising: whatever numbers are, they come back but for half a step, and packing is exact."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from slamlab.live.films.quantising import COLUMNS, FINEST, pack, quantise, restore, steps, unpack

whole_tables = arrays.arrays(
    np.int16, st.tuples(st.integers(0, 30), st.integers(1, 5)), elements=st.integers(-32768, 32767)
)


@st.composite
def tables(draw):
    """A kind of layer and rows of it, as large as they like, some not finite."""
    kind = draw(st.sampled_from(sorted(COLUMNS)))
    size = draw(st.sampled_from([2.0**-10, 1, 40, 2.0**20, 2.0**100]))
    numbers = st.floats(-size, size, width=32) | st.sampled_from([np.nan, np.inf, -np.inf])
    shape = draw(st.integers(0, 12)), len(COLUMNS[kind])
    return kind, draw(arrays.arrays(np.float32, shape, elements=numbers))


def off(kind, rows, back):
    """How far rows are off, angles the short way round."""
    found = np.abs(back - rows)
    for column, what in enumerate(COLUMNS[kind]):
        if what == "radians":
            found[:, column] = np.abs(np.angle(np.exp(1j * found[:, column])))
    return found


@given(tables())
def test_quantisation_error_is_at_most_half_a_step(table):
    kind, rows = table
    rows = rows.astype(float)
    used = np.array(steps(kind, rows))
    back = restore(quantise(kind, rows, used), used)
    finite = np.isfinite(rows)
    assert np.array_equal(np.isfinite(back), finite)
    rows[~finite] = back[~finite] = 0
    # an angle of many turns is wrapped by floating-point numbers, which err by themselves
    slack = 1e-9 + 1e-15 * np.abs(rows)
    wrapped = np.array([what == "radians" for what in COLUMNS[kind]])
    allowed = used / 2 * (1 + 1e-9) + np.where(wrapped, slack, 0)
    assert np.all(off(kind, rows, back) <= allowed)


@given(tables(), tables())
def test_steps_only_grow_and_columns_drawn_together_share_one(table, later):
    kind, rows = table
    first = steps(kind, rows)
    then = steps(kind, np.resize(later[1], (3, len(first))), first)
    assert all(after >= before for before, after in zip(first, then, strict=True))
    for what in set(COLUMNS[kind]):
        assert (
            len({s for s, column in zip(then, COLUMNS[kind], strict=True) if column == what}) == 1
        )


def test_positions_in_a_building_are_stored_with_millimetres():
    rows = np.array([[32.767, -32.767], [0.0004, 0.0006]])
    assert steps("points", rows) == [FINEST["metres"]] * 2 == [0.001] * 2
    assert quantise("points", rows, [0.001] * 2).tolist() == [[32767, -32767], [0, 1]]


@pytest.mark.parametrize(("size", "step"), [(32.768, 0.002), (100, 0.005), (1000, 0.05)])
def test_large_values_get_larger_steps(size, step):
    assert steps("segments", np.array([[0, 0, -size, 0]])) == [step] * 4


def test_a_wrapped_title_keeps_its_layout():
    rows = np.array([[0, 0, 7 * np.pi / 2], [0, 0, -np.pi], [0, 0, 1e4]])
    used = steps("poses", rows)
    assert used == [0.001, 0.001, 0.0001]
    wrapped = restore(quantise("poses", rows, used), used)[:, 2]
    assert np.all(np.abs(wrapped) <= np.pi + 1e-4)
    assert wrapped[0] == pytest.approx(-np.pi / 2, abs=1e-4)


@given(whole_tables)
def test_packing_is_exact(whole):
    data = pack(whole)
    assert len(data) == 2 * whole.size
    assert np.array_equal(unpack(data, whole.shape[1]), whole)
