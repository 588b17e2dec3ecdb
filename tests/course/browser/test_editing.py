"""World editor in JupyterLab: dragging, keys, typing, undo; rows and drawing stay consistent."""

import pytest

from tests.course.browser.editing import NAME, Editor

pytestmark = pytest.mark.slow


@pytest.fixture
def editor(visit):
    """The editor of the notebook, just run."""
    visit.open(NAME)
    visit.run_all()
    shown = Editor(visit)
    shown.handle("centre of circle 1").wait_for()
    visit.page.get_by_text("| Idle").wait_for()
    yield shown
    assert visit.errors == []
    assert visit.foreign_requests == []


def drag(editor, name, dx, dy, keys=()):
    """Drag a point by pixels."""
    mouse, keyboard = editor.page.mouse, editor.page.keyboard
    x, y = editor.at(name)
    mouse.move(x, y)
    mouse.down()
    for key in keys:
        keyboard.down(key)
    mouse.move(x + dx, y + dy, steps=5)
    mouse.up()
    for key in keys:
        keyboard.up(key)


def multiple(values, step):
    return all(abs(value / step - round(value / step)) < 1e-6 for value in values)


def test_a_corner_that_is_dragged_moves_both_walls_in_python_and_undo_moves_them_back(editor):
    before, picture = editor.kernel(), editor.picture()
    drag(editor, "corner of walls 2, 3", -61, 43)
    editor.until("2.0 -1.0 2.0 1.0\n", there=False)
    walls, circles = editor.kernel()
    x, y = walls[1][2:]
    assert walls[2][:2] == [x, y]
    assert 0.5 < x < 2 and 0 < y < 1 and multiple([x, y], 0.05)
    assert [walls[0], walls[3], circles] == [before[0][0], before[0][3], before[1]]
    editor.until(f"\n-2.0 -1.0 2.0 -1.0\n2.0 -1.0 {x!r} {y!r}\n{x!r} {y!r} -2.0 1.0\n")
    assert editor.picture() != picture
    editor.press("↶ undo")
    editor.until("2.0 -1.0 2.0 1.0\n")
    assert editor.kernel() == before
    editor.until_drawn(picture)


def test_a_point_that_was_dragged_is_moved_on_by_keys_that_the_notebook_would_take(editor):
    drag(editor, "corner of walls 2, 3", -61, 43)
    editor.until("2.0 -1.0 2.0 1.0\n", there=False)
    walls, _ = editor.kernel()
    x, y = walls[1][2:]
    drag(editor, "corner of walls 2, 3", 0, 0)
    editor.page.keyboard.press("ArrowDown")
    editor.until(f"2.0 -1.0 {x!r} {round(y - 0.05, 6)!r}\n")
    editor.page.keyboard.press("Control+z")
    editor.until(f"2.0 -1.0 {x!r} {y!r}\n")


def test_with_shift_a_point_is_put_between_the_lines_of_the_grid(editor):
    drag(editor, "centre of circle 1", -14, 9, keys=["Shift"])
    editor.until("1.0 0.5 0.2", there=False)
    _, ((x, y, radius),) = editor.kernel()
    assert radius == 0.2 and multiple([x, y], 0.01) and not multiple([x, y], 0.05)


def test_a_finger_drags_as_a_mouse_does(editor):
    x, y = editor.at("centre of circle 1")
    session = editor.page.context.new_cdp_session(editor.page)

    def touch(kind, *at):
        points = [{"x": at[0], "y": at[1]}] if at else []
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    touch("touchStart", x, y)
    for share in (0.3, 0.6, 1):
        touch("touchMove", x - 90 * share, y)
    touch("touchEnd")
    moved = "(area) => /(^|\\n)(-|0\\.[0-4])\\S* 0\\.5 0\\.2/.test(area.value)"
    editor.page.wait_for_function(moved, arg=editor.rows.element_handle())
    _, ((x, y, _),) = editor.kernel()
    assert x < 0.5 and y == 0.5


def test_without_a_mouse_a_point_is_chosen_by_tab_and_moved_by_the_arrow_keys(editor):
    keyboard = editor.page.keyboard
    editor.handle("corner of walls 3, 4").focus()
    keyboard.press("Tab")
    for key in ["ArrowLeft"] * 3 + ["Shift+ArrowUp"]:
        keyboard.press(key)
    editor.until("0.85 0.51 0.2")
    message = editor.cell.get_by_role("status").text_content()
    assert message == "centre of circle 1: x 0.85, y 0.51 m"
    keyboard.press("Control+z")
    editor.until("\n1.0 0.5 0.2")
    # a wall is never without length: the end stops before the other one
    editor.handle("corner of walls 1, 2").focus()
    for _ in range(45):
        keyboard.press("ArrowUp")
    walls, _ = editor.kernel()
    assert walls[1][:2] != walls[1][2:]


def test_a_number_that_is_changed_moves_the_drawing_and_a_mistake_is_reported(editor):
    editor.rows.fill("-2 -1 2 -1\n1 1 1.5 1.5\n0 0.5 0.1\n")
    editor.rows.blur()
    editor.handle("end of wall 2: x 1.5").wait_for()
    assert editor.cell.locator(".slamlab-handle").count() == 5
    editor.rows.fill("-2 -1 2 -1\n1 1 1\n0 0 one\n")
    editor.rows.blur()
    editor.cell.get_by_text("Not drawn: world:3: 'one' is not a number").wait_for()
    assert editor.cell.locator(".slamlab-handle").count() == 5
    drag(editor, "end of wall 2: x 1.5", 40, -40)
    editor.cell.get_by_text("Not drawn").wait_for(state="detached")
