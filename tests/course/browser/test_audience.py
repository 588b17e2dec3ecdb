"""Audience of a lecture: the lecturer's deck, and a phone of 390 pixels."""

import contextlib
import functools
import http.server
import json
import threading

import pytest

from classroom.audience import server_start
from tests.course.browser.audience import LECTURE, Files, Hall
from tests.course.browser.watching import faults

pytestmark = pytest.mark.slow


@pytest.fixture
def notebook_page():
    """The address of the lecturer's page."""
    served = functools.partial(Files, directory=LECTURE)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), served) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


@pytest.fixture
def hall(browser, notebook_page, tmp_path, monkeypatch):
    monkeypatch.setenv("JUPYTER_RUNTIME_DIR", str(tmp_path))
    made = Hall(browser, notebook_page)
    yield made
    with contextlib.suppress(Exception):
        made.deck.evaluate("deck.ended.emit()")
    made.close()
    state = tmp_path / "slamlab-audience.json"
    if state.exists():
        with contextlib.suppress(OSError):
            server_start._request(json.loads(state.read_text()), "POST", "/end")


def test_a_phone_follows_the_slide_and_looks_back_but_never_ahead(hall):
    hall.open()
    phone = hall.join()
    phone.get_by_role("heading", name="Odometry").wait_for()
    assert phone.locator("#slide math msub").count() == 1
    hall.go(1)
    phone.get_by_role("heading", name="Two").wait_for()
    text = phone.locator("#slide").inner_text()
    assert "x = 1 < 2" in text
    for hidden in ("second step", "notes", "later fragment", "not shown", "only what is in sight",
                   "[1]", "run", "¶", "bad"):  # fmt: skip
        assert hidden not in text
    alts = phone.locator("#slide img").evaluate_all("all => all.map((one) => one.alt)")
    assert alts == ["A drawing.", "A sketch.", "A map."]
    phone.wait_for_function(
        "[...document.querySelectorAll('#slide img')].every((one) => one.naturalWidth > 0)"
    )
    assert phone.get_by_role("button", name="next").is_disabled()
    phone.get_by_role("button", name="previous").click()
    phone.get_by_role("heading", name="Odometry").wait_for()
    assert phone.get_by_role("button", name="previous").is_disabled()
    hall.go(1, 1)  # who looks back is not disturbed
    hall.join().get_by_text("second step").wait_for()
    hall.go(2)
    phone.get_by_text("Earlier slide: 1").wait_for()
    phone.get_by_role("button", name="current").click()
    phone.get_by_text("What does").first.wait_for()
    phone.get_by_role("button", name="previous").click()
    phone.get_by_text("second step").wait_for()
    assert hall.errors == hall.foreign_requests == []


def test_the_class_is_asked_and_its_answers_are_bars(hall):
    hall.open()
    phones = []
    for number in ("1 phone connected.", "2 phones connected."):
        phones.append(hall.join())
        hall.deck.get_by_text(number).wait_for()
    hall.ask()
    for phone, letter in zip(phones, "AB", strict=True):
        phone.get_by_role("button", name=letter, exact=False).first.wait_for()
        button = phone.locator(".choices button").nth("AB".index(letter))
        assert button.bounding_box()["height"] >= 44
        button.click()
        phone.get_by_text("Your answer was received.").wait_for()
        assert button.get_attribute("aria-pressed") == "true"
    assert phones[0].locator(".choices button math").count() == 1
    hall.deck.get_by_text("2 answers, 2 phones").wait_for()
    phones[1].locator(".choices button").nth(0).click()  # changed
    hall.deck.get_by_role("button", name="show bars").click()
    hall.deck.locator(".slamlab-bars li", has_text="A").get_by_text("2", exact=True).wait_for()
    hall.deck.get_by_role("button", name="show of hands").click()
    hall.deck.get_by_role("spinbutton", name="B").fill("7")
    hall.deck.get_by_role("button", name="count them").click()
    hall.deck.locator(".slamlab-bars li", has_text="B").get_by_text("7", exact=True).wait_for()
    hall.deck.get_by_role("button", name="hide bars").click()
    assert hall.deck.locator(".slamlab-bars").count() == 0
    hall.deck.get_by_role("button", name="close the poll").click()
    phones[0].get_by_text("9 answers.").wait_for()
    assert phones[0].locator(".choices").count() == 0
    hall.deck.get_by_role("button", name="done").click()
    phones[0].locator("#poll").wait_for(state="hidden")
    assert hall.errors == hall.foreign_requests == []


