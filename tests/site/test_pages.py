"""What the site makes of a notebook, a question, a formula; what it finds wrong with itself."""

import operator
import re
from functools import partial

import nbformat
import numpy as np
import pytest

from course.site import gathered, looking, rendering
from course.site.moving_outputs import films_alone
from course.site.moving_pictures import Renderer, values_of
from course.site.pages_of_notebooks import page, without_links
from course.site.questions import question
from course.site.symbols import plain_forms, spelled
from course.source import sources
from slamlab import estimators
from slamlab.sources.simulated_robot import simulation
from slamlab.views.sliders import _control

FILES = {"04": "04_models_and_jacobians"}


def text(source, **metadata):
    return nbformat.v4.new_markdown_cell(source, metadata=metadata)


def code(source, *outputs, **metadata):
    shown = [nbformat.v4.new_output("display_data", data=data) for data in outputs]
    return nbformat.v4.new_code_cell(source, outputs=shown, metadata=metadata)


def shown(*cells):
    return page(nbformat.v4.new_notebook(cells=[text("# 05 · Title"), *cells]), FILES).cells[1:]


def test_lecturers_notes_are_no_part_of_a_page():
    notes = [
        text("Ask.", slideshow={"slide_type": "notes"}),
        text("If you give the lecture", tags=["lecturer"]),
    ]
    assert shown(*notes) == []


def test_a_page_has_one_heading_of_the_first_level():
    assert shown(text("# Part two\n\n## A section"))[0].source == "## Part two\n\n## A section"


@pytest.mark.parametrize(
    "before, after",
    [
        ("[a](04_models_and_jacobians.ipynb)", "[a](../notebooks/04_models_and_jacobians.ipynb)"),
        ("[a](../exercises/ex04_m.ipynb#part)", "[a](../exercises/ex04_m.ipynb#part)"),
        ("[a](#Deeper:-why-so?)", "[a](#deeper-why-so)"),
        ("[a](../docs/lecturing.md)", "[a](../guides/lecturing.md)"),
        ("[In print](in_print.ipynb)", "[In print](../errata.md)"),
        ("See lesson 04.", "See [lesson 04](../notebooks/04_models_and_jacobians.ipynb)."),
        ("See lesson 77.", "See lesson 77."),
        ("[lesson 04](x.ipynb)", "[lesson 04](x.ipynb)"),
    ],
)
def test_links_lead_to_pages(before, after):
    assert shown(text(before))[0].source == after


def test_where_only_lessons_are_pages_other_links_become_names():
    cell = text(
        "[a](../exercises/ex04_m.ipynb#p), [*b*](../guides/live.md), [d](../errata.md), "
        "[c](../notebooks/n.ipynb)"
    )
    without_links(nbformat.v4.new_notebook(cells=[cell]))
    assert cell.source == "a, *b*, d, [c](../notebooks/n.ipynb)"


def test_a_question_unfolds_choice_by_choice_and_its_code_is_not_shown():
    asked = 'ask("05-a", "Why?", {"A < B": "no, *since*.", "C": "yes."}, right="C")'
    (cell,) = shown(code(asked))
    assert cell.cell_type == "markdown" and "ask(" not in cell.source
    assert cell.source.count("<details") == 2 and "A &lt; B" in cell.source
    assert "**✓ Right:** yes." in cell.source and "**✗ Not so:** no, *since*." in cell.source


def test_a_formula_in_a_choice_stays_a_formula():
    asked = r'ask("05-a", "Why?", {r"at $r < r_0$": "no.", "C": "yes."}, right="C")'
    assert "<summary>\n\nat $r < r_0$\n\n</summary>" in question(asked).as_cell("a").source


def test_a_number_that_is_asked_for_stands_among_those_one_may_have():
    asked = 'ask("05-n", "How many?", right=-2, unit="m", reason="so", wrong={10: "no", -7: "no"})'
    assert list(question(asked).choices) == ["-7 m", "-2 m", "10 m"]
    assert question(asked).right == "-2 m"


