"""The run of the notebooks detects a stored output that is no longer right."""

import re
import subprocess
import sys

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_notebook, new_output

from course.source import ROOT

PLUGIN = "tests.course.notebooks.approximate_outputs"
ARGUMENTS = ["-p", PLUGIN, "@tests/course/notebooks/nbval.args"]


def nbval(*paths, processes="-n0"):
    """Run notebooks with the very arguments that ``make test`` uses, by default in one process."""
    command = [sys.executable, "-m", "pytest", *ARGUMENTS, processes, *paths]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300)


def test_make_test_runs_all_notebooks_with_the_arguments_tried_here():
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    command = re.search(f".*{' '.join(ARGUMENTS)}.*", makefile)
    assert command, f"the Makefile runs nbval with {ARGUMENTS}"
    assert re.search(r"notebooks/? exercises/? solutions/?", command[0])
    assert not command[0].lstrip().startswith("-"), "a failure must stop make"


def stored(file, source, output, *tags):
    """Write a notebook whose second cell shows something else or the same as is stored."""
    metadata = {"tags": ["nbval-check-output", *tags]}
    cell = new_code_cell(source, outputs=[output], execution_count=2, metadata=metadata)
    cells = [new_code_cell("import sympy\n\nx = sympy.Symbol('x')"), cell]
    nbformat.write(new_notebook(cells=cells), file)
    return file


@pytest.mark.parametrize(
    ("number", "sign", "words"),
    [("1.415", "", "2 failed, 2 passed"), ("1.414", "-", "4 passed")],
    ids=["wrong", "right"],
)
def test_a_wrong_stored_output_fails_and_the_right_ones_pass(tmp_path, number, sign, words):
    latex = rf"$\displaystyle {sign} \sin{{\left(x \right)}}$"
    text = {"text/plain": f"{sign}sin(x)", "text/latex": latex}
    printed = new_output("stream", text=f"{number}\n")
    algebra = new_output("execute_result", text, execution_count=2)
    done = nbval(
        stored(tmp_path / "canary_print.ipynb", "print(round(2**0.5, 3))", printed),
        stored(tmp_path / "canary_sympy.ipynb", "sympy.cos(x).diff(x)", algebra),
    )
    assert words in done.stdout
    assert done.returncode == ("failed" in words)
    for name in ("canary_print", "canary_sympy"):
        reported = re.search(rf"FAILED \S*{name}.ipynb::Cell 1", done.stdout)
        assert bool(reported) == ("failed" in words)