def test_a_number_is_asked_for_and_a_comma_is_understood(hall):
    hall.open()
    phone = hall.join()
    hall.ask(slide=3)
    field = phone.get_by_label("Your number [m]")
    field.fill("far")
    phone.get_by_role("button", name="send").click()
    phone.get_by_text("Enter a number").wait_for()
    field.fill("2,5")
    field.press("Enter")
    phone.get_by_text("Your answer was received.").wait_for()
    assert hall.deck.get_by_role("button", name="show of hands").count() == 0
    hall.deck.get_by_role("button", name="close the poll").click()
    phone.get_by_text("2.5 m").wait_for()
    hall.deck.get_by_text("2.5 m", exact=True).wait_for()


@pytest.fixture
def asked(hall):
    """The lecturer's page, whose class is asked a question with choices."""
    hall.open()
    hall.ask()
    hall.deck.get_by_text("0 answers, 0 phones").wait_for()
    return hall.deck


def test_a_lecturer_counting_hands_is_not_called_back_by_a_late_poll(asked):
    held = []
    asked.route("**/poll/close", lambda route: held.append(route))
    asked.get_by_role("button", name="close the poll").click()
    asked.get_by_role("button", name="show of hands").click()
    asked.keyboard.press("1")
    held[0].continue_()
    asked.locator(".slamlab-bars").wait_for()
    asked.keyboard.press("End")
    asked.keyboard.type("2")
    assert asked.get_by_role("spinbutton", name="A").input_value() == "012"
    asked.get_by_role("button", name="back").click()
    asked.get_by_role("button", name="done").click()  # it is closed


def test_a_lecturer_counting_hands_goes_on_while_the_class_does_not_answer(asked):
    asked.get_by_role("button", name="show of hands").click()
    hands = asked.get_by_role("spinbutton", name="B")
    hands.fill("3")
    failed = []
    asked.on("requestfailed", lambda request: failed.append(request))
    asked.route("**/poll", lambda route: route.abort())
    asked.get_by_text("does not respond").wait_for()
    while len(failed) < 2:
        asked.wait_for_timeout(50)
    asked.keyboard.press("End")
    asked.keyboard.type("4")
    assert hands.input_value() == "34"


def test_a_figure_that_comes_late_takes_nobody_from_the_question(hall):
    hall.open()
    hall.deck.get_by_role("button", name="hide").click()
    hall.go(2)
    button = hall.deck.get_by_role("button", name="ask the class")
    button.focus()
    hall.deck.evaluate("deck.changed.emit()")
    assert button.evaluate("(one) => one === document.activeElement")
    hall.deck.keyboard.press("Enter")
    hall.deck.get_by_text("0 answers, 0 phones").wait_for()


def test_a_reader_who_looks_back_stays_when_a_lecture_restarts(hall):
    hall.open()
    phone = hall.join()
    phone.get_by_role("heading", name="Odometry").wait_for()
    hall.go(1)
    phone.get_by_role("heading", name="Two").wait_for()
    phone.locator("#previous").focus()
    phone.route("**/state/*", lambda route: route.fulfill(status=403))
    hall.go(2)
    phone.get_by_label("Code on the lecturer's screen").wait_for()
    assert phone.evaluate("document.activeElement.id") == "previous"


def test_the_end_of_the_lecture_is_announced_in_words(hall):
    hall.open()
    phone = hall.join()
    hall.deck.evaluate("deck.ended.emit()")
    hall.deck.get_by_role("button", name="End it for the class").click()
    phone.get_by_text("The lecture has ended.").wait_for()
    assert hall.deck.get_by_text("The class is still open").count() == 0
    assert hall.deck.locator(".slamlab-class").count() == 0


