"""Arguments that ``slamlab live`` refuses, and what it prints without a page."""

import subprocess
import sys

import pytest

from slamlab.cli import main


@pytest.mark.parametrize("port", ["-1", "65536", "99999"])
def test_a_port_out_of_range_is_refused(port, capsys):
    assert main(["live", "sim:situation-2", "--no-open", "--port", port]) == 2
    assert f"--port must be from 0 to 65535, not {port}" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("source", "words"),
    [
        (["sim:room"], "0.5, 30 to drive"),
        (["sim:landmarks", "--estimator", "mak"], "pause, run, reset or exit"),
    ],
)
def test_without_a_page_the_command_states_how_the_run_starts_and_what_can_be_typed(source, words):
    pytest.importorskip("tornado")  # slamlab live serves a page
    live = [sys.executable, "-m", "slamlab", "live", *source, "--no-open"]
    done = subprocess.run(live, input="run\nexit\n", capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "when you type run" in done.stdout and f"Type {words}" in done.stdout
