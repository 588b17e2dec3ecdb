"""Presentation of a failing case if its arrays are not the function's arguments and results.

A seed represents a generator, flags represent infinity and None, and ragged rows are padded."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

NONE = {"result": np.array("None")}


def _as_they_are(inputs, outputs):
    return inputs, outputs


@dataclass(frozen=True)
class CasePresentation:
    """The description of a failing case for the student.

    shown : (inputs, outputs) of one row -> the arrays to show. ``outputs`` is empty if the function
    failed. Raises KeyError if an array is missing."""

    called: str = ""  # how the function is called with the arrays that follow; "": once
    returned: str = "it returns"  # what the returned arrays are
    shown: Callable = _as_they_are


def _distance(inputs, outputs):
    far = {"result": np.where(outputs["met"] > 0, outputs["distance"], np.inf)} if outputs else {}
    return inputs, far


def _cut(name):
    def shown(inputs, outputs):
        return inputs, {"result": outputs[name][: int(outputs["count"])]} if outputs else {}

    return shown


def _logarithm(inputs, outputs):
    if not outputs:
        return inputs, {}
    finite = outputs["finite"]
    odd = np.select([finite == -1, finite == -2], [-np.inf, np.inf], np.nan)
    return inputs, {"result": np.where(finite > 0, outputs["log"], odd)}


def _one_draw(inputs, outputs):
    """Select the draw whose copies deviate most from n w, and show it as sorted indices."""
    if not outputs:
        return inputs, {}
    w, copies = inputs["weights"], outputs["copies"]
    k = np.abs(copies - len(w) * w).max(axis=1).argmax()
    drawn = np.repeat(np.arange(len(w)), copies[k].astype(int))
    return {"weights": w, "seed": inputs["seeds"][k]}, {"result": drawn}


def _sweep(inputs, outputs):
    refused = bool(outputs) and not outputs["taken"]
    return (inputs, NONE) if refused else _cut("rays")(inputs, outputs)


def _relaxed(inputs, outputs):
    if not outputs:
        return inputs, {}
    return inputs, {k: outputs[k] for k in ("box", "outliers")} if outputs["left"] else NONE


def _verdict(inputs, outputs):
    names = np.array(['"A"', '"B"', '"cannot tell"'])
    return inputs, {k: names[int(a)] if k == "better" else a for k, a in outputs.items()}


def _ragged(scans, kept):
    """Write the measurements of a run, each scan in a line, without the rows that pad it."""
    rows = [str(scan[k].round(4).tolist()) for scan, k in zip(scans, kept, strict=True)]
    return ",\n  ".join(rows)


def _consistency(inputs, outputs):
    """Show None for the true pose and for nees, and of many runs the measurements of the first;
    ``outputs`` may lack any of its arrays."""
    kept = inputs["seen"] >= 0
    seen = [row[k].astype(int).tolist() for row, k in zip(inputs["seen"], kept, strict=True)]
    runs = [f"[{_ragged(scans, kept)}]" for scans in inputs["z"]]
    z = ",\n ".join(runs if len(runs) < 3 else [runs[0], f"... ({len(runs) - 1} more runs)"])
    inputs = inputs | {"seen": np.array(str(seen)), "z": np.array(f"[{z}]")}
    known = not np.isnan(inputs["end"]).any()
    shown = {name: array for name, array in outputs.items() if name != "known"}
    if not outputs.get("known", known) and {"nees", "known"} & set(outputs):
        shown["nees"] = NONE["result"]
    return inputs | ({} if known else {"end": NONE["result"]}), shown


def _pairs(inputs, outputs):
    if "pairs" not in outputs:
        return inputs, outputs
    walls = [None if wall < 0 else int(wall) for wall in outputs["pairs"]]
    return inputs, outputs | {"pairs": np.array(str(walls))}


def _pillar(inputs, outputs):
    shown = {name: array for name, array in outputs.items() if name != "found"}
    if not outputs.get("found", 1):
        shown = {name: array for name, array in shown.items() if name != "inside"}
        shown |= {"pillar": NONE["result"]}
    return inputs, shown


STEPS = (
    "{} is called once for each step. Each call gets the rows and weights that the previous call "
    "returned, and the same rng; call k gets {}. The first call gets rng = "
    "np.random.default_rng(seed) and"
)
PRESENTATIONS = {
    "02-ray-wall": CasePresentation(shown=_distance),
    "02-echo": CasePresentation(shown=_distance),
    "02-noise": CasePresentation(
        "noisy is called twice with rng = np.random.default_rng([seed, 0]), and then with "
        "np.random.default_rng([seed, 1]). It is given"
    ),
    "02-beam": CasePresentation(shown=_logarithm),
    "05-alternate": CasePresentation(
        returned="it returns xs, Ps and a dict. The dict contains these p and P (here L), in the "
        "order of the ids:"
    ),
    "06-consistent": CasePresentation(shown=_consistency),
    "08-associate": CasePresentation(shown=_pairs),
    "08-joint": CasePresentation(shown=_pairs),
    "08-pillar": CasePresentation(
        "fit_circle is given arc. find_pillar is given the other arrays, with rng = "
        "np.random.default_rng(seed):",
        "fit_circle returns centre and radius, here called circle. find_pillar returns centre and "
        "radius, here called pillar, and inside, or it returns None:",
        _pillar,
    ),
    "09-life": CasePresentation(
        "keep_book is called once for each row of scans, without the −1 that pads the row. The "
        "first call gets an empty book; each later call gets the book that the previous call "
        "returned:",
        "after each call, for each id that occurs in any scan, in ascending order: whether the id "
        "is in the book, its remaining lives and its `observations`, and how often it is in used:",
    ),
    "10-relaxed": CasePresentation(shown=_relaxed),
    "11-draw": CasePresentation(
        "draw is called with rng = np.random.default_rng(seed) and",
        "the indices that it returns, sorted, are",
        _one_draw,
    ),
    "11-localise": CasePresentation(
        STEPS.format("localise", "u = us[k] and z = zs[k]"),
        "call k, counted from 0, returned rows[k] and weights[k]:",
    ),
    "11-fastslam": CasePresentation(
        "fast_slam is called with rng = np.random.default_rng(seed) and",
        "it returns rows, weights, p and P:",
    ),
    "11-kidnapped": CasePresentation(
        STEPS.format("find_again", "u = us[k], p = ps[k] and z = zs[k]")
    ),
    "12-relocalise": CasePresentation(
        "relocalise is called once for the whole run. Scan k consists of the first counts[k] rows "
        "of `measurements[k]`. It is given"
    ),
    "14-nodes": CasePresentation(shown=_cut("nodes")),
    "14-sweep": CasePresentation(shown=_sweep),
    "14-deskew": CasePresentation(shown=_cut("points")),
    "15-step": CasePresentation(
        "step is given poses, and edges (i, j, z, Λ) from the rows of the other arrays:"
    ),
    "15-gate": CasePresentation(
        "gate_loop is given poses, H, the loop (*pair, z, information), and gates:"
    ),
    "15-false-loops": CasePresentation(
        "close_loops is given poses, edges (k, k + 1, measured[k], information[k]), and loops "
        "from the rows of the other arrays:"
    ),
    "16-versions": CasePresentation(shown=_verdict),
}
"""Presentations by task id; in all other tasks, the arrays are the arguments and results."""
