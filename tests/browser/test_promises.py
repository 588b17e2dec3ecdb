"""Nothing that a page promises is waited for in silence or for ever."""

import pytest

from tests.browser.promises import promised


@pytest.fixture
def page(browser):
    """An empty page."""
    page = browser.new_page()
    yield page
    page.close()


@pytest.mark.parametrize(
    "script", ["() => new Promise(() => {})", "() => false", "() => { for (;;); }"]
)
def test_what_never_comes_is_told(page, script):
    with pytest.raises(AssertionError, match="waited in vain for rain"):
        promised(page, "rain", script, patience=0.5)


def test_what_comes_is_given(page):
    assert promised(page, "a sum", "async ([a, b]) => [a + b]", [1, 2]) == [3]
    waits = "() => { window.asked = (window.asked ?? 0) + 1; return window.asked > 3 && 'seen'; }"
    assert promised(page, "the fourth time", waits) == "seen"


def test_what_goes_wrong_in_the_page_is_told(page):
    with pytest.raises(Exception, match="no such thing"):
        promised(page, "nothing", "async () => { throw new Error('no such thing'); }")