def test_a_deck_that_was_left_and_started_again_has_its_class(hall):
    hall.open()
    phone = hall.join()
    hall.ask()
    phone.locator(".choices button").first.wait_for()
    hall.deck.evaluate("deck.startAgain()")
    phone.locator("#poll").wait_for(state="hidden")
    assert hall.deck.get_by_text("The class is still open").count() == 0
    hall.go(1)
    phone.get_by_role("heading", name="Two").wait_for()
    hall.go(2)
    hall.deck.get_by_role("button", name="ask the class").click()
    phone.locator(".choices button").first.wait_for()
    assert hall.errors == hall.foreign_requests == []


def test_a_question_is_asked_closed_and_put_away_by_one_key(hall):
    hall.open()
    phone = hall.join()
    hall.deck.get_by_role("button", name="hide").click()
    hall.go(2)
    hall.deck.keyboard.press("q")
    phone.locator(".choices button").nth(1).click()
    message = "deck.classStatus == '1 answer, 1 phone: A 0, B 1. Press q to {}.'"
    hall.deck.wait_for_function(message.format("close the poll and show the bars"))
    hall.deck.keyboard.press("q")
    phone.get_by_text("One answer.").wait_for()
    hall.deck.locator(".slamlab-bars li").first.wait_for()
    hall.deck.wait_for_function(message.format("remove the poll"))
    hall.deck.keyboard.press("q")
    phone.locator("#poll").wait_for(state="hidden")
    assert hall.deck.evaluate("deck.classStatus") == "Press q to ask the class."
    hall.go(1)
    assert hall.deck.evaluate("deck.classStatus") == ""


def test_a_phone_that_loses_the_network_comes_back_by_itself(hall):
    hall.open()
    phone = hall.join()
    phone.context.set_offline(True)
    hall.go(1)
    phone.get_by_text("No connection. Trying again").wait_for()
    phone.context.set_offline(False)
    phone.get_by_role("heading", name="Two").wait_for()
    phone.reload()  # with the cookie it has
    phone.get_by_role("heading", name="Two").wait_for()


def test_a_wrong_code_is_reported(hall):
    hall.open()
    phone = hall.phone()
    phone.get_by_label("Code on the lecturer's screen").fill("AAAAAAAA")
    phone.get_by_role("button", name="join").click()
    phone.get_by_text("The code is wrong.").wait_for()
    assert hall.started["code"] not in phone.content()
    hall.deck.get_by_text("Phones cannot reach this address").wait_for()  # on this machine only
    assert hall.deck.get_by_role("img", name="QR code of").count() == 0


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [320, 390])
def test_nothing_on_the_phone_keeps_anybody_out_or_is_wider_than_it(hall, scheme, width):
    hall.open()
    hall.deck.get_by_role("button", name="hide").click()
    phone = hall.phone(width=width, color_scheme=scheme)
    phone.get_by_label("Code on the lecturer's screen").wait_for()
    assert faults(phone) == []
    phone.keyboard.type(hall.started["code"])  # the field has the focus
    phone.keyboard.press("Enter")
    phone.get_by_text("Connected.").wait_for()
    hall.go(1)
    phone.get_by_role("heading", name="Two").wait_for()
    assert phone.locator(".scroll[tabindex] math").count() == 1, "a wide formula is out of reach"
    assert phone.evaluate("document.documentElement.scrollWidth") <= width
    assert faults(phone) == []
    hall.go(2)
    hall.deck.get_by_role("button", name="ask the class").click()
    phone.locator(".choices button").first.wait_for()
    assert faults(phone) == []
    phone.locator(".choices button").first.focus()
    phone.keyboard.press("Enter")
    phone.get_by_text("Your answer was received.").wait_for()
    assert phone.evaluate("document.documentElement.scrollWidth") <= width
    hall.deck.get_by_role("button", name="close the poll").click()
    phone.get_by_text("One answer.").wait_for()
    assert faults(phone) == []


def test_nothing_that_the_lecturer_sees_of_the_class_keeps_anybody_out(hall):
    hall.open()
    assert faults(hall.deck, "#layer") == []
    hall.ask()
    hall.deck.get_by_role("button", name="show bars").click()
    hall.deck.locator(".slamlab-bars li").first.wait_for()
    assert faults(hall.deck, "#layer") == []
