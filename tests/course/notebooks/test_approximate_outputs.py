"""Numbers that depend on rounding are compared approximately, in tagged cells only."""

import pytest
from nbformat.v4 import new_output

from tests.course.notebooks.approximate_outputs import TAG, settled
from tests.course.notebooks.test_canary import nbval, stored

STORED = "walls 98%, 60 wrong, 12,135 paid, scan 239, −0.006 m and 1.50e-03\n"


@pytest.mark.parametrize(
    ("found", "same"),
    [
        (STORED, True),
        (STORED.replace("60", "58").replace("12,135", " 9,450"), True),  # another width, too
        (STORED.replace("0.006", "0.005"), True),
        (STORED.replace("60", "130"), False),
        (STORED.replace("−0.006", "0.006"), False),
        (STORED.replace("1.50e-03", "1.50e-02"), False),
        (STORED.replace("wrong", "right"), False),
        (STORED + "1\n", False),
        (STORED.replace("60", "nan"), False),
    ],
)
def test_only_near_numbers_are_taken_for_the_stored_ones(found, same):
    assert (settled(found, STORED) == STORED) is same


@pytest.mark.slow
@pytest.mark.parametrize(
    ("tags", "printed", "passes"),
    [([TAG], 1.1, True), ([TAG], 2.2, False), ([], 1.1, False)],
)
def test_nbval_compares_nearly_what_is_tagged(tags, printed, passes, tmp_path):
    output = new_output("stream", name="stdout", text="1.0 m\n")
    one = stored(tmp_path / "one.ipynb", f"print({printed}, 'm')", output, *tags)
    done = nbval(one, processes="-n1")  # in a worker, as make test does
    assert done.returncode == (0 if passes else 1), done.stdout
    assert ("2 passed" if passes else "1 failed, 1 passed") in done.stdout
