"""The figure linter finds typed colours, typed numbers in alternative texts, per cent formats."""

import ast

import pytest

from course import large_numbers, percent_signs
from course.figure_lint import figure_problems
from course.source import ROOT


def problems(code):
    return [text for _, text in figure_problems(ast.parse(code))]


@pytest.mark.parametrize(
    "code",
    [
        'ax.plot(x, y, color="red")',
        'ax.plot(x, y, color="0.5")',
        "ax.plot(x, y, color=(1, 0, 0))",
        'ax.plot(x, y, "r--")',
        'ax.scatter(x, y, c="tab:blue")',
        'ax.add_patch(Wedge(p, r, fc="#D55E00"))',
        'color = f"C{k % 10}"',
        'styles = {"robot": "C0"}',
        'style = {"edgecolor": "white"}',
    ],
)
def test_a_typed_colour_is_found(code):
    (reported,) = problems(code)
    assert "is hard-coded" in reported


@pytest.mark.parametrize(
    "code",
    [
        'ax.plot(x, y, color=views.COLOURS["truth"])',
        'ax.plot(x, y, "--", label="b")',
        'ax.contour(x, y, z, cmap="viridis")',
        'print("redder than red")',
    ],
)
def test_a_colour_by_its_meaning_is_none(code):
    assert problems(code) == []


@pytest.mark.parametrize(
    "code",
    [
        'views.show(fig, "The error falls to 2 cm.")',
        'views.show(fig, alt=f"The error falls to 2 cm in {n} steps.")',
        'views.show(fig, alt="a text " "and 7 more")',
        'views.explore(draw, lambda step: f"Step {step} of 12.")',
        'live.watch(source, estimator, "After 60 steps.")',
    ],
)
def test_a_number_typed_into_an_alternative_text_is_found(code):
    ((line, reported),) = figure_problems(ast.parse(f"x = 1\n{code}"))
    assert line == 2 and "has the hard-coded number" in reported


@pytest.mark.parametrize(
    "code",
    [
        'views.show(fig, f"The error falls to {100 * error[-1]:.1f} cm.")',
        'views.show(fig, "Rooms of situation 1 and of situation-2.")',
        'views.explore(draw, lambda step: f"Step {step} of {len(film) - 1}.")',
        'views.axes("after 60 steps")',
        'print("2 cm")',
    ],
)
def test_a_number_from_the_data_or_a_name_is_none(code):
    assert problems(code) == []


@pytest.mark.parametrize(
    "code",
    [
        'print(f"{share:5.{digits}%}")',
        'print("{:.1%}".format(share))',
        'views.axes("the right 38%")',
        'print(f"{100 * share:.0f}% are inside")',
    ],
)
def test_per_cent_without_its_space_is_found_in_what_code_shows(code):
    ((line, reported),) = percent_signs.in_code(ast.parse(f"x = 1\n{code}"))
    assert line == 2 and "write a space before %" in reported


@pytest.mark.parametrize(
    "code",
    [
        'print(f"{100 * share:.0f} % are inside")',
        'layout = {"max_width": "100%"}',
        'style = "margin: 0; font-size: 95%"',
        "rest = n %2",
    ],
)
def test_per_cent_with_its_space_a_remainder_or_a_style_is_none(code):
    assert list(percent_signs.in_code(ast.parse(code))) == []


@pytest.mark.parametrize("room", ["slamlab", "course", "benchmarks"])
def test_no_program_shows_per_cent_or_a_large_number_in_another_form(room):
    makers = {  # the programs that produce the form; answers are written as students write
        percent_signs.in_code: ["percent_signs.py", "answers.py"],
        large_numbers.in_code: ["large_numbers.py", "notebook_output.py"],
    }
    found = []
    for file in sorted((ROOT / room).rglob("*.py")):
        tree = ast.parse(file.read_text("utf-8"))
        for lint, but in makers.items():
            if file.name not in but:
                found += [f"{file.relative_to(ROOT)}:{line}: {text}" for line, text in lint(tree)]
    assert found == []


@pytest.mark.parametrize(
    "code",
    [
        'print(f"{steps:,} steps")',
        'print(f"{cost:9_.0f}")',
        'print("40401 of them are understood")',
        'views.axes("1 000 samples")',
        'print("from 0 to 12345.6 m")',
    ],
)
def test_a_large_number_in_another_form_is_found_in_what_code_shows(code):
    ((line, reported),) = large_numbers.in_code(ast.parse(f"x = 1\n{code}"))
    assert line == 2 and "10 000" in reported


@pytest.mark.parametrize(
    "code",
    [
        "steps = 10_000",
        'print(f"{grouped(steps)} steps of 10 000, 1000 to 9999 samples in 2026")',
        'print(f"{share:6.2f} and 0.000175 rad, 1.234567, 1, 200 and 37 749 of 115 200")',
        'rest = "(last - first) % 36000 / n"',
        'print("see #100100EF, `256000`, https://a.b/12345 and [11002, 11013, 11024]")',
    ],
)
def test_a_large_number_in_its_form_a_small_one_or_code_is_none(code):
    assert list(large_numbers.in_code(ast.parse(code))) == []


@pytest.mark.parametrize("guide", [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))])
def test_no_guide_writes_a_large_number_in_another_form(guide):
    assert large_numbers.in_prose(guide.read_text("utf-8")) is None
