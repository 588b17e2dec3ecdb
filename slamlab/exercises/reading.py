"""How a case reads to a student, where a drive's arrays are not what a function takes and returns.

A generator travels as a seed, infinity and None as flags, rows of different length filled up; some
functions are called many times in a row. What is shown is said in the function's own terms.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

NONE = {"result": np.array("None")}


def _as_they_are(inputs, outputs):
    return inputs, outputs


@dataclass(frozen=True)
class Reading:
    """A reading of a case.

    Parameters
    ----------
    called : str, how the function is called, with the arrays that follow; "": once, with these
    returned : str, what the arrays are that came back
    shown : (inputs, outputs) of one row -> the arrays of each that are shown; outputs are empty
        where the function failed, and raise KeyError where an array is lacking
    """

    called: str = ""
    returned: str = "it returns"
    shown: Callable = _as_they_are


def _distance(inputs, outputs):
    """A distance, which may be infinite."""
    far = {"result": np.where(outputs["met"] > 0, outputs["distance"], np.inf)} if outputs else {}
    return inputs, far


def _cut(name):
    """A table without the rows that fill it up."""

    def shown(inputs, outputs):
        return inputs, {"result": outputs[name][: int(outputs["count"])]} if outputs else {}

    return shown


def _logarithms(inputs, outputs):
    """Logarithms that may be infinite or none."""
    if not outputs:
        return inputs, {}
    logs, finite = outputs["logs"], outputs["finite"]
    odd = np.select([finite == -1, finite == -2], [-np.inf, np.inf], np.nan)
    return inputs, {"result": np.where(finite > 0, logs, odd)}


def _one_draw(inputs, outputs):
    """The draw that strays most from n w, as indices in order."""
    if not outputs:
        return inputs, {}
    w, copies = inputs["weights"], outputs["copies"]
    k = np.abs(copies - len(w) * w).max(axis=1).argmax()
    drawn = np.repeat(np.arange(len(w)), copies[k].astype(int))
    return {"weights": w, "seed": inputs["seeds"][k]}, {"result": drawn}


def _sweep(inputs, outputs):
    """The rays of a packet, or None where it was refused."""
    refused = bool(outputs) and not outputs["taken"]
    return (inputs, NONE) if refused else _cut("rays")(inputs, outputs)


def _ring(inputs, outputs):
    """The box that is left, or None."""
    if not outputs:
        return inputs, {}
    return inputs, {"result": outputs["box"]} if outputs["left"] else NONE


STEPS = (
    "{} is called once for each step, each time with the rows and weights that it returned before "
    "and the same rng; call k has {}. It begins with rng = np.random.default_rng(seed), and is "
    "given"
)
READINGS = {
    "02-ray-wall": Reading(shown=_distance),
    "02-echo": Reading(shown=_distance),
    "02-to-points": Reading(shown=_cut("points")),
    "02-noise": Reading(
        "noisy is called with rng = np.random.default_rng([seed, 0]), so once more, and then with "
        "np.random.default_rng([seed, 1]); it is given"
    ),
    "05-map": Reading(returned="it returns a dict; its values p and P, by ascending ids, are"),
    "07-corridor": Reading(
        "step is called once for each entry of d, q, i, z and r, each time with the x and P that "
        "it returned before; at first it is given",
        "in the end it has returned",
    ),
    "08-associate": Reading(returned="it returns (−1 stands for None)"),
    "08-pillar": Reading(
        "fit_circle is given arc; find_pillar the rest, with rng = np.random.default_rng(seed):",
        "circle is fit_circle's centre and radius, pillar and inside are what find_pillar returns "
        "(found = 0 stands for None):",
    ),
    "09-life": Reading(
        "keep_book is called once for each row of scans, without the −1 that fill it up, each time "
        "with the book that it returned before, at first an empty one:",
        "after each call, for each id that is seen in some scan, ascending: whether it is inside "
        "the book, lives left and sightings there, how often it is among the used:",
    ),
    "10-ring": Reading(shown=_ring),
    "11-weigh": Reading(shown=_logarithms),
    "11-draw": Reading(
        "draw is called with rng = np.random.default_rng(seed) and",
        "the indices that it returns are, in order",
        _one_draw,
    ),
    "11-localise": Reading(
        STEPS.format("localise", "u = us[k] and z = zs[k]"),
        "rows[k] and weights[k] are what call k returned, counted from 0:",
    ),
    "11-kidnapped": Reading(STEPS.format("find_again", "u = us[k], p = ps[k] and z = zs[k]")),
    "12-relocalise": Reading(
        "relocalise is called once for the whole drive; scan k holds the first counts[k] rows of "
        "sights[k]. It is given"
    ),
    "14-nodes": Reading(shown=_cut("nodes")),
    "14-sweep": Reading(shown=_sweep),
    "15-step": Reading(
        "step is given poses, and edges (i, j, z, Λ) made of the other arrays' rows:"
    ),
    "15-liars": Reading(
        "close_loops is given poses, wheels (k, k + 1, measured[k], information[k]), and loops "
        "made of the other arrays' rows:"
    ),
}
"""Task's id to the reading of its cases; the others' arrays are arguments and results."""
