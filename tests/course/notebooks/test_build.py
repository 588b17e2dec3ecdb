"""Builder of notebooks: solutions removed, outputs kept, violations refused."""

import re
import textwrap

import nbformat
import pytest

from classroom.exercises import catalogue, verdict_text
from course import build as tool
from course import source
from course.solution_cells import STUB, SolutionError, solution_regions, strip_solutions
from course.source import CourseError

HEAD = """\
# %% [markdown] slideshow={"slide_type": "slide"}
# # 90 · A lesson
# You will be able to add. 2 minutes. You need nothing before.

# %% [markdown]
# ## Two and two

"""
TAIL = """
# %% [markdown]
# Next: [the exercise](../exercises/ex90_sums.ipynb).
"""
ADD = """
# %% tags=["nbval-check-output"]
print(2 + 2)
"""


@pytest.fixture
def root(tmp_path):
    (tmp_path / "course" / "lessons").mkdir(parents=True)
    (tmp_path / "course" / "exercises").mkdir()
    return tmp_path


def write(root, text, head=HEAD, tail=TAIL, kind="lessons", name="90_sums"):
    path = root / "course" / kind / f"{name}.py"
    path.parent.mkdir(exist_ok=True)
    path.write_text(head + textwrap.dedent(text) + tail, encoding="utf-8")
    return path


def stored(root, name="90_sums"):
    return nbformat.read(root / "notebooks" / f"{name}.ipynb", as_version=4)


def refused(path, root):
    with pytest.raises(CourseError) as error:
        tool.derive(path, root)
    return str(error.value)


# -- solutions


def test_a_solution_becomes_a_stub_and_docstring_and_indent_stay():
    cell = '''\
def total(numbers):
    """Their sum."""
    s = 0
    for n in numbers:
        ### BEGIN SOLUTION
        s += n
        # done
        ### END SOLUTION
    return s'''
    assert strip_solutions(cell) == (
        'def total(numbers):\n    """Their sum."""\n    s = 0\n    for n in numbers:\n'
        f"        {STUB}\n    return s"
    )


@pytest.mark.parametrize(
    ("cell", "message"),
    [
        ("### BEGIN SOLUTION\nx = 1\n### END SOLUTION", "inside a function"),
        ("class C:\n    ### BEGIN SOLUTION\n    x = 1\n    ### END SOLUTION", "inside a function"),
        ("def f():\n    ### BEGIN SOLUTION\n    return 1", "without ### END"),
        ("def f():\n    return 1\n    ### END SOLUTION", "without ### BEGIN"),
        ("def f():\n    x = 1\n    ### BEGIN SOLUTION\n    ### END SOLUTION", "is empty"),
        (
            "def f():\n    ### BEGIN SOLUTION\n    for a in b:\n        c = a\n"
            "    ### END SOLUTION\n        d = a",
            "split a statement",
        ),
        ("def f():\n    # BEGIN SOLUTION\n    return 1", "write the marks exactly"),
    ],
)
def test_a_solution_that_is_marked_wrongly_is_refused(cell, message):
    with pytest.raises(SolutionError, match=message):
        solution_regions(cell)


# -- an exercise of the course, whichever it is


@pytest.fixture(scope="module")
def exercise():
    path = source.numbered("01", "exercises")
    unsolved, solved = tool.derive(path)
    return unsolved.notebook, solved.notebook


def test_exercise_and_solution_differ_in_solutions_and_checked_outputs_only(exercise):
    for unsolved, solved in zip(*(notebook.cells for notebook in exercise), strict=True):
        assert unsolved.id == solved.id
        if "BEGIN SOLUTION" in solved.source:
            assert unsolved.source == strip_solutions(solved.source)
            assert unsolved.metadata.nbgrader.solution
        else:
            assert unsolved.source == solved.source


def test_a_check_cannot_be_edited_away_and_a_solution_cannot_be_deleted(exercise):
    for cell in exercise[0].cells:
        mark = cell.metadata.get("nbgrader")
        if mark:
            assert cell.metadata.deletable is False
            assert cell.metadata.get("editable", True) is not mark.grade


