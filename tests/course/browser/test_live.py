"""Live view in JupyterLab: buttons, driving, playing; each frame is drawn and acknowledged."""

import pytest

from benchmarks.live import rows
from tests.course.browser.live import NAME, View

pytestmark = pytest.mark.slow

PLAIN_PICTURE = ".widget-html img"


@pytest.fixture
def views(visit):
    """Both views of the notebook, just run."""
    visit.open(NAME)
    visit.run_all()
    shown = View(visit.page, 1), View(visit.page, 2)
    for view in shown:
        view.root.wait_for()
        view.wait(1)  # frame 0 came with the widget
    yield shown
    assert visit.errors == []
    assert visit.foreign_requests == []
    assert [view.behind() for view in shown] == [1, 1], "more than one frame was on its way"


def changes(view, act):
    """Do something and wait for the picture; whether it is another one."""
    before, frame = view.picture(), view.frame()
    act()
    view.wait(frame + 1)
    return view.picture() != before


def test_a_robot_is_chosen_run_and_driven_and_a_recording_is_played(views, visit):
    driven, played = views
    assert changes(driven, lambda: driven.press("Simulation 2"))
    driven.press("▶ run")
    assert changes(driven, lambda: driven.press("▲ forward"))
    driven.wait(driven.frame() + 3)
    driven.press("❚❚ pause")
    for way in ["▲ forward"] * 5 + ["◀ left", "▼ back", "right ▶", "▲ forward", "▼ back"]:
        assert changes(driven, lambda way=way: driven.press(way)), way

    # the arrow keys drive when the picture was clicked, and do not move the notebook
    driven.canvas.click()
    assert changes(driven, lambda: visit.page.keyboard.press("ArrowUp"))
    assert driven.canvas.evaluate("canvas => document.activeElement === canvas")
    assert changes(driven, lambda: driven.press("reset"))
    assert driven.status().startswith("step 1 ")

    assert changes(played, lambda: played.press("step"))
    played.press("▶ run")
    played.wait(played.frame() + 10)
    played.press("❚❚ pause")
    played.rest()


def test_wheel_and_drag_move_the_picture_and_fit_shows_all_again(views, visit):
    view = views[1]
    whole = view.picture()
    view.canvas.click()
    visit.page.mouse.wheel(0, -300)
    view.until(lambda picture: picture != whole)
    near = view.picture()
    visit.page.mouse.down()
    visit.page.mouse.move(600, 300)
    visit.page.mouse.up()
    view.until(lambda picture: picture not in (whole, near))
    view.press("fit")
    view.until(lambda picture: picture == whole)


def test_the_wheel_over_a_picture_that_nobody_clicked_scrolls_the_notebook(views, visit):
    view = views[1]
    view.canvas.scroll_into_view_if_needed()
    whole, place = view.picture(), view.canvas.bounding_box()["y"]
    view.canvas.hover()
    visit.page.mouse.wheel(0, -120)
    visit.page.wait_for_function(
        "([canvas, y]) => canvas.getBoundingClientRect().y > y",
        arg=[view.canvas.element_handle(), place],
    )
    assert view.picture() == whole
    visit.page.keyboard.down("Control")
    visit.page.mouse.wheel(0, -120)
    visit.page.keyboard.up("Control")
    view.until(lambda picture: picture != whole)


def test_the_picture_takes_jupyterlabs_dark_colours_and_gives_them_back(views, visit):
    view = views[1]
    light = view.picture()
    for theme, ground in (("Dark", [17, 17, 17]), ("Light", [255, 255, 255])):
        visit.page.evaluate(
            "theme => jupyterapp.commands.execute('apputils:change-theme', { theme })",
            f"JupyterLab {theme}",
        )
        visit.page.wait_for_function(
            """([canvas, ground]) => {
                const { data } = canvas.getContext("2d").getImageData(1, 1, 1, 1);
                return ground.every((value, at) => data[at] == value);
            }""",
            arg=[view.canvas.element_handle(), ground],
        )
    view.until(lambda picture: picture == light)


def test_without_javascript_of_ours_a_picture_is_shown_and_steps_on(views, visit):
    cell = visit.page.locator(".jp-Cell").nth(3)
    before = cell.locator(PLAIN_PICTURE).get_attribute("src")
    assert cell.locator(PLAIN_PICTURE).get_attribute("alt") == "A room."
    cell.get_by_role("button", name="step", exact=True).click()
    cell.locator(f"{PLAIN_PICTURE}:not([src='{before}'])").wait_for()
    # text comes as a separate message
    cell.locator(".widget-html").filter(has_text="step 21 of").wait_for()


def test_a_cell_that_is_run_again_ends_its_loop_and_shows_a_new_one(views, visit):
    view = views[1]
    view.press("▶ run")
    view.wait(5)
    view.cell.locator(".cm-content").click()
    visit.page.keyboard.press("Shift+Enter")
    visit.page.wait_for_function(
        "cell => cell.querySelector('.slamlab-live')?.dataset.frame === '1'",
        arg=view.cell.element_handle(),
    )
    visit.page.wait_for_timeout(300)
    assert view.frame() == 1
    view.press("step")
    view.wait(2)


def test_the_benchmark_measures_clicks_and_pictures_and_no_frame_waits_for_another(visit):
    found = rows(visit, quick=True)
    assert {row["unit"] for row in found} == {"ms", "1/s", "1"}
    assert all(row["value"] > 0 and row["ratio"] > 0 for row in found)
    assert [row["value"] for row in found if row["unit"] == "1"] == [1, 1]
    assert visit.errors == []
    assert visit.foreign_requests == []
