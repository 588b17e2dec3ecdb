"""Two hundred phones in a lecture while another client floods the server with connections."""

import asyncio
import contextlib
import json
import os
import subprocess
import sys

import pytest

from tests.slamlab.web_server.client import Client, run
from tests.timeouts import PATIENCE

PAGE, PHONES, AT_ONCE = "http://localhost:8888", 200, 300
SLIDE = "<h2>Odometry</h2><p>It <b>drifts</b>.</p>"


@contextlib.contextmanager
def lecture(tmp_path):
    """A running audience server: yields its addresses."""
    places = {name: str(tmp_path) for name in ("TMPDIR", "HOME")}
    words = ["-m", "classroom.audience", PAGE, "--port", "0"]
    running = subprocess.Popen(
        [sys.executable, *words], stdout=subprocess.PIPE, text=True, env=os.environ | places
    )
    try:
        output = json.loads(running.stdout.readline())
        yield output
    finally:
        running.terminate()
        running.stdout.close()
        running.terminate()
        running.wait(PATIENCE)


def phone_port(message):
    return int(message["addresses"][0]["address"].rpartition(":")[2])


class Lecturer(Client):
    """The lecturer's page."""

    def __init__(self, expected):
        super().__init__(int(expected["control"].rpartition(":")[2]))
        self._shown = {"Origin": PAGE, "Authorization": f"Bearer {expected['key']}"}

    async def do(self, method, path, message=None):
        status, _, body = await self.ask(method, path, message, **self._shown)
        assert status == 200, (status, body)
        return json.loads(body)


async def attend(message, n, address):
    """One phone: it logs in, loads the page, the slide and the poll, and votes."""
    phone = Client(phone_port(message), address)
    # browsers retry after a refused connection
    for path in ("/", "/phone.js", "/phone.css"):
        while (await phone.ask("GET", path))[0] != 200:
            await asyncio.sleep(0.1)
    while await phone.log_in(message["code"]) != 200:
        await asyncio.sleep(0.1)
    state = await phone.state()
    assert state["poll"]["choices"] == ["left", "right"]
    status, _, body = await phone.ask("GET", f"/slide/{state['shown']}")
    assert (status, json.loads(body)["html"]) == (200, SLIDE)
    assert await phone.vote(state["poll"]["number"], n % 2) == 200
    return n


async def flood(message, served, connections):
    """Connections that send nothing, incomplete or invalid requests; none is served."""
    kinds = [
        b"",
        b"GET / HT",
        b"GET /state/0 HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n",
        b"POST /login HTTP/1.1\r\nContent-Length: 900\r\n\r\n{",
        b"\x16\x03\x01\x02\x00\x01\x00\x01" * 40,
    ]
    one_at_a_time = asyncio.Semaphore(AT_ONCE)

    async def one(n):
        async with one_at_a_time:
            flooder = Client(phone_port(message), "127.0.9.9")
            with contextlib.suppress(OSError):
                _, writer = await flooder.connect()
                writer.write(kinds[n % len(kinds)])
                if n % 7 == 0:
                    await asyncio.sleep(0.05)
                writer.close()
        if n % len(kinds) == 2:
            served.append((await flooder.ask("GET", "/state/0"))[0])

    await asyncio.gather(*(one(n) for n in range(connections)))


async def hold(message, addresses, flooding):
    """Hold a lecture with phones at these addresses, and run ``flooding`` meanwhile."""
    lecturer = Lecturer(message)
    await lecturer.do("PUT", "/slide", {"slide": 3, "place": 2, "html": SLIDE})
    poll = {"question": "05-turn", "text": "Where?", "choices": ["left", "right"], "unit": ""}
    await lecturer.do("PUT", "/poll", poll)
    flooding = asyncio.create_task(flooding)
    came = await asyncio.gather(*(attend(message, n, where) for n, where in enumerate(addresses)))
    during = await lecturer.do("GET", "/poll")
    await flooding
    assert len(came) == len(addresses)
    assert during["counts"] == [PHONES // 2, PHONES // 2]
    assert during["phones"] == PHONES
    assert await lecturer.do("GET", "/poll") == during, "the flood has voted"
    await lecturer.do("POST", "/end")


@pytest.mark.parametrize("connections", [2000, pytest.param(10_000, marks=pytest.mark.slow)])
def test_two_hundred_phones_vote_during_a_flood_of_connections(tmp_path, connections):
    addresses, served = [f"127.0.{1 + n // 100}.{1 + n % 100}" for n in range(PHONES)], []
    with lecture(tmp_path) as raised:
        run(hold(raised, addresses, flood(raised, served, connections)))
    assert served
    assert set(served) <= {0, 400, 403, 429}


def test_two_hundred_phones_behind_one_address_can_log_in_at_once(tmp_path):
    with lecture(tmp_path) as raised:
        alone = hold(raised, ["127.0.1.1"] * PHONES, asyncio.sleep(0))
        run(alone)
