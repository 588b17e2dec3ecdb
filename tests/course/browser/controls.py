"""Controls on a slide, operated by pointer and by keys; the kernel confirms the values."""

from playwright.sync_api import TimeoutError

# no control was found yet; from now on, what the page sends the kernel: presses, values, and keys
# for a picture that is driven
LISTEN = """() => {
    document.querySelectorAll("[data-control]").forEach((one) => delete one.dataset.control);
    const { kernel } = window.jupyterapp.shell.currentWidget.sessionContext.session;
    window.slamlabHeard = [];
    kernel.anyMessage.connect((_, { msg, direction }) => {
        if (direction != "send" || msg.header.msg_type != "comm_msg") return;
        const { method, state, content } = msg.content.data;
        if (method == "custom" && content?.event == "click") window.slamlabHeard.push("click");
        else if (method == "custom" && content?.kind == "key") window.slamlabHeard.push("key");
        else if (method == "update" && ["value", "index", "world"].some((one) => one in state)) {
            window.slamlabHeard.push("value");
        }
    });
}"""

# of each kind of control: what of it takes the pointer and the keys
KINDS = {
    "slider": ".widget-slider .noUi-handle",
    "point": ".slamlab-handle",
    "tick": "input[type=checkbox]",
    "choice": "select",
    "number": "input[type=number]",
    "line": "input[type=text]",
    "picture": "canvas[tabindex]",
    "look": ".slamlab-live button",  # at the picture: nothing that the kernel hears of
    "button": ".jupyter-button",
}

# the share of its track at which a handle stands, both measured at once
SHARE = """(handle) => {
    const track = handle.closest(".noUi-target").getBoundingClientRect();
    const at = handle.getBoundingClientRect();
    return (at.x + at.width / 2 - track.x) / track.width;
}"""
# one of few steps goes to the next
STANDS = f"([handle, share]) => Math.abs(({SHARE})(handle) - share) <= 0.26"

# the controls that can be seen now and had no number yet: marked with one each
FIND = """(kinds) => {
    const found = [];
    const cells = ".slamlab-deck .jp-Cell:not(.slamlab-off) .jp-OutputArea-output";
    for (const [kind, selector] of Object.entries(kinds)) {
        const all = cells + " :is(" + selector + ")";
        for (const one of document.querySelectorAll(all)) {
            if (!one.getClientRects().length || one.disabled || one.dataset.control) continue;
            if (getComputedStyle(one).visibility != "visible") continue;
            one.dataset.control = window.slamlabControls = (window.slamlabControls ?? 0) + 1;
            found.push([kind, one.dataset.control]);
        }
    }
    return found;
}"""
COUNT_CLICKS = """(one) => {
    one.dataset.clicks = 0;
    one.onclick = () => { one.dataset.clicks++; };
}"""
NAMED = """(one) => one.getAttribute("aria-label") || one.textContent || one.placeholder
    || one.closest(".jupyter-widgets")?.textContent || one.tagName"""


