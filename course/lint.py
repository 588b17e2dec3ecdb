"""Linter for the course's sources: it lists violations of the standards with file and line."""

import ast
import importlib
import re
from itertools import pairwise

from classroom.coursework.progress_overview import QUESTION
from classroom.lecturing.time_plan import total_minutes
from course import (
    computed_values,
    equations,
    large_numbers,
    percent_signs,
    question_cells,
    visible_code,
)
from course.figure_lint import figure_problems
from course.solution_cells import SolutionError, solution_regions
from course.source import CHECK, ID, METADATA, heading, main_line

OURS = ("slamlab", "classroom", "course")
TAGS = {
    "your-turn",
    visible_code.FOLDED,
    visible_code.SUBJECT,
    "lecturer",
    "nbval-check-output",
    "nbval-ignore-output",
    "nbval-skip",
    "nearly",  # numbers that depend on the processor's rounding
    "raises-exception",
}
SLIDES = {"slide", "subslide", "fragment", "notes", "skip", "-"}
MAX_CELL_LINES = 30  # lines of a lesson's code cell

_FIRST = {
    "lesson": {
        r"able to": "state what the reader will be able to do",
        r"\bmin": "state how many minutes the lesson takes",
        r"before|need": "state what the reader must know beforehand",
    },
    "exercise": {},
    "appendix": {},
}
# the first line of a table with an empty cell, or the first string of a table in code
HEADLESS = re.compile(r"^\|(?:.*\|)? +\|.*\n\|[ :|-]+\|$|\"\| +\|", re.MULTILINE)


def lint(source, exercise=None):
    """Lint a source and list all violations of the standards.

    Parameters
    ----------
    source : Source
    exercise : classroom.exercises.exercise.Exercise or None, the exercise's entry in the catalogue

    Returns
    -------
    list of str, each "file:line: what is wrong and what to do"
    """
    problems = [f"{source.at(cell)}: {text}" for cell, text in _names(source)]
    for cell in source.cells:
        problems += [f"{source.at(cell)}: {text}" for text in _markers(cell)]
        if cell.type == "code":
            problems += [f"{source.at(cell, line)}: {text}" for line, text in _code(source, cell)]
    problems += [f"{source.at(cell)}: {text}" for cell, text in _slides(source)]
    problems += [f"{source.at(cell)}: {text}" for cell, text in _minutes(source)]
    problems += [f"{source.at(cell)}: {text}" for cell, text in _questions(source)]
    problems += [f"{source.at(cell)}: {text}" for cell, text in _numbers(source)]
    problems += [f"{source.at(cell)}: {text}" for cell, text in _tables(source)]
    problems += [f"{source.at(cell)}: {text}" for cell, text in equations.problems(source)]
    problems += [f"{source.at(cell)}: {text}" for cell, text in _first_and_last_cell(source)]
    if source.kind == "lesson":
        problems += [f"{source.at(cell)}: {text}" for cell, text in visible_code.problems(source)]
    if source.kind == "exercise":
        problems += [f"{source.at(cell)}: {text}" for cell, text in _checks(source, exercise)]
        for cell in source.cells:
            for line, text in _imports(cell, exercise):
                problems.append(f"{source.at(cell, line)}: {text}")
    return problems


def _names(source):
    seen = {}
    for cell in source.cells:
        if not ID.fullmatch(cell.id):
            yield cell, f"{cell.id!r} is not a valid name: use 1 to 64 letters, digits, hyphens"
        if cell.id in seen:
            yield cell, f"the name {cell.id!r} is already used in line {seen[cell.id]}"
        seen.setdefault(cell.id, cell.line)


