"""Task 09-thin: points that keep a distance, judged by the distances."""

import numpy as np

from slamlab.exercises.drives.ex09 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

COUNT, SIZE = 3, 110  # scans, and points in each
ROUNDING = 1e-9


def scans(rng):
    """Walls and some clutter, seen again and again; the spacing is not that of the thesis."""
    spacing = rng.uniform(0.04, 0.07)
    t = rng.uniform(-0.7, 0.7, (COUNT, SIZE))
    tilt, wall = rng.uniform(0.3, 1.2), rng.integers(0, 2, (COUNT, SIZE))
    points = np.stack([t, 0.4 * wall], axis=-1) + 0.03 * rng.standard_normal((COUNT, SIZE, 2))
    c, s = np.cos(tilt), np.sin(tilt)
    points = points @ [[c, s], [-s, c]]
    # two points in one cell, yet farther apart than it is wide
    points[:2, 0] = spacing * (np.floor(2 / spacing) + np.array([[0.03, 0.03], [0.96, 0.96]]))
    return {"scans": points, "spacing": np.array([spacing])}


def _apart(a, b):
    return np.hypot(*(a[:, None] - b[None]).transpose(2, 0, 1))


def _offered(inputs):
    return inputs["scans"].reshape(-1, 2)


def _spaced(inputs, outputs):
    off = _apart(outputs["kept"], outputs["kept"])
    off[np.diag_indices(len(off))] = np.inf
    return bool((off > inputs["spacing"][0] - ROUNDING).all())


def _covering(inputs, outputs):
    if not len(outputs["kept"]):
        return False
    off = _apart(_offered(inputs), outputs["kept"]).min(axis=1)
    return bool((off <= inputs["spacing"][0] + ROUNDING).all())


def _given(inputs, outputs):
    if not len(outputs["kept"]):
        return False
    return bool(_apart(outputs["kept"], _offered(inputs)).min(axis=1).max() <= ROUNDING)


def _faithful(inputs, outputs):
    """What was kept after a scan comes from the scans so far: nothing goes, nothing is older."""
    counts = outputs["counts"].astype(int)
    if (np.diff(counts) < 0).any() or counts[-1] != len(outputs["kept"]):
        return False
    first = 0
    for count, scan in zip(counts, inputs["scans"], strict=True):
        fresh = outputs["kept"][first:count]
        if len(fresh) and _apart(fresh, scan).min(axis=1).max() > ROUNDING:
            return False
        first = count
    return True


# ---- mistakes: the same points thinned otherwise ----------------------------------------------


def _thinned(inputs, near):
    """Points kept one by one; ``near(kept, fresh, point, spacing)`` says who is in the way."""
    kept, spacing = [], float(inputs["spacing"][0])
    for scan in inputs["scans"]:
        before, fresh = list(kept), []
        for point in scan:
            if not near(before, fresh, point, spacing):
                fresh.append(point)
        kept += fresh
    return np.array(kept)


def _close(points, point, spacing):
    return bool(len(points) and np.hypot(*(np.array(points) - point).T).min() <= spacing)


def _cells(points, spacing):
    return {tuple(c) for c in np.floor(np.array(points).reshape(-1, 2) / spacing).astype(int)}


def _in_cell(before, fresh, point, spacing):
    """Whether a point's own cell is taken."""
    return tuple(np.floor(point / spacing).astype(int)) in _cells(before + fresh, spacing)


def _round_cell(before, fresh, point, spacing):
    """Whether its cell or one of the eight round it is taken, near or not."""
    i, j = np.floor(point / spacing).astype(int)
    return bool(
        {(i + a, j + b) for a in (-1, 0, 1) for b in (-1, 0, 1)} & _cells(before + fresh, spacing)
    )


def _own_cell_only(before, fresh, point, spacing):
    """Distances asked only of points in the same cell."""
    cell = np.floor(point / spacing)
    mine = [p for p in before + fresh if (np.floor(p / spacing) == cell).all()]
    return _close(mine, point, spacing)


WAYS = {
    "last-only": (
        "Each point is compared with the last one kept only. Walls are seen again in later scans: "
        "every kept point counts.",
        lambda before, fresh, p, d: _close((before + fresh)[-1:], p, d),
    ),
    "old-only": (
        "New points are compared with the old ones, but not with each other: the first scan comes "
        "in whole (as in the thesis).",
        lambda before, fresh, p, d: _close(before, p, d),
    ),
    "new-only": (
        "New points are compared with each other, but not with those kept before.",
        lambda before, fresh, p, d: _close(fresh, p, d),
    ),
    "all-kept": ("Every point is kept.", lambda before, fresh, p, d: False),
    "one-per-cell": (
        "That is one point a cell: two on either side of a cell's edge may nearly touch. Ask the "
        "eight cells round it, too, and the distance.",
        _in_cell,
    ),
    "own-cell": (
        "Only points in the same cell are asked for their distance. The nearest may lie in the "
        "next cell.",
        _own_cell_only,
    ),
    "cells-for-distance": (
        "A point is left out because a neighbouring cell is taken, however far off its point is. "
        "The cells say whom to ask; the distance decides.",
        _round_cell,
    ),
    "along-axes": (
        "Distances are taken along x and y each, not straight: the corner of a square is farther "
        "than its side.",
        lambda before, fresh, p, d: any((np.abs(q - p) <= d).all() for q in before + fresh),
    ),
}  # fmt: skip


def _kept_by(near):
    def matches(inputs, outputs):
        wrong = _thinned(inputs, near)
        got = outputs["kept"]
        return got.shape == wrong.shape and np.allclose(got, wrong, atol=ROUNDING)

    return matches


def _forgot(inputs, outputs):
    return not _faithful(inputs, outputs) and _given(inputs, outputs)


THIN = Task(
    id="09-thin",
    title="Thin the points",
    drive=DRIVES["09-thin"],
    inputs=scans,
    shapes={"kept": (None, 2), "counts": (COUNT,)},
    laws=(
        Law("apart", 1, "no two kept points are closer than the spacing", _spaced),
        Law("covering", 1, "every point offered has a kept one within the spacing", _covering),
        Law("given", 1, "every kept point is one that was offered, as it was", _given),
        Law("faithful", 1, "kept points stay, new ones of each scan come behind them", _faithful),
    ),
    diagnoses=(
        *(Diagnosis(name, hint, _kept_by(near)) for name, (hint, near) in WAYS.items()),
        Diagnosis(
            "forgot",
            "What was kept before is not all there any more, or not in front. Return the old "
            "points and the new ones behind them.",
            _forgot,
        ),
        Diagnosis(
            "moved",
            "Some kept points are none that were offered (a mean, the middle of a cell?). Keep a "
            "point as it is, or leave it out.",
            lambda inputs, outputs: not _given(inputs, outputs),
        ),
    ),
)
