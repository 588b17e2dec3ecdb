"""The guard of whatever listens: who gets on, and what bounds everybody."""

import asyncio
import contextlib
import functools
import json

import pytest
from tornado.websocket import WebSocketHandler

from slamlab.listening import guard
from slamlab.listening.door import Door, Key
from slamlab.listening.rates import Rate
from tests.listening.client import Client, parsed, run

METHODS = ["GET", "HEAD", "POST", "PUT", "DELETE", "PATCH", "OPTIONS"]
HANDSHAKE = {
    "Upgrade": "websocket",
    "Connection": "Upgrade",
    "Sec_WebSocket_Version": "13",
    "Sec_WebSocket_Key": "dGhlIHNhbXBsZSBub25jZQ==",
}


class Echo(guard.Guarded):
    """What is inside: it answers every method with what was sent."""

    async def get(self):
        await self.give({"inside": True})

    async def post(self):
        await self.give(self.body())

    head = delete = patch = get
    put = post


class Open(Echo):
    is_open = True


class Socket(guard.Guarded, WebSocketHandler):
    """A socket that sends back what it hears."""

    def open(self):
        self.write_message("inside")

    def on_message(self, message):
        self.write_message(message)


class Large(guard.Guarded):
    """An answer too large for any buffer on its way."""

    async def get(self):
        await self.give(bytes(30_000_000), "image/png")


ROUTES = [(r"/inside", Echo), (r"/open", Open), (r"/socket", Socket), (r"/large", Large)]


@contextlib.contextmanager
def listening(access, origin=None, **bounds):
    made = guard.Guard(access, origin, guard.Bounds(**bounds))
    server, port = guard.listen(ROUTES, made)
    try:
        yield Client(port)
    finally:
        server.stop()


def in_a_loop(test):
    @functools.wraps(test)
    def in_it(**fixtures):
        run(test(**fixtures))

    return in_it


def admitted(door, client):
    client.cookie = f"{door.name}={door.enter(door.token, '127.0.0.1')}"
    return client


@in_a_loop
async def test_who_has_a_cookie_gets_on_and_who_has_none_gets_nothing():
    door = Door("test")
    with listening(door) as client:
        assert (await client.ask("GET", "/inside"))[0] == 403
        assert (await client.ask("GET", "/nowhere"))[0] == 403, "a stranger learns what there is"
        for wrong in ("test=", "test=x", f"other={door.token}", f"test={door.token}"):
            assert (await client.ask("GET", "/inside", Cookie=wrong))[0] == 403
        admitted(door, client)
        assert (await client.ask("GET", "/inside"))[0] == 200
        assert (await client.ask("GET", "/nowhere"))[0] == 404


HOSTS = [
    "localhost:{}",
    "evil.example",
    "127.0.0.1",
    "127.0.0.1:1",
    "127.0.0.2:{}",
    "evil.example:{}",
    "",
]


@pytest.mark.parametrize("path", ["/inside", "/open", "/socket"])
@in_a_loop
async def test_a_host_that_is_not_the_address_of_arrival_gets_nothing(path):
    door = Door("test")
    with listening(door) as client:
        admitted(door, client)
        socket = HANDSHAKE | {"Origin": f"http://{client.own}"} if path == "/socket" else {}
        for host in HOSTS:
            asked = await client.ask("GET", path, Host=host.format(client.port), **socket)
            assert asked[0] in (400, 403), host
        assert (await client.ask("GET", path, drop=["host"], **socket))[0] in (400, 403)
        old = f"GET {path} HTTP/1.0\r\ncookie: {client.cookie}\r\n\r\n"
        assert parsed(await client.say(old.encode()))[0] in (400, 403)
        both = f"Host: {client.own}\r\nHost: evil.example\r\nConnection: close"
        two = f"GET {path} HTTP/1.1\r\n{both}\r\n\r\n"
        assert parsed(await client.say(two.encode()))[0] in (0, 400, 403)


FOREIGN = [
    "http://evil.example",
    "null",
    "http://127.0.0.1",
    "https://{}",
    "http://{}.evil.example",
    "http://{}/",
]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("path", ["/inside", "/open"])
@in_a_loop
async def test_a_foreign_origin_gets_nothing_by_any_method(method, path):
    door = Door("test")
    with listening(door) as client:
        admitted(door, client)
        for origin in FOREIGN:
            origin = origin.format(client.own)
            status, headers, body = await client.ask(method, path, {}, Origin=origin)
            assert status == 403, origin
            assert b"inside" not in body
            assert "access-control-allow-origin" not in headers
        if method not in ("GET", "HEAD"):
            assert (await client.ask(method, path, {}, drop=["origin"]))[0] == 403
        if method in ("GET", "HEAD"):  # a picture on a foreign page
            assert (await client.ask(method, path, Sec_Fetch_Site="cross-site"))[0] == 403
            assert (await client.ask(method, path, Sec_Fetch_Site="same-site"))[0] == 403


