"""lab.py from a copy of the project to a JupyterLab that serves the first notebook."""

import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from types import SimpleNamespace

import pytest

from lab import NEWS, SETTINGS, python_of
from tests.course.setup import ROOT
from tests.timeouts import PATIENCE

pytestmark = pytest.mark.slow
START = "notebooks/00_start_here.ipynb"
LEFT_OUT = [".git", ".venv*", "__pycache__", ".*_cache", ".hypothesis", ".ipynb_checkpoints"]
NOT_FOR_STUDENTS = ["nbgrader", "pytest", "nbval", "hypothesis", "jupytext", "playwright", "ruff"]


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Server:
    """The course opened by lab.py without a browser; ended for sure when the block is left."""

    def __init__(self, folder, user_folder):
        self.port, self.token = free_port(), os.urandom(16).hex()
        self.output = folder / "output.txt"
        # a home of its own shows what is left there; the downloads already made are used again
        cache = subprocess.run(
            [sys.executable, "-m", "pip", "cache", "dir"],
            capture_output=True,
            text=True,
            check=True,
        ).stdout.strip()
        leave_out = ("JUPYTER", "IPYTHON", "VIRTUAL_ENV", "PYTEST", "COV")
        kept = {k: v for k, v in os.environ.items() if not k.startswith(leave_out)}
        arguments = ["--no-browser", "--ip=127.0.0.1", f"--port={self.port}"]
        arguments += ["--ServerApp.port_retries=0", f"--IdentityProvider.token={self.token}"]
        with open(self.output, "w") as output:
            self.process = subprocess.Popen(
                [sys._base_executable, "lab.py", *arguments],
                cwd=folder,
                env={
                    **kept,
                    "HOME": str(user_folder),
                    "USERPROFILE": str(user_folder),
                    "PIP_CACHE_DIR": cache,
                },
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            if os.name == "nt":
                self.process.kill()
            else:
                os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()

    def ask(self, path, method="GET"):
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}{path}", method=method)
        request.add_header("Authorization", f"token {self.token}")
        with urllib.request.urlopen(request, timeout=PATIENCE) as answer:
            return answer.read().decode()

    def wait(self, seconds):
        """Wait until the server answers; fail with the output of lab.py if it does not."""
        end = time.monotonic() + seconds
        while time.monotonic() < end and self.process.poll() is None:
            try:
                return self.ask("/api")
            except (urllib.error.URLError, ConnectionError, TimeoutError):
                time.sleep(0.3)
        pytest.fail(f"no JupyterLab within {seconds} s:\n{self.output.read_text()[-3000:]}")


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    """A bare copy of the project after its first start, and what that start served."""
    folder = tmp_path_factory.mktemp("course") / "with a space"
    shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(*LEFT_OUT))
    user_folder = tmp_path_factory.mktemp("home")
    with Server(folder, user_folder) as server:
        server.wait(900)
        served = SimpleNamespace(
            folder=folder,
            user_folder=user_folder,
            notebook=json.loads(server.ask(f"/api/contents/{START}")),
            page=server.ask(f"/lab/tree/{START}"),
            kernels=json.loads(server.ask("/api/kernelspecs"))["kernelspecs"],
            output=server.output.read_text(),
        )
        server.ask("/api/shutdown", "POST")
        server.process.wait(60)
    return served


def test_the_course_opens_on_its_first_notebook(course):
    assert course.notebook["content"]["cells"][0]["source"].startswith("# 00")
    assert "<title>JupyterLab</title>" in course.page
    assert "python3" in course.kernels
    assert f"/lab/tree/{START}" in course.output


def test_the_second_start_installs_nothing(course):
    log = course.folder / ".venv" / "install.log"
    before = log.read_bytes()
    with Server(course.folder, course.user_folder) as server:
        server.wait(120)
        assert "setting up" not in server.output.read_text()
    assert log.read_bytes() == before


def test_students_get_the_package_and_no_test_tools(course):
    code = f"""if True:
        import slamlab
        from importlib.util import find_spec
        print([name for name in {NOT_FOR_STUDENTS} if find_spec(name)], slamlab.__file__)"""
    python = python_of(str(course.folder / ".venv"))
    done = subprocess.run(
        [python, "-c", code], cwd=course.user_folder, capture_output=True, text=True, check=True
    )
    assert done.stdout.startswith(f"[] {course.folder}")


def test_the_environment_holds_compiled_modules(course):
    compiled = ".venv/[Ll]ib/**/site-packages/numpy/__pycache__/__init__.*.pyc"
    assert len(list(course.folder.glob(compiled))) == 1


def test_the_news_prompt_is_off(course):
    (page,) = course.folder.glob(".venv/etc/jupyter/labconfig/page_config.json")
    assert json.loads(page.read_text())["disabledExtensions"] == {NEWS: True}


def test_the_labextension_and_the_settings_of_the_course_are_there(course):
    share = course.folder / ".venv" / "share" / "jupyter"
    for path in (ROOT / "labextension").rglob("*"):
        if path.is_file():
            placed = course.folder / ".venv" / path.relative_to(ROOT / "labextension")
            assert placed.read_bytes() == path.read_bytes()
    settings = json.loads((share / "lab" / "settings" / "overrides.json").read_text())
    assert settings == SETTINGS
    assert '"slamlab"' in course.page


def test_nothing_is_registered_outside_the_course_folder(course):
    left = {path.name for path in course.user_folder.rglob("*")}
    assert not left & {"kernel.json", "page_config.json", "overrides.json"}