@pytest.mark.parametrize("id", catalogue.EXERCISES)
def test_the_heading_of_a_task_states_what_it_is_worth_and_its_source_does_not(id):
    task_of = {task.id: task for task in catalogue.exercise(id).tasks}
    path = source.numbered(id, "exercises")
    assert not re.search(r"^# ## .* · [\d.]+ points?$", path.read_text("utf-8"), re.MULTILINE)
    for notebook in (derived.notebook for derived in tool.derive(path)):
        headings, messages = [], {}
        for cell in notebook.cells:
            if cell.cell_type == "markdown":
                headings += re.findall(r"^## .*", cell.source, re.MULTILINE)
            elif cell.id in task_of:
                messages[cell.id] = headings[-1]
        for task, heading in messages.items():
            assert heading.endswith(f" · {verdict_text.points(task_of[task].points)}")
        assert messages.keys() == task_of.keys()
        worth = [heading for heading in headings if re.search(r" · [\d.]+ points?$", heading)]
        assert len(worth) == len(messages)


def test_an_exercise_breaks_the_standards_without_its_checks(root):
    original = source.numbered("01", "exercises")
    text = original.read_text(encoding="utf-8").replace('check("', 'print("')
    path = write(root, text, "", "", f"exercises/{original.parent.name}", "notebook")
    for task in catalogue.exercise("01").tasks:
        assert f"the task {task.id!r} has no cell" in refused(path, root)


@pytest.mark.parametrize(
    ("cell", "message"),
    [
        ('check("{task}")', "checked more than once"),
        ('x = 1\ncheck("{task}")', "alone in its cell"),
        ('check("{number}-nothing")', "no task"),
        ("from slamlab import grading", "not available during grading"),
        # it is of slamlab.layers, which is there, and only imported into this module, which is not
        ("from slamlab.estimators.graph_slam import Points", "not available during grading"),
    ],
)
def test_what_an_exercise_may_not_hold_is_reported_with_its_line(root, cell, message):
    original = source.numbered("01", "exercises")
    cell = cell.format(task=catalogue.exercise("01").tasks[0].id, number="01")
    lines = original.read_text(encoding="utf-8").rstrip().splitlines()
    folder = f"exercises/{original.parent.name}"
    path = write(root, "\n".join([*lines, "", "# %%", cell]), "", "\n", folder, "notebook")
    reported = refused(path, root)
    assert message in reported
    marker = len(lines) + 2
    assert max(map(int, re.findall(r"\.py:(\d+): ", reported))) in (marker, marker + 1)


# -- lessons


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('# %% tags=["hide"]\nprint(1)', "unknown tag 'hide'"),
        ('# %% slideshow={"slide_type": "pop"}\nprint(1)', "unknown slide type 'pop'"),
        ("# %% Intro\nprint(1)", "unknown marker 'Intro'"),
        ("# %% minutes=5\nprint(1)", "minutes belong to the first cell of a slide"),
        ('# %% slideshow={"slide_type": "slide"} minutes=0\nprint(1)', "must be a whole number"),
        ('# %% slideshow={"slide_type": "slide"} minutes=999\nprint(1)', "add up to 999, but the"),
        ('# %% colour="red"\nprint(1)', "unknown marker 'colour'"),
        ('# %% name="a b"\nprint(1)', "'a b' is not a valid name"),
        ('# %% name="a"\nprint(1)\n\n# %% name="a"\nprint(2)', "'a' is already used in line 8"),
        ("# %%\nprint(1);", "a semicolon"),
        ("# %% [markdown]\n# It is 38% of all.", "write a space before %"),
        ("# %% [markdown]\n# In 1,000,000 steps.", "write large numbers as 10 000"),
        ("# %% [markdown]\n# In {= n:, =} of 2.", "write large numbers as 10 000"),
        ("# %% [markdown]\n# | | b |\n# | --- | --- |\n# | c | d |", "has no heading"),
        ('# %%\nprint(f"{1 / 3:.0%}")', "write a space before %"),
        ("# %%\n%matplotlib inline", "not valid Python"),
        ('# %%\nstyle = {"color": "red"}', "the colour 'red' is hard-coded"),
        ("# %%\n" + "x = 1\n" * 31, "31 lines of code"),
        ("# %%\ndef f():\n    ### BEGIN SOLUTION\n    return 1\n    ### END SOLUTION", "solution"),
        ("# %% [raw]\n# text", "raw cell"),
        (
            '# %%\nprint(1)\n\n# %% [markdown] slideshow={"slide_type": "notes"}\n# Ask.',
            "notes after code",
        ),
    ],
)
def test_a_breach_of_the_standards_is_reported_with_its_line(root, text, message):
    reported = refused(write(root, text), root)
    assert message in reported
    assert "90_sums.py:" in reported


