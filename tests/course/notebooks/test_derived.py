"""Stored notebooks are those that their sources derive, and meet the course's standards."""

import io
import re
import statistics
import tokenize

import nbformat
import pytest
from nbgrader.nbgraderformat import MetadataValidator
from nbgrader.preprocessors import CheckCellMetadata

from classroom.exercises import catalogue, verdict_text
from course import large_numbers
from course.build import differences, orphans
from course.derive import derive
from course.question_cells import asks
from course.solution_cells import solution_lines, strip_solutions
from course.source import ID, ROOT, file_name, read, topic
from tests.course.notebooks import (
    APPENDICES,
    EXERCISES,
    LESSONS,
    NOTEBOOKS,
    code_cells,
    images,
    lesson,
    load,
    name,
    texts,
)

CHECKED = "nbval-check-output"
each_source = pytest.mark.parametrize("path", LESSONS + EXERCISES + APPENDICES, ids=name)
each_lesson = pytest.mark.parametrize("path", LESSONS, ids=name)
each_exercise = pytest.mark.parametrize("path", EXERCISES, ids=name)
each_notebook = pytest.mark.parametrize("path", NOTEBOOKS, ids=name)


@pytest.mark.slow
@each_source
def test_a_stored_notebook_is_what_its_source_derives(path):
    assert differences(path) == []


def test_every_notebook_has_a_source():
    assert orphans() == []


def test_every_exercise_of_the_catalogue_has_a_source():
    assert {topic(path) for path in EXERCISES} == {e.notebook for e in catalogue.EXERCISES.values()}


@pytest.mark.slow
@each_source
def test_the_same_source_derives_the_same_bytes(path):
    first, second = (
        [nbformat.writes(derived.notebook) for derived in derive(path)] for _ in range(2)
    )
    assert first == second


@each_notebook
def test_a_notebook_is_valid_and_light_and_its_cells_have_ids_of_their_own(path):
    nbformat.validate(load(path))
    assert path.stat().st_size < 600_000
    ids = [cell.id for cell in load(path).cells]
    assert len(set(ids)) == len(ids)
    assert [id for id in ids if not ID.fullmatch(id)] == []


@each_exercise
def test_no_line_of_a_solution_leaks_into_an_exercise(path):
    solutions = []
    for cell in read(path).cells:
        if cell.type == "code" and cell.given:  # solved as a whole
            solutions += [x for x in cell.text.splitlines() if x.strip() not in cell.given]
        elif cell.type == "code":
            solutions += solution_lines(cell.text)
    assert solutions, "an exercise without a solution has nothing to solve"
    exercise = load(ROOT / "exercises" / file_name(path))
    text = "\n".join("".join(tokens(line)) for c in exercise.cells for line in c.source.split("\n"))
    assert "SOLUTION" not in text
    leaked = [line for line in solutions if telling(line) and "".join(tokens(line)) in text]
    assert leaked == []


def tokens(line):
    """A line's tokens without comments; a line that is no Python, cut at its blanks."""
    try:
        found = list(tokenize.generate_tokens(io.StringIO(line.strip()).readline))
    except (tokenize.TokenError, SyntaxError):
        return line.split()
    return [token.string for token in found if token.type != tokenize.COMMENT and token.string]


def telling(line):
    """Return whether a line is more than an unpacking or the return of a name."""
    return sum(token not in "()[],: " for token in tokens(line)) >= 6


@each_exercise
def test_an_exercise_is_handed_out_unsolved_and_without_outputs(path):
    cells = code_cells(load(ROOT / "exercises" / file_name(path)))
    assert not any(cell.outputs or cell.execution_count for cell in cells)
    assert not any(CHECKED in cell.metadata.get("tags", []) for cell in cells)


@each_exercise
@pytest.mark.parametrize("folder", ["exercises", "solutions"])
def test_nbgrader_accepts_the_metadata_and_finds_the_points_of_the_tasks(path, folder):
    notebook = load(ROOT / folder / file_name(path))
    MetadataValidator().validate_nb(notebook)
    CheckCellMetadata().preprocess(notebook, {})
    marks = [c.metadata.nbgrader for c in notebook.cells if "nbgrader" in c.metadata]
    exercise = catalogue.exercise(topic(path)[:2])
    points = {mark.grade_id: mark.points for mark in marks if mark.grade}
    assert points == {task.id: task.points for task in exercise.tasks}
    assert all(mark.locked for mark in marks if mark.grade)
    assert any(mark.solution for mark in marks)


@each_exercise
def test_only_solutions_differ_and_checks_stay_and_tasks_state_what_they_are_worth(path):
    task_of = {task.id: task for task in catalogue.exercise(topic(path)[:2]).tasks}
    worth, headings = re.compile(r" · [\d.]+ points?$", re.MULTILINE), []
    assert not re.search(r"^# ## .*" + worth.pattern, path.read_text("utf-8"), re.MULTILINE)
    unsolved, solved = (derived.notebook for derived in derive(path))
    for cell, of_solution in zip(unsolved.cells, solved.cells, strict=True):
        assert cell.id == of_solution.id
        if "BEGIN SOLUTION" in of_solution.source:
            assert cell.source == strip_solutions(of_solution.source)
            assert cell.metadata.nbgrader.solution
        else:
            assert cell.source == of_solution.source or cell.id == "my-slam"  # of two files
        if mark := cell.metadata.get("nbgrader"):
            assert cell.metadata.deletable is False
            assert cell.metadata.get("editable", True) is not mark.grade
        if cell.cell_type == "markdown":
            headings += re.findall(r"^## .*", cell.source, re.MULTILINE)
        elif cell.id in task_of:
            assert headings[-1].endswith(f" · {verdict_text.points(task_of[cell.id].points)}")
    checked = [cell.id for cell in unsolved.cells if cell.id in task_of]
    assert set(checked) == task_of.keys()
    assert sum(bool(worth.search(heading)) for heading in headings) == len(checked)


