"""Linter of the course's sources: breaches of its standards with file and line."""

import ast
import importlib
import re
from itertools import pairwise

from course import asking, digits, equations, per_cent, values, visible_code
from course.exercise import SolutionError, solution_regions
from course.figure_lint import figure_problems
from course.source import CHECK, ID, METADATA, heading, main_line
from slamlab.lecturing.planning import total
from slamlab.coursework.overview import QUESTION

TAGS = {
    visible_code.FOLDED,
    visible_code.SUBJECT,
    "lecturer",
    "nbval-check-output",
    "nbval-ignore-output",
    "nbval-skip",
    "nearly",  # numbers that hang on the processor's rounding
    "raises-exception",
}
SLIDES = {"slide", "subslide", "fragment", "notes", "skip", "-"}
MAX_CELL_LINES = 30  # lines of a lesson's code cell

_FIRST = {
    "lesson": {
        r"able to": "say what the reader will be able to do",
        r"\bmin": "say how many minutes it takes",
        r"before|need": "say what the reader needs before",
    },
    "exercise": {},
}
# a table's first line with an empty cell; where code writes it, its first string
HEADLESS = re.compile(r"^\|(?:.*\|)? +\|.*\n\|[ :|-]+\|$|\"\| +\|", re.MULTILINE)


def lint(source, exercise=None):
    """Lint a source: every breach of the standards.

    Parameters
    ----------
    source : Source
    exercise : slamlab.exercises.exercise.Exercise or None, what the catalogue says of an exercise

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
            yield cell, f"{cell.id!r} is no name: use 1 to 64 letters, digits, hyphens"
        if cell.id in seen:
            yield cell, f"the name {cell.id!r} stands already in line {seen[cell.id]}"
        seen.setdefault(cell.id, cell.line)


def _markers(cell):
    if cell.type not in ("markdown", "code"):
        yield f"a {cell.type} cell: only markdown and code are used"
    if "title" in cell.metadata:
        yield f"unknown marker {cell.metadata['title']!r} behind # %%"
    for key in sorted(set(cell.metadata) - {*METADATA, "title"}):
        yield f"unknown marker {key!r}: only {', '.join(METADATA)}"
    for tag in cell.tags:
        if tag not in TAGS:
            yield f"unknown tag {tag!r}: only {', '.join(sorted(TAGS))}"
    if cell.slide not in SLIDES | {None}:
        yield f"unknown slide type {cell.slide!r}: only {', '.join(sorted(SLIDES))}"
    if set(cell.metadata.get("slideshow", {})) - {"slide_type"}:
        yield "slideshow holds slide_type and nothing else"
    if cell.slide == "notes" and cell.type != "markdown":
        yield "speaker's notes are markdown"
    if not cell.text.strip():
        yield "an empty cell"


def _code(source, cell):
    """Problems of a code cell as (line in the cell, text)."""
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
        yield error.lineno or 0, f"no plain Python: {error.msg}"
        return
    yield from figure_problems(tree)
    if not asking.asks(cell.text):  # its words are prose
        yield from per_cent.in_code(tree)
        yield from digits.in_code(tree)
    try:
        marked = solution_regions(cell.text)
    except SolutionError as error:
        yield error.line, error.message
        return
    if marked and source.kind == "lesson":
        yield marked[0][0], "a lesson holds no solution: that is for exercises"


def _slides(source):
    """Problems of hidden cells: on a slide, Shift+Enter goes to the next cell, hidden or not."""
    for before, cell in pairwise(source.cells):
        if cell.slide in ("notes", "skip") and before.type == "code":
            yield (
                cell,
                f"{cell.slide} behind code, where Shift+Enter ends on an empty slide: move it up",
            )


def _minutes(source):
    """Problems of the plan: minutes beside slides, and those that do not add up."""
    planned = [cell for cell in source.cells if cell.minutes is not None]
    for cell in planned:
        if cell.slide not in ("slide", "subslide"):
            yield cell, "minutes stand where a slide begins"
        if type(cell.minutes) is not int or cell.minutes < 1:
            yield cell, f"minutes are whole and above 0, not {cell.minutes!r}"
            return
    promised, whole = total(source.cells[0].text), sum(cell.minutes for cell in planned)
    if planned and promised != whole:
        yield source.cells[0], f"the sections' minutes add up to {whole}, the head says {promised}"


def _questions(source):
    """Problems of questions: ids that are not this notebook's, answers without their question."""
    asked = set()
    for cell in source.cells:
        for id in QUESTION.findall(cell.text) if cell.type == "code" else ():
            if not id.startswith(f"{source.prefix}-") or id in asked:
                yield cell, f"call the question {source.prefix}-…, and each one differently"
            asked.add(id)
            try:
                asking.asked(cell.text)
            except ValueError:
                yield cell, "a question is stored: write out what is asked, compute nothing in it"
        if cell.answers and cell.answers not in asked:
            yield cell, f"answers a question {cell.answers!r} that no cell before it asks"
        if cell.answers and cell.type == "markdown" and heading(cell.text):
            yield cell, "a heading is not folded: put it before the question"


