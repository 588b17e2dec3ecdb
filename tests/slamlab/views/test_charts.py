"""Charts show every number in its place: bits, shares, intervals, weights, strips."""

import numpy as np
import pytest
from matplotlib.colors import to_rgba

from slamlab import views
from slamlab.layers import Points
from slamlab.views import COLOURS, bits, shares


def test_bits_are_in_rows_with_the_highest_first():
    _, ax = bits(b"\x81\x0f", {"all": [(0, 0)]})
    rows = {}
    for text in ax.texts:
        rows.setdefault(round(text.get_position()[1]), []).append(text)
    messages = ["".join(t.get_text() for t in sorted(row, key=_x)) for row in rows.values()]
    assert messages == ["10000001", "00001111"]
    assert [label.get_text() for label in ax.get_yticklabels()] == ["byte 0: 81", "byte 1: 0f"]


def test_bits_have_field_colours_and_a_frame_for_the_marked_one():
    _, ax = bits(b"\x00", {"first": [(0, 7), (0, 6)], "rest": [(0, 0)]}, marked=(0, 0))
    first, _, rest, frame = ax.patches
    assert first.get_facecolor() == to_rgba(COLOURS["corrected"])
    assert rest.get_facecolor() == to_rgba(COLOURS["naive"])
    assert first.get_x() == 0 and rest.get_x() == 7 and not frame.get_fill()
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["first", "rest"]


def _x(text):
    return text.get_position()[0]


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


ROWS = {
    "free": {"box": (0.5, 0.4, 0.6), "samples": (0.1, 0.05, 0.2)},
    "snagged": {"box": (0.9, 0.8, 1.0), "samples": (0.7, 0.6, 0.8)},
}


def test_every_share_has_its_mark_and_its_bar_in_the_row_of_its_label():
    _, ax = shares(ROWS, "share [%]", "who is lost")
    assert [label.get_text() for label in ax.get_yticklabels()] == ["box", "samples"]
    for container, (name, of) in zip(ax.containers, ROWS.items(), strict=True):
        marks, _, (bars,) = container.lines
        assert container.get_label() == name
        np.testing.assert_allclose(marks.get_xdata(), [share for share, _, _ in of.values()])
        np.testing.assert_array_equal(np.rint(marks.get_ydata()), [0, 1])
        ends = [segment[:, 0] for segment in bars.get_segments()]
        np.testing.assert_allclose(ends, [(low, high) for _, low, high in of.values()])


def test_one_kind_of_share_needs_no_legend():
    assert shares({"all": ROWS["free"]}, "share")[1].get_legend() is None


def test_the_wheel_shows_weights_and_positions():
    weights = np.array([0.5, 0.2, 0.3])
    picks = {"systematic": np.array([0.1, 0.6]), "multinomial": np.array([0.2, 0.25, 0.9])}
    fig, ax = views.wheel(weights, picks, "draws")
    np.testing.assert_allclose([bar.get_width() for bar in ax.patches], weights)
    np.testing.assert_allclose([bar.get_x() for bar in ax.patches], [0, 0.5, 0.7])
    rows = [line.get_xdata() for line in ax.lines]
    for row, positions in zip(rows, picks.values(), strict=True):
        np.testing.assert_array_equal(row, positions)
    assert [label.get_text() for label in ax.get_yticklabels()] == [
        "systematic",
        "multinomial",
        "particle",
    ]
    assert ax.get_title() == "draws"
    assert views.png(fig)


def test_every_value_stands_on_its_strip_and_a_limit_runs_across():
    values = {
        "right": ("corrected", np.array([0.5, 2.0, 7.0])),
        "false": ("naive", np.array([90.0])),
    }
    _, ax = views.strips(values, {"gate": 11.3}, (0.1, 1000), "surprise [1]")
    dots = ax.lines[: len(values)]
    for row, (line, (name, wanted)) in enumerate(zip(dots, values.values(), strict=True)):
        np.testing.assert_array_equal(line.get_xdata(), wanted)
        assert np.all(np.abs(line.get_ydata() - row) < 0.5)
        assert line.get_color() == views.COLOURS[name]
    assert set(ax.lines[-1].get_xdata()) == {11.3}
    assert [text.get_text() for text in ax.get_yticklabels()] == list(values)
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["gate"]


def test_layers_side_by_side_have_their_names_or_given_ones():
    layer = Points("corrected", np.zeros((2, 2)))
    for given, called in (([layer], "estimate"), ({"scans": layer}, "scans")):
        fig, _ = views.side_by_side({"map": given})
        assert [text.get_text() for text in fig.legends[0].get_texts()] == [called]
