"""A solution is taken out of a cell where it is marked rightly, and refused where it is not."""

import pytest

from course.solution_cells import STUB, SolutionError, solution_regions, strip_solutions


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
