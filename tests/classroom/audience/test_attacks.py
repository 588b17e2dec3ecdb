"""Attacks by a client on the phones' server and the lecturer's server."""

import asyncio
import base64
import contextlib
import io
import json

import pytest
from PIL import Image

from classroom.audience import lecturer_routes, phone_routes
from classroom.audience.lecture_state import LectureState
from classroom.audience.server import LECTURER_LIMITS
from slamlab.live.web_server import http_server
from slamlab.live.web_server.sessions import BearerToken, Sessions
from tests.slamlab.web_server.client import Client
from tests.slamlab.web_server.small_server import in_a_loop

PAGE = "http://localhost:8888"


class RunningLecture:
    """A lecture with both servers, in the event loop of the test."""

    def __init__(self):
        self.lecture, self.sessions, self.key = (
            LectureState(lambda: 0.0),
            Sessions("class"),
            BearerToken(),
        )
        own = http_server.AccessControl(self.key, PAGE, LECTURER_LIMITS)
        routes = lecturer_routes.routes(self.lecture, self.sessions)
        self.phone_server, self.port = http_server.listen(
            phone_routes.routes(self.lecture), http_server.AccessControl(self.sessions)
        )
        self.lecturer_server, self.lecturer_port = http_server.listen(routes, own)

    def phone(self):
        client = Client(self.port)
        sessions = self.sessions
        client.cookie = f"{sessions.name}={sessions.log_in(sessions.token, '127.0.0.1')}"
        return client

    async def do(self, method, path, message=None, **headers):
        shown = {"Origin": PAGE, "Authorization": f"Bearer {self.key.token}"} | headers
        return await Client(self.lecturer_port).ask(method, path, message, **shown)

    async def ask(self, choices=("left", "right")):
        choices = choices and list(choices)
        asked = {"question": "q", "text": "Where?", "choices": choices, "unit": "m"}
        assert (await self.do("PUT", "/poll", asked))[0] == 200
        return self.lecture.poll.number

    async def counts(self):
        return json.loads((await self.do("GET", "/poll"))[2])


@contextlib.contextmanager
def running_lecture():
    made = RunningLecture()
    try:
        yield made
    finally:
        made.phone_server.stop()
        made.lecturer_server.stop()


NO_CHOICES = 'null "0" "<script>alert(1)</script>" -1 2 0.0 1.5 true [0] {"a":0} NaN Infinity'
NO_NUMBERS = 'NaN Infinity -Infinity 1e400 -1e400 1e13 true null "1" "<b>" [1] {} 1' + "0" * 400


@pytest.mark.parametrize(
    ("choices", "wrong", "right"),
    [(("left", "right"), NO_CHOICES, (0, 1)), (None, NO_NUMBERS, (0, -1.5, 1e12, 5e-324))],
    ids=["one of the choices", "a finite number"],
)
@in_a_loop
async def test_a_vote_must_be_one_of_the_choices_or_a_finite_number(choices, wrong, right):
    with running_lecture() as here:
        number, phone = await here.ask(choices), here.phone()
        for text in wrong.split():
            body = f'{{"poll": {number}, "answer": {text}}}'.encode()
            assert (await phone.ask("POST", "/vote", body))[0] == 400, text
        assert (await phone.ask("POST", "/vote", b'{"poll": 1}'))[0] == 400
        assert (await here.counts())["answers"] == 0
        for answer in right:
            assert await phone.vote(number, answer) == 200
        assert (await here.counts())["answers"] == 1


@in_a_loop
async def test_each_client_has_one_vote_until_the_poll_is_closed():
    with running_lecture() as here:
        number, phone = await here.ask(), here.phone()
        for answer in (0, 0, 1, 0, 1):
            assert await phone.vote(number, answer) == 200
        assert (await here.counts())["counts"] == [0, 1]
        assert (await phone.state())["poll"]["mine"] == 1
        assert (await here.phone().state())["poll"]["mine"] is None
        assert (await phone.state())["poll"]["result"] is None, "counts are shown at the end"
        await here.do("PUT", "/hands", {"hands": [3, 4]})
        assert (await here.do("POST", "/poll/close"))[0] == 200
        assert await phone.vote(number, 0) == 409
        assert (await phone.state())["poll"]["result"]["counts"] == [3, 5]


@in_a_loop
async def test_only_an_open_poll_accepts_votes():
    with running_lecture() as here:
        phone = here.phone()
        assert await phone.vote(1, 0) == 409
        first = await here.ask()
        second = await here.ask()
        for number in (first, second + 1, 0, -1, str(second), None, [second]):
            assert await phone.vote(number, 0) == 409, number
        await here.do("DELETE", "/poll")
        assert await phone.vote(second, 0) == 409
        assert (await here.do("GET", "/poll"))[0] == 409


@in_a_loop
async def test_a_client_gets_one_cookie_http_only_and_same_site():
    with running_lecture() as here:
        phone = Client(here.port)
        status, headers, _ = await phone.ask("POST", "/login", {"key": here.sessions.code})
        parts = {part.strip().lower() for part in headers["set-cookie"].split(";")[1:]}
        assert status == 200 and {"httponly", "samesite=strict", "path=/"} <= parts
        assert here.sessions.token not in headers["set-cookie"]
        phone.cookie = headers["set-cookie"].partition(";")[0]
        for _ in range(2):
            status, headers, _ = await phone.ask("POST", "/login", {"key": here.sessions.token})
            assert (status, "set-cookie" in headers) == (200, False)
        assert here.sessions.client_count == 1


