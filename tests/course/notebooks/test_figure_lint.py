"""The figure linter finds typed colours, typed numbers in alternative texts, per cent formats."""

import ast

import pytest

from course import large_numbers, percent_signs
from course.figure_lint import figure_problems
from course.source import ROOT

LINTS = {  # what finds it, its message, code in which it is found, and code that is right
    "a typed colour": (
        figure_problems,
        "is hard-coded",
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
        [
            'ax.plot(x, y, color=views.COLOURS["truth"])',
            'ax.plot(x, y, "--", label="b")',
            'ax.contour(x, y, z, cmap="viridis")',
            'print("redder than red")',
        ],
    ),
    "a number typed into an alternative text": (
        figure_problems,
        "has the hard-coded number",
        [
            'views.show(fig, "The error falls to 2 cm.")',
            'views.show(fig, alt=f"The error falls to 2 cm in {n} steps.")',
            'views.show(fig, alt="a text " "and 7 more")',
            'views.explore(draw, lambda step: f"Step {step} of 12.")',
            'live.watch(source, estimator, "After 60 steps.")',
        ],
        [
            'views.show(fig, f"The error falls to {100 * error[-1]:.1f} cm.")',
            'views.show(fig, "Rooms of situation 1 and of situation-2.")',
            'views.explore(draw, lambda step: f"Step {step} of {len(film) - 1}.")',
            'views.axes("after 60 steps")',
            'print("2 cm")',
        ],
    ),
    "per cent": (
        percent_signs.in_code,
        "write a space before %",
        [
            'print(f"{share:5.{digits}%}")',
            'print("{:.1%}".format(share))',
            'views.axes("the right 38%")',
            'print(f"{100 * share:.0f}% are inside")',
        ],
        [
            'print(f"{100 * share:.0f} % are inside")',
            'layout = {"max_width": "100%"}',
            'style = "margin: 0; font-size: 95%"',
            "rest = n %2",
        ],
    ),
    "a large number": (
        large_numbers.in_code,
        "10 000",
        [
            'print(f"{steps:,} steps")',
            'print(f"{cost:9_.0f}")',
            'print("40401 of them are understood")',
            'views.axes("1 000 samples")',
            'print("from 0 to 12345.6 m")',
        ],
        [
            "steps = 10_000",
            'print(f"{grouped(steps)} steps of 10 000, 1000 to 9999 samples in 2026")',
            'print(f"{share:6.2f} and 0.000175 rad, 1.234567, 1, 200 and 37 749 of 115 200")',
            'rest = "(last - first) % 36000 / n"',
            'print("see #100100EF, `256000`, https://a.b/12345 and [11002, 11013, 11024]")',
        ],
    ),
}


def each(which):
    """A parameter for each of the codes in this column of the table."""
    return pytest.mark.parametrize(
        ("what", "code"), [(what, code) for what, row in LINTS.items() for code in row[which]]
    )


@each(2)
def test_a_wrong_form_is_found_with_its_line(what, code):
    lint, message, *_ = LINTS[what]
    ((line, reported),) = lint(ast.parse(f"x = 1\n{code}"))
    assert line == 2 and message in reported


@each(3)
def test_a_right_form_is_none(what, code):
    assert list(LINTS[what][0](ast.parse(code))) == []


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


@pytest.mark.parametrize("guide", [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))])
def test_no_guide_writes_a_large_number_in_another_form(guide):
    assert large_numbers.in_prose(guide.read_text("utf-8")) is None