def _numbers(source):
    """Problems of prose, that of questions too: large numbers, a number and its %."""
    for cell in source.cells:
        prose = cell.type == "markdown" or asking.asks(cell.text)
        if prose and per_cent.in_prose(values.MARK.sub("", cell.text)):  # values get their space
            yield cell, per_cent.SAYS
        if prose and (found := digits.in_prose(cell.text)):
            yield cell, f"{found}: {digits.SAYS}"


def _tables(source):
    """Problems of tables, those that code writes too: a column without a heading."""
    for cell in source.cells:
        if HEADLESS.search(cell.text):
            yield cell, "a column of a table has no heading, by which it is read out"


def _first_and_last_cell(source):
    """Problems of the first and the last cell."""
    if not source.cells:
        return
    first = source.cells[0]
    last = main_line(source.cells)[-1]
    title = heading(first.text) if first.type == "markdown" else None
    if not re.fullmatch(rf"(Exercise )?{source.number} · .+", title or ""):
        yield first, f"the first cell begins with the heading `# {source.number} · Title`"
    for pattern, wish in _FIRST[source.kind].items():
        if not re.search(pattern, first.text, re.IGNORECASE):
            yield first, f"the first cell: {wish}"
    if source.kind == "lesson":
        wanted = f"../exercises/ex{source.path.stem}.ipynb" if source.number != "00" else ".ipynb"
        if last.type != "markdown" or wanted not in last.text:
            yield (
                last,
                f"the last cell of the main line says what comes next and links to {wanted}",
            )


def _checks(source, exercise):
    """Problems of the checks: each task of the exercise has exactly one."""
    known = [task.id for task in exercise.tasks] if exercise else []
    found = [cell.check for cell in source.cells if cell.check]
    for cell in source.cells:
        if cell.check and known and cell.check not in known:
            yield cell, f"no task {cell.check!r}: this exercise has {', '.join(known)}"
        elif cell.check and found.count(cell.check) > 1:
            yield cell, f"{cell.check!r} is checked more than once"
        elif cell.check and cell.id != cell.check:
            yield cell, "a check cell is named by its task: leave the name away"
        elif cell.type == "code" and not cell.check and CHECK.search(cell.text):
            yield cell, "a check stands in a cell of its own, nothing beside it"
    for id in known:
        if id not in found:
            yield source.cells[-1], f'the task {id!r} has no cell check("{id}")'
    if exercise and exercise.notebook != source.path.stem:
        yield source.cells[0], f"the catalogue calls this notebook {exercise.notebook!r}"
    if not exercise:
        yield source.cells[0], f"slamlab.exercises.catalogue knows no exercise {source.number!r}"


def _imports(cell, exercise):
    """Top-level imports from slamlab that a submission could not have when it is graded."""
    if cell.type != "code" or exercise is None:
        return
    try:
        tree = ast.parse(cell.text)
    except SyntaxError:
        return
    allowed = {*exercise.allows, "slamlab.checks"}
    for node in _top_level(tree):
        if isinstance(node, ast.Import):
            modules = [(alias.name,) for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith("slamlab"):
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
            if names[0].split(".")[0] == "slamlab" and not allowed.intersection(names):
                listed = ", ".join(sorted(allowed))
                yield (
                    node.lineno,
                    f"{names[-1]} is not there at grading (only {listed}): import it "
                    "inside the function under @attempt",
                )


def _defining_module(module, name):
    """The module in which a name stands that a room of slamlab offers at its door.

    What a module merely imports for itself is not there at grading, unless that module is.
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
