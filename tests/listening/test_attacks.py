"""What somebody in the hall may try against the phones' listener and the control."""

import asyncio
import base64
import contextlib
import io
import json

import pytest
from PIL import Image

from slamlab.audience import control, phones
from slamlab.audience.lecture import Lecture
from slamlab.audience.process import FOR_CONTROL
from slamlab.listening import guard
from slamlab.listening.door import Door, Key
from tests.listening.client import Client
from tests.listening.test_guard import in_a_loop

PAGE = "http://localhost:8888"


class Hall:
    """A lecture with both its listeners, in the loop of the test."""

    def __init__(self):
        self.lecture, self.door, self.key = Lecture(lambda: 0.0), Door("class"), Key()
        own = guard.Guard(self.key, PAGE, FOR_CONTROL)
        routes = control.routes(self.lecture, self.door)
        self.phones, self.port = guard.listen(phones.routes(self.lecture), guard.Guard(self.door))
        self.control, self.control_port = guard.listen(routes, own)

    def phone(self):
        client = Client(self.port)
        client.cookie = f"class={self.door.enter(self.door.token, '127.0.0.1')}"
        return client

    async def do(self, method, path, said=None, **headers):
        shown = {"Origin": PAGE, "Authorization": f"Bearer {self.key.token}"} | headers
        return await Client(self.control_port).ask(method, path, said, **shown)

    async def ask(self, choices=("left", "right")):
        asked = {
            "question": "q",
            "text": "Where?",
            "choices": choices and list(choices),
            "unit": "m",
        }
        assert (await self.do("PUT", "/poll", asked))[0] == 200
        return self.lecture.poll.number

    async def counts(self):
        return json.loads((await self.do("GET", "/poll"))[2])


@contextlib.contextmanager
def hall():
    made = Hall()
    try:
        yield made
    finally:
        made.phones.stop()
        made.control.stop()


def picture():
    """A small picture as a page names it."""
    written = io.BytesIO()
    Image.new("RGB", (3, 2), "red").save(written, "PNG")
    return f"data:image/png;base64,{base64.b64encode(written.getvalue()).decode()}"


NO_CHOICES = [
    None,
    "0",
    "<b>0</b>",
    "<script>alert(1)</script>",
    -1,
    2,
    0.0,
    1.5,
    True,
    [0],
    {"a": 0},
    10**400,
]


@in_a_loop
async def test_a_vote_is_one_of_the_choices_and_nothing_else():
    with hall() as here:
        number, phone = await here.ask(), here.phone()
        for answer in NO_CHOICES:
            assert await phone.vote(number, answer) == 400, answer
        for body in (
            b'{"poll": 1, "answer": NaN}',
            b'{"poll": 1, "answer": Infinity}',
            b'{"poll": 1}',
        ):
            assert (await phone.ask("POST", "/vote", body))[0] == 400
        assert (await here.counts())["answers"] == 0


@in_a_loop
async def test_a_number_is_finite():
    with hall() as here:
        number, phone = await here.ask(None), here.phone()
        for text in (
            "NaN",
            "Infinity",
            "-Infinity",
            "1e400",
            "-1e400",
            "1e13",
            "1" + "0" * 400,
            "true",
            "null",
            '"1"',
            '"<b>"',
            "[1]",
            "{}",
        ):
            body = f'{{"poll": {number}, "answer": {text}}}'.encode()
            assert (await phone.ask("POST", "/vote", body))[0] == 400, text
        assert (await here.counts())["answers"] == 0
        for answer in (0, -1.5, 1e12, 5e-324):
            assert await phone.vote(number, answer) == 200
        assert (await here.counts())["answers"] == 1


@in_a_loop
async def test_a_cookie_has_one_vote_which_may_be_changed_until_the_poll_is_closed():
    with hall() as here:
        number, phone = await here.ask(), here.phone()
        for answer in (0, 0, 1, 0, 1):
            assert await phone.vote(number, answer) == 200
        assert (await here.counts())["counts"] == [0, 1]
        assert (await phone.state())["poll"]["mine"] == 1
        assert (await here.phone().state())["poll"]["mine"] is None
        assert (await here.do("POST", "/poll/close"))[0] == 200
        assert await phone.vote(number, 0) == 409
        assert (await here.counts())["counts"] == [0, 1]


@in_a_loop
async def test_a_poll_that_is_closed_gone_or_none_takes_no_vote():
    with hall() as here:
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
async def test_counts_are_seen_by_phones_only_once_the_poll_is_closed():
    with hall() as here:
        number, phone = await here.ask(), here.phone()
        await phone.vote(number, 0)
        assert (await phone.state())["poll"]["result"] is None
        await here.do("PUT", "/hands", {"hands": [3, 4]})
        await here.do("POST", "/poll/close")
        assert (await phone.state())["poll"]["result"]["counts"] == [4, 4]


@in_a_loop
async def test_who_has_a_cookie_and_shows_the_code_again_gets_no_second_one():
    with hall() as here:
        phone = Client(here.port)
        assert await phone.enter(here.door.code) == 200
        for _ in range(5):
            status, headers, _ = await phone.ask("POST", "/enter", {"key": here.door.token})
            assert (status, "set-cookie" in headers) == (200, False)
        assert here.door.clients == 1


@in_a_loop
async def test_the_cookie_is_out_of_reach_of_scripts_and_of_other_sites():
    with hall() as here:
        _, headers, _ = await Client(here.port).ask("POST", "/enter", {"key": here.door.code})
        parts = {part.strip().lower() for part in headers["set-cookie"].split(";")[1:]}
        assert {"httponly", "samesite=strict", "path=/"} <= parts
        assert here.door.token not in headers["set-cookie"]


