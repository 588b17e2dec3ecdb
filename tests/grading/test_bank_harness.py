"""The harness that holds the bank to its word, held to its own, on the fake exercise."""

import pytest

from tests.bank import Right, Wrong, harness
from tests.grading import fake

SQUARE = "def double(a):\n    return a * a\n"
BANK = harness.Bank(fake.EXERCISE, (fake.SOLUTION,), (), ())


def missed(entry):
    return list(harness.missed(BANK, entry, 3))


def test_the_solution_and_another_right_one_lose_nothing():
    assert missed(Right("the solution", "")) == []
    assert missed(Right("add", "def double(a):\n    return a + a\n")) == []


def test_a_wrong_one_that_loses_what_it_says_is_accepted_and_what_needs_it_is_added():
    assert missed(Wrong("square", SQUARE, {"twice"}, "square")) == []
    assert missed(Wrong("square", SQUARE, {"99-double:twice"}, "square")) == []


@pytest.mark.parametrize(
    "entry",
    [
        Right("square", SQUARE),
        Wrong("too much", SQUARE, {"twice", "sign"}, "square"),
        Wrong("too little", "def double(a):\n    return -a\n", {"twice"}),
        Wrong("no hint expected", SQUARE, {"twice"}),
        Wrong("another hint expected", SQUARE, {"twice"}, "cube"),
        Wrong("no problem expected", "def double(a):\n    pass\n", {"99-double"}),
        Wrong("loses nothing", "def double(a):\n    return 2 * a\n", {"twice"}, "square"),
    ],
    ids=lambda entry: entry.name,
)
def test_an_entry_that_comes_out_otherwise_is_told_for_each_seed(entry):
    assert missed(entry) == [0, 1, 2]


def test_a_problem_loses_the_whole_task():
    code = "def turn(v, angle):\n    raise NotImplementedError\n"
    assert missed(Wrong("untouched", code, {"99-turn"}, problem="not attempted")) == []


def test_an_expectation_no_law_fits_is_an_error():
    with pytest.raises(ValueError, match="no law or task 'turned'"):
        harness.expected(BANK, Wrong("other task's law", SQUARE, {"turned"}))
