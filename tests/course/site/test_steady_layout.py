"""Pictures of a slider: axes keep their positions unless their labels need more room."""

import numpy as np

from course.site.steady_layout import SteadyLayout
from slamlab import views


def places(layout, highest, xlim=(0, 1)):
    fig, (left, right) = views.panels([None, None], (8, 4))
    left.plot([0, 1], [0, highest])
    for ax in (left, right):
        ax.set(xlim=xlim, ylim=(0, highest), aspect="auto")
    layout(fig)
    words = [ax.get_tightbbox().extents for ax in fig.axes]
    assert min(np.min(words), fig.bbox.x1 - np.max(words)) >= 0  # nothing is cut off
    assert words[0][2] <= words[1][0]  # and nothing is covered
    return np.array([ax.get_position().bounds for ax in fig.axes])


def test_axes_stay_until_their_words_need_more_room():
    layout = SteadyLayout()
    first = places(layout, 80)
    assert np.array_equal(places(layout, 90), first)
    assert not np.allclose(places(layout, 8e6), first)
