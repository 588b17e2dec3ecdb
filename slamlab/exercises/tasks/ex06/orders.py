"""The same calls of a filter in a wrong order: the mistakes of whoever puts the parts together."""

import numpy as np

from slamlab import models
from slamlab.exercises.tasks.ex06.ends import whole
from slamlab.filters.mak import MAK
from slamlab.models import jacobians, noise


def ordered(ends, *orders):
    """Whether the end of a run is that of the same calls in one of these orders.

    Parameters
    ----------
    ends : Ends
    orders : str, calls of one step. p predict; u update what is known; a augment what is new; m
        both, in the scan's order. Three mistakes on top of m: d what was augmented is updated as
        well; e a predict before each update; s a predict before each sight. And w: update what is
        known by now, what is new included

    Returns
    -------
    function of inputs and outputs
    """

    def matches(inputs, outputs):
        return whole(inputs, outputs) and any(
            _like(ends, inputs, outputs, order) for order in orders
        )

    return matches


def _like(ends, inputs, outputs, order):
    for run in (0, 1):
        mak = _filtered(inputs, run, order, ends.kind)
        (x,), (P,) = ends.in_order(inputs, mak.x[None], mak.P[None], np.array([mak.ids]))
        (got,), (claimed,) = (part[run, None] for part in ends.of(inputs, outputs))
        sigma, off = np.sqrt(np.diag(P)), ends.wrapped(got - x)
        if max((abs(off) / sigma).max(), (abs(claimed - P) / np.outer(sigma, sigma)).max()) > 0.1:
            return False
    return True


def _filtered(inputs, run, order, kind):
    """A run of the filter with the calls of each step in some order."""
    mak = MAK(inputs["x"][run], inputs["P"], kind=kind)
    for u, seen, z in zip(inputs["u"][run], inputs["seen"], inputs["z"][run], strict=True):
        known = mak.ids
        for what in order:
            if what == "p":
                _predict(mak, u, inputs["C"])
                continue
            for i, one in zip(seen.tolist(), z, strict=True):
                if i < 0:
                    continue
                if what == "s" or (what == "e" and i in known):
                    _predict(mak, u, inputs["C"])
                if i not in known and what in "amdes":
                    mak.add([i], [one], inputs["R"])
                if what in "dw" or (i in known and what in "umes"):
                    mak.update([i], [one], inputs["R"])
    return mak


def _predict(mak, u, C):
    pose = mak.pose
    mak.predict(models.f_odometry(pose, u), noise.Q(jacobians.W_odometry(pose, u), C))