class Controls:
    """The controls of a lecture that has begun.

    Parameters
    ----------
    lecture : Lecture
    """

    def __init__(self, lecture):
        self.lecture, self.page = lecture, lecture.page
        self.page.evaluate(LISTEN)

    def unworked(self):
        """The visible controls that were not found before.

        Yields
        ------
        (str, Locator), kind and place
        """
        for kind, number in self.page.evaluate(FIND, KINDS):
            yield kind, self.page.locator(f"[data-control='{number}']")

    def work(self, kind, place):
        """Work a control by pointer and by keys; what did not come, as sentences.

        Returns
        -------
        list of str
        """
        if not place.is_visible():  # what was worked before has taken it away
            return []
        name = f"{kind} {place.evaluate(NAMED).strip()[:40]!r} on slide {self.lecture.number}"
        methods = {"by pointer": f"_point_{kind}", "by keys": f"_key_{kind}"}
        wrong = [
            f"{name} {method}" for method, does in methods.items() if not getattr(self, does)(place)
        ]
        self.page.evaluate("() => document.activeElement.blur()")  # its keys are its own
        return wrong

    def _changes(self, what, does):
        """Whether the kernel received a change made by an action, and has processed it."""
        self.page.evaluate("() => { window.slamlabHeard.length = 0; }")
        does()
        try:  # a value waits until the kernel is done with the one before
            self.page.wait_for_function("(what) => window.slamlabHeard.includes(what)", arg=what)
        except TimeoutError:
            return False
        self.lecture.visit.settle()
        return True

    def _middle(self, place):
        box = place.bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def _click(self, place):
        self.page.mouse.click(*self._middle(place))

    def _drag(self, place, x, y):
        self.page.mouse.move(*self._middle(place))
        self.page.mouse.down()
        self.page.mouse.move(x, y, steps=2)  # at each a figure may be drawn again

    def _press(self, place, *keys):
        place.focus()
        for key in keys:
            self.page.keyboard.press(key)

    def _point_slider(self, handle):
        track = handle.locator("xpath=ancestor::*[contains(@class, 'noUi-target')]")
        shares = (0.2, 0.8) if handle.evaluate(SHARE) > 0.5 else (0.8, 0.2)  # it has to move
        for share in shares:
            box = track.bounding_box()
            at = box["x"] + share * box["width"], box["y"] + box["height"] / 2

            def drag(at=at):
                self._drag(handle, *at)
                self.page.mouse.up()

            if not self._changes("value", drag) or not self._stands(handle, share):
                return False
        return True

    def _stands(self, handle, share):
        """Whether a slider's handle comes to stand at a share of its track."""
        try:  # the slide's layout may change meanwhile
            self.page.wait_for_function(STANDS, arg=[handle.element_handle(), share])
        except TimeoutError:
            return False
        return True

    def _key_slider(self, handle):
        before = handle.get_attribute("aria-valuetext")  # aria-valuenow is rounded
        changed = self._changes("value", lambda: self._press(handle, "ArrowLeft"))
        return changed and handle.get_attribute("aria-valuetext") != before

    def _point_point(self, handle):
        x, y = self._middle(handle)

        def drag():
            self._drag(handle, x + 30, y)
            self.page.wait_for_timeout(50)  # drawn with the next frame
            self.off = abs(self._middle(handle)[0] - x - 30)
            self.page.mouse.up()

        return self._changes("value", drag) and self.off < 6

    def _key_point(self, handle):
        return self._changes("value", lambda: self._press(handle, "ArrowLeft"))

    def _point_tick(self, box):
        return self._changes("value", lambda: self._click(box))

    def _key_tick(self, box):
        return self._changes("value", lambda: self._press(box, "Space"))

    def _point_choice(self, select):
        self._click(select)  # the list that opens is the browser's own
        self.page.keyboard.press("Escape")
        return select.evaluate("(one) => one === document.activeElement")

    def _key_choice(self, select):
        last = select.evaluate("(one) => one.selectedIndex == one.length - 1")
        key = "ArrowUp" if last else "ArrowDown"
        return self._changes("value", lambda: self._press(select, key))

    def _point_number(self, field):
        return self._typed(field, "7")

    def _key_number(self, field):
        return self._changes("value", lambda: self._press(field, "ArrowUp", "Enter"))

    def _point_line(self, field):
        return self._typed(field, "0, 10")

    def _key_line(self, field):
        return self._typed(field, "0, 20", by_pointer=False)

    def _typed(self, field, text, by_pointer=True):
        def type_it():
            self._click(field) if by_pointer else field.focus()
            self.page.keyboard.press("Control+a")
            self.page.keyboard.type(text)
            self.page.keyboard.press("Enter")

        return self._changes("value", type_it)

    def _point_picture(self, canvas):
        self._click(canvas)
        return canvas.evaluate("(one) => one === document.activeElement")

    def _key_picture(self, canvas):
        return self._changes("key", lambda: self._press(canvas, "ArrowUp"))

    def _point_look(self, button):
        return self._clicked(button, lambda: self._click(button))

    def _key_look(self, button):
        return self._clicked(button, lambda: self._press(button, "Space"))

    def _clicked(self, button, does):
        """Whether the page received exactly one click."""
        button.evaluate(COUNT_CLICKS)
        does()
        return button.get_attribute("data-clicks") == "1"

    def _point_button(self, button):
        return self._changes("click", lambda: self._click(button))

    def _key_button(self, button):
        return self._changes("click", lambda: self._press(button, "Space"))
