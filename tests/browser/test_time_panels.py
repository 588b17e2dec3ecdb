"""The time axis of a live view's curves says a time, however few values there are."""

import pytest

from slamlab.views.player.library import DRAWING, script

TEXTS = """(rows) => {
    const said = [], camera = new Camera(700, 400);
    const g = new Proxy({}, {
        get: (_, name) => (...given) => name == "fillText" && said.push(String(given[0])),
        set: () => true,
    });
    const curves = [{ rows: new Float32Array(rows.map((x) => x ?? NaN)), colour: "#000000" }];
    panel(g, camera, "error [m]", curves, 0, LIGHT);
    return said;
}"""


@pytest.mark.parametrize(
    ("rows", "times"),
    [([], {"0 s", "1 s"}), ([0, None], {"0 s", "1 s"}), ([3, 0.5], {"3 s", "4 s"})],
    ids=["no value", "one that is no number", "one"],
)
def test_before_there_is_a_range_the_axis_says_a_second(browser, rows, times):
    page = browser.new_page()
    page.add_script_tag(content=script(DRAWING))
    said = page.evaluate(TEXTS, rows)
    page.close()
    assert times <= set(said)
    assert not any("Infinity" in text or "NaN" in text for text in said)
