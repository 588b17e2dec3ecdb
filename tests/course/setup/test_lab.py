"""lab.py makes an environment once, detects an unfinished one, and reports errors in one line."""

import ast
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
import types
import venv
from unittest import mock

import pytest

from tests.course.setup import ROOT

FILES = ["lab.py", "pyproject.toml", "requirements.lock", "requirements-test.lock"]


class Lab:
    """A copy of the project's set-up files whose lab.py makes no real environment.

    ``calls`` lists the modules run in the environment; ``answers`` maps one of these to
    the output and exit code it shall give.
    """

    def __init__(self, folder, monkeypatch):
        self.folder, self.calls, self.answers = folder, [], {}
        for name in FILES:
            shutil.copy(ROOT / name, folder / name)
        spec = importlib.util.spec_from_file_location("lab_copy", folder / "lab.py")
        self.module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(self.module)
        self.stamp = folder / ".venv" / self.module.STAMP
        self.free(1e12, monkeypatch)
        monkeypatch.setattr(self.module, "run", self.run)
        looked = "look_for_browser", lambda venv: self.calls.append("look for a browser")
        monkeypatch.setattr(self.module, *looked)
        made = types.SimpleNamespace(create=self.create)
        monkeypatch.setattr(venv, "EnvBuilder", lambda **options: made)

    def free(self, space, monkeypatch):
        usage = types.SimpleNamespace(free=space)
        monkeypatch.setattr(self.module.shutil, "disk_usage", lambda folder: usage)

    def create(self, folder):
        python = self.module.python_of(folder)
        os.makedirs(os.path.dirname(python))
        open(python, "w").close()
        self.calls.append("venv")

    def run(self, folder, *arguments):
        assert json.loads(self.stamp.read_text()) == {}, "unfinished, and must say so"
        self.calls.append(arguments[0])
        output, code = self.answers.get(arguments[0], ("", 0))
        if isinstance(output, BaseException):
            raise output
        with open(self.module.log_of(folder), "a") as log:
            log.write(output)
        return code

    def start(self, *arguments):
        self.calls.clear()
        return self.module.main(["--install-only", *arguments])


@pytest.fixture
def lab(tmp_path, monkeypatch):
    return Lab(tmp_path, monkeypatch)


def message(lab, *arguments):
    """The one line with which lab.py ends."""
    with pytest.raises(SystemExit) as end:
        lab.start(*arguments)
    assert end.value.code.startswith("lab.py: ") and "\n" not in end.value.code
    return end.value.code


def test_only_the_first_start_installs_and_line_ends_of_another_system_are_no_change(lab):
    lab.start()
    assert lab.calls == ["venv", "pip", "pip", "compileall", "jupyterlab.labextensions"]
    lock = lab.folder / "requirements.lock"
    lock.write_bytes(lock.read_bytes().replace(b"\n", b"\r\n"))
    lab.start()
    assert lab.calls == []


def changed(lab, name):
    """Change a file, of an environment that was made."""
    lab.start()
    with open(lab.folder / name, "a") as file:
        file.write("# changed\n")


@pytest.mark.parametrize("name", ["requirements.lock", "pyproject.toml"])
def test_a_changed_lock_or_project_is_installed_into_the_same_environment(lab, name):
    changed(lab, name)
    lab.start()
    assert "pip" in lab.calls and "venv" not in lab.calls


def test_an_interrupted_installation_is_repeated(lab):
    lab.answers["compileall"] = (KeyboardInterrupt(), 0)
    assert "start again" in message(lab)
    lab.answers.clear()
    lab.start()
    assert lab.calls[0] == "venv"


def test_an_environment_half_removed_is_made_again(lab):
    lab.start()
    lab.stamp.write_text("{}")
    with mock.patch.object(lab.module.shutil, "rmtree", side_effect=KeyboardInterrupt):
        assert "start again" in message(lab)
    lab.start()
    assert lab.calls[0] == "venv"


def test_an_environment_whose_python_is_gone_is_made_again(lab):
    lab.start()
    os.remove(lab.module.python_of(str(lab.folder / ".venv")))
    lab.start()
    assert lab.calls[0] == "venv"


@pytest.mark.parametrize("key", ["place", "python"])
def test_an_environment_of_another_folder_or_python_is_made_again(lab, key):
    lab.start()
    lab.stamp.write_text(json.dumps({**json.loads(lab.stamp.read_text()), key: "another"}))
    lab.start()
    assert lab.calls[0] == "venv"


def test_without_a_network_an_older_environment_is_left_as_it_was(lab):
    changed(lab, "requirements.lock")
    before = lab.stamp.read_text()
    lab.answers["pip"] = ("WARNING: Retrying (Retry(total=4))\nERROR: No matching distribution", 1)
    assert "network" in message(lab)
    assert lab.stamp.read_text() == before


@pytest.mark.parametrize(
    ("output", "expected"),
    [
        ("ERROR: Could not install: [Errno 28] No space left on device", "disk is full"),
        ("ERROR: THESE PACKAGES DO NOT MATCH THE HASHES FROM THE FILE", "does not match the lock"),
        ("ERROR: No matching distribution found for numpy", "no package for this computer"),
        ("ERROR: something never seen", "something never seen"),
    ],
)
def test_the_output_of_pip_becomes_one_line(lab, output, expected):
    lab.answers["pip"] = (output, 1)
    assert expected in message(lab)


def test_a_full_disk_is_noticed_before_anything_is_fetched(lab, monkeypatch):
    lab.free(1e8, monkeypatch)
    assert "disk is full" in message(lab)
    assert lab.calls == []


