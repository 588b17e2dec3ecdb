"""Promises of a page are awaited with a message and a timeout."""

import pytest

from tests.course.browser.promises import promised


@pytest.fixture
def page(browser):
    """An empty page."""
    page = browser.new_page()
    yield page
    page.close()


@pytest.mark.parametrize(
    "script", ["() => new Promise(() => {})", "() => false", "() => { for (;;); }"]
)
def test_a_page_promise_that_never_resolves_is_reported(page, script):
    with pytest.raises(AssertionError, match="waited in vain for rain"):
        promised(page, "rain", script, patience=0.5)


def test_a_resolved_value_is_returned(page):
    assert promised(page, "a sum", "async ([a, b]) => [a + b]", [1, 2]) == [3]
    waits = "() => { window.asked = (window.asked ?? 0) + 1; return window.asked > 3 && 'seen'; }"
    assert promised(page, "the fourth time", waits) == "seen"


def test_what_goes_wrong_in_the_page_is_reported(page):
    with pytest.raises(Exception, match="no such thing"):
        promised(page, "nothing", "async () => { throw new Error('no such thing'); }")
