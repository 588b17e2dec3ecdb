"""Access control of the HTTP server: cookies, tokens, hosts, origins, headers."""

import pytest

from slamlab.live.web_server import http_server
from slamlab.live.web_server.sessions import BearerToken, Sessions
from tests.slamlab.web_server.client import parsed, run
from tests.slamlab.web_server.small_server import (
    FOREIGN,
    HANDSHAKE,
    HOSTS,
    METHODS,
    ROUTES,
    in_a_loop,
    inside,
    logged_in,
    running_server,
)


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
            status, _, body = await client.ask(method, path, {}, drop=["origin"])
            assert status == 403 and b"the request is not from this page" in body
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


def test_the_default_address_is_loopback():
    async def where():
        server, _ = http_server.listen(ROUTES, http_server.AccessControl(Sessions("test")))
        hosts = {socket.getsockname()[0] for socket in server._sockets.values()}
        server.stop()
        return hosts

    assert run(where()) == {"127.0.0.1"}