@each_notebook
def test_a_cell_whose_output_is_checked_has_one_stored(path):
    checked = [c for c in code_cells(load(path)) if CHECKED in c.metadata.get("tags", [])]
    assert [cell.id for cell in checked if not cell.outputs or not cell.execution_count] == []


@each_notebook
def test_every_stored_picture_has_alternative_text(path):
    for cell in code_cells(load(path)):
        for picture in images(cell):
            alt = re.search(r'alt="([^"]*)"', picture)
            assert alt and len(alt[1].split()) >= 8, f"{cell.id}: {picture[:200]}"


@each_notebook
def test_stored_outputs_hold_no_warning_no_live_widget_and_no_path_of_a_machine(path):
    for cell in code_cells(load(path)):
        assert "execution" not in cell.metadata, f"{cell.id}: stores when it ran"
        for output in cell.outputs:
            raises = "raises-exception" in cell.metadata.get("tags", [])
            assert output.output_type != "error" or raises, f"{cell.id}: stores an error"
            assert output.get("name") != "stderr", f"{cell.id}: {output.text[:200]}"
            mimes = set(output.get("data", {}))
            assert "application/vnd.jupyter.widget-view+json" not in mimes, cell.id
            for text in texts(output):
                assert not re.search(r"(^|[\s\"'(=])(/(home|root|work|tmp|Users)/|[A-Z]:\\)", text)


@pytest.mark.parametrize("id", catalogue.EXERCISES)
def test_a_stored_solution_reports_each_law_of_today_as_satisfied(id):
    exercise = catalogue.exercise(id)
    cells = code_cells(load(ROOT / "solutions" / exercise.file))
    shown = "".join(text for cell in cells for output in cell.outputs for text in texts(output))
    shown = " ".join(shown.split())
    again = f"python -m course.build --force {id}"
    assert "✗" not in shown and "is not saved" not in shown, again
    for law in (law for task in exercise.tasks for law in task.laws):
        assert f"✓ {law.says} (" in shown, (again, law.says)


@each_notebook
def test_no_text_and_no_output_has_a_large_number_in_another_form(path):
    for cell in load(path).cells:
        shown = [cell.source] if cell.cell_type == "markdown" else []
        for output in cell.get("outputs", []):
            kinds = {"printed": output.get("text")} | output.get("data", {})
            shown += [kinds.get(each) for each in ("printed", "text/markdown", "text/plain")]
        for text in filter(None, shown):
            assert large_numbers.in_prose(text) is None, f"{cell.id}: {large_numbers.MESSAGE}"


@each_lesson
def test_every_figure_is_followed_by_what_to_see(path):
    cells = [c for c in lesson(path).cells if slide(c) != "notes"]
    for cell, after in zip(cells, [*cells[1:], None], strict=True):
        if images(cell):
            assert after and after.cell_type == "markdown", f"{cell.id}: no word after its figure"
            assert not after.source.startswith("#"), f"{cell.id}: a heading follows its figure"


@each_lesson
def test_code_cells_are_short_and_leave_drawing_to_the_package(path):
    cells = code_cells(lesson(path))
    own = [c for c in cells if not line_of_a_derivation(c) and not asks(c.source)]
    lengths = [len(c.source.splitlines()) for c in own]
    assert 5 <= statistics.median(lengths) <= 12
    for cell in cells:
        assert "matplotlib" not in cell.source, f"{cell.id}: draw with slamlab.views"
        drawing = re.findall(r"^\s*(?:ax\w*(?:\[\w+\])?\.|views\.draw)", cell.source, re.MULTILINE)
        assert len(drawing) <= 3, f"{cell.id}: {len(drawing)} lines of drawing"


def line_of_a_derivation(cell):
    """Whether a code cell is one line of a derivation, revealed alone: short on purpose."""
    return slide(cell) == "fragment" and len(cell.source.splitlines()) <= 2


@each_lesson
def test_a_lesson_can_be_presented_and_checks_an_output(path):
    slides = [slide(cell) for cell in lesson(path).cells]
    assert slides[0] == "slide", "the first cell is the first slide"
    assert "notes" in slides, "no notes for the lecturer"
    assert slides.count("slide") + slides.count("subslide") >= 3
    assert any(CHECKED in cell.metadata.get("tags", []) for cell in lesson(path).cells)


def slide(cell):
    """A cell's slide type, None where it has none."""
    return cell.metadata.get("slideshow", {}).get("slide_type")


@each_notebook
def test_links_to_other_files_lead_somewhere(path):
    for cell in load(path).cells:
        if cell.cell_type == "markdown":
            for target in re.findall(r"\]\(([^)#\s]+)", cell.source):
                if not re.match(r"[a-z]+:", target):
                    assert (path.parent / target).exists(), f"{cell.id}: {target}"
