"""What a live run gives to whom: nothing without its token or from another origin."""

import asyncio
import contextlib
import json

import pytest

from slamlab.console.serving import serve
from tests.console.test_desk import At
from tests.listening.client import Client, parsed, run
from tests.listening.test_guard import HANDSHAKE
from tests.patience import PATIENCE


@contextlib.asynccontextmanager
async def served(**more):
    """A desk that is served, a client without a cookie, and the token."""
    at, address = At(**more), asyncio.get_running_loop().create_future()
    task = asyncio.create_task(serve(at.desk, 0, address.set_result))
    host, token = (await asyncio.wait_for(address, PATIENCE)).split("/#")
    try:
        yield at, Client(int(host.rpartition(":")[2])), token
    finally:
        at.desk.over.set()
        await task


async def shaken(client, **headers):
    """The status of a WebSocket's handshake."""
    sent = {"Host": client.own, "Origin": f"http://{client.own}"} | HANDSHAKE
    if client.cookie:
        sent["Cookie"] = client.cookie
    sent |= headers
    lines = [f"{name.replace('_', '-')}: {value}" for name, value in sent.items() if value]
    raw = "\r\n".join(["GET /socket HTTP/1.1", *lines, "", ""]).encode()
    return parsed(await client.say(raw, lambda reader: reader.readuntil(b"\r\n\r\n")))[0]


def test_without_the_token_or_from_elsewhere_there_is_nothing():
    async def asked():
        async with served() as (_, client, token):
            assert await shaken(client) == 403
            assert await client.enter("guessed") == 403
            assert await client.enter(token) == 200
            assert await shaken(client) == 101
            assert await shaken(client, Origin="http://elsewhere.example") == 403
            assert await shaken(client, Origin=None) == 403
            assert await shaken(client, Host="slam.example") == 403
            client.cookie = None
            assert await shaken(client) == 403
            for path in ("/socket", "/map", "/film", "/../pyproject.toml"):
                assert (await client.ask("GET", path))[0] in (403, 404)

    run(asked())


def test_the_page_is_given_and_holds_nothing_of_the_run():
    async def asked():
        async with served() as (_, client, token):
            for path in ("/", "/console.js", "/console.css", "/favicon.ico"):
                status, headers, body = await client.ask("GET", path)
                assert status == 200 and headers["content-security-policy"]
                assert token.encode() not in body and b"situation" not in body

    run(asked())


class Talk:
    """A page's end of a socket, by tornado's own client."""

    def __init__(self, socket):
        self.socket, self.state = socket, {}

    async def until(self, kind):
        """The next message of a kind."""
        while True:
            message = await asyncio.wait_for(self.socket.read_message(), PATIENCE)
            assert message is not None, "closed"
            if isinstance(message, bytes):
                size = int.from_bytes(message[:4], "little")
                said = json.loads(message[4 : 4 + size])
            else:
                said = json.loads(message)
            if said["kind"] == "state":
                self.state = said
            if said["kind"] == kind:
                return said

    async def until_drives(self, who):
        """Wait until the page says that somebody drives, or nobody."""
        while self.state.get("drives") != who:
            await self.until("state")

    def say(self, kind, **said):
        self.socket.write_message(json.dumps({"kind": kind} | said))


async def talk(client, token):
    from tornado.httpclient import HTTPRequest
    from tornado.websocket import websocket_connect

    assert await client.enter(token) == 200
    headers = {"Origin": f"http://{client.own}", "Cookie": client.cookie}
    asked = HTTPRequest(f"ws://{client.own}/socket", headers=headers)
    return Talk(await websocket_connect(asked))


def test_two_pages_look_one_drives_and_when_it_is_closed_the_robot_stands():
    async def driven():
        async with served(speed=100) as (at, client, token):
            one, two = await talk(client, token), await talk(client, token)
            for page in (one, two):
                assert (await page.until("state"))["drivable"]
                page.say("ready", calm=False)
                assert "step" in (await page.until("frame"))["status"]
            one.say("line", text="3, 0")
            assert "driving 3 m" in (await one.until("answer"))["text"]
            two.say("key", name="left")
            assert "somebody else drives" in (await two.until("answer"))["text"]
            await two.until_drives("another page")
            one.socket.close()
            await two.until_drives("")
            assert not at.desk.control.moving

    run(driven())


@pytest.mark.parametrize(
    "said", ["", "nonsense", "[]", "null", '{"kind": 7}', '{"kind": "drawn", "number": "x"}',
             '{"kind": "line"}', '{"kind": "press", "name": "x"}', "[" * 1000]
)  # fmt: skip
def test_nonsense_is_passed_over(said):
    async def nonsense():
        async with served() as (_, client, token):
            page = await talk(client, token)
            page.socket.write_message(said)
            page.say("press", name="stop")
            while (await page.until("answer"))["text"] != "the robot stands":
                pass

    run(nonsense())


def test_who_talks_without_end_is_shown_out():
    async def flood():
        async with served() as (_, client, token):
            page = await talk(client, token)
            with contextlib.suppress(Exception):
                for _ in range(3000):
                    page.say("renew")
            while await asyncio.wait_for(page.socket.read_message(), PATIENCE) is not None:
                pass

    run(flood())
