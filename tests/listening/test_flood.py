"""Two hundred phones in a lecture, each with an address of its own, while somebody floods it."""

import asyncio
import contextlib
import json
import os
import subprocess
import sys

import pytest

from tests.listening.client import Client, run
from tests.patience import PATIENCE

PAGE, PHONES, AT_ONCE = "http://localhost:8888", 200, 300
SLIDE = "<h2>Odometry</h2><p>It <b>drifts</b>.</p>"


@contextlib.contextmanager
def lecture(tmp_path):
    """The process as it is started: what it told, and a client of its control."""
    places = {name: str(tmp_path) for name in ("TMPDIR", "HOME")}
    words = ["-m", "slamlab.audience", PAGE, "--port", "0"]
    running = subprocess.Popen(
        [sys.executable, *words], stdout=subprocess.PIPE, text=True, env=os.environ | places
    )
    try:
        told = json.loads(running.stdout.readline())
        yield told
    finally:
        running.terminate()
        running.stdout.close()
        running.terminate()
        running.wait(PATIENCE)


def phone_port(told):
    return int(told["addresses"][0]["address"].rpartition(":")[2])


class Lecturer(Client):
    """The lecturer's page."""

    def __init__(self, told):
        super().__init__(int(told["control"].rpartition(":")[2]))
        self._shown = {"Origin": PAGE, "Authorization": f"Bearer {told['key']}"}

    async def do(self, method, path, said=None):
        status, _, body = await self.ask(method, path, said, **self._shown)
        assert status == 200, (status, body)
        return json.loads(body)


async def attend(told, n, address):
    """One phone: it comes in, gets the page, the slide and the poll, and votes."""
    phone = Client(phone_port(told), address)
    # what a browser does when a connection was refused
    for path in ("/", "/phone.js", "/phone.css"):
        while (await phone.ask("GET", path))[0] != 200:
            await asyncio.sleep(0.1)
    while await phone.enter(told["code"]) != 200:
        await asyncio.sleep(0.1)
    state = await phone.state()
    assert state["poll"]["choices"] == ["left", "right"]
    status, _, body = await phone.ask("GET", f"/slide/{state['shown']}")
    assert (status, json.loads(body)["html"]) == (200, SLIDE)
    assert await phone.vote(state["poll"]["number"], n % 2) == 200
    return n


async def flood(told, served, connections):
    """Connections that say nothing, half of something, or something wrong; none gets anything."""
    kinds = [
        b"",
        b"GET / HT",
        b"GET /state/0 HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n",
        b"POST /enter HTTP/1.1\r\nContent-Length: 900\r\n\r\n{",
        b"\x16\x03\x01\x02\x00\x01\x00\x01" * 40,
    ]
    one_at_a_time = asyncio.Semaphore(AT_ONCE)

    async def one(n):
        async with one_at_a_time:
            flooder = Client(phone_port(told), "127.0.9.9")
            with contextlib.suppress(OSError):
                _, writer = await flooder.connect()
                writer.write(kinds[n % len(kinds)])
                if n % 7 == 0:
                    await asyncio.sleep(0.05)
                writer.close()
        if n % len(kinds) == 2:
            served.append((await flooder.ask("GET", "/state/0"))[0])

    await asyncio.gather(*(one(n) for n in range(connections)))


async def hold(told, addresses, flooding):
    """Hold a lecture with phones at these addresses, and something that goes on besides."""
    lecturer = Lecturer(told)
    await lecturer.do("PUT", "/slide", {"slide": 3, "place": 2, "html": SLIDE})
    poll = {"question": "05-turn", "text": "Where?", "choices": ["left", "right"], "unit": ""}
    await lecturer.do("PUT", "/poll", poll)
    flooding = asyncio.create_task(flooding)
    came = await asyncio.gather(*(attend(told, n, where) for n, where in enumerate(addresses)))
    during = await lecturer.do("GET", "/poll")
    await flooding
    assert len(came) == len(addresses)
    assert during["counts"] == [PHONES // 2, PHONES // 2]
    assert during["phones"] == PHONES
    assert await lecturer.do("GET", "/poll") == during, "the flood has voted"
    await lecturer.do("POST", "/end")


@pytest.mark.parametrize("connections", [2000, pytest.param(10_000, marks=pytest.mark.slow)])
def test_two_hundred_phones_see_and_vote_while_connections_flood_in(tmp_path, connections):
    addresses, served = [f"127.0.{1 + n // 100}.{1 + n % 100}" for n in range(PHONES)], []
    with lecture(tmp_path) as told:
        run(hold(told, addresses, flood(told, served, connections)))
    assert served
    assert set(served) <= {0, 400, 403, 429}


def test_two_hundred_phones_behind_one_address_all_come_in_at_once(tmp_path):
    with lecture(tmp_path) as told:
        alone = hold(told, ["127.0.1.1"] * PHONES, asyncio.sleep(0))
        run(alone)