def _markers(cell):
    if cell.type not in ("markdown", "code"):
        yield f"{cell.type} cell: only markdown and code cells are allowed"
    if "title" in cell.metadata:
        yield f"unknown marker {cell.metadata['title']!r} after # %%"
    for key in sorted(set(cell.metadata) - {*METADATA, "title"}):
        yield f"unknown marker {key!r}: only {', '.join(METADATA)}"
    for tag in cell.tags:
        if tag not in TAGS:
            yield f"unknown tag {tag!r}: only {', '.join(sorted(TAGS))}"
    if cell.slide not in SLIDES | {None}:
        yield f"unknown slide type {cell.slide!r}: only {', '.join(sorted(SLIDES))}"
    if set(cell.metadata.get("slideshow", {})) - {"slide_type"}:
        yield "slideshow may contain slide_type only"
    if cell.slide == "notes" and cell.type != "markdown":
        yield "speaker's notes must be markdown"
    if not cell.text.strip():
        yield "the cell is empty"


def _code(source, cell):
    """Yield the problems of a code cell as (line in the cell, text)."""
    lines = cell.text.splitlines()
    if source.kind == "lesson" and len(lines) > MAX_CELL_LINES:
        yield 0, f"{len(lines)} lines of code: at most {MAX_CELL_LINES} in a lesson's cell"
    if lines and lines[-1].rstrip().endswith(";"):
        yield len(lines), "a semicolon at the end does not hide a value here: write `_ = ...`"
    try:
        tree = compile(
            cell.text, "<cell>", "exec", ast.PyCF_ALLOW_TOP_LEVEL_AWAIT | ast.PyCF_ONLY_AST
        )
    except SyntaxError as error:
        yield error.lineno or 0, f"not valid Python: {error.msg}"
        return
    yield from figure_problems(tree)
    if not question_cells.asks(cell.text):  # a question's wording is prose
        yield from percent_signs.in_code(tree)
        yield from large_numbers.in_code(tree)
    try:
        marked = solution_regions(cell.text)
    except SolutionError as error:
        yield error.line, error.message
        return
    if marked and source.kind == "lesson":
        yield marked[0][0], "a lesson must not contain a solution; only exercises do"


def _slides(source):
    """Yield problems with hidden cells: Shift+Enter selects the next cell even if it is hidden."""
    for before, cell in pairwise(source.cells):
        if cell.slide in ("notes", "skip") and before.type == "code":
            yield (
                cell,
                f"{cell.slide} after code: Shift+Enter would end on an empty slide: move it up",
            )


def _minutes(source):
    """Yield problems with the time plan: minutes in wrong cells, or minutes with a wrong sum."""
    planned = [cell for cell in source.cells if cell.minutes is not None]
    for cell in planned:
        if cell.slide not in ("slide", "subslide"):
            yield cell, "minutes belong to the first cell of a slide"
        if type(cell.minutes) is not int or cell.minutes < 1:
            yield cell, f"minutes must be a whole number above 0, not {cell.minutes!r}"
            return
    promised, whole = total_minutes(source.cells[0].text), sum(cell.minutes for cell in planned)
    if planned and promised != whole:
        yield (
            source.cells[0],
            f"the sections' minutes add up to {whole}, but the first cell states {promised}",
        )


def _questions(source):
    """Yield problems with questions: wrong ids, or answers without a question."""
    asked = set()
    for cell in source.cells:
        for id in QUESTION.findall(cell.text) if cell.type == "code" else ():
            if not id.startswith(f"{source.prefix}-") or id in asked:
                yield cell, f"a question's id must begin with {source.prefix}- and be unique"
            asked.add(id)
            try:
                question_cells.asked(cell.text)
            except ValueError:
                yield cell, "a question is stored: use literals only, compute nothing in it"
        if cell.answers and cell.answers not in asked:
            yield cell, f"answers the question {cell.answers!r}, which no earlier cell asks"
        if cell.answers and cell.type == "markdown" and heading(cell.text):
            yield cell, "a heading cannot be folded: move it before the question"


def _numbers(source):
    """Yield problems with large numbers and per cent signs in prose and questions."""
    for cell in source.cells:
        prose = cell.type == "markdown" or question_cells.asks(cell.text)
        if prose and percent_signs.in_prose(
            computed_values.MARK.sub("", cell.text)
        ):  # values get their space
            yield cell, percent_signs.MESSAGE
        if prose and (found := large_numbers.in_prose(cell.text)):
            yield cell, f"{found}: {large_numbers.MESSAGE}"


