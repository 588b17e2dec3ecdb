"""Page of a film, opened as a file: played, scrubbed, by keys; on a phone, dark, damaged."""

import base64

import numpy as np
import pytest

from slamlab.live import films
from slamlab.views.colours import COLOURS, contrast
from tests.course.browser.watching import SERIOUS, faults, fits
from tests.slamlab.films.scenes import damaged, record, scenes
from tests.timeouts import PATIENCE, until

pytestmark = pytest.mark.slow

# presses play; frames that are drawn from then on, until the film no longer plays
PLAYED = """(root) => new Promise((done) => {
    const seen = [], button = root.querySelector("button");
    button.click();
    const look = () => {
        seen.push(Number(root.dataset.frame));
        if (button.textContent.includes("pause")) requestAnimationFrame(look);
        else requestAnimationFrame(() => done([...seen, Number(root.dataset.frame)]));
    };
    look();
})"""
# all rows of each frame, as the browser decodes them
DECODED = """async () => {
    const film = await Film.read(filmOfPage());
    return film.frames.map((_, frame) => {
        film.seek(frame);
        return film.layers.list.map(({ kind, name, rows }) => [kind, name, [...rows].map(String)]);
    });
}"""


class FilmPage:
    """A film's page, opened from a file.

    Parameters
    ----------
    browser : Browser of Playwright
    path : Path, of the page
    more : what a context of Playwright takes, such as reduced_motion
    """

    def __init__(self, browser, path, **more):
        self.context = browser.new_context(**({"viewport": {"width": 1000, "height": 900}} | more))
        self.page = self.context.new_page()
        self.page.set_default_timeout(1000 * PATIENCE)
        self.errors, self.asked = [], []
        self.page.on("console", lambda message: self.errors.append(message.text))
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.address = path.resolve().as_uri()
        self.page.goto(self.address)
        self.root = self.page.locator(".slamlab-live")
        self.canvas = self.root.locator("canvas")
        self.button = self.root.get_by_role("button").first
        self.scrubber = self.root.get_by_role("slider", name="frame")

    def at(self, frame):
        """Wait until a frame is drawn; its picture, as text."""
        self.until("frame === arg", frame)
        return self.canvas.evaluate("canvas => canvas.toDataURL()")

    def until(self, condition, arg=None):
        """Wait until a condition on the canvas, the frame and an argument holds, in JavaScript."""
        self.page.wait_for_function(
            f"([canvas, root, arg]) => {{ const frame = Number(root.dataset.frame);"
            f" return {condition}; }}",
            arg=[self.canvas.element_handle(), self.root.element_handle(), arg],
        )

    def scrub(self, frame):
        """Move the scrubber to a frame; its picture."""
        self.scrubber.evaluate(
            "(one, frame) => { one.value = frame; one.dispatchEvent(new Event('input')); }", frame
        )
        return self.at(frame)

    def close(self):
        """Close the page; nothing went wrong on it, and it asked for nothing but itself."""
        assert self.errors == []
        assert self.asked == [self.address]
        self.context.close()


