"""Widgets used after the whole notebook ran still show the same."""

import ast

import pytest

from course.source import ROOT
from tests.course.notebooks import load

WIDGETS = {"explore", "watch", "edit_world"}  # what they are given is called when a reader acts
FUNCTIONS = (ast.FunctionDef, ast.ClassDef, ast.Lambda)


def parsed(path):
    sources = (cell.source for cell in load(path).cells if cell.cell_type == "code")
    return [ast.parse(source) for source in sources if not source.startswith("%")]


def names(node, context):
    found = (n for n in ast.walk(node) if isinstance(n, ast.Name))
    return {n.id for n in found if isinstance(n.ctx, context)}


def bound(cell):
    """By name what a cell's statements outside functions make of it: a function, or a value."""
    made = {}
    for statement in cell.body:
        if isinstance(statement, (ast.FunctionDef, ast.ClassDef)):
            made[statement.name] = statement
        else:
            made |= dict.fromkeys(names(statement, ast.Store), statement)
    return made


def read_within(function):
    """Names of the notebook that a function, or a class, reads when it is called."""
    arguments = {node.arg for node in ast.walk(function) if isinstance(node, ast.arg)}
    return names(function, ast.Load) - names(function, ast.Store) - arguments


def functions_in(node, known):
    """Functions that an expression hands over: its lambdas, and those that its names stand for."""
    pending, seen = [node], []
    while pending:
        node = pending.pop()
        if node in seen:
            continue
        seen.append(node)
        if isinstance(node, FUNCTIONS):
            yield node
            pending += [known[name] for name in read_within(node) if name in known]
        else:
            pending += [n for n in ast.walk(node) if isinstance(n, ast.Lambda)]
            pending += [known[name] for name in names(node, ast.Load) if name in known]


def called_later(cells):
    """(position of a cell, function that its widgets call) of all cells."""
    known = {}
    for position, cell in enumerate(cells):
        known |= bound(cell)
        for node in ast.walk(cell):
            called = getattr(node, "func", None)
            if WIDGETS & {getattr(called, "attr", None), getattr(called, "id", None)}:
                for given in [*node.args, *(word.value for word in node.keywords)]:
                    yield from ((position, each) for each in functions_in(given, known))


def changed(cells):
    """(function, names) that a widget reads and a later cell gives another value."""
    for position, function in called_later(cells):
        later = set().union(*(bound(cell) for cell in cells[position + 1 :]))
        if read := read_within(function) & later:
            yield getattr(function, "name", f"the lambda in line {function.lineno}"), read


@pytest.mark.parametrize("path", sorted((ROOT / "notebooks").glob("*.ipynb")), ids=lambda p: p.stem)
def test_what_a_widget_shows_is_not_given_another_value_by_a_later_cell(path):
    assert not list(changed(parsed(path)))


@pytest.mark.parametrize(
    "cell",
    [
        "live.watch(source, estimator, 'alt', note=lambda pair: f'{error}')",
        "live.watch(source, estimator, 'alt', curves={'error': {'naive': lambda pair: error}})",
        "def off(pair):\n    return error\nlive.watch(source, off, 'alt')",
        "def off(pair):\n    return error\nlive.watch(source, lambda s: off(s), 'alt')",
        "class Own:\n    def step(self):\n        return error\nlive.watch(source, Own, 'alt')",
        "def scan(world):\n    return error\neditor = edit_world(world, 'alt', scan=scan)",
        "def drawn(step):\n    return error\nviews.explore(drawn, 'alt', step=(0, 1, 0))",
    ],
)
def test_each_way_to_pass_a_function_is_recorded(cell):
    before, same, other = map(ast.parse, ("error = 1", "print(error)", "error = 2"))
    assert not list(changed([other, before, ast.parse(cell), same]))
    assert [read for _, read in changed([before, ast.parse(cell), other])] == [{"error"}]


def test_what_is_evaluated_at_once_may_change_later():
    cells = map(ast.parse, ("live.watch(source, estimator, f'{error}', seed=seed)", "seed = 2"))
    assert not list(changed(list(cells)))
