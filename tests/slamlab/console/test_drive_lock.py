"""The drive lock: one client holds it, as long as it is renewed."""

from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.live.console.drive_lock import LOCK_TIMEOUT, DriveLock, LockTaken

actions = st.sampled_from(["acquire", "renew", "release"])
waits = st.sampled_from([0, LOCK_TIMEOUT / 2, LOCK_TIMEOUT, 1.01 * LOCK_TIMEOUT])


@given(st.lists(st.tuples(actions, st.sampled_from("ab"), waits)))
def test_one_client_holds_it_until_it_releases_it_or_has_not_renewed_it_within_a_second(course):
    assert LOCK_TIMEOUT <= 1.0
    time, holder, renewed = SimpleNamespace(now=0.0), None, 0.0
    lock = DriveLock(clock=lambda: time.now)
    for action, who, wait in course:
        time.now += wait
        if time.now - renewed > LOCK_TIMEOUT:
            holder = None
        if action == "acquire" and holder not in (None, who):
            with pytest.raises(LockTaken, match="another client is driving"):
                lock.acquire(who)
        else:
            done = getattr(lock, action)(who)
            assert action != "renew" or done == (holder == who)
            if action == "acquire" or done:
                holder, renewed = who, time.now
            elif action == "release" and holder == who:
                holder = None
        assert lock.holder == holder
