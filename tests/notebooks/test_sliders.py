"""A slider is moved after the whole notebook ran: it must still show what it showed before."""

import ast

import pytest

from course.source import ROOT
from tests.notebooks import load


def parsed(path):
    sources = (cell.source for cell in load(path).cells if cell.cell_type == "code")
    return [ast.parse(source) for source in sources if not source.startswith("%")]


def names(node, context):
    found = (n for n in ast.walk(node) if isinstance(n, ast.Name))
    return {n.id for n in found if isinstance(n.ctx, context)}


def rebound(statements):
    """Names that statements outside functions give a value to."""
    functions = (ast.FunctionDef, ast.ClassDef)
    outside = (s for s in statements if not isinstance(s, functions))
    return set().union(*(names(s, ast.Store) for s in outside))


def drawn_later(cells):
    """(function, the notebook's names it reads, cell) of functions in cells with sliders."""
    for position, cell in enumerate(cells):
        if "explore" in {n.attr for n in ast.walk(cell) if isinstance(n, ast.Attribute)}:
            for node in (n for n in cell.body if isinstance(n, ast.FunctionDef)):
                own = names(node, ast.Store) | {a.arg for a in node.args.args}
                yield node.name, names(node, ast.Load) - own, position


@pytest.mark.parametrize("path", sorted((ROOT / "notebooks").glob("*.ipynb")), ids=lambda p: p.stem)
def test_what_a_slider_draws_is_not_given_another_value_by_a_later_cell(path):
    cells = parsed(path)
    for function, read, position in drawn_later(cells):
        later = set().union(*(rebound(cell.body) for cell in cells[position + 1 :]))
        assert not read & later, f"{function} reads what a later cell rebinds: {read & later}"