def _tables(source):
    """Yield problems with tables, including tables in code: columns without a heading."""
    for cell in source.cells:
        if HEADLESS.search(cell.text):
            yield cell, "a table column has no heading; screen readers need one"


def _first_and_last_cell(source):
    """Yield problems with the first and the last cell."""
    if not source.cells:
        return
    first = source.cells[0]
    last = [cell for cell in main_line(source.cells) if cell.slide != "notes"][-1]
    title = heading(first.text) if first.type == "markdown" else None
    if source.kind == "appendix":
        if not title:
            yield first, "the first cell must begin with a heading of the first level"
    elif not re.fullmatch(rf"(Exercise )?{source.number} · .+", title or ""):
        yield first, f"the first cell must begin with the heading `# {source.number} · Title`"
    for pattern, wish in _FIRST[source.kind].items():
        if not re.search(pattern, first.text, re.IGNORECASE):
            yield first, f"the first cell: {wish}"
    if source.kind == "lesson":
        wanted = f"../exercises/ex{source.topic}.ipynb" if source.number != "00" else ".ipynb"
        if last.type != "markdown" or wanted not in last.text:
            yield (
                last,
                f"the last cell of the main line must state what comes next and link to {wanted}",
            )


def _checks(source, exercise):
    """Yield problems with the checks: each task of the exercise must have exactly one check."""
    known = [task.id for task in exercise.tasks] if exercise else []
    found = [cell.check for cell in source.cells if cell.check]
    for cell in source.cells:
        if cell.check and known and cell.check not in known:
            yield cell, f"no task {cell.check!r}: this exercise has {', '.join(known)}"
        elif cell.check and found.count(cell.check) > 1:
            yield cell, f"{cell.check!r} is checked more than once"
        elif cell.check and cell.id != cell.check:
            yield cell, "a check cell gets the name of its task: omit the name"
        elif cell.type == "code" and not cell.check and CHECK.search(cell.text):
            yield cell, "a check must be alone in its cell"
    for id in known:
        if id not in found:
            yield source.cells[-1], f'the task {id!r} has no cell check("{id}")'
    if exercise and exercise.notebook != source.topic:
        yield source.cells[0], f"the catalogue calls this notebook {exercise.notebook!r}"
    if not exercise:
        yield source.cells[0], f"classroom.exercises.catalogue has no exercise {source.number!r}"


def _imports(cell, exercise):
    """Yield top-level imports of modules that are not available when a notebook is graded."""
    if cell.type != "code" or exercise is None:
        return
    try:
        tree = ast.parse(cell.text)
    except SyntaxError:
        return
    allowed = {*exercise.allows, "classroom.checks"}
    for node in _top_level(tree):
        if isinstance(node, ast.Import):
            modules = [(alias.name,) for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith(OURS):
            modules = [
                (
                    node.module,
                    _defining_module(node.module, alias.name),
                    f"{node.module}.{alias.name}",
                )
                for alias in node.names
            ]
        else:
            continue
        for names in modules:
            if names[0].startswith(OURS) and not allowed.intersection(names):
                listed = ", ".join(sorted(allowed))
                yield (
                    node.lineno,
                    f"{names[-1]} is not available during grading (only {listed}): import it "
                    "inside the function under @attempt",
                )


def _defining_module(module, name):
    """Return the module that defines a name exported by a package of slamlab.

    A name that a module only imports is available during grading only if the module that defines it
    is available, too.
    """
    try:
        room = importlib.import_module(module)
    except ImportError:
        return module
    if name not in getattr(room, "__all__", ()):
        return module
    return getattr(getattr(room, name), "__module__", module)


def _top_level(node):
    for child in ast.iter_child_nodes(node):
        if not isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            yield child
            yield from _top_level(child)
