"""Ink on slides: it stays at its position, in its own file, and does not block the slide."""

import json

import pytest

from tests.course.browser.presenting import Lecture, draw
from tests.timeouts import until

pytestmark = pytest.mark.walk  # minutes of a browser's time

KEPT = ".slamlab-ink .slamlab-stroke:not(.slamlab-unseen)"
PLACE = """([mark, thing]) => {
    const [a, b] = [mark, thing].map((one) => document.querySelector(one).getBoundingClientRect());
    return [(a.left - b.left) / b.width, (a.top - b.top) / b.width, a.width / b.width];
}"""  # of a mark on a thing, in widths of the thing


@pytest.fixture
def lecture(visit, lab_folder, request):
    """A lecture whose second slide is shown, with its slider alive."""
    shown = Lecture(visit, lab_folder, f"inked_{request.node.name}")
    shown.begin(run=True)
    shown.press("PageDown", "PageDown")
    shown.page.locator("img.slamlab-figure").wait_for()
    yield shown
    assert visit.foreign_requests == []


def ink(lecture):
    return lecture.file.with_name(f"{lecture.file.stem}.ink.json")


def strokes(lecture):
    """The strokes in the file; none while there is no file, or it is being written."""
    try:
        return json.loads(ink(lecture).read_text("utf-8"))["strokes"]
    except (FileNotFoundError, json.JSONDecodeError):
        return []


def on(lecture, thing, *parts):
    """Points of a thing on the page, given by parts of its width and height."""
    box = lecture.page.locator(thing).first.bounding_box()
    return [(box["x"] + x * box["width"], box["y"] + y * box["height"]) for x, y in parts]


def count(lecture, number):
    lecture.page.wait_for_function(
        "([shown, number]) => document.querySelectorAll(shown).length === number",
        arg=[KEPT, number],
    )


def place(lecture):
    return lecture.page.evaluate(PLACE, [f"{KEPT} path", "img.slamlab-figure"])


def test_a_stroke_stays_on_its_figure_in_any_window_in_any_size_and_after_all_is_loaded_again(
    lecture,
):
    before = lecture.file.read_bytes()
    lecture.press("i")
    draw(lecture.page, *on(lecture, "img.slamlab-figure", (0.2, 0.3), (0.5, 0.8), (0.7, 0.4)))
    count(lecture, 1)
    first = place(lecture)
    assert first[:2] == pytest.approx([0.2, 0.15], abs=0.01)

    def stays():
        until(lambda: place(lecture) == pytest.approx(first, abs=0.003))

    for width, height in ((1920, 1080), (1024, 768), (1400, 600)):
        lecture.page.set_viewport_size({"width": width, "height": height})
        stays()
    lecture.press("i", "i", "i", "i", "-", "-")  # the tool is put down; all is made smaller
    stays()
    lecture.press("PageDown", "PageDown")
    count(lecture, 0)
    lecture.press("PageUp")
    count(lecture, 1)
    lecture.press("Escape")  # the deck ends
    lecture.page.locator(".slamlab-ink").wait_for(state="detached")
    until(lambda: len(strokes(lecture)) == 1)
    lecture.start()
    count(lecture, 1)
    lecture.press("Escape")
    lecture.page.reload()
    lecture.page.locator(".jp-NotebookPanel .jp-Cell").first.wait_for()
    lecture.start()
    lecture.press("Home", "PageDown", "PageDown")
    count(lecture, 1)
    stays()
    assert lecture.file.read_bytes() == before


def test_with_no_tool_in_use_a_slider_below_has_its_pointer(lecture):
    page = lecture.page
    turns = ".widget-slider .noUi-target"
    handle = page.locator(".widget-slider .noUi-handle")

    def value():
        return float(handle.get_attribute("aria-valuenow"))

    draw(page, *on(lecture, turns, (0.02, 0.5), (0.5, 0.5)))
    first = value()
    assert first > 0
    lecture.press("i")  # the slider has the focus
    draw(page, *on(lecture, turns, (0.5, 0.5), (0.9, 0.5)))
    count(lecture, 1)  # the pen wrote over it
    assert value() == first
    page.get_by_role("button", name="Stop drawing").click()
    draw(page, *on(lecture, turns, (0.5, 0.5), (0.9, 0.5)))
    assert value() > first
    page.locator(".widget-label", has_text=f"at {value():.0f}").wait_for()  # and Python knows
    count(lecture, 1)