def test_first_and_last_cell_follow_the_convention(root):
    reported = refused(write(root, ADD, head="# %% [markdown]\n# # A lesson\n", tail=""), root)
    assert "`# 90 · Title`" in reported
    assert "how many minutes" in reported
    assert "../exercises/ex90_sums.ipynb" in reported


def test_ids_are_names_or_sections_and_another_section_leaves_them_alone(root):
    named = '\n# %% name="sum"\nprint(3)\n'
    before = tool.derive(write(root, ADD + named), root)[0].notebook
    assert [c.id for c in before.cells] == [
        "90-a-lesson-1",
        "two-and-two-1",
        "two-and-two-2",
        "sum",
        "two-and-two-3",
    ]
    more = "# %% [markdown]\n# ## Before\n\n# %%\nprint(0)\n\n# %% [markdown]\n# ## Two and two\n"
    head = HEAD.replace("# %% [markdown]\n# ## Two and two\n", more)
    after = tool.derive(write(root, ADD + named, head), root)[0].notebook
    assert {c.id for c in before.cells} < {c.id for c in after.cells}


def test_slide_marks_and_notes_survive_and_layout_does_not(root):
    note = '\n# %% [markdown] slideshow={"slide_type": "notes"}\n# Ask first.\n\n\n'
    notebook = tool.derive(write(root, note + ADD), root)[0].notebook
    assert notebook.cells[0].metadata == {"slideshow": {"slide_type": "slide"}}
    assert notebook.cells[2].metadata == {"slideshow": {"slide_type": "notes"}}
    assert "jupytext" not in notebook.metadata
    assert notebook.metadata.slamlab == {"lesson": "90"}


# -- running


@pytest.fixture
def runs(monkeypatch):
    """The notebooks that were run, as a list that grows."""
    ran, execute = [], tool.execute
    monkeypatch.setattr(tool, "execute", lambda *a: ran.append(a) or execute(*a))
    return ran


def test_only_changed_code_runs_again_and_outputs_are_carried(root, runs):
    path = write(root, ADD)
    assert tool.build(path, root=root) == ["notebooks/90_sums.ipynb ran and written"]
    assert stored(root).cells[2].outputs[0].text == "4\n"
    assert tool.differences(path, root) == []

    assert tool.build(path, root=root) == ["notebooks/90_sums.ipynb unchanged"]
    write(root, ADD, head=HEAD.replace("to add", "to sum"))
    assert tool.differences(path, root) == ["notebooks/90_sums.ipynb: differs in 90-a-lesson-1"]
    assert tool.build(path, root=root) == ["notebooks/90_sums.ipynb written"]
    assert stored(root).cells[2].outputs[0].text == "4\n"
    assert len(runs) == 1

    write(root, ADD.replace("2 + 2", "2 + 3"))
    tool.build(path, root=root)
    assert stored(root).cells[2].outputs[0].text == "5\n"
    assert len(runs) == 2


def test_stored_outputs_reveal_nothing_of_the_machine_and_explain_their_widgets(root):
    text = """
    # %%
    import pathlib, sys
    import ipywidgets
    from slamlab.views.notebook_output import show_controls

    print(pathlib.Path.home() / "x")
    print(sys.prefix)
    show_controls(ipywidgets.IntSlider())
    """
    tool.build(write(root, text), root=root)
    notebook = stored(root)
    printed, shown = notebook.cells[2].outputs
    assert printed.text == "~/x\npython\n"
    assert shown.data == {"text/plain": "Run this cell for its controls."}
    assert set(notebook.metadata) == {"kernelspec", "language_info", "slamlab"}
    assert notebook.cells[2].execution_count == 1


