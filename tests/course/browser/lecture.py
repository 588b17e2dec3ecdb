"""A lesson shown as a lecture in the browser, and what a test can see of it."""

from tests.course.browser.promises import promised
from tests.timeouts import until

# what is shown of a slide: its place, whether it is cut off, its letters in pixels of the screen;
# a cell that lies on another counts as cut off
SEEN = """() => {
    const deck = document.querySelector(".slamlab-deck");
    const page = deck.querySelector(".jp-WindowedPanel-viewport");
    const { stop, stops, shrink } = deck.querySelector(".slamlab-layer").dataset;
    const zoom = Number(page.style.zoom);
    const isSeen = (one) => !one.closest(".slamlab-off, .slamlab-later")
        && one.getClientRects().length && getComputedStyle(one).visibility == "visible";
    const letters = (selector) => [...page.querySelectorAll(selector)]
        .filter((one) => isSeen(one) && one.textContent.trim())
        .map((one) => zoom * parseFloat(getComputedStyle(one).fontSize));
    const wide = [...page.querySelectorAll(
        ".jp-OutputArea-output, .jp-RenderedMarkdown, .cm-scroller")]
        .filter((one) => isSeen(one) && one.scrollWidth > one.clientWidth + 1);
    const box = page.getBoundingClientRect();
    const outside = [...page.querySelectorAll(".jp-Cell")].filter((one) => isSeen(one)
        && (one.getBoundingClientRect().bottom > Math.min(box.bottom, innerHeight) + 1
            || one.getBoundingClientRect().top < -1));
    const boxes = [...page.querySelectorAll(".jp-Cell")].filter(isSeen)
        .map((one) => one.getBoundingClientRect());
    const covered = boxes.some((a, k) => boxes.slice(k + 1).some((b) =>
        Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1
        && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1));
    const figures = [...page.querySelectorAll("img.slamlab-figure")].filter(isSeen);
    const scales = figures
        .map((one) => one.getBoundingClientRect().width / one.getAttribute("width"));
    const style = getComputedStyle(page);
    const margin = (side) => zoom * parseFloat(style[`padding${side}`]);
    const alone = page.querySelectorAll(".jp-Cell:not(.slamlab-off)").length == 1;
    const sizes = figures.map((one) => one.getBoundingClientRect());
    const share = Math.max(...sizes.map((one) => Math.max(
        one.width / (box.width - margin("Left") - margin("Right")),
        one.height / (box.height - margin("Top") - margin("Bottom")))));
    return {
        stop: Number(stop), stops: Number(stops), shrink: Number(shrink),
        cut: page.scrollHeight > page.clientHeight + 1 || covered
            || outside.length > 0 || wide.length > 0,
        letters: Math.min(...letters(
            ".jp-RenderedMarkdown p, .jp-RenderedMarkdown li, .jp-RenderedMarkdown td, .cm-line, "
            + ".jp-OutputArea-output pre, mjx-container, .widget-label, .slamlab-telling")),
        figure_letters: LETTERS_OF_A_FIGURE * Math.min(...scales),
        telling: [...page.querySelectorAll(".slamlab-telling")].filter(isSeen)
            .map((one) => one.textContent),
        figure: alone && figures.length == 1 ? share : 1,
        shown: [...page.querySelectorAll(".jp-Cell")].filter(isSeen)
            .map((one) => one.dataset.windowedListIndex).join()
            + "/" + page.querySelectorAll(".jp-Cell:not(.slamlab-off) .slamlab-later").length,
    };
}""".replace("LETTERS_OF_A_FIGURE", "12")  # 9 pt at the width a figure has in a notebook

LAID_OUT = """(width) => {
    const { style } = document.querySelector(".slamlab-deck .jp-WindowedPanel-viewport");
    return Math.abs(style.zoom * parseFloat(style.getPropertyValue("--slamlab-width")) - width) < 1;
}"""
PAINTED = "() => new Promise((done) => requestAnimationFrame(() => setTimeout(done, 0, true)))"
SEEN_PAINTED = f"async () => {{ await ({PAINTED})(); return ({SEEN})(); }}"


class Lecture:
    """The deck on a page of JupyterLab.

    Parameters
    ----------
    visit : Visit, with a notebook open
    """

    def __init__(self, visit):
        self.visit, self.page = visit, visit.page

    def start(self):
        """Start with the button, at the first slide."""
        self.page.locator(".slamlab-lecture-start:visible").click()
        self.page.wait_for_selector(".slamlab-deck .slamlab-bar")
        self.press("Home")

    def resize(self, width, height):
        """Give the window another size and wait until the slide is laid out for it."""
        self.page.set_viewport_size({"width": width, "height": height})
        self.page.wait_for_function(LAID_OUT, arg=width)

    def press(self, key):
        """Press a key and wait until what it does is painted."""
        self.see(key, PAINTED)

    def see(self, key, script=SEEN_PAINTED):
        """Press a key and wait until what it does is painted; what is seen then."""
        self.page.keyboard.press(key)
        return promised(self.page, f"the picture after {key}", script)

    @property
    def seen(self):
        """dict : stop, stops, shrink, cut, letters, figure_letters, telling, figure, shown."""
        return self.page.evaluate(SEEN)

    @property
    def runs(self):
        """bool, whether the deck is there."""
        return self.page.locator(".slamlab-deck").count() > 0

    def end(self):
        """Press Escape until the deck is gone; a class and a tool need one of their own."""
        until(lambda: not self.runs or self.press("Escape"))

    def end_and_restore(self):
        """Leave the deck, and leave the lesson as it was before; answers that were shown fold."""
        self.end()
        restore = self.page.get_by_role("button", name="Restore it")
        if restore.count():
            restore.click()

    def go_on_to(self, what, is_seen):
        """Go on from where it is until something is seen."""
        assert any(is_seen() for _ in self.walk()), f"no slide shows {what}"

    @property
    def number(self):
        """str, the number of the slide, of how many."""
        return self.page.locator(".slamlab-number").text_content()

    def walk(self):
        """Go on by PageDown from where it is to the last stop.

        Yields
        ------
        dict, what is seen at each stop
        """
        before, seen = None, self.seen
        while seen["stop"] != before:
            yield seen
            before, seen = seen["stop"], self.see("PageDown")
