"""The lease of the controls: one holds it, and only as long as it is renewed."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.console.lease import LENGTH, Lease, Taken


class Time:
    now = 0.0

    def __call__(self):
        return self.now


@pytest.fixture
def time():
    return Time()


@pytest.fixture
def lease(time):
    return Lease(clock=time)


def test_it_is_no_longer_than_a_second():
    assert LENGTH <= 1.0


def test_one_holds_it_and_another_is_told_so(lease):
    lease.take("a")
    assert lease.holder == "a"
    with pytest.raises(Taken, match="somebody else drives"):
        lease.take("b")
    assert lease.holder == "a"


def test_what_is_not_renewed_lapses_and_is_not_renewed_later(lease, time):
    lease.take("a")
    time.now = LENGTH
    assert lease.renew("a")
    time.now = 2 * LENGTH + 0.01
    assert lease.holder is None and not lease.renew("a")
    lease.take("b")
    assert not lease.renew("a") and lease.holder == "b"


def test_only_its_holder_gives_it_back(lease):
    lease.take("a")
    lease.release("b")
    assert lease.holder == "a"
    lease.release("a")
    assert lease.holder is None


deeds = st.tuples(st.sampled_from(["take", "renew", "release"]), st.sampled_from("ab"))


@given(st.lists(st.tuples(deeds, st.floats(0, 2))))
def test_whoever_holds_it_has_said_so_within_its_length(course):
    time, said = Time(), {}
    lease = Lease(clock=time)
    for (deed, who), wait in course:
        time.now += wait
        try:
            if getattr(lease, deed)(who) is not False and deed != "release":
                said[who] = time.now
        except Taken:
            assert lease.holder not in (None, who)
        holder = lease.holder
        assert holder is None or time.now - said[holder] <= LENGTH