@in_a_loop
async def test_a_foreign_origin_opens_no_socket():
    door = Door("test")
    with listening(door) as client:
        admitted(door, client)
        for origin in FOREIGN:
            asked = await client.ask(
                "GET", "/socket", Origin=origin.format(client.own), **HANDSHAKE
            )
            assert asked[0] == 403
        assert (await client.ask("GET", "/socket", **HANDSHAKE))[0] == 403, "without any"
        client.cookie = None
        own = HANDSHAKE | {"Origin": f"http://{client.own}"}
        assert (await client.ask("GET", "/socket", **own))[0] == 403, "without a cookie"


@in_a_loop
async def test_a_socket_is_opened_from_here_and_closed_at_a_message_that_is_too_long():
    door = Door("test")
    with listening(door, message=100) as client:
        admitted(door, client)
        reader, writer = await client.connect()
        own = HANDSHAKE | {
            "Host": client.own,
            "Origin": f"http://{client.own}",
            "Cookie": client.cookie,
        }
        lines = [f"{name.replace('_', '-')}: {value}" for name, value in own.items()]
        writer.write("\r\n".join(["GET /socket HTTP/1.1", *lines, "", ""]).encode())
        head = await reader.readuntil(b"\r\n\r\n")
        assert b" 101 " in head
        assert await reader.readexactly(8) == b"\x81\x06inside"
        writer.write(b"\x81\x82\0\0\0\0ok")  # a frame with a mask of zeros
        assert await reader.readexactly(4) == b"\x81\x02ok"
        writer.write(b"\x81\xfe\x03\xe8\0\0\0\0" + bytes(1000))
        rest = await reader.read()  # ends because the listener closes
        assert bytes(100) not in rest
        writer.close()


@in_a_loop
async def test_a_key_is_shown_with_each_request_and_only_from_the_page_it_was_made_for():
    key, page = Key(), "http://localhost:8888"
    with listening(key, origin=page) as client:
        right = {"Origin": page, "Authorization": f"Bearer {key.token}"}
        status, headers, _ = await client.ask("GET", "/inside", **right)
        assert (status, headers["access-control-allow-origin"]) == (200, page)
        for change in (
            {"Origin": "http://localhost:9999"},
            {"Origin": f"http://{client.own}"},
            {"Authorization": "Bearer x"},
            {"Authorization": "Bearer é"},
        ):
            for method in ("GET", "POST", "PUT", "DELETE"):
                assert (await client.ask(method, "/inside", {}, **right | change))[0] == 403
        assert (await client.ask("GET", "/inside", drop=["origin"], **right))[0] == 403
        assert (await client.ask("GET", "/inside", drop=["authorization"], **right))[0] == 403
        asked = {"Origin": page, "Access_Control_Request_Method": "PUT"}
        status, headers, body = await client.ask("OPTIONS", "/inside", **asked)
        assert (status, body) == (204, b"")
        assert "PUT" in headers["access-control-allow-methods"]
        asked["Origin"] = "http://evil.example"
        assert (await client.ask("OPTIONS", "/inside", **asked))[0] == 403


@in_a_loop
async def test_every_answer_forbids_scripts_from_elsewhere_guessing_of_types_and_keeping():
    door = Door("test")
    with listening(door) as client:
        for path in ("/open", "/inside", "/nowhere"):
            _, headers, _ = await client.ask("GET", path)
            assert headers["content-security-policy"].startswith("default-src 'self';")
            assert headers["x-content-type-options"] == "nosniff"
            assert headers["referrer-policy"] == "no-referrer"
            assert headers["cache-control"] == "no-store"
            assert "server" not in headers
            assert "etag" not in headers


@in_a_loop
async def test_what_is_too_large_is_not_taken_in():
    door = Door("test")
    with listening(door, header=2000, body=500) as client:
        admitted(door, client)
        assert (await client.ask("POST", "/inside", {"a": "b"}))[0] == 200
        assert (await client.ask("POST", "/inside", {"a": "b" * 500}))[0] in (0, 400, 413)
        assert (await client.ask("GET", "/inside", X="y" * 3000))[0] in (0, 400, 431)
        assert (await client.ask("GET", "/inside?" + "y" * 3000))[0] in (0, 400, 414)
        chunked = await client.ask(
            "POST",
            "/inside",
            b"1f4\r\n" + b" " * 0x1F4 + b"\r\n1f4\r\n" + b" " * 0x1F4 + b"\r\n0\r\n\r\n",
            drop=["content-length"],
            Transfer_Encoding="chunked",
        )
        assert chunked[0] in (0, 400, 413)
        assert (await client.ask("POST", "/inside", b"{}", Content_Length="10000000000"))[0] in (
            0,
            400,
        )
        assert (await client.ask("POST", "/inside", b"{}", Content_Length="-1"))[0] in (0, 400)


