"""Task 09-life: sightings and lives of walls, scan after scan, judged by counting."""

import numpy as np

from slamlab.exercises.drives.ex09 import DRIVES, ids_of
from slamlab.exercises.law import Law, once
from slamlab.exercises.task import Probe, Task


def sequences(rng, rows=16, scans=10, walls=3, N=(1, 4), lives=(1, 4), names=9, seen=0.5, most=2):
    """Scans of ids in no order, filled up with −1.

    Parameters
    ----------
    rng : numpy.random.Generator
    rows, scans, walls : int
    N, lives : (low, high) of these numbers, high not included
    names : int, ids are below this
    seen : float, share of the scans that hold a wall
    most : int, so often a wall may stand in a scan
    """
    table = np.full((rows, scans, most * walls), -1)
    for row in table:
        ids = rng.choice(names, walls, replace=False)
        for scan in row:
            held = ids[rng.random(walls) < seen]
            times = rng.choice([1, 1, most], len(held)) if most > 1 else 1
            held = rng.permutation(np.repeat(held, times))
            scan[: len(held)] = held
    return {"scans": table, "N": rng.integers(*N, rows), "lives": rng.integers(*lives, rows)}


def _gaps(rng):
    """One wall, unseen for as many scans as it has lives, for one fewer, and for one more."""
    found = sequences(rng, 6, 12, 1, lives=(2, 4), most=1, seen=0.0)
    for row, lives, off in zip(found["scans"], found["lives"], (-1, 0, 1) * 2, strict=True):
        row[[0, 1, 2 + lives + off, 3 + lives + off], 0] = 0
    return found


@once
def truth(inputs):
    """What the book holds after each scan, counted from the scans, not kept step by step.

    Left are the lives less the scans since the last sighting; a life began after the last gap that
    used them up, and the sightings are those since.
    """
    ids = ids_of(inputs["scans"])
    seen = (inputs["scans"][..., None] == ids[:, None, None]).any(axis=2) & (ids >= 0)[:, None]
    found = {name: np.zeros(seen.shape) for name in ("inside", "left", "sightings", "used")}
    for row, column in np.ndindex(ids.shape):
        lives, N = int(inputs["lives"][row]), int(inputs["N"][row])
        times = np.flatnonzero(seen[row, :, column])
        for k in range(seen.shape[1]):
            past, at = times[times <= k], (row, k, column)
            if not len(past) or k - past[-1] >= lives:
                continue
            deaths = np.flatnonzero(np.diff(past) > lives)
            since = len(past) - (deaths[-1] + 1 if len(deaths) else 0)
            found["inside"][at], found["left"][at] = 1, lives - (k - past[-1])
            found["sightings"][at], found["used"][at] = since, seen[at] and since >= N
    return found


def _counts(name, says, asks, holds=None, **more):
    def same(inputs, outputs):
        return (outputs[name] == truth(inputs)[name]).all(axis=(1, 2))

    def want(inputs):
        return {name: truth(inputs)[name]}

    return Law(name, 1, says, holds or same, want=want, asks=asks, **more)


def _lives(inputs, outputs):
    """Whether lives are right; of walls that are not in the book, or should not be, none are."""
    right = truth(inputs)
    same = (outputs["left"] == right["left"]) | (outputs["inside"] != right["inside"])
    return same.all(axis=(1, 2))


def _shapes(inputs):
    rows, scans, _ = inputs["scans"].shape
    walls = ids_of(inputs["scans"]).shape[1]
    return dict.fromkeys(("inside", "left", "sightings", "used"), (rows, scans, walls))


LIFE = Task(
    id="09-life",
    title="Sightings and lives",
    drive=DRIVES["09-life"],
    inputs=sequences,
    probes=(
        Probe("gaps about as long as a life", _gaps),
        Probe("one life", lambda rng: sequences(rng, 4, 6, 2, lives=(1, 2))),
        Probe("N = 1", lambda rng: sequences(rng, 4, 5, 2, N=(1, 2))),
        Probe("scans that hold nothing", lambda rng: sequences(rng, 2, 5, 2, seen=0.0)),
        Probe("a wall three times in a scan", lambda rng: sequences(rng, 3, 5, 2, most=3)),
        Probe("a dozen walls of any ids", lambda rng: sequences(rng, 2, 12, 12, names=1000)),
    ),
    shapes=_shapes,
    rounds=False,
    laws=(
        _counts(
            "inside",
            "a wall is in the book unless it was unseen for `lives` scans",
            "A wall with one life left is not seen. And one that is seen?",
        ),
        _counts(
            "left",
            "it has as many lives as are left since it was last seen",
            "What does a sighting restore, and what does a scan without the wall cost?",
            _lives,
            alone=False,
        ),
        _counts(
            "sightings",
            "its sightings are the scans that held it since it came into the book",
            "How many looks at a wall is one scan, however often its id stands there?",
            after=("inside",),
        ),
        _counts(
            "used",
            "used are the walls of this scan that have N sightings, each once",
            "Is this scan's own sighting among the N? And which walls can be used at all?",
            after=("inside", "sightings"),
        ),
    ),
)