@pytest.fixture
def opened(browser):
    """Opens pages of films that stand still at first."""
    pages = []

    def open_page(path, **more):
        pages.append(FilmPage(browser, path, **({"reduced_motion": "reduce"} | more)))
        return pages[-1]

    yield open_page
    for page in pages:
        page.close()


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The page of a film with every kind of layer, 30 frames."""
    path = record(tmp_path_factory.mktemp("films") / "run.film", scenes())
    page = path.with_name("run.html")
    page.write_text(films.page(path), encoding="utf-8")
    return page


def test_what_the_browser_decodes_is_what_python_reads(opened, made):
    page = opened(made)
    decoded = page.page.evaluate(DECODED)
    film = films.load(made.with_name("run.film"))
    assert len(decoded) == len(film) == 30
    for found, (_, shown) in zip(decoded, film, strict=True):
        assert [each[:2] for each in found] == [[layer.kind, layer.name] for layer in shown]
        for (_, _, numbers), layer in zip(found, shown, strict=True):
            rows = np.array(numbers, dtype=float).reshape(layer.rows.shape)
            assert np.array_equal(rows.astype("f4"), layer.rows.astype("f4"), equal_nan=True)


def test_played_is_scrubbed_pixel_for_pixel(opened, made):
    page, fresh = opened(made), opened(made)
    page.scrub(0)
    stepped = {0: page.at(0)}
    for frame in range(1, 30):  # on, frame by frame, as playing does
        page.page.keyboard.press("ArrowRight")
        stepped[frame] = page.at(frame)
    assert len(set(stepped.values())) == 30
    for frame in (29, 3, 17, 16, 0, 28):  # to and fro
        assert fresh.scrub(frame) == stepped[frame], frame
    # and played in its own time, stopped somewhere
    page.scrub(5)
    page.button.click()
    page.until("frame > 8")
    page.button.click()
    frame, before = int(page.root.get_attribute("data-frame")), None
    while frame != before:  # a frame that was asked for before the stop may still be drawn
        page.page.wait_for_timeout(200)
        frame, before = int(page.root.get_attribute("data-frame")), frame
    assert page.at(frame) == stepped[frame]


def test_it_plays_to_its_end_and_again_from_the_start(opened, made):
    page = opened(made)
    page.root.get_by_role("combobox", name="speed").select_option("5")
    for _ in range(2):
        seen = page.root.evaluate(PLAYED)
        while seen[0] == 29 and len(seen) > 1:
            seen.pop(0)  # still there from the time before
        assert seen[-1] == 29
        assert seen == sorted(seen)
        assert page.button.text_content() == "▶ play"


def test_it_begins_by_itself_unless_the_reader_asked_for_reduced_motion(opened, made):
    still = opened(made)
    still.at(29)
    still.page.wait_for_timeout(500)
    assert still.button.text_content() == "▶ play"
    assert still.at(29)
    moving = opened(made, reduced_motion="no-preference")
    moving.until("frame < 29")
    assert moving.button.text_content() == "❚❚ pause"


def test_keys_play_step_and_jump(opened, made):
    page = opened(made)
    press = page.page.keyboard.press
    page.at(29)
    press("Home")
    page.at(0)
    press("ArrowLeft")
    press("ArrowRight")
    press("ArrowRight")
    page.at(2)
    press("End")
    page.at(29)
    press("Home")
    press("Space")
    page.until("frame > 2")
    press("Space")
    assert page.button.text_content() == "▶ play"
    # on the scrubber, too, which takes arrows by itself; on a button space presses it
    page.scrub(10)
    page.scrubber.focus()
    press("ArrowRight")
    page.at(11)
    press("Home")
    page.at(0)
    page.root.get_by_role("button", name="fit").focus()
    press("Space")
    assert page.button.text_content() == "▶ play"
    page.button.focus()
    press("Space")
    assert page.button.text_content() == "❚❚ pause"


def test_what_has_the_focus_is_ringed_and_everything_has_a_name(opened, made):
    page = opened(made)
    names, rings = [], []
    page.page.locator("body").click(position={"x": 1, "y": 1})  # the window has the focus
    for _ in range(5):
        page.page.keyboard.press("Tab")
        names.append(page.page.evaluate("document.activeElement.tagName"))
        rings.append(page.page.evaluate("getComputedStyle(document.activeElement).outlineStyle"))
    assert names == ["CANVAS", "BUTTON", "INPUT", "SELECT", "BUTTON"]
    assert rings == ["solid"] * 5
    assert page.canvas.get_attribute("aria-label") == "A robot drives round."
    page.scrub(4)
    assert page.scrubber.get_attribute("aria-valuetext").startswith("step 5 ")


@pytest.mark.parametrize("look", ["light", "dark", "phone"])
def test_nothing_on_the_page_keeps_anybody_out(opened, made, look):
    phone = {"viewport": {"width": 390, "height": 800}, "has_touch": True, "is_mobile": True}
    more = {"light": {}, "dark": {"color_scheme": "dark"}, "phone": phone}[look]
    page = opened(made, **more)
    page.at(29)
    assert faults(page.page, impacts=SERIOUS) == []
    assert fits(page.page)
    # the picture's paper is the page's own
    data = "canvas => [...canvas.getContext('2d').getImageData(1, 1, 1, 1).data]"
    ground = page.page.evaluate("getComputedStyle(document.body).backgroundColor")
    paper = page.canvas.evaluate(data)
    assert ground == f"rgb({paper[0]}, {paper[1]}, {paper[2]})"


def test_in_the_dark_every_colour_of_the_course_is_distinguished_from_the_paper(opened, made):
    page = opened(made)
    colours = sorted(set(COLOURS.values()))
    on = "([colours, paper]) => colours.map((one) => legible(one, paper ?? DARK.paper))"
    shown = page.page.evaluate(on, [colours, None])
    assert min(contrast(colour, "#17191c") for colour in shown) >= 4.5
    assert page.page.evaluate(on, [colours, "#ffffff"]) == colours


def test_the_wheel_scrolls_the_page_until_the_picture_was_clicked(opened, made):
    page = opened(made, viewport={"width": 800, "height": 400})
    whole = page.at(29)
    page.canvas.hover()
    page.page.mouse.wheel(0, 100)
    page.page.wait_for_function("() => scrollY > 0")
    assert page.at(29) == whole
    page.canvas.click()
    page.page.mouse.wheel(0, -100)
    page.until("canvas.toDataURL() !== arg", whole)
    page.root.get_by_role("button", name="fit").click()
    page.until("canvas.toDataURL() === arg", whole)


@pytest.mark.parametrize("which", range(len(damaged(scenes()))))
def test_a_damaged_film_is_reported_in_the_page(opened, made, tmp_path, which):
    data, _, message = damaged(scenes())[which]
    text = made.read_text("utf-8")
    whole = base64.b64encode(made.with_name("run.film").read_bytes()).decode()
    assert whole in text
    path = tmp_path / "page.html"
    path.write_text(text.replace(whole, base64.b64encode(data).decode()), encoding="utf-8")
    page = opened(path)
    reported = page.page.get_by_role("alert")
    reported.wait_for()
    assert message in reported.text_content()
    assert page.root.count() == 0


def test_a_finger_scrolls_the_page_until_the_picture_was_tapped(opened, made):
    page = opened(made, viewport={"width": 390, "height": 400}, has_touch=True, is_mobile=True)
    whole, touch = page.at(29), page.context.new_cdp_session(page.page)

    def swipe():
        touch.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [at(300)]})
        for y in range(285, 150, -15):
            touch.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [at(y)]})
        touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})

    def at(y):
        return {"x": 200, "y": y}

    swipe()
    page.page.wait_for_function("() => scrollY > 0")
    assert page.at(29) == whole

    def tapped():
        """Whether a tap has led into the picture; one on a page that still scrolls halts it."""
        page.page.evaluate("scrollTo(0, 0)")
        page.page.touchscreen.tap(200, 200)
        return page.page.evaluate("document.activeElement.tagName") == "CANVAS"

    until(tapped)
    page.page.evaluate("scrollTo(0, 0)")  # the tap came while the page still moved
    swipe()
    page.until("canvas.toDataURL() !== arg", whole)
    assert page.page.evaluate("scrollY") == 0
