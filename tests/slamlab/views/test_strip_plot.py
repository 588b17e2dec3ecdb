"""Strip plots: every value a dot at its place, limits across; and maps whose layers are named."""

import numpy as np

from slamlab import views
from slamlab.layers import Points


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
