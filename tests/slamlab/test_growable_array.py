"""A table that grows holds what was appended, in order, and what was read stays as it was."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.estimators.growable_array import GrowableArray


@given(st.lists(st.integers(0, 1500), max_size=4))
def test_it_holds_all_pieces_in_order_and_earlier_reads_stay(sizes):
    grown, pieces, read = GrowableArray(2), [np.empty((0, 2))], []
    for number, size in enumerate(sizes):
        pieces.append(number + np.arange(2.0 * size).reshape(-1, 2))
        grown.append(pieces[-1])
        read.append((grown.rows, np.concatenate(pieces)))
    assert np.array_equal(grown.rows, np.concatenate(pieces))
    assert all(np.array_equal(seen, then) for seen, then in read)


def test_a_reader_cannot_change_it():
    grown = GrowableArray(2)
    grown.append(np.ones((3, 2)))
    with pytest.raises(ValueError, match="read-only"):
        grown.rows[0, 0] = 5
