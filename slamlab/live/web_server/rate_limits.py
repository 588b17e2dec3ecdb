"""Rate limiting by token buckets."""

import time
from typing import NamedTuple


class Rate(NamedTuple):
    """Allowed rate: a burst at once, then a number of actions per second."""

    burst: float
    per_second: float


class TokenBucket:
    """Token bucket: each action takes a token, and time adds tokens up to the burst."""

    def __init__(self, rate, clock=time.monotonic):
        self._rate, self._clock = rate, clock
        self._tokens, self._updated = rate.burst, clock()

    def take(self):
        """Take a token; return False if none is left."""
        now = self._clock()
        refilled = self._tokens + (now - self._updated) * self._rate.per_second
        self._tokens, self._updated = min(self._rate.burst, refilled), now
        if self._tokens < 1:
            return False
        self._tokens -= 1
        return True


class ClientBuckets:
    """A token bucket for each of at most ``max_clients`` clients, and one shared by all."""

    def __init__(self, each, total, clock=time.monotonic, max_clients=4096):
        self._each, self._clock, self._max_clients = each, clock, max_clients
        self._buckets, self._total = {}, TokenBucket(total, clock)

    def take(self, client):
        """Take a token from the client's and the shared bucket; return False if either is empty."""
        bucket = self._buckets.pop(client, None) or TokenBucket(self._each, self._clock)
        self._buckets[client] = bucket  # the most recent client is last
        if len(self._buckets) > self._max_clients:
            del self._buckets[next(iter(self._buckets))]
        return bucket.take() and self._total.take()
