"""Who comes in, how often something may be done, whose connection gives way: in simulated time."""

import pytest

from slamlab.listening.crowd import Crowd, Hall
from slamlab.listening.door import LETTERS, Door, Refused
from slamlab.listening.rates import Bucket, Buckets, Rate


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


class Stream:
    """A connection that is open or closed."""

    def __init__(self):
        self.is_closed = False

    def close(self):
        self.is_closed = True

    def closed(self):
        return self.is_closed


def refused(door, given, address="10.0.0.1"):
    """HTTP's number for why a key is refused, 0 if it is not."""
    try:
        door.enter(given, address)
    except Refused as error:
        return error.status
    return 0


def wrong_codes(number):
    """Codes of which none is right, but for a chance of one in 10**7."""
    return (f"{n:08d}" for n in range(number))  # no code has a digit


def test_a_code_has_eight_letters_of_which_none_is_taken_for_another():
    codes = {Door("x").code for _ in range(200)}
    assert len(codes) == 200
    assert all(len(code) == 8 and set(code) <= set(LETTERS) for code in codes)
    assert not set("ILOQUV0125") & set(LETTERS)
    assert len({Door("x").token for _ in range(200)}) == 200
    assert len(Door("x").token) == 22  # 128 bits in base64


@pytest.mark.parametrize("write", [str, str.lower, " {} ".format, lambda c: f"{c[:4]}-{c[4:]}"])
def test_a_code_is_taken_as_people_write_it(write):
    door = Door("x", Clock())
    assert refused(door, write(door.code)) == 0


@pytest.mark.parametrize(
    "given", ["", "A", "\ud800", "é" * 8, "\0" * 8, 12_500 * "ABCDEFGH"], ids=range(6)
)
def test_what_is_no_code_is_refused(given):
    assert refused(Door("x", Clock()), given) == 403


def test_a_part_of_a_code_or_of_a_token_does_not_open():
    door = Door("x", Clock())
    for part in (
        door.code[:-1],
        door.code + "A",
        door.token[:-1],
        door.token.lower(),
        door.token + "=",
    ):
        assert refused(door, part) == 403


def test_guessing_by_force_gets_a_few_tries_whatever_the_number_of_guessers():
    clock = Clock()
    door = Door("x", clock)
    tried = 0
    for second in range(0, 7200, 10):
        clock.now = float(second)
        for guesser in range(40):
            for guess in wrong_codes(500):
                status = refused(door, guess, f"10.0.0.{guesser}")
                if status == 429:
                    break
                tried += 1
    assert tried < 40_000
    assert tried / len(LETTERS) ** 8 < 2e-6


def test_a_class_behind_one_address_comes_in_though_each_mistypes_once():
    door = Door("x", Clock())
    for _ in range(200):
        assert refused(door, "ABCDEFGH") in (403, 0)
        assert refused(door, door.code) == 0


def test_the_qr_code_lets_in_even_when_a_guesser_has_used_up_the_tries_of_the_address():
    door = Door("x", Clock())
    assert [refused(door, guess) for guess in wrong_codes(1000)][-1] == 429
    assert refused(door, door.token) == 0
    assert refused(door, door.code, "10.0.0.2") == 0, "a guesser keeps another address out"


def test_after_too_many_tries_a_moment_is_waited_for_and_no_more():
    clock = Clock()
    door = Door("x", clock)
    for guess in wrong_codes(1000):
        refused(door, guess)
    assert refused(door, door.code) == 429
    clock.now = 2.0
    assert refused(door, door.code) == 0


def test_a_key_that_is_good_for_one_use_is_of_no_use_when_it_is_shown_again():
    door = Door("x", Clock(), admits=1)
    cookie = door.enter(door.token, "10.0.0.1")
    assert refused(door, door.token) == refused(door, door.code) == 503
    assert door.clients == 1
    assert cookie not in (door.token, door.code)


def test_so_many_come_in_and_no_more():
    door = Door("x", Clock(), admits=50)
    assert len({door.enter(door.token, "10.0.0.1") for _ in range(50)}) == 50
    assert refused(door, door.token) == 503


def test_a_bucket_gives_its_burst_and_then_its_rate():
    clock = Clock()
    bucket = Bucket(Rate(3, 0.5), clock)
    assert [bucket.take() for _ in range(5)] == [True] * 3 + [False] * 2
    clock.now = 4.0
    assert [bucket.take() for _ in range(3)] == [True, True, False]
    clock.now = 1e6
    assert [bucket.take() for _ in range(5)] == [True] * 3 + [False] * 2


def test_buckets_keep_so_many_and_forget_who_asked_longest_ago():
    buckets = Buckets(Rate(1, 0), Rate(1e9, 0), Clock(), most=100)
    assert buckets.take("first")
    assert all(buckets.take(str(n)) for n in range(1000))
    assert len(buckets._of) == 100
    assert not buckets.take("999")


def test_when_there_are_too_many_connections_who_holds_most_gives_one_up():
    hall = Hall(20)
    honest = [Stream() for _ in range(10)]
    for n, stream in enumerate(honest):
        hall.enter(f"honest {n}", stream)
    flood = [Stream() for _ in range(1000)]
    for stream in flood:
        hall.enter("flood", stream)
    assert not any(stream.is_closed for stream in honest)
    assert [stream.is_closed for stream in flood] == [True] * 990 + [False] * 10


def test_a_connection_that_is_closed_takes_no_room():
    hall = Hall(5)
    for _ in range(100):
        stream = Stream()
        hall.enter("one", stream)
        stream.close()
    kept = [Stream() for _ in range(5)]
    for stream in kept:
        hall.enter("one", stream)
    assert not any(stream.is_closed for stream in kept)


def test_strangers_push_out_nobody_who_has_come_in():
    crowd = Crowd(200)
    inside = [Stream() for _ in range(50)]
    for n, stream in enumerate(inside):
        crowd.enter("10.0.0.1", stream)
        crowd.admit("10.0.0.1", f"cookie {n}", stream)
        crowd.admit("10.0.0.1", f"cookie {n}", stream)  # its next request
    flood = [Stream() for _ in range(5000)]
    for n, stream in enumerate(flood):
        crowd.enter(f"10.0.{n % 250}.1", stream)
    assert not any(stream.is_closed for stream in inside)
    assert 0 < sum(not stream.is_closed for stream in flood) < 200
