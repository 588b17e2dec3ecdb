"""Access control and limits of the HTTP server."""

import asyncio
import contextlib
import functools
import json

import pytest
from tornado.websocket import WebSocketHandler

from slamlab.live.web_server import http_server
from slamlab.live.web_server.rate_limits import Rate
from slamlab.live.web_server.sessions import BearerToken, Sessions
from tests.slamlab.web_server.client import Client, parsed, run

METHODS = ["GET", "HEAD", "POST", "PUT", "DELETE", "PATCH", "OPTIONS"]
HANDSHAKE = {
    "Upgrade": "websocket",
    "Connection": "Upgrade",
    "Sec_WebSocket_Version": "13",
    "Sec_WebSocket_Key": "dGhlIHNhbXBsZSBub25jZQ==",
}


class Echo(http_server.ProtectedHandler):
    """A protected route, which answers every method with the request's body."""

    async def get(self):
        await self.respond({"inside": True})

    async def post(self):
        await self.respond(self.json_body())

    head = delete = patch = get
    put = post


class Open(Echo):
    is_public = True


class Socket(http_server.ProtectedHandler, WebSocketHandler):
    """A WebSocket that echoes messages."""

    def open(self):
        self.write_message("inside")

    def on_message(self, message):
        self.write_message(message)


class Large(http_server.ProtectedHandler):
    """A response too large for any buffer."""

    async def get(self):
        await self.respond(bytes(30_000_000), "image/png")


ROUTES = [(r"/inside", Echo), (r"/open", Open), (r"/socket", Socket), (r"/large", Large)]


@contextlib.contextmanager
def running_server(access, origin=None, **bounds):
    made = http_server.AccessControl(access, origin, http_server.ServerLimits(**bounds))
    server, port = http_server.listen(ROUTES, made)
    try:
        yield Client(port)
    finally:
        server.stop()


def in_a_loop(test):
    @functools.wraps(test)
    def in_it(**fixtures):
        run(test(**fixtures))

    return in_it


def logged_in(sessions, client):
    client.cookie = f"{sessions.name}={sessions.log_in(sessions.token, '127.0.0.1')}"
    return client


@contextlib.contextmanager
def inside(**bounds):
    """A client of a running server that has logged in."""
    sessions = Sessions("test")
    with running_server(sessions, **bounds) as client:
        yield logged_in(sessions, client)


@in_a_loop
async def test_a_cookie_is_required_except_for_public_paths():
    sessions = Sessions("test")
    with running_server(sessions) as client:
        assert (await client.ask("GET", "/inside"))[0] == 403
        assert (await client.ask("GET", "/nowhere"))[0] == 403, (
            "an anonymous client learns which paths exist"
        )
        for wrong in ("test=", "test=x", f"other={sessions.token}", f"test={sessions.token}"):
            assert (await client.ask("GET", "/inside", Cookie=wrong))[0] == 403
        logged_in(sessions, client)
        assert (await client.ask("GET", "/inside"))[0] == 200
        assert (await client.ask("GET", "/nowhere"))[0] == 404


HOSTS = ["localhost:{}", "evil.example", "127.0.0.1", "127.0.0.1:1", "127.0.0.2:{}"]
HOSTS += ["evil.example:{}", ""]


@pytest.mark.parametrize("path", ["/inside", "/open", "/socket"])
@in_a_loop
async def test_a_host_header_other_than_the_own_address_is_refused(path):
    with inside() as client:
        socket = HANDSHAKE | {"Origin": f"http://{client.own}"} if path == "/socket" else {}
        for host in HOSTS:
            asked = await client.ask("GET", path, Host=host.format(client.port), **socket)
            assert asked[0] in (400, 403), host
        assert (await client.ask("GET", path, drop=["host"], **socket))[0] in (400, 403)
        old = f"GET {path} HTTP/1.0\r\ncookie: {client.cookie}\r\n\r\n"
        assert parsed(await client.send(old.encode()))[0] in (400, 403)
        both = f"Host: {client.own}\r\nHost: evil.example\r\nConnection: close"
        two = f"GET {path} HTTP/1.1\r\n{both}\r\n\r\n"
        assert parsed(await client.send(two.encode()))[0] in (0, 400, 403)


FOREIGN = ["http://evil.example", "null", "http://127.0.0.1"]
FOREIGN += ["https://{}", "http://{}.evil.example", "http://{}/"]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("path", ["/inside", "/open"])
@in_a_loop
async def test_a_foreign_origin_is_refused_for_every_method(method, path):
    with inside() as client:
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
async def test_a_foreign_origin_cannot_open_a_websocket():
    with inside() as client:
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
async def test_a_websocket_opens_for_the_own_origin_and_closes_at_a_long_message():
    with inside(message=100) as client:
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
        rest = await reader.read()  # ends because the server closes
        assert bytes(100) not in rest
        writer.close()


