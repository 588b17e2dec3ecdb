"""The process: started, found again by a new kernel, ended; what it is given, what it leaves."""

import asyncio
import json
import os
import signal
import stat
import subprocess
import sys
from pathlib import Path

import psutil
import pytest

from slamlab.audience import addresses, starting
from tests.listening.client import Client, run
from tests.patience import PATIENCE, until

PAGE = "http://localhost:8888"


@pytest.fixture
def home(tmp_path, monkeypatch):
    """Folders of its own for Jupyter and for temporary files; whatever still runs is ended."""
    (tmp_path / "temporary").mkdir()
    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(tmp_path / "runtime"))
    monkeypatch.setenv("TMPDIR", str(tmp_path / "temporary"))
    yield tmp_path
    state = tmp_path / "runtime" / "slamlab-audience.json"
    if state.exists():
        stop(json.loads(state.read_text())["pid"])


def runs(pid):
    try:
        return psutil.Process(pid).status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False


def stop(pid):
    if runs(pid):
        os.kill(pid, signal.SIGTERM)
        until(lambda: not runs(pid))


def phone(told):
    return Client(int(told["addresses"][0]["address"].rpartition(":")[2]))


def left(home):
    """Files in which something could have been kept."""
    return [path for path in home.rglob("*") if path.is_file() and path.suffix != ".lock"]


def test_started_twice_it_runs_once_and_a_new_kernel_finds_it(home):
    first = starting.start(PAGE, port=0)
    assert starting.start(PAGE, port=0) == first
    code = f"import json; from slamlab import audience; print(json.dumps(audience.start({PAGE!r})))"
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert json.loads(said.stdout) == first


def test_a_kernel_that_is_killed_does_not_take_the_lecture_with_it(home):
    code = (
        "import json, time; from slamlab import audience\n"
        f"print(json.dumps(audience.start({PAGE!r}, port=0)), flush=True); time.sleep(1000)"
    )
    kernel = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    with kernel.stdout:
        told = json.loads(kernel.stdout.readline())
    kernel.send_signal(signal.SIGINT)
    kernel.kill()
    kernel.wait(PATIENCE)
    assert starting.start(PAGE, port=0) == told


def test_a_process_that_died_is_not_taken_for_one_that_runs(home):
    first = starting.start(PAGE, port=0)
    os.kill(first["pid"], signal.SIGKILL)
    until(lambda: not runs(first["pid"]))
    second = starting.start(PAGE, port=0)
    assert second["pid"] != first["pid"]
    assert second["code"] != first["code"]


@pytest.mark.slow
def test_another_page_ends_the_lecture_that_runs_and_begins_one_of_its_own(home):
    first = starting.start(PAGE, port=0)
    second = starting.start("http://localhost:9999", port=0)
    until(lambda: not runs(first["pid"]))
    assert starting.start("http://localhost:9999", port=0) == second


def test_it_knows_nothing_of_jupyter_and_stands_in_an_empty_folder(home, monkeypatch):
    monkeypatch.setenv("JUPYTER_TOKEN", "secret-token")
    monkeypatch.setenv("JPY_PARENT_PID", "1")
    monkeypatch.setenv("HTTPS_PROXY", "http://proxy.example")
    told = starting.start(PAGE, port=0)
    process = psutil.Process(told["pid"])
    assert process.environ().keys() <= set(starting.KEPT) | {"LC_CTYPE"}
    assert "secret-token" not in " ".join([*process.environ().values(), *process.cmdline()])
    assert list(Path(process.cwd()).iterdir()) == []
    if os.name == "posix":
        state = home / "runtime" / "slamlab-audience.json"
        assert stat.S_IMODE(state.stat().st_mode) == 0o600
    listens = {c.laddr.ip for c in process.net_connections() if c.status == psutil.CONN_LISTEN}
    assert listens == {"127.0.0.1"}


@pytest.mark.slow
def test_it_ends_when_told_tells_the_phones_and_leaves_nothing(home):
    async def attend(told):
        here = phone(told)
        assert await here.enter(told["code"]) == 200
        starting._ask(told, "GET", "/alive")
        version = (await here.state())["version"]
        waiting = asyncio.create_task(here.ask("GET", f"/state/{version}"))
        await asyncio.to_thread(starting._ask, told, "POST", "/end")
        return json.loads((await waiting)[2])

    told = starting.start(PAGE, port=0)
    assert run(attend(told))["over"]
    until(lambda: not runs(told["pid"]))
    assert left(home) == []
    assert list((home / "temporary").iterdir()) == []


@pytest.mark.slow
def test_it_ends_by_itself_when_the_lecturer_s_page_is_silent(home):
    command = [sys.executable, "-m", "slamlab.audience", PAGE, "--port", "0", "--patience", "0.5"]
    command += ["--state", str(home / "state.json")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as running:
        json.loads(running.stdout.readline())
        assert running.wait(PATIENCE) == 0
    assert left(home) == []


@pytest.mark.slow
def test_a_vote_stands_in_no_file_while_it_lasts_or_after(home):
    async def attend(told):
        here = phone(told)
        await here.enter(told["code"])
        number = (await here.state())["poll"]["number"]
        assert await here.vote(number, 123456.75) == 200
        return here.cookie.partition("=")[2]

    told = starting.start(PAGE, port=0)
    lecturer = Client(int(told["control"].rpartition(":")[2]))
    shown = {"Origin": PAGE, "Authorization": f"Bearer {told['key']}"}
    poll = {"question": "q", "text": "?", "choices": None, "unit": "m"}
    assert run(lecturer.ask("PUT", "/poll", poll, **shown))[0] == 200
    cookie = run(attend(told))
    for path in left(home):
        text = path.read_text()
        assert "123456.75" not in text
        assert cookie not in text
    starting._ask(told, "POST", "/end")
    until(lambda: not runs(told["pid"]))
    assert left(home) == []


def test_what_cannot_be_listened_on_is_said(home):
    with pytest.raises(RuntimeError, match=r"cannot listen on 192\.0\.2\.77.*this machine's"):
        starting.start(PAGE, host="192.0.2.77")
    with pytest.raises(ValueError, match="no origin"):
        starting.start("javascript:alert(1)")


def test_a_port_that_is_taken_is_no_obstacle(home):
    first = starting.start(PAGE, port=0)
    port = int(first["addresses"][0]["address"].rpartition(":")[2])
    told = starting.start("http://localhost:9999", port=port)
    assert phone(told).port > 0


def test_addresses_are_of_this_machine_and_loopback_only_where_nothing_else_is():
    found = addresses.reachable("0.0.0.0")
    assert found
    assert "0.0.0.0" not in found
    assert addresses.reachable("127.0.0.1") == ["127.0.0.1"]


def test_a_qr_code_is_a_picture_by_itself():
    code = addresses.qr_code("http://192.168.1.5:8765/#abc")
    assert code.startswith("<svg")
    assert "href" not in code
