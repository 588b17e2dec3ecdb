"""A diagnosis by a property of the outputs is right for every seed, without a table."""

import pytest

from classroom.exercises.task import OPEN_SEED
from tests.classroom.grading.program_verdicts import OF, edited, mistake

GATE = """
def wary_filter(x, P, us, zs, F, Q, H, R):
    xs, Ps = [], []
    for u, z in zip(us, zs):
        x, P = predict(x, P, F, Q)
        x = x + u
        v, S = innovation(x, P, z, H, R)
        if {near}:
            x, P = update(x, P, z, H, R)
        xs.append(x)
        Ps.append(P)
    return xs, Ps
"""
WHO = {
    "takes in what is far off": ("03-outliers", "v[0]**2 > 9 * S[0, 0]", "turned-round"),
    "refuses outliers on one side": ("03-outliers", "v[0] < 3 * S[0, 0]**0.5", "one-sided"),
    "refuses by R alone": ("03-outliers", "v[0]**2 < R[0, 0]", "refuses"),
    "takes in half of everything": ("03-outliers", "one-share", "alike"),
    "does not use the dock": ("01-home", "dock not used", "not in the dock"),
    "leaps into the dock": ("01-home", "rows at the dock only", "leaps home"),
    "leaves the way beyond": ("01-home", "way beyond not mended", "lost beyond"),
    "trusts the wheels": ("04-moments", "wheels-trusted", "wheels-trusted"),
    "trusts all loops": ("15-false-loops", "all-trusted", "all-pull"),
    "trusts no loop": ("15-false-loops", "refused-without-drift", "none-used"),
}
"""Task, what its gate holds for near or the name of a mistake, and the diagnosis."""


def diagnosed(id, source, reported):
    for seed in (OPEN_SEED, b"said 1", b"said 2", b"said 3"):
        assert OF[id].verdict(source, seed).diagnosis == reported


@pytest.mark.parametrize("who", WHO)
def test_a_property_of_an_answer_is_reported(who):
    id, how, reported = WHO[who]
    diagnosed(id, GATE.format(near=how) if "[0" in how else mistake(id, how), reported)


def test_control_inputs_that_are_left_out_are_reported():
    diagnosed("03-outliers", edited("03-outliers", ("        x = x + u\n", "")), "no-push")
