"""Limits of the HTTP server: sizes, times, rates, paths."""

import asyncio
import contextlib
import json

from slamlab.live.web_server.rate_limits import Rate
from slamlab.live.web_server.sessions import Sessions
from tests.slamlab.web_server.client import Client, parsed
from tests.slamlab.web_server.small_server import (
    PATHS,
    in_a_loop,
    inside,
    logged_in,
    running_server,
)


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
