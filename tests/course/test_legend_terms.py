"""Consistent terms: figures, pages and guides name the trajectories as the lessons do."""

import re

import numpy as np
import pytest

from course.source import ROOT
from slamlab import views
from slamlab.layers import Points, Poses
from slamlab.live.frame_packing import Scene
from slamlab.live.raster_screen import RasterScreen
from slamlab.live.run_scene import still_picture
from slamlab.views.colours import IN_LEGENDS

WAY = np.array([[0.0, 0, 0], [1, 0, 0]])
LAYERS = [Poses("naive", WAY), Points("corrected", WAY[:, :2]), Poses("truth", WAY)]
TERMS = ["odometry alone", "estimate", "truth"]
CURVES = {"error [m]": {"naive": WAY[:, :2], "corrected": WAY[:, :2]}}
GUIDES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")),
        ROOT / "slamlab/live/console/page/console.html"]  # fmt: skip
# ids of elements and names in code are no words
NO_WORDS = re.compile(r"`[^`]*`|\bid=\"[^\"]*\"|^ {4}.*$", re.MULTILINE)


def entries(legend):
    return [text.get_text() for text in legend.get_texts()]


def test_a_figure_and_a_live_views_still_picture_show_it():
    fig, _ = views.side_by_side({"a map": LAYERS})
    assert entries(fig.legends[0]) == TERMS
    assert entries(still_picture(Scene(LAYERS), "A run", (720, 480)).legends[0]) == TERMS
    with_curves = still_picture(Scene(LAYERS, curves=CURVES), "A run", (720, 480))
    assert {line.get_label() for line in with_curves.axes[1].lines} == set(TERMS[:2])


def test_a_picture_without_javascript_is_explained():
    screen = RasterScreen()
    screen.offer(Scene(LAYERS))
    words = screen.widget.children[1].value
    assert all(message in words for message in TERMS) and "naive" not in words


@pytest.mark.parametrize("path", GUIDES, ids=lambda path: path.name)
def test_all_texts_for_readers_use_the_same_term(path):
    reported = NO_WORDS.sub("", path.read_text(encoding="utf-8"))
    other = re.compile(rf"\b(?:{'|'.join(IN_LEGENDS)}) (?:one|map|path|pose|track)?|>\s*naive\b")
    assert other.findall(reported) == []