def test_a_question_that_is_computed_shows_no_code_that_tells_the_answer():
    (cell,) = shown(code('ask("05-n", "How many?", right=len(run))'))
    assert question(cell.source) is None and "remove-input" in cell.metadata.tags


def test_what_answers_a_question_is_folded_and_words_for_widgets_are_dropped():
    controls, picture = {"text/plain": "Run this cell for its controls."}, {"text/html": "<img>"}
    answering, other = shown(
        code("draw()", controls, picture, slamlab={"answers": "05-a"}), code("1", picture)
    )
    assert "hide-cell" in answering.metadata.tags and "hide-cell" not in other.metadata.tags
    assert [output.data for output in other.outputs] == [picture]
    still, told = (output.data for output in answering.outputs)
    assert still == picture and "in the notebook it has controls" in told["text/html"]


def test_text_that_explains_an_answer_is_folded_too():
    folded, other = shown(text("**Across.**", slamlab={"answers": "05-a"}), text("Next."))
    assert folded.source.startswith("<details>") and "\n\n**Across.**\n\n" in folded.source
    assert other.source == "Next."


@pytest.mark.parametrize(
    "latex, plain",
    [
        (r"\psi", {"ψ"}),
        (r"P_{\mathrm{ri}} = \Lambda", {"P_ri", "Λ"}),
        (r"\hat{x}_{k}", {"x_k"}),
        (r"\hat x_{k-1} + \bar p", {"x_k", "p"}),
        (r"H_{\mathrm r} P_{j\mathrm r}", {"H_r", "P_jr"}),
        (r"\Delta\theta + \Delta x_i", {"Δθ", "Δx_i"}),
        (r"P_{\theta\theta} J_{\mathrm{r}i}^\top", {"P_θθ", "J_ri"}),
        (r"P_{r,i}", {"P_ri"}),
        (r"\varepsilon + \lambda", {"ε", "λ"}),
    ],
)
def test_symbols_are_found_by_their_plain_form(latex, plain):
    assert plain <= plain_forms(latex)


def test_greek_letters_are_found_by_their_names():
    assert spelled({"σ_x", "Δθ", "λ", "x"}) == {"sigma", "delta", "theta", "lambda"}


def test_looking_finds_what_is_wrong_with_a_site(tmp_path):
    (tmp_path / "a.html").write_text(
        '<p id="here"><a href="b.html#there">b</a><a href="b.html#gone">b</a><a href="c.html">c</a>'
        '<a href="../out.html">o</a><a href="https://doi.org/1">d</a><img src="p.png">'
        '<script src="//cdn.example/x.js"></script>For the lecturer'
        r"<p>at $\psi$<pre>$\phi$</pre>"
    )
    (tmp_path / "b.html").write_text('<p id="there"><a href="a.html#here">a</a>')
    (tmp_path / "p.png").touch()
    found = looking.problems(tmp_path)
    wanted = [
        "says 'For",
        r"not set: $\psi$",
        "another machine",
        "#gone",
        "link c.html",
        "../out.html",
        "without a text",
    ]
    assert len(found) == len(wanted)
    assert all(any(words in each for each in found) for words in wanted)


def test_a_slider_is_thinned_evenly_and_keeps_its_first_value():
    values, said = values_of(_control("a", (0, 100, 33)), 21)
    assert values[0] == 0 and values[-1] == 100 and 33 in values and len(values) <= 22
    assert said == [str(value) for value in values]
    assert np.diff(values).max() <= 5
    values, said = values_of(_control("a", (0.0, 1.0, 0.25)), 5)
    assert values == [0, 0.25, 0.5, 0.75, 1] and said[1] == "0.25"
    assert values_of(_control("a", ["x", "y"]), 21) == (["x", "y"], ["x", "y"])
    assert values_of(_control("a", True), 21) == ([False, True], ["no", "yes"])