def test_a_folder_that_is_no_environment_is_not_touched(lab):
    (lab.folder / "mine").mkdir()
    (lab.folder / "mine" / "thesis.txt").write_text("years of work")
    assert "move it" in message(lab, "--venv", "mine")
    assert (lab.folder / "mine" / "thesis.txt").exists()


def test_the_browsers_driver_stays_once_it_was_asked_for(lab):
    lab.start("--lecture")
    assert lab.calls.count("pip") == 3 and lab.calls[-1] == "look for a browser"
    driver = (lab.folder / ".venv" / "lecture.lock").read_text()
    assert re.findall(r"^(\S+)==", driver, re.M) == sorted(lab.module.LECTURE)
    assert driver.count("--hash=sha256:") >= 2 and not driver.rstrip().endswith("\\")
    lab.start()
    assert lab.calls == []


def test_the_students_pack_has_no_driver_and_reports_it_before_anything_is_made(lab):
    (lab.folder / lab.module.LECTURE_LOCK).unlink()
    assert "--lecture needs the whole project or the lecturers' pack" in message(lab, "--lecture")
    assert lab.calls == []


def test_the_lecturer_is_informed_whether_there_is_a_browser(tmp_path, monkeypatch, capsys):
    lab = Lab(tmp_path, monkeypatch)
    monkeypatch.undo()
    monkeypatch.setattr(lab.module, "python_of", lambda venv: sys.executable)
    monkeypatch.setattr(lab.module, "environment", lambda: {"PYTHONPATH": str(ROOT), "PATH": ""})
    lab.module.look_for_browser("anywhere")
    output = capsys.readouterr().err
    assert "Chromium" in output and output.count("\n") == 1


@pytest.mark.skipif(os.name == "nt", reason="JupyterLab is a child process there")
def test_terminals_of_jupyterlab_find_the_course_s_commands(lab, monkeypatch):
    def become(path, command, known):
        sys.exit(known["PATH"])

    monkeypatch.chdir(lab.folder)
    monkeypatch.setattr(os, "execve", become)
    monkeypatch.setenv("PATH", "/elsewhere")
    with pytest.raises(SystemExit) as opened:
        lab.module.open_lab(str(lab.folder / ".venv"), [])
    assert opened.value.code == f"{lab.folder / '.venv' / 'bin'}:/elsewhere"


def test_the_supported_pythons_are_those_of_the_project(lab):
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    above = (lab.module.NEWEST[0], lab.module.NEWEST[1] + 1)
    spelt = ">={}.{},<{}.{}".format(*lab.module.OLDEST, *above)
    assert project["requires-python"] == spelt


def test_old_pythons_can_read_the_script():
    source = (ROOT / "lab.py").read_text(encoding="utf-8")
    assert source.isascii()
    unknown = (ast.JoinedStr, ast.NamedExpr, ast.AnnAssign, ast.Nonlocal, ast.YieldFrom,
               ast.MatMult, ast.AsyncFunctionDef, ast.Match)  # fmt: skip
    for node in ast.walk(ast.parse(source)):
        assert not isinstance(node, unknown), ast.dump(node)
        if isinstance(node, ast.FunctionDef):
            assert not node.args.kwonlyargs and node.returns is None
            assert all(argument.annotation is None for argument in node.args.args)
        if isinstance(node, ast.Raise):
            assert node.cause is None
        if isinstance(node, (ast.List, ast.Tuple, ast.Set)):
            assert not any(isinstance(element, ast.Starred) for element in node.elts)
        if isinstance(node, ast.Call):
            assert sum(isinstance(argument, ast.Starred) for argument in node.args) <= 1


def run_script(folder, before="pass", **variables):
    """Run lab.py as a program after some preparing code; return its exit code and output."""
    code = f"import runpy, sys; {before}; runpy.run_path('lab.py', run_name='__main__')"
    done = subprocess.run(
        [sys.executable, "-c", code, "--install-only"],
        cwd=folder,
        env={**os.environ, **variables},
        capture_output=True,
        text=True,
        timeout=240,
    )
    return done.returncode, done.stderr.strip().splitlines()


@pytest.mark.parametrize(
    ("before", "expected"),
    [
        ("sys.version_info = (3, 8, 0)", "Python 3.8 is older than the course supports"),
        ("sys.version_info = (3, 14, 0)", "Python 3.14 is newer than the course supports"),
        ("sys.modules['ensurepip'] = None", "sudo apt install python3"),
    ],
)
def test_a_python_that_will_not_do_is_refused_in_one_line(tmp_path, before, expected):
    shutil.copy(ROOT / "lab.py", tmp_path)
    code, lines = run_script(tmp_path, before)
    assert code == 1 and len(lines) == 1 and expected in lines[0]
    assert not (tmp_path / ".venv").exists()


@pytest.mark.slow
def test_a_first_installation_without_a_network_is_explained(tmp_path):
    for name in FILES:
        shutil.copy(ROOT / name, tmp_path)
    nowhere = {"INDEX_URL": "http://127.0.0.1:9/simple", "EXTRA_INDEX_URL": "", "FIND_LINKS": "",
               "RETRIES": "1", "CONFIG_FILE": os.devnull}  # fmt: skip
    code, lines = run_script(tmp_path, **{f"PIP_{name}": at for name, at in nowhere.items()})
    assert code == 1 and "connect to a network" in lines[-1]
    assert all(line.startswith("lab.py: ") for line in lines)
