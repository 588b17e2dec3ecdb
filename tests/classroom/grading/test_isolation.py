"""Isolation levels: workers cannot reach anything else, or grading is refused with a reason."""

import os
import re
import stat
import sys

import pytest

from classroom.grading import (
    bubblewrap,
    escape_attempts,
    isolation,
    judge,
    landlock,
    sandbox,
    seccomp,
)
from slamlab.cli import main
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import lacks, notebook, workers

linux = pytest.mark.skipif(sys.platform != "linux", reason="bounded workers need Linux")


def had(level):
    """Skip where a level cannot be had."""
    if lacks(level):
        pytest.skip(f"no isolation {level!r} here: {lacks(level)}")


@linux
def test_without_a_sandbox_only_resource_limits_stop_forbidden_actions():
    done = isolation.self_test(sandbox.NONE)
    named = re.findall(r'^_attempt\("([^"]+)"', escape_attempts.FORBIDDEN_ACTIONS, re.M)
    assert len(named) == 12
    assert {name for name in named if name not in done} == set(escape_attempts.LIMITED_AT_NONE)


@pytest.mark.parametrize("level", [sandbox.BASIC, sandbox.STRICT])
def test_in_a_sandbox_no_forbidden_action_succeeds(level):
    had(level)
    assert isolation.self_test(level) == ""


def test_a_sandbox_with_a_hole_is_noticed_and_nothing_is_graded(monkeypatch):
    had(sandbox.STRICT)
    report = "raise RuntimeError('read the answers')"
    monkeypatch.setattr(isolation.escape_attempts, "REPORT", report)
    with pytest.raises(isolation.IsolationError, match=r"does not work here.*read the answers"):
        isolation.ensure_level(sandbox.STRICT)


def refused(tmp_path, capsys, level=sandbox.STRICT):
    """Return the message of ``slamlab grade`` when it refuses."""
    folder = tmp_path / "class"
    folder.mkdir()
    (folder / "anna.ipynb").write_text(notebook(fake.SOLUTION))
    out = tmp_path / "out"
    assert main(["grade", str(folder), "--out", str(out), "--isolation", level]) == 2
    assert not (out / "grades.csv").exists()
    output = capsys.readouterr().err
    assert output.startswith("slamlab grade: isolation")
    assert "Traceback" not in output
    return output


@pytest.mark.parametrize(
    ("module", "name", "value", "level", "remedies"),
    [
        pytest.param(bubblewrap, "executable", lambda: None, sandbox.STRICT,
                     ["apt install bubblewrap"], marks=linux),
        pytest.param(landlock, "abi_version", lambda: 0, sandbox.STRICT,
                     ["Linux 5.13"], marks=linux),
        pytest.param(seccomp, "available", lambda: False, sandbox.STRICT,
                     ["system-call filter"], marks=linux),
        pytest.param(bubblewrap, "drops_privileges", lambda: True, sandbox.BASIC,
                     ["ordinary user"], marks=linux),
        (isolation, "CAN_FORK", False, sandbox.STRICT, ["WSL2", "container"]),
    ],
    ids=["no bubblewrap", "no Landlock", "no list of system calls", "root", "other platform"],
)  # fmt: skip
def test_where_a_level_cannot_be_had_the_command_refuses_and_names_the_remedy(
    tmp_path, monkeypatch, capsys, module, name, value, level, remedies
):
    monkeypatch.setattr(module, name, value)
    output = refused(tmp_path, capsys, level)
    assert [remedy for remedy in remedies if remedy not in output] == []


@linux
def test_the_remedy_for_restricted_namespaces_is_named(tmp_path, monkeypatch, capsys):
    program = tmp_path / "bwrap"
    message = "bwrap: setting up uid map: Permission denied"
    program.write_text(f"#!/bin/sh\necho '{message}' >&2; exit 1\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    output = refused(tmp_path, capsys)
    assert "setting up uid map" in output
    assert "AppArmor" in output


@pytest.mark.parametrize(
    "cell",
    [
        "open('left', 'w').write('x'); numpy.left = 1",
        "os.mkdir('shut', 0o300); open('shut/left', 'w').close()",
        "for _ in range(3000): os.mkdir('d'); os.chdir('d')",
    ],
)
def test_workers_share_no_files_or_names(cell):
    spy = "import os, numpy\nraise ValueError([os.listdir('.'), hasattr(numpy, 'left')])"
    for source in (f"import os, numpy\n{cell}", spy) * 2:
        found = judge.judge_notebook(fake.EXERCISE, [(1, source)], b"seed", workers())["cells"]
        if source == spy:
            assert found[1].startswith("ValueError: [[], False]")
