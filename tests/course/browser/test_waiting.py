"""Live view while the kernel is busy, and while a robot delays it."""

import pytest

from tests.course.browser.waiting import GO, NAME, Waiting

pytestmark = pytest.mark.slow


@pytest.fixture
def waiting(visit, lab_folder):
    """The notebook, all run but its last cell, which lasts."""
    (lab_folder / GO).unlink(missing_ok=True)
    visit.open(NAME)
    visit.run_all()
    yield Waiting(visit)
    (lab_folder / GO).touch()  # else the kernel would stay
    assert visit.errors == []
    assert visit.foreign_requests == []


def test_the_first_picture_is_there_while_a_later_cell_keeps_the_kernel_busy(waiting, lab_folder):
    for view, message in ((waiting.played, "step 20 of"), (waiting.silent, "no reading")):
        view.root.and_(waiting.visit.page.locator("[data-frame]")).wait_for()
        assert view.status().startswith(message)
    colours = waiting.played.canvas.evaluate(
        """canvas => {
            const { width, height } = canvas;
            const data = canvas.getContext("2d").getImageData(0, 0, width, height).data;
            return new Set(new Uint32Array(data.buffer)).size;
        }"""
    )
    assert colours > 20, "the picture is empty"
    # it came with the widget: the kernel does not know yet that there is a browser
    assert waiting.busy and waiting.played.frame() == 0
    (lab_folder / GO).touch()
    waiting.played.wait(1)
    waiting.played.press("step")
    waiting.played.wait(2)


def test_a_robot_that_is_off_stops_nothing_and_leaves_no_thread_behind(waiting, lab_folder):
    (lab_folder / GO).touch()
    silent, page = waiting.silent, waiting.visit.page
    silent.root.wait_for()
    page.get_by_text("| Idle").wait_for()
    waiting.until_threads(1)
    for press, shown in (("▶ run", "❚❚ pause"), ("❚❚ pause", "▶ run"), ("step", "❚❚ pause")):
        silent.press(press)
        silent.cell.get_by_role("button", name=shown, exact=True).wait_for()
    # others go on meanwhile
    waiting.played.press("step")
    waiting.played.wait(2)
    silent.press("reset")
    waiting.until_threads(1)
    for _ in range(2):
        waiting.visit.run(2)
        waiting.until_threads(1)
    waiting.clear(2)
    waiting.until_threads(0)
