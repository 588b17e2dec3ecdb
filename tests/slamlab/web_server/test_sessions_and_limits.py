"""Login, rate limits and connection limits, in simulated time."""

import pytest

from slamlab.live.web_server.connection_limits import ConnectionLimits, ConnectionPool
from slamlab.live.web_server.rate_limits import ClientBuckets, Rate, TokenBucket
from slamlab.live.web_server.sessions import LETTERS, LoginRefused, Sessions


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


def refused(sessions, given, address="10.0.0.1"):
    """HTTP status of a refused login, 0 if it is accepted."""
    try:
        sessions.log_in(given, address)
    except LoginRefused as error:
        return error.status
    return 0


def wrong_codes(number):
    """Codes that are wrong."""
    return (f"{n:08d}" for n in range(number))  # no code has a digit


def test_a_code_has_eight_letters_of_which_none_is_taken_for_another():
    codes = {Sessions("x").code for _ in range(200)}
    assert len(codes) == 200
    assert all(len(code) == 8 and set(code) <= set(LETTERS) for code in codes)
    assert not set("ILOQUV0125") & set(LETTERS)
    assert len({Sessions("x").token for _ in range(200)}) == 200
    assert len(Sessions("x").token) == 22  # 128 bits in base64


@pytest.mark.parametrize("write", [str, str.lower, " {} ".format, lambda c: f"{c[:4]}-{c[4:]}"])
def test_a_code_is_accepted_in_any_usual_spelling(write):
    sessions = Sessions("x", Clock())
    assert refused(sessions, write(sessions.code)) == 0


@pytest.mark.parametrize(
    "given", ["", "A", "\ud800", "é" * 8, "\0" * 8, 12_500 * "ABCDEFGH"], ids=range(6)
)
def test_a_wrong_code_is_refused_and_so_is_a_part_of_a_code_or_token(given):
    sessions = Sessions("x", Clock())
    code, token = sessions.code, sessions.token
    for wrong in (given, code[:-1], code + "A", token[:-1], token.lower(), token + "="):
        assert refused(sessions, wrong) == 403


def test_brute_force_is_limited_whatever_the_number_of_addresses():
    clock = Clock()
    sessions = Sessions("x", clock)
    tried = 0
    for second in range(0, 7200, 10):
        clock.now = float(second)
        for guesser in range(40):
            for guess in wrong_codes(500):
                status = refused(sessions, guess, f"10.0.0.{guesser}")
                if status == 429:
                    break
                tried += 1
    assert tried < 40_000
    assert tried / len(LETTERS) ** 8 < 2e-6


def test_a_class_behind_one_address_can_log_in_although_each_mistypes_once():
    sessions = Sessions("x", Clock())
    for _ in range(200):
        assert refused(sessions, "ABCDEFGH") in (403, 0)
        assert refused(sessions, sessions.code) == 0


def test_an_address_with_too_many_attempts_is_refused_for_a_moment_but_for_the_token():
    clock = Clock()
    sessions = Sessions("x", clock)
    assert [refused(sessions, guess) for guess in wrong_codes(1000)][-1] == 429
    assert refused(sessions, sessions.code) == 429 and refused(sessions, sessions.token) == 0
    assert refused(sessions, sessions.code, "10.0.0.2") == 0, "a guesser blocks another address"
    clock.now = 2.0
    assert refused(sessions, sessions.code) == 0


@pytest.mark.parametrize("allowed", [1, 50])
def test_the_number_of_clients_is_limited(allowed):
    sessions = Sessions("x", Clock(), max_clients=allowed)
    cookies = {sessions.log_in(sessions.token, "10.0.0.1") for _ in range(allowed)}
    assert refused(sessions, sessions.token) == refused(sessions, sessions.code) == 503
    assert len(cookies) == sessions.client_count == allowed
    assert not cookies & {sessions.token, sessions.code}


def test_a_token_bucket_allows_its_burst_and_then_its_rate():
    clock = Clock()
    bucket = TokenBucket(Rate(3, 0.5), clock)
    assert [bucket.take() for _ in range(5)] == [True] * 3 + [False] * 2
    clock.now = 4.0
    assert [bucket.take() for _ in range(3)] == [True, True, False]
    clock.now = 1e6
    assert [bucket.take() for _ in range(5)] == [True] * 3 + [False] * 2


def test_buckets_forget_the_client_whose_last_request_is_oldest():
    buckets = ClientBuckets(Rate(1, 0), Rate(1e9, 0), Clock(), max_clients=100)
    assert buckets.take("first")
    assert all(buckets.take(str(n)) for n in range(1000))
    assert len(buckets._buckets) == 100
    assert not buckets.take("999")


def test_above_the_capacity_the_client_with_most_connections_loses_one():
    pool = ConnectionPool(20)
    regular = [Stream() for _ in range(10)]
    for n, stream in enumerate(regular):
        pool.add(f"regular {n}", stream)
    flood = [Stream() for _ in range(1000)]
    for stream in flood:
        pool.add("flood", stream)
    assert not any(stream.is_closed for stream in regular)
    assert [stream.is_closed for stream in flood] == [True] * 990 + [False] * 10


def test_closed_connections_do_not_count():
    pool = ConnectionPool(5)
    for _ in range(100):
        stream = Stream()
        pool.add("one", stream)
        stream.close()
    kept = [Stream() for _ in range(5)]
    for stream in kept:
        pool.add("one", stream)
    assert not any(stream.is_closed for stream in kept)


def test_anonymous_connections_do_not_close_authenticated_ones():
    limits = ConnectionLimits(200)
    inside = [Stream() for _ in range(50)]
    for n, stream in enumerate(inside):
        limits.add("10.0.0.1", stream)
        limits.authenticate("10.0.0.1", f"cookie {n}", stream)
        limits.authenticate("10.0.0.1", f"cookie {n}", stream)  # its next request
    flood = [Stream() for _ in range(5000)]
    for n, stream in enumerate(flood):
        limits.add(f"10.0.{n % 250}.1", stream)
    assert not any(stream.is_closed for stream in inside)
    assert 0 < sum(not stream.is_closed for stream in flood) < 200