def test_a_cell_that_fails_is_reported_with_its_line_and_nothing_is_written(root):
    path = write(root, "\n# %%\nx = 1\n\n# %%\n1 / 0\n")
    with pytest.raises(CourseError, match=r"90_sums.py:12: two-and-two-3 failed(.|\n)*ZeroDiv"):
        tool.build(path, root=root)
    assert not (root / "notebooks" / "90_sums.ipynb").exists()


def test_a_checked_cell_that_shows_nothing_is_refused(root):
    path = write(root, ADD.replace("print(2 + 2)", "x = 2 + 2"))
    with pytest.raises(CourseError, match="no output to compare"):
        tool.build(path, root=root)


def test_a_missing_a_foreign_and_a_cleared_notebook_are_reported(root):
    path = write(root, ADD)
    assert tool.differences(path, root) == ["notebooks/90_sums.ipynb: is missing"]
    derived = tool.derive(path, root)[0]
    (root / "notebooks").mkdir()
    nbformat.write(derived.notebook, derived.path)
    assert tool.differences(path, root) == ["notebooks/90_sums.ipynb: was not run"]
    nbformat.write(derived.notebook, root / "notebooks" / "91_mine.ipynb")
    assert tool.orphans(root) == ["notebooks/91_mine.ipynb"]


def test_an_unknown_name_is_reported_without_a_traceback(capsys):
    assert tool.main(["99"]) == 1
    assert "99: no such source" in capsys.readouterr().err


# -- values in prose

VALUE = """
# %%
total = -2.5

# %% [markdown]
# It is {= total:.1f =}, or {= total ** 2:.2f =}.
"""


def test_values_in_prose_are_computed_where_they_stand_and_kept_without_running(root, monkeypatch):
    path = write(root, VALUE)
    tool.build(path, root=root)
    *_, code, text, _ = stored(root).cells
    assert text.source == "It is −2.5, or 6.25."
    assert code.execution_count == 1
    per_cent = VALUE.replace("total ** 2:.2f", "-total / 10:.0%")
    write(root, per_cent)
    assert tool.differences(path, root) == ["notebooks/90_sums.ipynb: differs in two-and-two-3"]
    tool.build(path, root=root)
    assert stored(root).cells[3].source == "It is −2.5, or 25 %."
    assert tool.differences(path, root) == []
    monkeypatch.setattr(tool, "execute", lambda *_: pytest.fail("nothing is to be run"))
    write(root, per_cent.replace("It is", "So it is"))
    tool.build(path, root=root)
    assert stored(root).cells[3].source == "So it is −2.5, or 25 %."


def test_a_value_that_ends_a_sentence_begins_no_list(root):
    of_list = VALUE.replace("It is {= total:.1f =}, or", "It is\n# {= total + 3.5:.0f =}. It is")
    tool.build(write(root, of_list), root=root)
    assert stored(root).cells[3].source == "It is\n1\\. It is 6.25."


def test_a_value_that_cannot_be_computed_is_reported_with_its_position(root):
    path = write(root, VALUE.replace("total ** 2", "nobody"))
    with pytest.raises(CourseError, match=r"90_sums\.py:\d+: two-and-two-3 failed(.|\n)*nobody"):
        tool.build(path, root=root)


# -- equations


def test_a_reference_to_an_equation_must_have_one_and_numbers_ascend(root):
    numbered = """
    # %% [markdown]
    # $$ a = b \\tag{90.1} $$
    #
    # By (90.1), and by
    # $$ b = c \\tag{90.3} $$
    #
    # so that (90.4) holds.
    """
    message = refused(write(root, numbered), root)
    assert "(90.3) should be (90.2)" in message and "equation (90.4) does not exist" in message
    right = numbered.replace("90.3", "90.2").replace("(90.4)", "(90.2)")
    tool.derive(write(root, right), root)
    once = numbered.replace(" \\tag{90.3}", "")
    assert "has no number" in refused(write(root, once), root)


def test_an_optional_section_may_stand_behind_what_comes_next(root):
    deeper = TAIL + "\n# %% [markdown]\n# ## Deeper: why\n#\n# Because.\n"
    derived = tool.derive(write(root, ADD, tail=deeper), root)[0]
    assert "Because" in derived.notebook.cells[-1].source
