"""Behind a cell with a syntax error an older function is judged: that is told, and nothing else."""

from types import SimpleNamespace

import pytest
from IPython.core.inputtransformer2 import TransformerManager

from slamlab.checks.unread_cells import unread

GOOD = "import numpy as np\n\ndef turn(v, angle):\n    return v"
BAD = "# mine\ndef turn(v, angle):\n    return (v"
OTHER = "def turns(v:\n    return v"


def shell(*cells, defined=True):
    names = {"In": ["", *cells]} | ({"turn": print} if defined else {})
    return SimpleNamespace(user_ns=names, transform_cell=TransformerManager().transform_cell)


@pytest.mark.parametrize(
    "cells",
    [
        (),
        (GOOD,),
        (BAD, GOOD),
        (GOOD, OTHER),
        (GOOD, "%time turn(1, 2)"),
        (f"%matplotlib\n{GOOD}",),
    ],
)
def test_nothing_is_told_where_the_last_definition_was_read(cells):
    assert unread(["turn"], shell(*cells)) is None
    assert unread(["turn"], None) is None


def test_an_older_function_behind_a_syntax_error_is_told_with_its_line():
    said = unread(["other", "turn"], shell(GOOD, BAD, "check('99-turn')"))
    assert "defines turn has a syntax error in its line 3" in said
    assert said.endswith("what is judged is the one before it.")
    assert unread(["turn"], shell(BAD, defined=False)).endswith("Python read none of it.")
