"""A derivation in JupyterLab: typeset, played line by line, or all lines shown."""

import nbformat
import pytest

from tests.course.browser.lecture import Lecture
from tests.course.browser.live import fresh
from tests.timeouts import until

pytestmark = pytest.mark.slow

NAME = "derivation.ipynb"
DERIVED = """\
import sympy as sp
from classroom.derivation import derive, differentiate, partials
x, theta = sp.symbols("x theta", real=True)
d = sp.symbols("d", positive=True)
f = sp.Matrix([x + d * sp.cos(theta), theta])
(
    derive("A", partials(f, [x, theta]))
    .step("by x", differentiate(x))
    .step("by θ", differentiate(theta))
    .step("a wrong sign", sp.Matrix([[1, d * sp.sin(theta)], [0, 1]]))
)"""
MARK = '.slamlab-derivation [style*="color"]'


@pytest.fixture
def derived(visit, lab_folder):
    """A page on which a derivation of four lines, the last one false, was just made."""
    nbformat.write(fresh(DERIVED), lab_folder / NAME)
    visit.open(NAME)
    visit.run(0)
    visit.page.locator(".slamlab-derivation mjx-container").nth(5).wait_for()
    visit.page.locator(".slamlab-playback").wait_for()
    return visit


def lines_seen(visit):
    """How many lines of the derivation can be seen."""
    return visit.page.locator(".slamlab-derivation > li").evaluate_all(
        "all => all.filter((one) => getComputedStyle(one).visibility == 'visible').length"
    )


def colour(visit):
    return visit.page.locator(MARK).first.evaluate("one => getComputedStyle(one).color")


def test_a_derivation_is_typeset_and_what_is_new_is_coloured_in_both_themes(derived):
    text = derived.page.locator(".slamlab-derivation").text_content()
    assert "$" not in text and "\\" not in text
    assert text.count("✓") == 2 and text.count("✗ line 4 does not follow") == 1
    assert colour(derived) == "rgb(0, 114, 178)"
    derived.page.evaluate("document.body.dataset.jpThemeLight = 'false'")
    assert colour(derived) == "rgb(86, 180, 233)"
    assert derived.errors == []
    assert derived.foreign_requests == []


def test_a_derivation_is_played_back_and_forth_by_mouse_and_keyboard(derived):
    def press(name, key=None):
        button = derived.page.get_by_role("button", name=name, exact=True)
        _ = button.press(key) if key else button.click()
        return lines_seen(derived)

    assert lines_seen(derived) == 4
    assert press("next line", "Enter") == 4, "there is no fifth line"
    assert press("one line back") == 3
    assert press("one line back", "Enter") == 2
    derived.page.get_by_text("line 2 of 4").wait_for()
    assert press("first line only") == 1
    assert press("one line back", " ") == 1, "the first line always stands"
    assert press("next line", " ") == 2
    assert press("all lines") == 4
    assert not derived.errors


def test_on_a_slide_a_derivation_run_again_stands_at_the_line_it_stood_at(derived):
    lecture = Lecture(derived)
    lecture.start()
    lecture.press("PageDown")
    lecture.press("PageDown")
    assert lines_seen(derived) == 3
    stop = lecture.seen["stop"]
    lecture.press("Control+Enter")
    derived.page.wait_for_function("() => !document.querySelector('.slamlab-notice').textContent")
    until(lambda: (lecture.seen["stop"], lines_seen(derived)) == (stop, 3))


def test_a_derivation_keeps_nobody_out(derived):
    derived.look_through()
    assert derived.serious_faults() == []
