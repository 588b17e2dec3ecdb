"""Pages of the site: notebooks, questions and formulas; and the checks of the site."""

import operator
import re
from functools import partial
from types import MappingProxyType

import ipywidgets
import nbformat
import numpy as np
import pytest

from course import literature
from course.site import rendering, site_checks
from course.site.moving_pictures import Renderer, values_of
from course.site.notebook_pages import page, without_links
from course.site.rendered_outputs import films_alone
from course.site.static_questions import question
from course.site.symbol_search import plain_forms, spelled
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


def test_a_page_has_one_heading_of_the_first_level_and_no_lecturers_notes():
    notes = text("Ask.", slideshow={"slide_type": "notes"})
    words = text("If you give the lecture", tags=["lecturer"])
    (part,) = shown(notes, words, text("# Part two\n\n## A section"))
    assert part.source == "## Part two\n\n## A section"


@pytest.mark.parametrize(
    "before, after",
    [
        ("[a](04_models_and_jacobians.ipynb)", "[a](../notebooks/04_models_and_jacobians.ipynb)"),
        ("[a](../exercises/ex04_m.ipynb#part)", "[a](../exercises/ex04_m.ipynb#part)"),
        ("[a](#Deeper:-why-so?)", "[a](#deeper-why-so)"),
        ("[a](../docs/lecturing.md)", "[a](../guides/lecturing.md)"),
        ("[In print](in_print.ipynb)", "[In print](../notebooks/in_print.ipynb)"),
        ("See lesson 04.", "See [lesson 04](../notebooks/04_models_and_jacobians.ipynb)."),
        ("See lesson 77.", "See lesson 77."),
        ("[lesson 04](x.ipynb)", "[lesson 04](x.ipynb)"),
    ],
)
def test_links_lead_to_pages(before, after):
    assert shown(text(before))[0].source == after


def test_where_only_lessons_are_pages_other_links_become_names():
    cell = text(
        "[a](../exercises/ex04_m.ipynb#p), [*b*](../guides/live.md), [c](../notebooks/n.ipynb)"
    )
    without_links(nbformat.v4.new_notebook(cells=[cell]))
    assert cell.source == "a, *b*, [c](../notebooks/n.ipynb)"


def test_a_question_unfolds_choice_by_choice_and_its_code_is_not_shown():
    choices = r'{"A < B": "no, *since*.", r"at $r < r_0$": "no.", "C": "yes."}'
    (cell,) = shown(code(f'ask("05-a", "Why?", {choices}, right="C")'))
    assert cell.cell_type == "markdown" and "ask(" not in cell.source
    assert cell.source.count("<details") == 3 and "A &lt; B" in cell.source
    assert "**✓ Right:** yes." in cell.source and "**✗ Wrong:** no, *since*." in cell.source
    assert "<summary>\n\nat $r < r_0$\n\n</summary>" in cell.source


def test_a_number_that_is_asked_for_stands_among_those_one_may_have():
    asked = 'ask("05-n", "How many?", right=-2, unit="m", reason="so", wrong={10: "no", -7: "no"})'
    assert list(question(asked).choices) == ["-7 m", "-2 m", "10 m"]
    assert question(asked).right == "-2 m"


def test_a_computed_question_shows_no_code_that_reveals_the_answer():
    (cell,) = shown(code('ask("05-n", "How many?", right=len(run))'))
    assert question(cell.source) is None and "remove-input" in cell.metadata.tags


def test_what_answers_a_question_is_folded_and_words_for_widgets_are_dropped():
    controls, picture = {"text/plain": "Run this cell for its controls."}, {"text/html": "<img>"}
    answers = {"answers": "05-a"}
    answering, other, folded, after = shown(
        *(code("draw()", controls, picture, slamlab=answers), code("1", picture)),
        *(text("**Across.**", slamlab=answers), text("Next.")),
    )
    assert "hide-cell" in answering.metadata.tags and "hide-cell" not in other.metadata.tags
    assert [output.data for output in other.outputs] == [picture]
    still, reported = (output.data for output in answering.outputs)
    assert still == picture and "in the notebook, the figure has controls" in reported["text/html"]
    assert folded.source.startswith("<details>") and "\n\n**Across.**\n\n" in folded.source
    assert after.source == "Next."


