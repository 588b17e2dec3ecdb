"""Bit plot: every bit stands in its place, in its field's colour."""

from matplotlib.colors import to_rgba

from slamlab.views import COLOURS, bits


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
