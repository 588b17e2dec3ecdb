"""Exercise 08, RANSAC: on simulated clouds, against the best that any pair of points can do."""

import numpy as np

from slamlab.exercises.drives.ex08 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex08_lines import direction, distances, is_least, same, total

WALL, OTHERS, BAND, NEEDED, TRIES = 28, 20, 0.05, 16, 60
SCANS, EMPTY = 6, 2  # the last hold no wall
ENOUGH = 0.8  # share of the most points that any guess has
RAIL = 6  # of the others stand just before the wall, out of the band
OFF = 0.25  # m, all the rest are farther than this from the wall's line
LOOSE = 0.01  # share of the least sum of squares that a refit may have more


def scans(rng):
    """Walls among other points, in no order; and clouds without a wall."""
    points = rng.uniform(-3.5, 3.5, (SCANS + EMPTY, WALL + OTHERS, 2))
    for cloud in points[:SCANS]:
        alpha, rho = rng.uniform(-np.pi, np.pi), rng.uniform(0.5, 2)
        normal = direction(alpha)
        across = rho + rng.uniform(-0.012, 0.012, WALL)
        along = np.linspace(-2, 2, WALL) + rng.uniform(-0.05, 0.05, WALL)
        cloud[:WALL] = across[:, None] * normal + along[:, None] * (normal[::-1] * [-1, 1])
        others = cloud[WALL:]  # a view
        off = others @ normal - rho
        near = np.abs(off) < OFF
        others[near] += np.outer(np.where(off[near] < 0, -2, 2) * OFF, normal)
        ahead = rho - rng.uniform(0.13, 0.2, RAIL)
        along = rng.uniform(-1.8, 1.8, RAIL)
        others[:RAIL] = ahead[:, None] * normal + along[:, None] * (normal[::-1] * [-1, 1])
        rng.shuffle(cloud)
    count = len(points)
    return {
        "points": points,
        "band": np.full(count, BAND),
        "needed": np.full(count, float(NEEDED)),
        "tries": np.full(count, float(TRIES)),
        "seed": rng.integers(0, 2**31, count).astype(float),
    }


def most(points):
    """(n,) how many points of a cloud (n, k, 2) the best line through two of them has near it."""
    first, second = np.triu_indices(points.shape[1], 1)
    way = points[:, second] - points[:, first]
    normal = np.stack([-way[..., 1], way[..., 0]], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    rho = np.einsum("npi,npi->np", normal, points[:, first])
    off = normal @ points.transpose(0, 2, 1) - rho[..., None]
    return (np.abs(off) <= BAND).sum(axis=2).max(axis=1)


def _walls(inputs, outputs):
    """What concerns the clouds with a wall: points, lines, masks."""
    return (
        inputs["points"][:SCANS],
        outputs["line"][:SCANS],
        outputs["inside"][:SCANS].astype(bool),
    )


def _enough(inputs, outputs):
    points, _, inside = _walls(inputs, outputs)
    return inside.sum(axis=1) >= ENOUGH * most(points)


def _near(inputs, outputs):
    points, line, inside = _walls(inputs, outputs)
    return (np.abs(distances(points, line)) <= BAND)[inside].all() and inside.any(axis=1)


def _refitted(inputs, outputs):
    points, line, inside = _walls(inputs, outputs)
    return np.array(
        [
            mask.sum() > 1 and is_least(cloud[None, mask], one[None], LOOSE)[0]
            for cloud, one, mask in zip(points, line, inside, strict=True)
        ]
    )


def _none(inputs, outputs):
    return outputs["found"][SCANS:] == 0


# ---- mistakes -------------------------------------------------------------------------------


def _no_abs(inputs, outputs):
    _, _, inside = _walls(inputs, outputs)
    return (inside.mean(axis=1) > 0.75).all()


def _wide(inputs, outputs):
    points, line, inside = _walls(inputs, outputs)
    off = np.abs(distances(points, line))[inside]
    enough = _enough(inputs, outputs).all()
    return enough and 1.5 * BAND < off.max() < 2 * np.sqrt(BAND)


def _not_refitted(inputs, outputs):
    points, line, inside = _walls(inputs, outputs)
    on = (np.abs(distances(points, line)) < 1e-9) & inside
    return ((on.sum(axis=1) >= 2) & (inside.sum(axis=1) > 2)).all()


def _on_all(inputs, outputs):
    points, line, _ = _walls(inputs, outputs)
    return same(line, total(points)).all()


def _never_none(inputs, outputs):
    return (outputs["found"] == 1).all() and _enough(inputs, outputs).all()


def _always_none(inputs, outputs):
    return not outputs["found"].any()


def _inverted(inputs, outputs):
    points, line, inside = _walls(inputs, outputs)
    near = np.abs(distances(points, line)) <= BAND
    return bool(near[~inside].all()) and not inside.all(axis=1).any() and inside.any()


def _not_the_most(inputs, outputs):
    return not _enough(inputs, outputs).all()


RANSAC = Task(
    id="08-ransac",
    title="A wall among other points",
    drive=DRIVES["08-ransac"],
    inputs=scans,
    shapes={
        "found": (SCANS + EMPTY,),
        "line": (SCANS + EMPTY, 2),
        "inside": (SCANS + EMPTY, WALL + OTHERS),
    },
    laws=(
        Law("most", 1, "hardly any line through two of the points has more of them near", _enough),
        Law("near", 1, "every point that is inside lies within the band of the line", _near),
        Law(
            "refitted", 1, "the line is that of least squares through the points inside", _refitted
        ),
        Law("nothing", 1, "where fewer than needed agree, there is no wall: None", _none),
    ),
    diagnoses=(
        Diagnosis(
            "no-abs",
            "Nearly all points are inside: distances have a sign, and those on the other side of "
            "the line are all below the band. Take their absolute values.",
            _no_abs,
        ),
        Diagnosis(
            "always-none",
            "Your function found no wall anywhere: is the best guess kept, and the count compared "
            "with needed?",
            _always_none,
        ),
        Diagnosis(
            "inverted",
            "inside marks the points that are not on the wall: it is True for those within the "
            "band.",
            _inverted,
        ),
        Diagnosis(
            "wide",
            "Points too far from the line are inside, as far as the root of the band: the band is "
            "a distance, so compare it with distances, not with their squares.",
            _wide,
        ),
        Diagnosis(
            "not-refitted",
            "The line goes exactly through two of the points: it is the guess itself. Refit it on "
            "all that agree; their errors average out.",
            _not_refitted,
        ),
        Diagnosis(
            "refitted-on-all",
            "The line was refitted on all points, also on those that are not on the wall. Use "
            "points[inside].",
            _on_all,
        ),
        Diagnosis(
            "never-none",
            "Some line always has a few points near it. Where the best guess has fewer than "
            "needed, return None.",
            _never_none,
        ),
        Diagnosis(
            "not-the-most",
            "Of all guesses, the one with the most points has to win: not the first that is good "
            "enough, nor the last.",
            _not_the_most,
        ),
    ),
    needs=("08-fit-line",),
)
