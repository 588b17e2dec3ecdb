"""A property of outputs is told of who has it, whatever was drawn: by the judge alone, no table."""

import pytest

from slamlab.exercises.task import OPEN_SEED
from tests.grading.saying import OF, edited, slip

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
    "takes in what is far off": (
        "03-ghosts",
        GATE.format(near="v[0]**2 > 9 * S[0, 0]"),
        "turned-round",
    ),
    "refuses ghosts on one side": (
        "03-ghosts",
        GATE.format(near="v[0] < 3 * S[0, 0]**0.5"),
        "one-sided",
    ),
    "takes in half of everything": ("03-ghosts", slip("03-ghosts", "one-share"), "alike"),
    "refuses by R alone": ("03-ghosts", GATE.format(near="v[0]**2 < R[0, 0]"), "refuses"),
    "leaves out the pushes": (
        "03-ghosts",
        edited("03-ghosts", ("        x = x + u\n", "")),
        "no-push",
    ),
    "does not use the dock": ("01-home", slip("01-home", "dock not used"), "not in the dock"),
    "leaps into the dock": ("01-home", slip("01-home", "rows at the dock only"), "leaps home"),
    "leaves the way beyond": ("01-home", slip("01-home", "way beyond not mended"), "lost beyond"),
    "trusts the wheels": (
        "04-unsure-drive",
        slip("04-unsure-drive", "wheels-trusted"),
        "wheels-trusted",
    ),
    "trusts all loops": ("15-liars", slip("15-liars", "all-trusted"), "all-pull"),
    "trusts no loop": ("15-liars", slip("15-liars", "refused-without-drift"), "none-used"),
}


@pytest.mark.parametrize("who", WHO)
def test_a_property_is_told_of_who_has_it(who):
    id, source, told = WHO[who]
    for seed in (OPEN_SEED, b"said 1", b"said 2", b"said 3"):
        assert OF[id].verdict(source, seed).diagnosis == told
