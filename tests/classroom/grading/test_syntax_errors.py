"""If a cell has a syntax error, an older function is judged, and the check reports it."""

from types import SimpleNamespace

from IPython.core.inputtransformer2 import TransformerManager

from classroom.checks.syntax_errors import describe_syntax_error

GOOD = "import numpy as np\n\ndef turn(v, angle):\n    return v"
BAD = "# mine\ndef turn(v, angle):\n    return (v"
OTHER = "def turns(v:\n    return v"


def shell(*cells, defined=True):
    names = {"In": ["", *cells]} | ({"turn": print} if defined else {})
    return SimpleNamespace(user_ns=names, transform_cell=TransformerManager().transform_cell)


def test_nothing_is_reported_where_the_last_definition_was_read():
    magic = f"%matplotlib\n{GOOD}\n%time turn(1, 2)"
    for cells in ((), (GOOD,), (BAD, GOOD), (GOOD, OTHER), (magic,)):
        assert describe_syntax_error(["turn"], shell(*cells)) is None
    assert describe_syntax_error(["turn"], None) is None


def test_an_older_function_behind_a_syntax_error_is_reported_with_its_line():
    message = describe_syntax_error(["other", "turn"], shell(GOOD, BAD, "check('99-turn')"))
    assert "defines turn has a syntax error in line 3" in message
    assert message.endswith("an older definition is checked.")
    assert describe_syntax_error(["turn"], shell(BAD, defined=False)).endswith(
        "Python did not run the cell."
    )