@pytest.mark.parametrize("key", [None, 1, ["x"], {}, "", "AAAAAAAA", "\0", "<script>"])
@in_a_loop
async def test_a_wrong_code_gets_nothing(key):
    with hall() as here:
        stranger = Client(here.port)
        assert await stranger.enter(key) in (400, 403)
        assert stranger.cookie is None
        for path in (
            "/state/0",
            "/state/999999999",
            "/slide/0",
            "/picture/" + "0" * 32,
            "/nothing",
        ):
            assert (await stranger.ask("GET", path))[0] == 403, path
        assert await stranger.vote(1, 0) == 403


@in_a_loop
async def test_only_what_was_shown_is_given_and_nothing_ahead():
    with hall() as here:
        phone = here.phone()
        for number in (2, 5):
            await here.do(
                "PUT",
                "/slide",
                {"slide": number, "place": 9, "html": f"<p>{number}</p><img src='{picture()}'>"},
            )
        state = await phone.state()
        assert (state["shown"], list(state["slides"])) == (5, ["2", "5"])
        for number in (0, 1, 3, 4, 6, 999):
            assert (await phone.ask("GET", f"/slide/{number}"))[0] == 404
        html = json.loads((await phone.ask("GET", "/slide/2"))[2])["html"]
        name = html.partition('src="')[2].partition('"')[0]
        status, headers, content = await phone.ask("GET", f"/{name}")
        assert (status, headers["content-type"]) == (200, "image/png")
        assert Image.open(io.BytesIO(content)).size == (3, 2)
        for odd in (
            "/slide/-1",
            "/slide/2/..",
            "/slide/2.0",
            "/slide/2%20",
            "/slide/0002",
            "/picture/x",
            "/picture/../phone.js",
            f"/{name}x",
            "/state/x",
            "/state/-1",
            "/state/9999999999",
        ):
            assert (await phone.ask("GET", odd))[0] == 404, odd


@in_a_loop
async def test_a_phone_that_waits_hears_of_a_change_and_of_the_end():
    with hall() as here:
        phone = here.phone()
        known = (await phone.state())["version"]
        waiting = asyncio.create_task(phone.ask("GET", f"/state/{known}"))
        await here.do("PUT", "/slide", {"slide": 0, "place": 1, "html": "<p>first</p>"})
        heard = json.loads((await waiting)[2])
        assert (heard["shown"], heard["over"]) == (0, False)
        waiting = asyncio.create_task(phone.ask("GET", f"/state/{heard['version']}"))
        await here.do("POST", "/end")
        heard = json.loads((await waiting)[2])
        assert (heard["over"], heard["slides"], heard["poll"]) == (True, {}, None)


@in_a_loop
async def test_a_phone_controls_nothing_and_the_page_s_key_opens_no_phone_s_door():
    with hall() as here:
        phone = here.phone()
        for method, path in (
            ("PUT", "/slide"),
            ("PUT", "/poll"),
            ("GET", "/poll"),
            ("POST", "/end"),
            ("GET", "/alive"),
        ):
            assert (await phone.ask(method, path, {}))[0] == 404, (
                "of the control at the phones' port"
            )
            at_control = Client(here.control_port)
            at_control.cookie = phone.cookie
            for shown in (
                {},
                {"Origin": PAGE},
                {"Authorization": f"Bearer {here.door.token}", "Origin": PAGE},
            ):
                assert (await at_control.ask(method, path, {}, **shown))[0] == 403
        assert await Client(here.port).enter(here.key.token) == 403
        assert not here.lecture.over


ODD_SLIDES = [
    {},
    {"slide": 0},
    {"slide": 0, "place": 1, "html": None},
    *({"slide": odd, "place": 1, "html": ""} for odd in ("0", True, -1, 1000, 1.0)),
    *({"slide": 0, "place": odd, "html": ""} for odd in (None, "1", True, -1, 1000, 1.0)),
]
ODD_POLLS = [
    {},
    {"question": "q", "text": "", "choices": ["a"], "unit": ""},
    {"question": "q", "text": "", "choices": ["a"] * 9, "unit": ""},
    {"question": "q", "text": "", "choices": [1, 2], "unit": ""},
    {"question": "q", "text": "", "choices": "ab", "unit": ""},
]
ODD_HANDS = [
    {},
    {"hands": [1]},
    {"hands": [1, 2, 3]},
    {"hands": [1, -1]},
    {"hands": [1, 1.5]},
    {"hands": [1, True]},
    {"hands": [1, "<b>"]},
    {"hands": [1, 10**9]},
]


@in_a_loop
async def test_the_control_says_what_it_cannot_do_and_goes_on():
    with hall() as here:
        for said in ODD_SLIDES:
            assert (await here.do("PUT", "/slide", said))[0] == 400
        for said in ODD_POLLS:
            assert (await here.do("PUT", "/poll", said))[0] in (400, 409)
        for path, said in (("/hands", {"hands": [1, 2]}), ("/poll/close", None)):
            assert (await here.do("PUT" if said else "POST", path, said))[0] == 409
        await here.ask()
        for said in ODD_HANDS:
            assert (await here.do("PUT", "/hands", said))[0] in (400, 409)
        assert (await here.counts())["counts"] == [0, 0]


@in_a_loop
async def test_the_page_that_is_shipped_is_given_to_everybody_and_holds_no_secret():
    with hall() as here:
        await here.do("PUT", "/slide", {"slide": 0, "place": 1, "html": "<p>shown</p>"})
        for path in phones.PAGE:
            status, _, body = await Client(here.port).ask("GET", path)
            assert status == 200
            for secret in (here.door.token, here.door.code, here.key.token, "shown</p>"):
                assert secret.encode() not in body
            assert b"http://" not in body.replace(b"http://www.w3.org/", b"")
            assert b"https://" not in body
