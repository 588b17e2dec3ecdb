"""The run of the notebooks notices a stored output that is no longer true."""

import re
import subprocess
import sys

from course.source import ROOT

ARGUMENTS = "tests/notebooks/nbval.args"


def nbval(*names):
    """Run notebooks with the very arguments that ``make test`` uses, but in one process."""
    paths = [f"tests/notebooks/{name}.ipynb" for name in names]
    command = [sys.executable, "-m", "pytest", f"@{ARGUMENTS}", "-n0", *paths]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300)


def test_make_test_runs_all_notebooks_with_the_arguments_tried_here():
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    command = re.search(rf".*@{ARGUMENTS}.*", makefile)
    assert command, f"the Makefile runs nbval with @{ARGUMENTS}"
    assert re.search(r"notebooks/? exercises/? solutions/?", command[0])
    assert not command[0].lstrip().startswith("-"), "a failure must stop make"


def test_a_wrong_stored_output_fails():
    done = nbval("canary_print", "canary_sympy")
    assert done.returncode == 1, done.stdout
    for name in ("canary_print", "canary_sympy"):
        assert f"FAILED tests/notebooks/{name}.ipynb::Cell 1" in done.stdout
    assert "2 failed, 2 passed" in done.stdout


def test_the_right_stored_outputs_pass():
    done = nbval("canary_twin")
    assert done.returncode == 0, done.stdout
    assert "3 passed" in done.stdout
