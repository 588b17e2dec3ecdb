"""Known faults of figures: only new and vanished ones are reported."""

from course import known_figure_faults

FAULT = "A figure → letters too faint: 'faint'"


def test_what_is_new_or_gone_is_reported():
    assert known_figure_faults.compare([FAULT], []) == [f"new: {FAULT}"]
    assert len(known_figure_faults.compare([], [FAULT])) == 1
    assert known_figure_faults.compare([FAULT], [FAULT]) == []
