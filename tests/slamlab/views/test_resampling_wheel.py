"""Resampling wheel: every marker stands over the weight that it picks."""

import numpy as np

from slamlab import views


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
