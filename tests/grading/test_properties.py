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
FIXED_GATE = slip("15-liars", "gate-of-one-size")
WHO = {
    "takes in what is far off": ("03-ghosts", GATE.format(near="v[0]**2 > 9 * S[0, 0]")),
    "refuses ghosts on one side": ("03-ghosts", GATE.format(near="v[0] < 3 * S[0, 0]**0.5")),
    "takes in half of everything": ("03-ghosts", slip("03-ghosts", "one-share")),
    "refuses by R alone": ("03-ghosts", GATE.format(near="v[0]**2 < R[0, 0]")),
    "leaves out the pushes": ("03-ghosts", edited("03-ghosts", ("        x = x + u\n", ""))),
    "does not use the dock": ("01-home", slip("01-home", "dock not used")),
    "begins anew in the dock": ("01-home", slip("01-home", "rows at the dock only")),
    "leaves the way beyond": ("01-home", slip("01-home", "way beyond not mended")),
    "trusts the wheels": ("04-unsure-drive", slip("04-unsure-drive", "wheels-trusted")),
    "trusts all loops": ("15-liars", slip("15-liars", "all-trusted")),
    "trusts no loop": ("15-liars", slip("15-liars", "refused-without-drift")),
}
TOLD = {
    "takes in what is far off": {"turned-round"},
    "refuses ghosts on one side": {"one-sided"},
    "takes in half of everything": {"alike"},
    "refuses by R alone": {"refuses"},
    "leaves out the pushes": {"no-push"},
    "does not use the dock": {"not in the dock"},
    "begins anew in the dock": {"leaps home"},
    "leaves the way beyond": {"lost beyond"},
    "trusts the wheels": {"wheels-trusted"},
    "trusts all loops": {"all-pull"},
    "trusts no loop": {"none-used"},
}


@pytest.mark.parametrize("who", WHO)
def test_a_property_is_told_of_who_has_it(who):
    id, source = WHO[who]
    for seed in (OPEN_SEED, b"said 1", b"said 2", b"said 3"):
        assert {OF[id].verdict(source, seed).diagnosis} == TOLD[who]
