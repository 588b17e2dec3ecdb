"""Legend entries of the player, also for old films."""

from slamlab.live.player.script_bundle import DRAWING, script

LEGEND_ENTRIES = """([names, kind]) => {
    const camera = new Camera(700, 400), g = { measureText: () => ({ width: 50 }) };
    const list = names.map((name) => ({ name, colour: "#000000", kind }));
    return legend(g, camera, list).map(({ label }) => label);
}"""


def test_a_layers_name_is_shown_as_in_figures(browser):
    page = browser.new_page()
    page.add_script_tag(content=script(DRAWING))
    names = ["truth", "naive", "corrected", "constructor"]
    labels = page.evaluate(LEGEND_ENTRIES, [names, "poses"])
    of_ellipses = page.evaluate(LEGEND_ENTRIES, [["corrected", "walls"], "ellipses"])
    page.close()
    assert labels == ["truth", "odometry alone", "estimate", "constructor"]
    assert of_ellipses == ["estimate (95 % ellipse)", "walls"]