def test_strokes_are_erased_as_a_whole_taken_back_and_cleared(lecture):
    page, figure = lecture.page, "img.slamlab-figure"
    lecture.press("i")
    draw(page, *on(lecture, figure, (0.1, 0.2), (0.9, 0.2)))
    page.get_by_role("button", name="Draw in red").click()
    page.get_by_role("button", name="Draw with the marker").click()
    draw(page, *on(lecture, figure, (0.1, 0.6), (0.9, 0.6)))
    count(lecture, 2)
    page.get_by_role("button", name="Draw with the eraser").click()
    draw(page, *on(lecture, figure, (0.5, 0.1), (0.5, 0.4)))  # across the first
    count(lecture, 1)
    until(lambda: [one["colour"] for one in strokes(lecture)] == ["red"])
    lecture.press("Control+z")
    count(lecture, 2)
    page.get_by_role("button", name="Clear this slide").click()
    count(lecture, 0)
    lecture.press("PageDown", "PageDown", "Control+z")  # of another slide nothing is taken back
    page.locator(".slamlab-notice", has_text="nothing to undo").wait_for()
    lecture.press("PageUp", "Control+z")
    count(lecture, 2)
    until(lambda: len(strokes(lecture)) == 2)


def test_the_laser_leaves_nothing_and_fades(lecture):
    lecture.press("i", "i", "i")
    page = lecture.page
    draw(page, *on(lecture, "img.slamlab-figure", (0.1, 0.2), (0.9, 0.2)))
    page.locator(".slamlab-laserdot[data-still=true]").wait_for(state="attached")
    count(lecture, 0)
    lecture.press("Escape")  # puts the laser down; the deck stays
    page.locator(".slamlab-inkbar").wait_for(state="detached")
    assert lecture.number == "2 / 5"


def test_a_pen_presses_and_the_palm_beside_it_does_not_write(lecture):
    page = lecture.page
    lecture.press("i")
    session = page.context.new_cdp_session(page)
    points = on(lecture, "img.slamlab-figure", *((0.1 + 0.05 * k, 0.5) for k in range(10)))

    def pen(kind, at, force):
        reported = {"type": kind, "x": at[0], "y": at[1], "force": force, "pointerType": "pen"}
        session.send("Input.dispatchMouseEvent", {**reported, "button": "left", "buttons": 1})

    pen("mousePressed", points[0], 0.2)
    for k, point in enumerate(points):
        pen("mouseMoved", point, 0.2 if k < 5 else 0.9)
    pen("mouseReleased", points[-1], 0)
    count(lecture, 1)
    widths = page.locator(f"{KEPT} path").evaluate_all(
        "paths => paths.map((path) => Number(path.getAttribute('stroke-width')))"
    )
    assert max(widths) > 3 * min(widths)

    palm = {"x": points[0][0], "y": points[0][1] + 40}
    session.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [palm]})
    palm["x"] += 30
    session.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [palm]})
    session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    draw(page, points[2], (points[2][0], points[2][1] + 60))
    count(lecture, 2)


def test_a_damaged_file_is_kept_aside_and_reported(visit, lab_folder):
    lecture = Lecture(visit, lab_folder, "inked_damaged")
    aside = [ink(lecture).with_suffix(f".{end}") for end in ("damaged.json", "damaged-2.json")]
    for content, kept in zip(
        (b'{"version": 1, "strokes": [{', b"\xff\xfe\x00"), aside, strict=True
    ):
        ink(lecture).write_bytes(content)
        lecture.begin()
        visit.page.locator(".slamlab-notice", has_text=kept.name).wait_for()
        assert kept.read_bytes() == content
        assert not ink(lecture).exists()
    lecture.press("i")
    draw(lecture.page, (400, 300), (500, 340))
    until(lambda: len(strokes(lecture)) == 1)


def test_a_server_killed_while_it_writes_loses_no_ink(lecture):
    kept, page = ink(lecture), lecture.page
    spare = kept.with_suffix(".spare.json")

    def torn(file, y):
        """Draw, while the server writes no more than a part of a file; then load all again."""

        def kill(route):
            if route.request.method != "PUT":
                return route.continue_()
            file.write_text('{"version": 1, "strokes": [{')
            return route.abort()

        page.route(f"**/api/contents/**/{file.name}*", kill)
        draw(page, *on(lecture, "img.slamlab-figure", (0.1, y), (0.9, y)))
        page.locator(".slamlab-notice", has_text="could not be saved").wait_for()
        page.reload()
        page.locator(".jp-NotebookPanel .jp-Cell").first.wait_for()
        page.unroute_all()
        lecture.start()
        lecture.press("Home", "PageDown", "PageDown", "i")

    lecture.press("i")
    draw(page, *on(lecture, "img.slamlab-figure", (0.1, 0.2), (0.9, 0.2)))
    until(lambda: len(strokes(lecture)) == 1)
    torn(spare, 0.5)
    count(lecture, 1)  # the file is whole
    torn(kept, 0.8)
    count(lecture, 2)  # the spare is, with what was drawn last
    until(lambda: len(strokes(lecture)) == 2)
    assert not list(kept.parent.glob(f"{kept.stem}.damaged*"))


def test_the_presenters_window_shows_it(lecture):
    presenter = lecture.presenter()
    lecture.press("i")
    draw(lecture.page, *on(lecture, "img.slamlab-figure", (0.2, 0.3), (0.5, 0.8)))
    presenter.frame_locator("#present iframe").locator(".slamlab-stroke").wait_for()