@in_a_loop
async def test_a_bearer_token_is_accepted_from_its_own_origin_only():
    key, page = BearerToken(), "http://localhost:8888"
    with running_server(key, origin=page) as client:
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
async def test_every_response_has_the_security_headers():
    sessions = Sessions("test")
    with running_server(sessions) as client:
        for path in ("/open", "/inside", "/nowhere"):
            _, headers, _ = await client.ask("GET", path)
            assert headers["content-security-policy"].startswith("default-src 'self';")
            assert headers["x-content-type-options"] == "nosniff"
            assert headers["referrer-policy"] == "no-referrer"
            assert headers["cache-control"] == "no-store"
            assert "server" not in headers
            assert "etag" not in headers


@in_a_loop
async def test_requests_above_the_size_limits_are_refused():
    with inside(header=2000, body=500) as client:
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
async def test_a_body_that_is_no_json_object_is_a_bad_request():
    with inside() as client:
        for body in NO_OBJECTS:
            status, _, answer = await client.ask("POST", "/inside", body)
            assert (status, list(json.loads(answer))) == (400, ["error"])
        assert (await client.ask("POST", "/inside", b"a=1", Content_Type="text/plain"))[0] == 400
        form = {"Content_Type": "multipart/form-data; boundary=x"}
        assert (await client.ask("POST", "/inside", b"--x\r\n\r\n--x--", **form))[0] == 400
        assert (await client.ask("POST", "/inside", {}))[0] == 200


@in_a_loop
async def test_a_slow_request_times_out():
    with inside(header_timeout=0.3, body_timeout=0.3) as client:
        for begun in (
            b"",
            b"GET /inside HTTP/1.1\r\nHost: 127",
            f"POST /open HTTP/1.1\r\nHost: {client.own}\r\nContent-Length: 9\r\n\r\n{{".encode(),
        ):
            answered = await client.send(begun)  # returns because the server closes
            assert parsed(answered)[0] in (0, 400, 408)


@in_a_loop
async def test_a_response_that_is_not_received_times_out():
    with inside(response_timeout=0.3) as client:
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
async def test_the_rate_limit_applies_to_each_client():
    sessions = Sessions("test")
    with running_server(sessions, client=Rate(5, 0), address=Rate(7, 0)) as client:
        logged_in(sessions, client)
        statuses = [(await client.ask("GET", "/inside"))[0] for _ in range(8)]
        assert statuses == [200] * 5 + [429] * 3
        other = logged_in(sessions, Client(client.port))
        assert (await other.ask("GET", "/inside"))[0] == 200
        anonymous = Client(client.port, "127.0.3.1")
        statuses = [(await anonymous.ask("GET", "/open"))[0] for _ in range(9)]
        assert statuses == [200] * 7 + [429] * 2
        assert (await Client(client.port, "127.0.3.2").ask("GET", "/open"))[0] == 200


@in_a_loop
async def test_the_rate_limit_applies_to_all_clients_together():
    sessions = Sessions("test")
    with running_server(sessions, all_addresses=Rate(20, 0)) as client:
        statuses = [
            (await Client(client.port, f"127.0.4.{n}").ask("GET", "/open"))[0] for n in range(1, 31)
        ]
        assert statuses == [200] * 20 + [429] * 10
        assert (await logged_in(sessions, client).ask("GET", "/inside"))[0] == 200


PATHS = ["/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd", "/open/../inside"]
PATHS += ["/open%00", "/phone.js/..", "/.git/config", "/open/", "http://evil.example/open", "*"]
PATHS += ["/open\\..\\x"]


@in_a_loop
async def test_paths_outside_the_table_are_refused():
    with inside() as client:
        for path in PATHS:
            status, _, body = await client.ask("GET", path)
            assert status in (0, 400, 403, 404), path
            assert b"root:" not in body


@in_a_loop
async def test_a_stopped_server_does_not_answer():
    sessions = Sessions("test")
    with running_server(sessions) as client:
        assert (await client.ask("GET", "/open"))[0] == 200
    assert (await client.ask("GET", "/open"))[0] == 0


def test_the_default_address_is_loopback():
    async def where():
        server, _ = http_server.listen(ROUTES, http_server.AccessControl(Sessions("test")))
        hosts = {socket.getsockname()[0] for socket in server._sockets.values()}
        server.stop()
        return hosts

    assert run(where()) == {"127.0.0.1"}
