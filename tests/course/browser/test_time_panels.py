"""The time axis of a live view's curves shows times for any number of values."""

import pytest

from slamlab.live.player.script_bundle import DRAWING, script

TEXTS = """(rows) => {
    const texts = [], camera = new Camera(700, 400);
    const g = new Proxy({}, {
        get: (_, name) => (...given) => name == "fillText" && texts.push(String(given[0])),
        set: () => true,
    });
    const curves = [{ rows: new Float32Array(rows.map((x) => x ?? NaN)), colour: "#000000" }];
    panel(g, camera, "error [m]", curves, 0, LIGHT);
    return texts;
}"""


@pytest.mark.parametrize(
    ("rows", "times"),
    [([], {"0 s", "1 s"}), ([0, None], {"0 s", "1 s"}), ([3, 0.5], {"3 s", "4 s"})],
    ids=["no value", "one that is no number", "one"],
)
def test_with_few_values_the_axis_shows_one_second(browser, rows, times):
    page = browser.new_page()
    page.add_script_tag(content=script(DRAWING))
    texts = page.evaluate(TEXTS, rows)
    page.close()
    assert times <= set(texts)
    assert not any("Infinity" in text or "NaN" in text for text in texts)
