"""A world edited by its rows: what is right is drawn and kept, what is wrong is said."""

import numpy as np
import pytest

from slamlab import worlds
from slamlab.views import widgets
from slamlab.views.editor import WorldEditor, edit_world


@pytest.fixture
def shown(monkeypatch):
    seen = []
    monkeypatch.setattr(widgets, "display", lambda data, **rest: seen.append(data))
    return seen


def test_a_wall_added_by_its_numbers_is_in_the_world_and_in_the_figure():
    editor = WorldEditor(worlds.situation_2())
    fig = editor.figure(worlds.text_of(editor.world) + "0 0 1 1\n")
    assert editor.world.walls[-1].tolist() == [0, 0, 1, 1]
    assert fig.axes[0].get_title() == "situation-2: 10 walls, 0 circles"


@pytest.mark.parametrize("row", ["1 2", "0 0 0 0", "a b c d", "0 0 1 nan"])
def test_a_row_with_a_mistake_is_told_by_its_line_and_the_last_world_stays(row):
    editor = WorldEditor(worlds.situation_2())
    before = editor.world
    fig = editor.figure(f"0 0 1 0\n{row}\n")
    assert editor.world is before
    assert "situation-2:2:" in fig.axes[0].get_title()


def test_it_shows_rows_and_picture_and_what_a_scanner_sees(shown):
    calls = []

    def scan(world):
        calls.append(len(world.walls))
        return np.zeros((1, 2))

    editor = edit_world(worlds.situation_2(), "An irregular room.", scan)
    (data,) = shown
    assert "image/png" in data and data["text/plain"] == "An irregular room."
    assert calls == [9] and editor.world.name == "situation-2"