MOVING = """\
import ipywidgets, numpy as np
from functools import partial
from slamlab import estimators, sources, views
"""
DRAWN = """\
def draw(n, big):
    fig, ax = views.axes("a line")
    ax.plot([0, n], [0, 1 + big])
    return fig
views.explore(draw, lambda n, big: f"A line to {n}.", n=(1, 4, 2), big=False)"""
LIVED = """\
views.live({"one": partial(sources.simulation, "polygon"), "by hand": partial(
    sources.simulation, "room", tour=False)}, partial(estimators.make, "odometry"), "Points.")"""


@pytest.mark.slow
def test_what_moves_is_rendered_once_and_stands_on_the_page(tmp_path):
    notebook = nbformat.v4.new_notebook(
        cells=[text("# 05 · T"), code(MOVING), code(DRAWN, {"text/html": "<img alt='A line'>"}),
               code(LIVED, {"text/html": "<img alt='Points'>"}), code("1 / 0")]
    )  # fmt: skip
    path = tmp_path / "05_t.ipynb"
    nbformat.write(notebook, path)
    told, folder = rendering.rendered(path, tmp_path / "cache")
    (n, big), (film,) = told[notebook.cells[2].id][0]["controls"], told[notebook.cells[3].id]
    assert n["words"] == ["1", "2", "3", "4"] and n["first"] == 1
    assert n["alts"][3].endswith("A line to 4.") and big["words"] == ["no", "yes"]
    assert n["pictures"][1] == big["pictures"][0]  # drawn once
    assert len(set(n["pictures"] + big["pictures"])) == 5 == len(list(folder.glob("*.webp")))
    assert (folder / film["film"]).read_text().startswith("slamlabFilm(")
    before = {file: file.stat().st_mtime_ns for file in folder.iterdir()}
    assert rendering.rendered(path, tmp_path / "cache") == (told, folder)
    assert before == {file: file.stat().st_mtime_ns for file in folder.iterdir()}
    sliders, live = page(notebook, {}, told, folder.name).cells[2:4]
    assert "slamlab-sliders" in sliders.outputs[0].data["text/html"]
    assert film["film"] in live.outputs[0].data["text/html"]
    assert "it runs live" in live.outputs[-1].data["text/html"]
    assert not any("stands still" in output.data["text/html"] for output in sliders.outputs)
    assert list(films_alone(told)) == [notebook.cells[3].id]
    notebook.cells[2].source += "\n1 / 0"
    nbformat.write(notebook, path)
    with pytest.raises(rendering.RenderingError, match="ZeroDivisionError"):
        rendering.rendered(path, tmp_path / "cache")


def asked_of_what_moves():
    """What lessons ask of what ``views.live`` and ``views.explore`` return: names after dots."""
    for path in sources():
        written = path.read_text(encoding="utf-8")
        for name in re.findall(r"^(\w+) = views\.(?:live|explore)\(", written, re.MULTILINE):
            yield from re.findall(rf"^[^#\n]*\b{name}\.([\w.]+)", written, re.MULTILINE)


def test_lessons_go_on_with_a_film_as_with_a_live_view(tmp_path):
    asked = set(asked_of_what_moves())
    assert "pair.estimator" in asked
    room = partial(simulation, "room", tour=False)
    filmed = Renderer(tmp_path).live(room, partial(estimators.make, "icp"), "A room.", steps=2)
    for names in asked:
        operator.attrgetter(names)(filmed)


def test_errata_and_literature_are_gathered_of_all_lessons():
    table = "| place | printed |\n| --- | --- |\n| (1) | $a$ |"
    lesson = nbformat.v4.new_notebook(
        cells=[text("# 05 · T"), text("## In print\n\nOptional.\n\n" + table), code("1"),
               text("### By machine\n\nSo."), text("## Literature\n\nA. B., [book](../x.ipynb)"),
               text("## What comes next\n\nMore.")]
    )  # fmt: skip
    errata = gathered.page("errata", [("05 · T", "notebooks/t.ipynb", lesson)])
    assert table in errata and "[05 · T](notebooks/t.ipynb)" in errata and "Optional" not in errata
    read = gathered.page("literature", [("05 · T", "notebooks/t.ipynb", lesson)])
    assert "A. B., [book](x.ipynb)" in read and "More" not in read
