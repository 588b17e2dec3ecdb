"""Forest plot: shares are drawn where they are, bars as long as their intervals."""

import numpy as np

from slamlab.views import shares

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
