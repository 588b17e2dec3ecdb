"""The audience server: start, reuse by a new kernel, end, environment, files."""

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

from classroom.audience import addresses, server_start
from tests.slamlab.web_server.client import Client, run
from tests.timeouts import PATIENCE, until

PAGE = "http://localhost:8888"


@pytest.fixture
def user_folder(tmp_path, monkeypatch):
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


def phone(message):
    return Client(int(message["addresses"][0]["address"].rpartition(":")[2]))


def left(user_folder):
    """Files in which something could have been kept."""
    return [path for path in user_folder.rglob("*") if path.is_file() and path.suffix != ".lock"]


def test_started_twice_it_runs_once_and_a_new_kernel_finds_it(user_folder):
    first = server_start.start(PAGE, port=0)
    assert server_start.start(PAGE, port=0) == first
    code = (
        f"import json; from classroom import audience; print(json.dumps(audience.start({PAGE!r})))"
    )
    process = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert json.loads(process.stdout) == first


def test_a_killed_kernel_does_not_end_the_lecture(user_folder):
    code = (
        "import json, time; from classroom import audience\n"
        f"print(json.dumps(audience.start({PAGE!r}, port=0)), flush=True); time.sleep(1000)"
    )
    kernel = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    with kernel.stdout:
        output = json.loads(kernel.stdout.readline())
    kernel.send_signal(signal.SIGINT)
    kernel.kill()
    kernel.wait(PATIENCE)
    assert server_start.start(PAGE, port=0) == output


def test_a_dead_server_is_replaced(user_folder):
    first = server_start.start(PAGE, port=0)
    os.kill(first["pid"], signal.SIGKILL)
    until(lambda: not runs(first["pid"]))
    second = server_start.start(PAGE, port=0)
    assert second["pid"] != first["pid"]
    assert second["code"] != first["code"]


@pytest.mark.slow
def test_a_start_for_another_page_replaces_the_server(user_folder):
    first = server_start.start(PAGE, port=0)
    second = server_start.start("http://localhost:9999", port=0)
    until(lambda: not runs(first["pid"]))
    assert server_start.start("http://localhost:9999", port=0) == second


def test_it_gets_no_secrets_and_runs_in_an_empty_folder(user_folder, monkeypatch):
    monkeypatch.setenv("JUPYTER_TOKEN", "secret-token")
    monkeypatch.setenv("JPY_PARENT_PID", "1")
    monkeypatch.setenv("HTTPS_PROXY", "http://proxy.example")
    reported = server_start.start(PAGE, port=0)
    process = psutil.Process(reported["pid"])
    assert process.environ().keys() <= set(server_start.KEPT) | {"LC_CTYPE"}
    assert "secret-token" not in " ".join([*process.environ().values(), *process.cmdline()])
    assert list(Path(process.cwd()).iterdir()) == []
    if os.name == "posix":
        state = user_folder / "runtime" / "slamlab-audience.json"
        assert stat.S_IMODE(state.stat().st_mode) == 0o600
    listens = {c.laddr.ip for c in process.net_connections() if c.status == psutil.CONN_LISTEN}
    assert listens == {"127.0.0.1"}


@pytest.mark.slow
def test_votes_are_never_written_to_a_file_and_the_end_informs_phones_and_leaves_nothing(
    user_folder,
):
    message = server_start.start(PAGE, port=0)
    poll = {"question": "q", "text": "?", "choices": None, "unit": "m"}

    async def attend():
        lecturer = Client(int(message["control"].rpartition(":")[2]))
        shown = {"Origin": PAGE, "Authorization": f"Bearer {message['key']}"}
        assert (await lecturer.ask("PUT", "/poll", poll, **shown))[0] == 200
        here = phone(message)
        assert await here.log_in(message["code"]) == 200
        state = await here.state()
        assert await here.vote(state["poll"]["number"], 123456.75) == 200
        for path in left(user_folder):
            text = path.read_text()
            assert "123456.75" not in text and here.cookie.partition("=")[2] not in text
        version = (await here.state())["version"]
        waiting = asyncio.create_task(here.ask("GET", f"/state/{version}"))
        await asyncio.to_thread(server_start._request, message, "POST", "/end")
        return json.loads((await waiting)[2])

    assert run(attend())["over"]
    until(lambda: not runs(message["pid"]))
    assert left(user_folder) == []
    assert list((user_folder / "temporary").iterdir()) == []


@pytest.mark.slow
def test_it_ends_by_itself_when_the_lecturer_s_page_is_silent(user_folder):
    command = [sys.executable, "-m", "classroom.audience", PAGE, "--port", "0", "--patience", "0.5"]
    command += ["--state", str(user_folder / "state.json")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as running:
        json.loads(running.stdout.readline())
        assert running.wait(PATIENCE) == 0
    assert left(user_folder) == []


def test_an_invalid_address_is_reported(user_folder):
    with pytest.raises(RuntimeError, match=r"cannot listen on 192\.0\.2\.77.*this machine"):
        server_start.start(PAGE, host="192.0.2.77")
    with pytest.raises(ValueError, match="not a web origin"):
        server_start.start("javascript:alert(1)")


def test_a_taken_port_is_replaced(user_folder):
    first = server_start.start(PAGE, port=0)
    port = int(first["addresses"][0]["address"].rpartition(":")[2])
    reported = server_start.start("http://localhost:9999", port=port)
    assert phone(reported).port > 0


def test_addresses_are_of_this_machine_and_loopback_only_where_nothing_else_is():
    found = addresses.reachable("0.0.0.0")
    assert found
    assert "0.0.0.0" not in found
    assert addresses.reachable("127.0.0.1") == ["127.0.0.1"]


def test_a_qr_code_is_a_standalone_picture():
    code = addresses.qr_code("http://192.168.1.5:8765/#abc")
    assert code.startswith("<svg")
    assert "href" not in code
