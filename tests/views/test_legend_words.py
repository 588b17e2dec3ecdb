"""One wording everywhere: pictures, pages and guides call the tracks what lessons call them."""

import re

import numpy as np
import pytest

from course.source import ROOT
from slamlab import views
from slamlab.layers import Points, Poses
from slamlab.views.colours import IN_LEGENDS, in_legends
from slamlab.views.live.frame_packing import Scene
from slamlab.views.live.live_view import still_picture
from slamlab.views.live.raster import RasterScreen

WAY = np.array([[0.0, 0, 0], [1, 0, 0]])
LAYERS = [Poses("naive", WAY), Points("corrected", WAY[:, :2]), Poses("truth", WAY)]
SAID = ["odometry alone", "estimate", "truth"]
CURVES = {"error [m]": {"naive": WAY[:, :2], "corrected": WAY[:, :2]}}
TOLD = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")),
        ROOT / "slamlab/console/page/console.html"]  # fmt: skip
# ids of elements and names in code are no words
NO_WORDS = re.compile(r"`[^`]*`|\bid=\"[^\"]*\"|^ {4}.*$", re.MULTILINE)


def entries(legend):
    return [text.get_text() for text in legend.get_texts()]


def test_a_name_without_a_word_of_its_own_stands_for_itself():
    assert [in_legends(layer.name) for layer in LAYERS] == SAID


def test_a_figure_and_a_live_views_still_picture_say_it():
    fig, _ = views.side_by_side({"a map": LAYERS})
    assert entries(fig.legends[0]) == SAID
    assert entries(still_picture(Scene(LAYERS), "A run", (720, 480)).legends[0]) == SAID
    with_curves = still_picture(Scene(LAYERS, curves=CURVES), "A run", (720, 480))
    assert {line.get_label() for line in with_curves.axes[1].lines} == set(SAID[:2])


def test_a_picture_without_javascript_says_it():
    screen = RasterScreen()
    screen.offer(Scene(LAYERS))
    words = screen.widget.children[1].value
    assert all(said in words for said in SAID) and "naive" not in words


@pytest.mark.parametrize("path", TOLD, ids=lambda path: path.name)
def test_what_a_reader_is_told_calls_it_the_same(path):
    told = NO_WORDS.sub("", path.read_text(encoding="utf-8"))
    other = re.compile(rf"\b(?:{'|'.join(IN_LEGENDS)}) (?:one|map|path|pose|track)?|>\s*naive\b")
    assert other.findall(told) == []
