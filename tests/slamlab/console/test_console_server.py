"""The console's server: nothing without the token or from another origin."""

import asyncio
import contextlib
import json

import pytest

from slamlab.live.console.console_server import serve
from tests.slamlab.console.test_control_panel import At
from tests.slamlab.web_server.client import Client, parsed
from tests.slamlab.web_server.small_server import HANDSHAKE
from tests.timeouts import PATIENCE


@contextlib.asynccontextmanager
async def served(**more):
    """A server of a control panel, a client without a cookie, and the token."""
    at, address = At(**more), asyncio.get_running_loop().create_future()
    task = asyncio.create_task(serve(at.panel, 0, address.set_result))
    host, token = (await asyncio.wait_for(address, PATIENCE)).split("/#")
    try:
        yield at, Client(int(host.rpartition(":")[2])), token
    finally:
        at.panel.ended.set()
        await task


async def handshake(client, **headers):
    """Status of a WebSocket handshake."""
    sent = {"Host": client.own, "Origin": f"http://{client.own}"} | HANDSHAKE
    if client.cookie:
        sent["Cookie"] = client.cookie
    sent |= headers
    lines = [f"{name.replace('_', '-')}: {value}" for name, value in sent.items() if value]
    raw = "\r\n".join(["GET /socket HTTP/1.1", *lines, "", ""]).encode()
    return parsed(await client.send(raw, lambda reader: reader.readuntil(b"\r\n\r\n")))[0]


async def test_without_the_token_or_from_another_origin_everything_is_refused():
    async with served() as (_, client, token):
        assert await handshake(client) == 403
        assert await client.log_in("guessed") == 403
        assert await client.log_in(token) == 200
        assert await handshake(client) == 101
        assert await handshake(client, Origin="http://elsewhere.example") == 403
        assert await handshake(client, Origin=None) == 403
        assert await handshake(client, Host="slam.example") == 403
        client.cookie = None
        assert await handshake(client) == 403
        for path in ("/socket", "/map", "/film", "/../pyproject.toml"):
            assert (await client.ask("GET", path))[0] in (403, 404)


async def test_the_public_page_contains_nothing_of_the_run():
    async with served() as (_, client, token):
        for path in ("/", "/console.js", "/console.css", "/favicon.ico"):
            status, headers, body = await client.ask("GET", path)
            assert status == 200 and headers["content-security-policy"]
            assert token.encode() not in body and b"situation" not in body


class Talk:
    """A page's end of a WebSocket."""

    def __init__(self, socket):
        self.socket, self.state = socket, {}

    async def until(self, kind):
        """Wait for the next message of a kind."""
        while True:
            message = await asyncio.wait_for(self.socket.read_message(), PATIENCE)
            assert message is not None, "closed"
            if isinstance(message, bytes):
                size = int.from_bytes(message[:4], "little")
                content = json.loads(message[4 : 4 + size])
            else:
                content = json.loads(message)
            if content["kind"] == "state":
                self.state = content
            if content["kind"] == kind:
                return content

    async def until_driver(self, who):
        """Wait until the state names a driver, or none ("")."""
        while self.state.get("driver") != who:
            await self.until("state")

    def send(self, kind, **content):
        self.socket.write_message(json.dumps({"kind": kind} | content))


@contextlib.asynccontextmanager
async def connected(client, token):
    """A page that logs in and closes its WebSocket at the end."""
    from tornado.httpclient import HTTPRequest
    from tornado.websocket import websocket_connect

    assert await client.log_in(token) == 200
    headers = {"Origin": f"http://{client.own}", "Cookie": client.cookie}
    asked = HTTPRequest(f"ws://{client.own}/socket", headers=headers)
    socket = await websocket_connect(asked)
    try:
        yield Talk(socket)
    finally:
        socket.close()


async def test_when_the_driving_page_closes_the_robot_stops():
    async with (
        served(speed=100) as (at, client, token),
        connected(client, token) as one,
        connected(client, token) as two,
    ):
        for page in (one, two):
            assert (await page.until("state"))["drivable"]
            page.send("ready", calm=False)
            assert "step" in (await page.until("frame"))["status"]
        one.send("line", text="3, 0")
        assert "driving 3 m" in (await one.until("answer"))["text"]
        two.send("key", name="left")
        assert "another client is driving" in (await two.until("answer"))["text"]
        await two.until_driver("another page")
        one.socket.close()
        await two.until_driver("")
        assert not at.panel.control.moving


@pytest.mark.parametrize(
    "content", ["", "nonsense", "[]", "null", '{"kind": 7}', '{"kind": "drawn", "number": "x"}',
             '{"kind": "line"}', '{"kind": "press", "name": "x"}', "[" * 1000]
)  # fmt: skip
async def test_invalid_messages_are_ignored(content):
    async with served() as (_, client, token), connected(client, token) as page:
        page.socket.write_message(content)
        page.send("press", name="stop")
        while (await page.until("answer"))["text"] != "the robot stops":
            pass


async def test_a_page_that_sends_too_much_is_disconnected():
    async with served() as (_, client, token), connected(client, token) as page:
        with contextlib.suppress(Exception):
            for _ in range(3000):
                page.send("renew")
        while await asyncio.wait_for(page.socket.read_message(), PATIENCE) is not None:
            pass
