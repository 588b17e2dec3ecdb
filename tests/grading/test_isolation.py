"""A worker is kept from all that is not its own, or nothing is graded and it is said why."""

import os
import re
import stat
import sys

import pytest

from slamlab.cli import main
from slamlab.grading import bubblewrap, isolation, landlock, probe, sandbox, seccomp
from tests.grading import fake
from tests.grading.conftest import lacks, notebook

linux = pytest.mark.skipif(sys.platform != "linux", reason="bounded workers need Linux")


def had(level):
    """Skip where a level cannot be had."""
    if lacks(level):
        pytest.skip(f"no isolation {level!r} here: {lacks(level)}")


@linux
def test_without_a_sandbox_every_forbidden_action_succeeds_but_those_that_limits_stop():
    done = isolation.self_test(sandbox.NONE)
    named = re.findall(r'^_attempt\("([^"]+)"', probe.FORBIDDEN_ACTIONS, re.M)
    assert len(named) == 12
    assert {name for name in named if name not in done} == set(probe.LIMITED_AT_NONE)


@pytest.mark.parametrize("level", [sandbox.BASIC, sandbox.STRICT])
def test_in_a_sandbox_no_forbidden_action_succeeds(level):
    had(level)
    assert isolation.self_test(level) == ""


def test_a_sandbox_with_a_hole_is_noticed_and_nothing_is_graded(monkeypatch):
    had(sandbox.STRICT)
    monkeypatch.setattr(isolation.probe, "REPORT", "raise RuntimeError('read the answers')")
    with pytest.raises(isolation.IsolationError, match=r"does not hold here.*read the answers"):
        isolation.ensure_level(sandbox.STRICT)


def bwrap_that(tmp_path, monkeypatch, script):
    program = tmp_path / "bwrap"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")


def refused(tmp_path, capsys, level=sandbox.STRICT):
    """What ``slamlab grade`` says when it refuses."""
    folder = tmp_path / "class"
    folder.mkdir()
    (folder / "anna.ipynb").write_text(notebook(fake.SOLUTION))
    out = tmp_path / "out"
    assert main(["grade", str(folder), "--out", str(out), "--isolation", level]) == 2
    assert not (out / "grades.csv").exists()
    said = capsys.readouterr().err
    assert said.startswith("slamlab grade: isolation")
    assert "Traceback" not in said
    return said


@linux
def test_without_bubblewrap_the_command_refuses_and_says_how_to_get_it(
    tmp_path, monkeypatch, capsys
):
    monkeypatch.setattr(bubblewrap, "executable", lambda: None)
    assert "apt install bubblewrap" in refused(tmp_path, capsys)


@linux
def test_where_ordinary_users_get_no_namespaces_the_way_out_is_named(tmp_path, monkeypatch, capsys):
    bwrap_that(
        tmp_path, monkeypatch, "echo 'bwrap: setting up uid map: Permission denied' >&2; exit 1"
    )
    said = refused(tmp_path, capsys)
    assert "setting up uid map" in said
    assert "AppArmor" in said


@linux
def test_without_landlock_the_command_refuses(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(landlock, "abi_version", lambda: 0)
    assert "Linux 5.13" in refused(tmp_path, capsys)


@linux
def test_on_a_machine_without_a_list_of_calls_the_command_refuses(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(seccomp, "available", lambda: False)
    assert "system calls" in refused(tmp_path, capsys)


@linux
def test_root_gets_strict_or_nothing(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(bubblewrap, "drops_privileges", lambda: True)
    assert "ordinary user" in refused(tmp_path, capsys, sandbox.BASIC)


def test_elsewhere_the_documented_way_is_named(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(isolation, "CAN_FORK", False)
    said = refused(tmp_path, capsys)
    assert "WSL2" in said
    assert "container" in said


def test_workers_share_nothing():
    from slamlab.grading import judge
    from tests.grading.conftest import workers

    first = "open('left', 'w').write('x'); import numpy; numpy.left = 1"
    second = "import os, numpy\nraise ValueError([os.listdir('.'), hasattr(numpy, 'left')])"
    judge.judge_notebook(fake.EXERCISE, [(1, first)], b"seed", workers())
    said = judge.judge_notebook(fake.EXERCISE, [(1, second)], b"seed", workers())["cells"][1]
    assert said.startswith("ValueError: [[], False]")


@pytest.mark.parametrize(
    "cell",
    [
        "os.mkdir('shut', 0o300); open('shut/left', 'w').close()",
        "for _ in range(3000): os.mkdir('d'); os.chdir('d')",
    ],
)
def test_what_cannot_be_cleared_away_is_not_seen_by_the_next(cell):
    from slamlab.grading import judge
    from tests.grading.conftest import workers

    for _ in range(2):
        judge.judge_notebook(fake.EXERCISE, [(1, "import os\n" + cell)], b"seed", workers())
        spy = "import os\nraise ValueError(os.listdir('.'))"
        said = judge.judge_notebook(fake.EXERCISE, [(1, spy)], b"seed", workers())["cells"][1]
        assert said.startswith("ValueError: []")
