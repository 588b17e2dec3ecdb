"""What the player's legend says: of films that were recorded long ago, too."""

from slamlab.views.player.library import DRAWING, script

SAID = """(names) => {
    const camera = new Camera(700, 400), g = { measureText: () => ({ width: 50 }) };
    const list = names.map((name) => ({ name, colour: "#000000", kind: "poses" }));
    return legend(g, camera, list).map(({ said }) => said);
}"""


def test_a_layers_name_is_said_as_in_figures(browser):
    page = browser.new_page()
    page.add_script_tag(content=script(DRAWING))
    said = page.evaluate(SAID, ["truth", "naive", "corrected", "constructor"])
    page.close()
    assert said == ["truth", "odometry alone", "estimate", "constructor"]
