"""Heat map of shares: each number stands in its cell, light ink on dark, dark ink on light."""

import numpy as np
import pytest

from slamlab import views

TABLE = np.array([[0.0, 0.25, 0.5], [0.75, 0.9, 1.0]])


def drawn(table=TABLE):
    return views.cells({"a": table, "b": table}, [0, 0.5, 1], [0, 90], "way [m]", "turn [°]")


def test_each_share_is_written_in_its_cell_below_the_value_of_its_column():
    _, all_axes = drawn()
    for ax in all_axes:
        written = {text.get_position(): text.get_text() for text in ax.texts}
        assert written == {
            (column, row): f"{100 * TABLE[row, column]:.0f}" for row, column in np.ndindex(2, 3)
        }
        assert [label.get_text() for label in ax.get_xticklabels()] == ["0", "0.5", "1"]
        assert ax.get_ylim()[0] < ax.get_ylim()[1]  # the first row is the lowest


def test_numbers_stand_out_from_their_cells():
    _, (ax, _) = drawn()
    picture = ax.images[0]
    for text in ax.texts:
        column, row = text.get_position()
        back = np.array(picture.cmap(TABLE[row, column])[:3]) @ [0.2126, 0.7152, 0.0722]
        assert abs(back - (text.get_color() == "white")) > 0.3


def test_an_invalid_table_of_shares_is_refused():
    with pytest.raises(ValueError, match=r"expected shape \(2, 3\)"):
        drawn(TABLE.T)
    with pytest.raises(ValueError, match="between 0 and 1"):
        drawn(100 * TABLE)
