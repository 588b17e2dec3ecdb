"""The world editor: rows and dragging, undo, errors."""

import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.live.editor import WorldEditor, edit_world, editor_view
from slamlab.live.editor.edit_history import replace_numbers
from slamlab.simulation import worlds
from slamlab.simulation.worlds.world import World
from slamlab.simulation.worlds.world_files import parse
from slamlab.views import figure_display, sliders
from tests.slamlab.views.outputs import Displays

ALT = "An irregular room."
ROWS = """\
# my room
0 0, 3 0  # south
1 1 0.2

3 0 3 2
"""


def moved(editor, wall, at, **more):
    """Move an end of a wall as a drag does."""
    walls = editor.world.walls.copy()
    walls[wall, :2] = at
    editor.move(walls.tolist(), editor.world.circles.tolist(), **more)


@pytest.fixture
def editor():
    made = WorldEditor(worlds.situation_2())
    made.edit_text(ROWS)
    return made


def test_a_wall_added_by_its_numbers_is_in_the_world_and_in_the_figure():
    editor = WorldEditor(worlds.situation_2())
    editor.edit_text(editor.text + "0 0 1 1\n")
    assert editor.world.walls[-1].tolist() == [0, 0, 1, 1]
    assert editor.figure().axes[0].get_title() == "situation-2: 10 walls, 0 circles"


@pytest.mark.parametrize("row", ["1 2", "0 0 0 0", "a b c d", "0 0 1 nan"])
def test_a_row_with_a_mistake_is_reported_by_its_line_and_the_last_world_stays(row):
    editor = WorldEditor(worlds.situation_2())
    before = editor.world
    editor.edit_text(f"0 0 1 0\n{row}\n")
    assert editor.world is before
    assert "situation-2:2:" in editor.figure().axes[0].get_title()
    editor.edit_text(editor.text)
    assert "situation-2:2:" not in editor.figure().axes[0].get_title()


def test_moving_an_end_changes_only_its_row_and_keeps_comments(editor):
    moved(editor, 0, [0.5, -1])
    assert editor.text == ROWS.replace("0 0, 3 0", "0.5 -1.0 3.0 0.0")
    assert parse(editor.text).walls.tolist() == editor.world.walls.tolist()


numbers = st.floats(-50, 50, allow_nan=False)


@given(st.lists(st.tuples(*[numbers] * 4), min_size=2, max_size=2), st.tuples(numbers, numbers))
def test_rows_and_world_stay_consistent_after_any_moves(walls, centre):
    walls = [wall for wall in walls if wall[:2] != wall[2:]]
    if len(walls) == 2:
        world = World(walls, [[*centre, 0.2]])
        again = parse(replace_numbers(ROWS, world))
        assert np.array_equal(again.walls, world.walls)
        assert np.array_equal(again.circles, world.circles)


@pytest.mark.parametrize(
    ("walls", "circles"),
    [
        ([[0, 0, 0, 0], [3, 0, 3, 2]], [[1, 1, 0.2]]),  # without length
        ([[0, 0, 3, 0]], [[1, 1, 0.2]]),  # one less
        ([[0, 0, 3, 0], [3, 0, 3, None]], [[1, 1, 0.2]]),
        ("nonsense", [[1, 1, 0.2]]),
        ([[0, 0, 3, 0], [3, 0, 3, 2]], [[1, 1, -1]]),
    ],
)
def test_impossible_drags_are_refused(editor, walls, circles):
    before = editor.world
    with pytest.raises(ValueError):
        editor.move(walls, circles)
    assert editor.world is before


def test_undo_takes_back_a_drag_as_a_whole_and_each_change_of_the_rows(editor):
    first = editor.text
    for x in (0.1, 0.2, 0.3):
        moved(editor, 0, [x, 0], edit=1)
    second = editor.text
    moved(editor, 0, [0.4, 0], edit=2)
    editor.edit_text(editor.text + "9 9 1\n")
    editor.undo()
    assert len(editor.world.circles) == 1
    editor.undo()
    assert editor.text == second
    editor.undo()
    assert editor.text == first
    for _ in range(3):
        editor.undo()
    assert editor.world.name == "situation-2" and len(editor.world.walls) == 9


@pytest.fixture
def shown(monkeypatch):
    """Show an editor as a cell does; its board, rows, undo button and message."""
    displays = Displays(monkeypatch, figure_display, sliders)
    connected, boxes = editor_view._connect, []

    def kept(*given):
        boxes.append(connected(*given))
        return boxes[-1]

    monkeypatch.setattr(editor_view, "_connect", kept)

    def run(world, **more):
        editor = edit_world(world, ALT, **more)
        board, beside = boxes[-1].children if boxes else (None, None)
        return editor, board, *(beside.children if boxes else ())

    run.stills = displays.bundles
    return run


def test_a_drag_changes_the_rows_and_the_scan_and_rows_change_the_drawing(shown):
    def scan(world):
        return world.walls[:1, :2]

    editor, board, rows, undo, _ = shown(parse(ROWS), scan=scan)
    (data,) = shown.stills
    assert "<img" in data["text/html"] and data["text/plain"].endswith(ALT)
    board.set_state({"world": {"walls": [[1, 0, 3, 0], [3, 0, 3, 2]], "circles": [[1, 1, 0.2]]}})
    assert rows.value == editor.text and "1.0 0.0 3.0 0.0" in rows.value
    assert np.frombuffer(board.scan, "<f4").tolist() == [1, 0]
    rows.value = "0 0 1 1\n"
    assert board.world["walls"] == [[0, 0, 1, 1]] == editor.world.walls.tolist()
    for _ in range(2):
        undo.click()
    assert board.world["walls"] == [[0, 0, 3, 0], [3, 0, 3, 2]]
    assert rows.value == editor.text


def test_an_error_in_the_rows_is_shown_until_it_is_corrected(shown):
    _, board, rows, _, reported = shown(parse(ROWS))
    before = board.world
    rows.value = "0 0 <b>\n"
    assert "world:1:" in reported.value and "<b>" not in reported.value
    assert board.world == before
    rows.value = "0 0 2 2\n"
    assert reported.value == "" and board.world["walls"] == [[0, 0, 2, 2]]


@pytest.mark.parametrize("sent", [{}, {"walls": [], "circles": []}, {"walls": 1, "circles": {}}])
def test_an_invalid_message_of_the_browser_restores_the_world(shown, sent):
    editor, board, *_ = shown(parse(ROWS))
    before = board.world
    board.set_state({"world": sent})
    assert board.world == before
    assert len(editor.world.walls) == 2


def test_a_scan_that_fails_is_reported_in_one_line(shown):
    def scan(world):
        return world.walls[2]

    with pytest.raises(IndexError):  # the first one as any other mistake
        shown(parse(ROWS), scan=scan)
    _, _, rows, _, reported = shown(parse(ROWS), scan=lambda world: world.walls[1, :2])
    rows.value = "0 0 1 1\n"
    assert "IndexError" in reported.value


@pytest.mark.slow
def test_without_anywidget_the_numbers_stay(shown, monkeypatch):
    monkeypatch.setitem(sys.modules, "slamlab.live.editor.world_canvas", None)
    editor = edit_world(parse(ROWS), ALT)
    assert "<img" in shown.stills[-1]["text/html"] and len(editor.world.walls) == 2