NO_OBJECTS = [b"", b"[]", b"1", b"nul", b"{", b"[" * 400, b"\xff\xfe", b'{"a":' * 80, b"9" * 450]


@in_a_loop
async def test_what_is_no_object_is_answered_in_words_and_the_listener_goes_on():
    door = Door("test")
    with listening(door) as client:
        admitted(door, client)
        for body in NO_OBJECTS:
            status, _, answer = await client.ask("POST", "/inside", body)
            assert (status, list(json.loads(answer))) == (400, ["error"])
        assert (await client.ask("POST", "/inside", b"a=1", Content_Type="text/plain"))[0] == 400
        form = {"Content_Type": "multipart/form-data; boundary=x"}
        assert (await client.ask("POST", "/inside", b"--x\r\n\r\n--x--", **form))[0] == 400
        assert (await client.ask("POST", "/inside", {}))[0] == 200


@in_a_loop
async def test_who_sends_slowly_is_cut_off():
    door = Door("test")
    with listening(door, silence=0.3, slowness=0.3) as client:
        admitted(door, client)
        for begun in (
            b"",
            b"GET /inside HTTP/1.1\r\nHost: 127",
            f"POST /open HTTP/1.1\r\nHost: {client.own}\r\nContent-Length: 9\r\n\r\n{{".encode(),
        ):
            answered = await client.say(begun)  # returns because the listener closes
            assert parsed(answered)[0] in (0, 400, 408)


@in_a_loop
async def test_who_does_not_take_the_answer_is_cut_off():
    door = Door("test")
    with listening(door, taking=0.3) as client:
        admitted(door, client)
        reader, writer = await client.connect()
        asked = f"GET /large HTTP/1.1\r\nHost: {client.own}\r\nCookie: {client.cookie}\r\n\r\n"
        writer.write(asked.encode())
        await writer.drain()
        writer.transport.pause_reading()
        await asyncio.sleep(1)  # longer than it may take
        writer.transport.resume_reading()
        taken = 0
        with contextlib.suppress(OSError):
            while part := await reader.read(1_000_000):
                taken += len(part)
        assert taken < 30_000_000
        writer.close()


@in_a_loop
async def test_who_asks_too_often_waits_and_nobody_else_does():
    door = Door("test")
    with listening(door, client=Rate(5, 0), stranger=Rate(7, 0)) as client:
        admitted(door, client)
        statuses = [(await client.ask("GET", "/inside"))[0] for _ in range(8)]
        assert statuses == [200] * 5 + [429] * 3
        other = admitted(door, Client(client.port))
        assert (await other.ask("GET", "/inside"))[0] == 200
        stranger = Client(client.port, "127.0.3.1")
        statuses = [(await stranger.ask("GET", "/open"))[0] for _ in range(9)]
        assert statuses == [200] * 7 + [429] * 2
        assert (await Client(client.port, "127.0.3.2").ask("GET", "/open"))[0] == 200


@in_a_loop
async def test_all_together_are_bounded_too():
    door = Door("test")
    with listening(door, strangers=Rate(20, 0)) as client:
        statuses = [
            (await Client(client.port, f"127.0.4.{n}").ask("GET", "/open"))[0] for n in range(1, 31)
        ]
        assert statuses == [200] * 20 + [429] * 10
        assert (await admitted(door, client).ask("GET", "/inside"))[0] == 200


PATHS = [
    "/../../etc/passwd",
    "/%2e%2e/%2e%2e/etc/passwd",
    "//etc/passwd",
    "/open/../inside",
    "/open%00",
    "/phone.js/..",
    "/.git/config",
    "/open/",
    "http://evil.example/open",
    "*",
    "/open\\..\\x",
]


@in_a_loop
async def test_no_path_leads_anywhere_but_to_the_table():
    door = Door("test")
    with listening(door) as client:
        admitted(door, client)
        for path in PATHS:
            status, _, body = await client.ask("GET", path)
            assert status in (0, 400, 403, 404), path
            assert b"root:" not in body


@in_a_loop
async def test_a_listener_that_stops_answers_nobody_and_leaves_nothing_behind():
    door = Door("test")
    with listening(door) as client:
        assert (await client.ask("GET", "/open"))[0] == 200
    assert (await client.ask("GET", "/open"))[0] == 0


def test_the_listener_is_on_this_machine_alone_unless_told_otherwise():
    async def where():
        server, _ = guard.listen(ROUTES, guard.Guard(Door("test")))
        hosts = {socket.getsockname()[0] for socket in server._sockets.values()}
        server.stop()
        return hosts

    assert run(where()) == {"127.0.0.1"}
