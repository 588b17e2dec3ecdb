"""Builder of notebooks: outputs kept, violations refused."""

import re
import textwrap

import nbformat
import pytest

from classroom.exercises import catalogue
from course import build as tool
from course import source
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
VALUE = """
# %%
total = -2.5

# %% [markdown]
# It is {= total:.1f =}, or {= total ** 2:.2f =}.
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


# -- exercises


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
    ids = "90-a-lesson-1 two-and-two-1 two-and-two-2 sum two-and-two-3"
    assert [c.id for c in before.cells] == ids.split()
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


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("\n# %%\nx = 1\n\n# %%\n1 / 0\n", r"py:12: two-and-two-3 failed(.|\n)*ZeroDiv"),
        (ADD.replace("print(2 + 2)", "x = 2 + 2"), "no output to compare"),
        (VALUE.replace("total ** 2", "nobody"), r"py:\d+: two-and-two-3 failed(.|\n)*nobody"),
    ],
)
def test_what_cannot_be_run_is_reported_with_its_line_and_nothing_is_written(root, text, message):
    path = write(root, text)
    with pytest.raises(CourseError, match=message):
        tool.build(path, root=root)
    assert not (root / "notebooks" / "90_sums.ipynb").exists()


def test_a_missing_a_foreign_and_a_cleared_notebook_and_an_unknown_name_are_reported(root, capsys):
    path = write(root, ADD)
    assert tool.differences(path, root) == ["notebooks/90_sums.ipynb: is missing"]
    derived = tool.derive(path, root)[0]
    (root / "notebooks").mkdir()
    nbformat.write(derived.notebook, derived.path)
    assert tool.differences(path, root) == ["notebooks/90_sums.ipynb: was not run"]
    nbformat.write(derived.notebook, root / "notebooks" / "91_mine.ipynb")
    assert tool.orphans(root) == ["notebooks/91_mine.ipynb"]
    assert tool.main(["99"]) == 1
    assert "99: no such source" in capsys.readouterr().err


# -- values in prose


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
