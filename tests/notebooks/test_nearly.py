"""Numbers that hang on rounding are compared nearly, and only where a cell is tagged so."""

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_notebook, new_output

from tests.notebooks.nearly import TAG, settled
from tests.notebooks.test_canary import nbval

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
    tags = [*tags, "nbval-check-output"]
    stored = [new_output("stream", name="stdout", text="1.0 m\n")]
    cell = new_code_cell(
        f"print({printed}, 'm')", outputs=stored, execution_count=1, metadata={"tags": tags}
    )
    nbformat.write(new_notebook(cells=[cell]), tmp_path / "one.ipynb")
    done = nbval(tmp_path / "one.ipynb", processes="-n1")  # in a worker, as make test does
    assert done.returncode == (0 if passes else 1), done.stdout
    assert ("1 passed" if passes else "1 failed") in done.stdout
