"""Task 09-life: sightings and lives of walls, scan after scan, judged by counting."""

import numpy as np

from slamlab.exercises.drives.ex09 import DRIVES
from slamlab.exercises.law import Diagnosis, Law
from slamlab.exercises.task import Task

SCANS, IDS, WIDTH = 36, 6, 8
NEVER, LAST = 4, 5  # ids that have a part of their own: one is never seen again, one comes late


def sequence(rng):
    """Scans of ids, filled up with −1; some ids twice in a scan, gaps of all lengths."""
    N, lives = int(rng.integers(3, 6)), int(rng.integers(3, 5))
    seen = np.zeros((SCANS, IDS), dtype=bool)
    for i in range(IDS):
        k = int(rng.integers(0, 3))
        # gaps shorter than a life, just as long, and longer, in random order
        gaps = rng.permutation([1, 1, 1, 1, 1, 1, 1, 2, 2, lives - 1, lives, lives, lives + 2])
        for gap in gaps:
            if k < SCANS:
                seen[k, i] = True
            k += gap
    seen[2, NEVER], seen[3:, NEVER] = True, False
    seen[:-4, LAST], seen[-4:, LAST] = False, True
    scans = np.full((SCANS, WIDTH), -1)
    for k, row in enumerate(seen):
        ids = np.flatnonzero(row)
        twice = rng.choice(ids, min(len(ids), int(rng.integers(0, 3))), replace=False)
        ids = rng.permutation(np.concatenate([ids, twice]))
        scans[k, : len(ids)] = ids
    return {"scans": scans, "N": np.array([N]), "lives": np.array([lives])}


def truth(inputs):
    """What the book holds after each scan, counted from the scans, not kept step by step.

    Left are the lives less the scans since the last sighting; a life began after the last gap that
    used them up, and the sightings are those since.
    """
    scans, lives, N = inputs["scans"], int(inputs["lives"][0]), int(inputs["N"][0])
    seen = (scans[:, :, None] == np.arange(IDS)).any(axis=1)
    found = {name: np.zeros(seen.shape) for name in ("sightings", "left", "used")}
    for i in range(IDS):
        times = np.flatnonzero(seen[:, i])
        for k in range(len(scans)):
            past = times[times <= k]
            if not len(past) or k - past[-1] >= lives:
                continue
            deaths = np.flatnonzero(np.diff(past) > lives)
            since = len(past) - (deaths[-1] + 1 if len(deaths) else 0)
            found["sightings"][k, i], found["left"][k, i] = since, lives - (k - past[-1])
            found["used"][k, i] = seen[k, i] and since >= N
    return found


def _counts(name):
    return lambda inputs, outputs: (outputs[name] == truth(inputs)[name]).all(axis=0)


def _alive(inputs, outputs):
    return ((outputs["left"] != 0) == (truth(inputs)["left"] > 0)).all(axis=0)


# ---- mistakes: the same book kept with a slip -------------------------------------------------


def kept(inputs, slip):
    """A book kept scan by scan with one of the slips."""
    scans, lives, N = inputs["scans"], int(inputs["lives"][0]), int(inputs["N"][0])
    found = {name: np.zeros((len(scans), IDS)) for name in ("sightings", "left", "used")}
    book, remembered = {}, {}
    for k, scan in enumerate(scans):
        ids = [int(i) for i in scan if i >= 0]
        once = ids if slip == "twice" else sorted(set(ids))
        for i in once:
            count, left = book.get(i, (remembered.get(i, 0) if slip == "reborn" else 0, lives))
            if slip == "restored-by-one":
                left = min(left + 1, lives)
            elif slip != "not-restored":
                left = lives
            book[i] = count + 1, left
        for i in list(book):
            count, left = book[i]
            left -= i not in ids or slip == "seen-pays"
            if slip == "consecutive" and i not in ids:
                count = 0
            gone = left < 0 if slip == "late" else left <= 0
            book[i] = count, left
            if gone and slip != "immortal":
                remembered[i] = count
                del book[i]
        for i, (count, left) in book.items():
            found["sightings"][k, i], found["left"][k, i] = count, left
            enough = count > N if slip == "one-too-many" else count >= N
            enough = True if slip == "at-once" else enough
            found["used"][k, i] = enough and (i in ids or slip == "unseen-used")
        if slip == "used-twice":
            for i in set(ids):
                found["used"][k, i] *= ids.count(i)
    return found


def _kept_with(slip):
    def matches(inputs, outputs):
        wrong = kept(inputs, slip)
        return all((outputs[name] == wrong[name]).all() for name in wrong)

    return matches


HINTS = {
    "twice": "Two sightings of one wall in one scan count twice. The second is dropped: it is the "
    "same look at the same wall.",
    "not-restored": "A wall that is seen again does not get its lives back. Restore all of them.",
    "restored-by-one": "A wall that is seen again gets one life back. Restore all of them.",
    "seen-pays": "Walls that were seen pay a life, too. Only those that were not seen do.",
    "late": "A wall with no life left is still in the book. At 0 it goes.",
    "immortal": "Walls never leave the book. Who has no life left is deleted, in x and P as well.",
    "reborn": "A wall that died and comes back remembers its old sightings. It is a new one.",
    "consecutive": "A scan without a wall sets its sightings back to 0. It costs a life, no more.",
    "one-too-many": "Used from sighting N + 1 on. It is to be used from the N-th on.",
    "at-once": "Walls are used at their first sighting: N is not asked.",
    "unseen-used": "Walls that are not in this scan are among those used. There is nothing to "
    "update them with.",
    "used-twice": "A wall that was seen twice in a scan is used twice. Drop the second sighting.",
}

LIFE = Task(
    id="09-life",
    title="Sightings and lives",
    drive=DRIVES["09-life"],
    inputs=sequence,
    shapes={name: (SCANS, IDS) for name in ("sightings", "left", "used")},
    laws=(
        Law("alive", 1, "a wall is in the book unless it was unseen for `lives` scans", _alive),
        Law("left", 1, "it has as many lives as are left since it was last seen", _counts("left")),
        Law(
            "sightings",
            1,
            "its sightings are the scans that held it since it came into the book",
            _counts("sightings"),
        ),
        Law(
            "used",
            1,
            "used are the walls of this scan that have N sightings, each once",
            _counts("used"),
        ),
    ),
    diagnoses=tuple(Diagnosis(slip, hint, _kept_with(slip)) for slip, hint in HINTS.items()),
)
