"""Phones on a JupyterHub: the attacks on the audience and the access control through the hub."""

import asyncio
import json

import pytest

from classroom.audience import phone_routes
from classroom.audience.lecture_state import LectureState
from classroom.audience.server import COOKIE
from classroom.hub import phones
from slamlab.live.web_server.sessions import Sessions
from tests.classroom.audience import test_attacks
from tests.classroom.hub.proxied import BASE, ProxiedClient, ProxiedLecture, published
from tests.slamlab.web_server.client import Client, parsed
from tests.slamlab.web_server.small_server import FOREIGN, HOSTS, METHODS, in_a_loop


@pytest.fixture(autouse=True)
def _through_the_hub(monkeypatch, tmp_path):
    direct = test_attacks.Client
    lectures = []

    def lecture():
        lectures.append(ProxiedLecture(tmp_path))
        return lectures[-1]

    def client(port):
        return (ProxiedClient if port == lectures[-1].port else direct)(port)

    monkeypatch.setattr(test_attacks, "RunningLecture", lecture)
    monkeypatch.setattr(test_attacks, "Client", client)
    monkeypatch.setattr(test_attacks, "Sessions", lambda name: Sessions(COOKIE))


# every attack on the audience is also tried through the hub
globals().update({name: f for name, f in vars(test_attacks).items() if name.startswith("test_")})


@in_a_loop
async def test_a_client_gets_one_cookie_http_only_and_same_site(tmp_path):
    """In place of the test above: the cookie is sent only to the pages of this lecture."""
    with published(phone_routes.routes(LectureState(lambda: 0.0)), tmp_path) as (port, sessions):
        status, headers, _ = await ProxiedClient(port).ask("POST", "/login", {"key": sessions.code})
        parts = {part.strip().lower() for part in headers["set-cookie"].split(";")[1:]}
        assert status == 200
        assert {"httponly", "samesite=strict", f"path={BASE}class"} <= parts


@pytest.fixture
def lecture_routes():
    return phone_routes.routes(LectureState(lambda: 0.0))


@in_a_loop
async def test_a_foreign_host_or_origin_is_refused(lecture_routes, tmp_path):
    with published(lecture_routes, tmp_path) as (port, sessions):
        client = ProxiedClient(port)
        assert await client.log_in(sessions.token) == 200
        state = "/state/999999999"
        assert (await client.ask("GET", state))[0] == 200
        for host in HOSTS:
            assert (await client.ask("GET", state, Host=host.format(port)))[0] in (400, 403), host
        for method in METHODS:
            for origin in FOREIGN:
                asked = await client.ask(method, state, Origin=origin.format(client.own))
                assert asked[0] in (403, 405) and b"shown" not in asked[2]
                assert "access-control-allow-origin" not in asked[1]
        for site in ("cross-site", "same-site"):
            assert (await client.ask("GET", state, Sec_Fetch_Site=site))[0] == 403


ELSEWHERE = ["/..", "/../lab", "/%2e%2e/lab", "//lab", "/@evil.example/", "/:80/", "/phone.js/.."]
ELSEWHERE += ["/phone.js?a=b#c", "/\\..\\lab", "/%00", "/phone.js%0d%0aX:y", "/;/", "é", "x", ".."]


@in_a_loop
async def test_no_path_leads_elsewhere_and_nothing_else_is_public(lecture_routes, tmp_path):
    with published(lecture_routes, tmp_path) as (port, _):
        for path in ELSEWHERE:
            status, headers, body = await ProxiedClient(port).ask("GET", path)
            assert status in (200, 400, 403, 404), path
            assert status != 200 or body == (await ProxiedClient(port).ask("GET", "/phone.js"))[2]
            assert "location" not in headers
        for path in ("", "classes", "api/class/", "proxy/1/class/", "../eve/class/"):
            assert (await Client(port).ask("GET", BASE + path))[0] == 404
        assert (await Client(port).ask("GET", f"{BASE}class"))[1]["location"] == f"{BASE}class/"


@in_a_loop
async def test_the_audience_server_gets_no_header_of_the_hub(tmp_path):
    received = []

    async def record(reader, writer):
        received.append((await reader.readuntil(b"\r\n\r\n")).decode().lower())
        writer.write(b"HTTP/1.1 200 OK\r\nContent-Length: 2\r\n\r\nok")
        writer.close()

    listening = await asyncio.start_server(record, "127.0.0.1", 0)
    inner = listening.sockets[0].getsockname()[1]
    with published([], tmp_path) as (port, _):
        phones.state_file().write_text(json.dumps({"ports": {"phones": inner}}))
        secret = f'jupyterhub-user-ada=s3cret; {COOKIE}="a\\012X: s3cret"; _xsrf=s3cret'
        headers = {"Cookie": secret, "Authorization": "token s3cret", "X_Real_IP": "9.9.9.9"}
        headers |= {"X_Forwarded_For": "8.8.8.8, 10.0.0.7", "X_Other": "s3cret"}
        assert (await ProxiedClient(port).ask("GET", "/x", **headers))[2] == b"ok"
    listening.close()
    assert "s3cret" not in received[0]
    assert "x-real-ip: 10.0.0.7" in received[0] and "9.9.9.9" not in received[0]


@in_a_loop
async def test_a_large_body_is_refused_before_it_is_received(lecture_routes, tmp_path):
    with published(lecture_routes, tmp_path) as (port, _):
        head = f"POST {BASE}class/login HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n"
        sent = f"{head}Content-Length: 1000000000\r\n\r\n".encode()
        assert parsed(await Client(port).send(sent))[0] in (0, 400, 413)


@in_a_loop
async def test_without_a_lecture_the_page_does_not_exist(lecture_routes, tmp_path):
    with published(lecture_routes, tmp_path) as (port, _):
        phones.state_file().write_text('{"ports": {"phones": 1}}')
        assert (await ProxiedClient(port).ask("GET", "/"))[0] == 404
        phones.state_file().unlink()
        assert (await ProxiedClient(port).ask("GET", "/"))[0] == 404
