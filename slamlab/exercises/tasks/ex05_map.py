"""Exercise 05, build_map: N little filters, judged by the batch least squares of each landmark."""

import numpy as np

from slamlab import models
from slamlab.exercises.drives.ex05 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Task
from slamlab.exercises.tasks.ex04_laws import differences
from slamlab.exercises.tasks.ex05_batch import deviations, each, same_covariance
from slamlab.exercises.tasks.ex05_map_mistakes import (
    all_updated,
    by_each,
    each_landmark,
    little_filter,
    made_by,
    pose_of_start,
    raw_R,
)
from slamlab.geometry import wrap

MAPS = 3
TIMES = (1, 1, 2, 3, 5)
"""How often each landmark is seen."""

STEPS = sum(TIMES)
SIGMA = np.array([0.04, 0.01])  # of r [m] and β [rad]: small, so that H hardly depends on where
MEAN_OFF, COVARIANCE_OFF = 0.25, 0.08
"""How far a filter may be off the batch, in standard deviations: its H come from early guesses."""


def courses(rng):
    """Poses all over a room, each seeing one landmark; ids are no row numbers."""
    made = [_course(rng) for _ in range(MAPS)]
    return {name: np.array([one[name] for one in made]) for name in made[0]}


def _course(rng):
    ids = rng.choice(np.arange(5, 90), len(TIMES), replace=False)
    angle = (np.arange(len(TIMES)) + 0.7 * rng.random(len(TIMES))) * 2 * np.pi / len(TIMES)
    places = rng.uniform(3.5, 5, (len(TIMES), 1)) * np.column_stack([np.cos(angle), np.sin(angle)])
    rows = rng.permutation(np.repeat(np.arange(len(TIMES)), TIMES))
    xs = np.column_stack([rng.uniform(-1.5, 1.5, (STEPS, 2)), rng.uniform(-3, 3, STEPS)])
    zs = each(models.h, xs, places[rows])
    # noise of one sign is as good as any other: nothing here is judged by chance
    zs += rng.choice([-1.0, 1.0], zs.shape) * rng.uniform(0.5, 1.5, zs.shape) * SIGMA
    zs[:, 1] = wrap(zs[:, 1])
    alone = ids[rng.choice([3, 4])]
    return {"xs": xs, "ids": ids[rows], "zs": zs, "R": np.diag(SIGMA**2), "alone": alone}


# ---- laws -----------------------------------------------------------------------------------


def batch(xs, zs, R):
    """The place that fits all sightings of one landmark best, and its covariance.

    Gauss-Newton on Σ (z − h)ᵀ R⁻¹ (z − h), with differences of h for its derivative.
    """
    p, weight = models.g(xs[0], zs[0]), np.linalg.inv(R)
    for _ in range(4):
        H = each(lambda x, p=p: differences(lambda q: models.h(x, q), p, 1), xs)
        v = zs - each(lambda x, p=p: models.h(x, p), xs)
        v[:, 1] = wrap(v[:, 1])
        P = np.linalg.inv(np.einsum("nki,kl,nlj->ij", H, weight, H))
        p = p + P @ np.einsum("nki,kl,nl->i", H, weight, v)
    return p, P


def fitted(inputs):
    """Batch estimates p (m, N, 2) and P (m, N, 2, 2), ids ascending."""
    return each_landmark(inputs, batch)


def _often(inputs):
    """(m, N) how often each landmark is seen, ids ascending."""
    return np.array([np.unique(ids, return_counts=True)[1] for ids in inputs["ids"]])


def _agree(inputs, outputs, mean_off, covariance_off):
    p, P = fitted(inputs)
    near = (np.abs(outputs["p"] - p) <= mean_off * deviations(P)).all(axis=-1)
    return near & same_covariance(outputs["P"], P, covariance_off)


def _first(inputs, outputs):
    return _agree(inputs, outputs, 1e-3, 1e-3)[_often(inputs) == 1]


def _again(inputs, outputs):
    return _agree(inputs, outputs, MEAN_OFF, COVARIANCE_OFF)[_often(inputs) > 1]


def _apart(inputs, outputs):
    row = [np.flatnonzero(np.unique(i) == a)[0] for i, a in _alone(inputs)]
    maps = np.arange(MAPS)
    p, P = outputs["p"][maps, row], outputs["P"][maps, row]
    near = (np.abs(outputs["alone_p"] - p) <= 1e-6 * deviations(P)).all(axis=-1)
    return near & same_covariance(outputs["alone_P"], P, 1e-6)


def _alone(inputs):
    return zip(inputs["ids"], inputs["alone"], strict=True)


MAP = Task(
    id="05-map",
    title="Where are they: a map from known poses",
    drive=DRIVES["05-map"],
    inputs=courses,
    shapes={
        "p": (MAPS, len(TIMES), 2),
        "P": (MAPS, len(TIMES), 2, 2),
        "alone_p": (MAPS, 2),
        "alone_P": (MAPS, 2, 2),
    },
    laws=(
        Law("first", 1, "a landmark seen once is where and as sure as that sighting says", _first),
        Law(
            "again",
            2,
            "a landmark seen often is where least squares of all its sightings puts it",
            _again,
        ),
        Law("apart", 1, "what is seen of other landmarks changes nothing", _apart),
    ),
    diagnoses=(
        made_by(
            "R-for-P",
            "A new landmark's P is R as it is. R is in range and bearing, P in x and y: "
            "J_z R J_zᵀ.",
            by_each(first=raw_R),
        ),
        made_by(
            "counted-twice",
            "A new landmark is placed by its first sighting and then corrected by the same one: "
            "it counts twice, and P is too small.",
            by_each(start=0),
        ),
        made_by(
            "overwritten",
            "Only the last sighting of each landmark is left. Place a landmark when its id is new; "
            "later sightings correct it.",
            lambda i: each_landmark(i, lambda xs, zs, R: little_filter(xs[-1:], zs[-1:], R)),
        ),
        made_by(
            "first-only",
            "Only the first sighting of each landmark is used. Correct it with the later ones.",
            lambda i: each_landmark(i, lambda xs, zs, R: little_filter(xs[:1], zs[:1], R)),
        ),
        made_by(
            "P-kept",
            "P stays what the first sighting made it: keep both parts of what update_landmark "
            "returns.",
            by_each(keep_P=True),
        ),
        made_by(
            "all-updated",
            "Every sighting corrects all landmarks. It was made of one: ids[k] says which.",
            all_updated,
        ),
        made_by(
            "pose-of-start",
            "All sightings are taken as made from the first pose. Sighting k was made from xs[k].",
            lambda i: by_each()(pose_of_start(i)),
        ),
    ),
    needs=("05-landmark",),
)
