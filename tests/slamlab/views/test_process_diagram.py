"""Process diagrams: arrows go straight where boxes face each other, and touch their edges."""

import numpy as np
import pytest

from slamlab import views
from slamlab.views.colours import contrast
from slamlab.views.figure_checks import faults
from slamlab.views.process_diagram import KINDS

BOXES = {
    "left": views.Box("device", "left", 1.0, 3.3),
    "middle": views.Box("step", "middle", 4.0, 2.5, 1.5, 2.0),
    "below": views.Box("lost", "below", 4.6, 0.5),
    "apart": views.Box("kept", "apart", 8.0, 4.5),
}
FLOWS = [("left", "middle", "a"), ("middle", "below", "b"), ("=middle", "apart", "c")]


def arrows(fig):
    """Ends of the arrows, and how they are drawn."""
    found = [text for text in fig.axes[0].texts if getattr(text, "arrow_patch", None)]
    return [(np.array(each.xyann), np.array(each.xy), each.arrow_patch) for each in found]


def test_arrows_are_level_or_upright_where_boxes_face_each_other_and_end_at_their_edges():
    level, upright, slanted = arrows(views.process(BOXES, FLOWS))
    assert level[0] == pytest.approx([1.75, 3.225]) and level[1] == pytest.approx([3.25, 3.225])
    assert upright[0][0] == upright[1][0] and upright[0][1] > upright[1][1]
    assert slanted[0] == pytest.approx([4.75, 3.5]) and slanted[1] == pytest.approx([7.25, 4.15])


def test_a_flow_in_both_directions_has_two_arrow_heads():
    styles = [
        type(patch.get_arrowstyle()).__name__ for *_, patch in arrows(views.process(BOXES, FLOWS))
    ]
    assert styles == ["CurveFilledB", "CurveFilledB", "CurveFilledAB"]


def test_the_legend_names_each_kind_that_there_is_once_and_nothing_is_wrong_with_the_figure():
    fig = views.process(BOXES | {"more": views.Box("step", "more", 8.0, 1.0)}, FLOWS)
    views.png(fig)
    messages = [text.get_text() for text in fig.legends[0].get_texts()]
    assert messages == ["device", "function", "forgotten", "kept for the next step"]
    assert faults(fig) == []


def test_box_frames_differ_from_the_background_and_each_other():
    frames = [frame for frame, *_ in KINDS.values()]
    assert all(contrast(frame) >= 3 for frame in frames)
    assert len(set(frames)) == len(KINDS)