@pytest.mark.parametrize(
    "latex, plain",
    [
        (r"\psi", {"ψ"}),
        (r"\hat{x}_{k}", {"x_k"}),
        (r"\hat x_{k-1} + \bar p", {"x_k", "p"}),
        (r"H_{\mathrm r} P_{j\mathrm r}", {"H_r", "P_jr"}),
        (r"\Delta\theta + \Delta x_i", {"Δθ", "Δx_i"}),
        (r"P_{\theta\theta} J_{\mathrm{r}i}^\top", {"P_θθ", "J_ri"}),
        (r"P_{r,i} = \Lambda", {"P_ri", "Λ"}),
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
        r"<p>at $\psi$<pre>$\phi$</pre><table><th>a</th><th> </th></table>"
        '<aside class="x"></aside><aside></aside>'
    )
    (tmp_path / "b.html").write_text('<p id="there"><a href="a.html#here">a</a>')
    (tmp_path / "p.png").touch()
    found = site_checks.problems(tmp_path)
    wanted = ["contains 'For", r"not rendered: $\psi$", "another host", "#gone", "link c.html",
              "../out.html", "no alternative text", "empty header", "two sidebars"]  # fmt: skip
    assert len(found) == len(wanted)
    assert all(any(words in each for each in found) for words in wanted)


def test_a_slider_is_thinned_evenly_and_keeps_its_first_value():
    values, message = values_of(_control("a", (0, 100, 33)), 21)
    assert values[0] == 0 and values[-1] == 100 and 33 in values and len(values) <= 22
    assert message == [str(value) for value in values]
    assert np.diff(values).max() <= 5
    values, message = values_of(_control("a", (0.0, 1.0, 0.25)), 5)
    assert values == [0, 0.25, 0.5, 0.75, 1] and message[1] == "0.25"
    assert values_of(_control("a", ["x", "y"]), 21) == (["x", "y"], ["x", "y"])
    assert values_of(_control("a", True), 21) == ([False, True], ["no", "yes"])


PAIRS = [("one", 1), ("two", (2, 2)), ("three", "x")]
SELECTIONS = "Dropdown", "RadioButtons", "Select", "SelectionSlider", "ToggleButtons"


@pytest.mark.parametrize("name", SELECTIONS)
@pytest.mark.parametrize(
    "options, expected",
    [
        (PAIRS, PAIRS),
        (tuple(map(list, PAIRS)), PAIRS),
        (dict(PAIRS), PAIRS),
        (MappingProxyType(dict(PAIRS)), PAIRS),
        (dict(PAIRS).items(), PAIRS),
        ([7, "x", 0.5], [("7", 7), ("x", "x"), ("0.5", 0.5)]),
        (range(2), [("0", 0), ("1", 1)]),
        ({"x"}, [("x", "x")]),
        ([(1, 2, 3), True], [("(1, 2, 3)", (1, 2, 3)), ("True", True)]),
    ],
)
def test_the_values_of_a_choice_are_those_that_ipywidgets_offers(name, options, expected):
    widget = getattr(ipywidgets, name)(options=options)
    values, words = values_of(widget, 21)
    assert list(zip(words, values, strict=True)) == expected
    for widget.label, value in expected:  # as a reader chooses it
        assert widget.value == value


@pytest.mark.parametrize(
    "widget, expected",
    [
        (ipywidgets.ToggleButton(True), ([False, True], ["no", "yes"])),
        (ipywidgets.IntSlider(3, 1, 5, 2), ([1, 3, 5], ["1", "3", "5"])),
        (ipywidgets.FloatLogSlider(10, min=-1, max=1, step=1), ([0.1, 1, 10], ["0.1", "1", "10"])),
        (ipywidgets.SelectionSlider(options=range(9), value=4), ([0, 4, 8], ["0", "4", "8"])),
    ],
)
def test_a_widget_of_a_lesson_is_drawn_at_its_own_values(widget, expected):
    values, words = values_of(widget, 3)
    assert (values, [word.strip() for word in words]) == expected


@pytest.mark.parametrize("name", ["Text", "IntRangeSlider", "SelectMultiple", "BoundedIntText"])
def test_a_control_without_single_values_is_refused_by_its_name(name):
    options = {"options": ["a", "b"]} if name == "SelectMultiple" else {}
    with pytest.raises(ValueError, match=f"a {name} has no list of values"):
        values_of(getattr(ipywidgets, name)(**options), 21)


MOVING = """\
import ipywidgets, numpy as np
from functools import partial
from slamlab import estimators, live, sources, views
"""
DRAWN = """\
def draw(n, big):
    fig, ax = views.axes("a line")
    ax.plot([0, n], [0, 1 + big])
    return fig
views.explore(draw, lambda n, big: f"A line to {n}.", n=(1, 4, 2), big=False)"""
LIVED = """\
live.watch({"one": partial(sources.simulation, "polygon"), "by hand": partial(
    sources.simulation, "room", tour=False)}, partial(estimators.make, "odometry"), "Points.")"""


@pytest.mark.slow
def test_what_moves_is_rendered_once_and_stands_on_the_page(tmp_path):
    notebook = nbformat.v4.new_notebook(
        cells=[text("# 05 · T"), code(MOVING), code(DRAWN, {"text/html": "<img alt='A line'>"}),
               code(LIVED, {"text/html": "<img alt='Points'>"}), code("1 / 0")]
    )  # fmt: skip
    path = tmp_path / "05_t.ipynb"
    nbformat.write(notebook, path)
    reported, folder = rendering.rendered(path, tmp_path / "cache")
    moved, (film,) = (reported[notebook.cells[k].id] for k in (2, 3))
    n, big = moved[0]["controls"]
    assert n["words"] == ["1", "2", "3", "4"] and n["first"] == 1
    assert n["alts"][3].endswith("A line to 4.") and big["words"] == ["no", "yes"]
    assert n["pictures"][1] == big["pictures"][0]  # drawn once
    assert len(set(n["pictures"] + big["pictures"])) == 5 == len(list(folder.glob("*.webp")))
    assert (folder / film["film"]).read_text().startswith("slamlabFilm(")
    before = {file: file.stat().st_mtime_ns for file in folder.iterdir()}
    assert rendering.rendered(path, tmp_path / "cache") == (reported, folder)
    assert before == {file: file.stat().st_mtime_ns for file in folder.iterdir()}
    sliders, live = page(notebook, {}, reported, folder.name).cells[2:4]
    assert "slamlab-sliders" in sliders.outputs[0].data["text/html"]
    assert film["film"] in live.outputs[0].data["text/html"]
    assert "the view runs live" in live.outputs[-1].data["text/html"]
    assert not any("still picture" in output.data["text/html"] for output in sliders.outputs)
    assert list(films_alone(reported)) == [notebook.cells[3].id]
    for wrong, place in {"\n1 / 0": "line 6: 1 / 0", "\n1 +": r"line 6: 1 \+"}.items():
        cell = notebook.cells[2]
        cell.source = DRAWN + wrong
        nbformat.write(notebook, path)
        with pytest.raises(rendering.RenderingError, match=rf"code cell 2 \({cell.id}\), {place}"):
            rendering.rendered(path, tmp_path / "cache")


def test_lessons_go_on_with_a_film_as_with_a_live_view(tmp_path):
    asked = set()  # names after dots, of what ``live.watch`` and ``views.explore`` return
    for path in sources():
        written = path.read_text(encoding="utf-8")
        for name in re.findall(r"^(\w+) = (?:live\.watch|views\.explore)\(", written, re.MULTILINE):
            asked |= {*re.findall(rf"^[^#\n]*\b{name}\.([\w.]+)", written, re.MULTILINE)}
    assert "pair.estimator" in asked
    room = partial(simulation, "room", tour=False)
    filmed = Renderer(tmp_path).live(room, partial(estimators.make, "icp"), "A room.", steps=2)
    for names in asked:
        operator.attrgetter(names)(filmed)


def test_literature_is_gathered_of_all_lessons():
    lesson = nbformat.v4.new_notebook(
        cells=[text("# 05 · T"), text("## Literature\n\nA. B., [book](../x.ipynb)"),
               text("## What comes next\n\nMore.")]
    )  # fmt: skip
    read = literature.page([("05 · T", "notebooks/t.ipynb", lesson)])
    assert "[05 · T](notebooks/t.ipynb)" in read and "A. B., [book](x.ipynb)" in read
    assert "More" not in read
