"""The run of the notebooks notices a stored output that is no longer true."""

import re
import subprocess
import sys

import pytest

from course.source import ROOT

ARGUMENTS = ["-p", "tests.notebooks.nearly", "@tests/notebooks/nbval.args"]
HERE = ROOT / "tests/notebooks"


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


def test_a_wrong_stored_output_fails():
    done = nbval(HERE / "canary_print.ipynb", HERE / "canary_sympy.ipynb")
    assert done.returncode == 1, done.stdout
    for name in ("canary_print", "canary_sympy"):
        assert f"FAILED tests/notebooks/{name}.ipynb::Cell 1" in done.stdout
    assert "2 failed, 2 passed" in done.stdout


@pytest.mark.slow
def test_the_right_stored_outputs_pass():
    done = nbval(HERE / "canary_twin.ipynb")
    assert done.returncode == 0, done.stdout
    assert "3 passed" in done.stdout