@in_a_loop
async def test_without_the_right_code_everything_is_refused():
    with running_lecture() as here:
        intruder = Client(here.port)
        for key in (None, 1, ["x"], {}, "", "AAAAAAAA"):
            assert await intruder.log_in(key) in (400, 403)
        assert intruder.cookie is None
        picture = "/picture/" + "0" * 32
        for path in ("/state/0", "/state/999999999", "/slide/0", picture, "/nothing"):
            assert (await intruder.ask("GET", path))[0] == 403, path
        assert await intruder.vote(1, 0) == 403


@in_a_loop
async def test_only_slides_that_were_shown_can_be_read():
    written = io.BytesIO()
    Image.new("RGB", (3, 2), "red").save(written, "PNG")
    picture = f"data:image/png;base64,{base64.b64encode(written.getvalue()).decode()}"
    with running_lecture() as here:
        phone = here.phone()
        for number in (2, 5):
            html = f"<p>{number}</p><img src='{picture}'>"
            await here.do("PUT", "/slide", {"slide": number, "place": 9, "html": html})
        state = await phone.state()
        assert (state["shown"], list(state["slides"])) == (5, ["2", "5"])
        for number in (0, 1, 3, 4, 6, 999):
            assert (await phone.ask("GET", f"/slide/{number}"))[0] == 404
        html = json.loads((await phone.ask("GET", "/slide/2"))[2])["html"]
        name = html.partition('src="')[2].partition('"')[0]
        status, headers, content = await phone.ask("GET", f"/{name}")
        assert (status, headers["content-type"]) == (200, "image/png")
        assert Image.open(io.BytesIO(content)).size == (3, 2)
        odd = "slide/-1 slide/2/.. slide/2.0 slide/2%20 slide/0002 picture/x picture/../phone.js"
        for path in [*odd.split(), f"{name}x", "state/x", "state/-1", "state/9999999999"]:
            assert (await phone.ask("GET", f"/{path}"))[0] == 404, path


@in_a_loop
async def test_a_waiting_phone_receives_changes_and_the_end():
    with running_lecture() as here:
        phone = here.phone()
        known = (await phone.state())["version"]
        waiting = asyncio.create_task(phone.ask("GET", f"/state/{known}"))
        await here.do("PUT", "/slide", {"slide": 0, "place": 1, "html": "<p>first</p>"})
        received = json.loads((await waiting)[2])
        assert (received["shown"], received["over"]) == (0, False)
        waiting = asyncio.create_task(phone.ask("GET", f"/state/{received['version']}"))
        await here.do("POST", "/end")
        received = json.loads((await waiting)[2])
        assert (received["over"], received["slides"], received["poll"]) == (True, {}, None)


@in_a_loop
async def test_phones_cannot_use_the_lecturers_routes_nor_the_reverse():
    with running_lecture() as here:
        phone, at_lecturer = here.phone(), Client(here.lecturer_port)
        at_lecturer.cookie = phone.cookie
        guessed = {"Authorization": f"Bearer {here.sessions.token}", "Origin": PAGE}
        for route in ("PUT /slide", "PUT /poll", "GET /poll", "POST /end", "GET /alive"):
            method, path = route.split()
            assert (await phone.ask(method, path, {}))[0] in (404, 405), route
            for shown in ({}, {"Origin": PAGE}, guessed):
                assert (await at_lecturer.ask(method, path, {}, **shown))[0] == 403
        assert await Client(here.port).log_in(here.key.token) == 403
        assert not here.lecture.over


ODD_SLIDES = [
    {},
    {"slide": 0},
    {"slide": 0, "place": 1, "html": None},
    *({"slide": odd, "place": 1, "html": ""} for odd in ("0", True, -1, 1000, 1.0)),
    *({"slide": 0, "place": odd, "html": ""} for odd in (None, "1", True, -1, 1000, 1.0)),
]
ODD_POLLS = [{}] + [
    {"question": "q", "text": "", "choices": choices, "unit": ""}
    for choices in (["a"], ["a"] * 9, [1, 2], "ab")
]
ODD_HANDS = [{}] + [
    {"hands": hands}
    for hands in ([1], [1, 2, 3], [1, -1], [1, 1.5], [1, True], [1, "<b>"], [1, 10**9])
]


@in_a_loop
async def test_invalid_requests_of_the_lecturer_are_refused():
    with running_lecture() as here:
        for message in ODD_SLIDES:
            assert (await here.do("PUT", "/slide", message))[0] == 400
        for message in ODD_POLLS:
            assert (await here.do("PUT", "/poll", message))[0] in (400, 409)
        for path, message in (("/hands", {"hands": [1, 2]}), ("/poll/close", None)):
            assert (await here.do("PUT" if message else "POST", path, message))[0] == 409
        await here.ask()
        for message in ODD_HANDS:
            assert (await here.do("PUT", "/hands", message))[0] in (400, 409)
        assert (await here.counts())["counts"] == [0, 0]


@in_a_loop
async def test_the_public_page_contains_no_secrets():
    with running_lecture() as here:
        await here.do("PUT", "/slide", {"slide": 0, "place": 1, "html": "<p>shown</p>"})
        for path in phone_routes.PAGE:
            status, _, body = await Client(here.port).ask("GET", path)
            assert status == 200
            for secret in (here.sessions.token, here.sessions.code, here.key.token, "shown</p>"):
                assert secret.encode() not in body
            assert b"http://" not in body.replace(b"http://www.w3.org/", b"")
            assert b"https://" not in body
