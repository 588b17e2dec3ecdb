"""Task 09-ghosts: a map of a room, without what only seemed a wall; any method goes."""

import numpy as np

from slamlab.exercises.drives.ex09 import DRIVES
from slamlab.exercises.law import Diagnosis, Law, once
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex09 import rooms
from slamlab.geometry import wrap

NEAR = np.array([0.5, 0.2])  # a wall of a map is one of the room within this of it [m, rad]


@once
def wrong(inputs, outputs):
    """(n, 2) of each map: how many of its walls are none of the room's, and how many it lacks."""
    counts, walls = outputs["counts"], outputs["walls"]
    if (counts < 0).any() or (counts % 1).any() or counts.sum() != len(walls):
        raise ValueError("the counts are not those of the walls")
    maps = np.split(walls, np.cumsum(counts.astype(int))[:-1])
    known = [room for room in rooms.truth(inputs) for _ in range(2)]
    pairs = np.array([_pairs(drawn, *room) for drawn, room in zip(maps, known, strict=True)])
    walls = np.array([len(walls) for _, walls in known])
    return np.column_stack([counts - pairs, walls - pairs])


def _pairs(drawn, way, walls):
    """How many walls of a map are one of the room's each, the nearest found first."""
    off = np.abs(rooms.from_middle(walls, way)[:, None] - rooms.from_middle(drawn, way))
    off[..., 1] = np.abs(wrap(off[..., 1]))
    off, count = np.where((off < NEAR).all(axis=-1), (off / NEAR).sum(axis=-1), np.inf), 0
    while np.isfinite(off).any():
        i, j = np.unravel_index(off.argmin(), off.shape)
        off[i], off[:, j], count = np.inf, np.inf, count + 1
    return count


def _step(name, points, asks, *limits):
    """The law that so many of twelve maps have so many walls too many or too few at most."""

    def holds(inputs, outputs):
        faults = wrong(inputs, outputs).sum(axis=1)
        return all(np.sum(faults <= most) * 12 >= maps * len(faults) for maps, most in limits)

    def why(inputs, outputs):
        ghosts, lacking = wrong(inputs, outputs).T
        count = {most: np.sum(ghosts + lacking <= most) for _, most in limits}
        of = " and ".join(f"{maps} have {_faults(most)}" for most, maps in count.items())
        return (
            f"Of {len(ghosts)} maps {of}; on the average a map has {ghosts.mean():.1f} walls too "
            f"many and lacks {lacking.mean():.1f}."
        )

    says = " and ".join(f"{maps} of 12 maps have {_faults(most)}" for maps, most in limits)
    return Law(name, points, says, holds, why=why, asks=asks)


def _faults(most):
    return f"{most} wall{'s' * (most > 1)} too many or too few at most" if most else "no fault"


# over 300 seeds 8 of 12 maps of the solution or more have one fault at most, 6 or more have none;
# by the lesson's rule none has, since the three things stay in the map. The eight that were found
# most often are right in 5 of 12 maps at times, but not in 7 but for one wall
STEPS = (
    _step("better", 0.5, "What does a map hold that believes every line it sees?", (6, 3)),
    _step("good", 1, "A thing stood for a dozen scans. What gives it away afterwards?", (6, 1)),
    _step("clean", 2, "Which walls do you lack: those the robot saw only shortly?", (7, 1)),
    _step(
        "right", 2, "Where does the robot think it is when it comes round again?", (7, 1), (5, 0)
    ),
)


# ---- mistakes that many methods share --------------------------------------------------------


def _turned(inputs, outputs):
    ghosts, lacking = wrong(inputs, outputs).mean(axis=0)
    return ghosts > 2 and lacking > 2


MISTAKES = (
    Diagnosis(
        "astray",
        "Your maps have walls too many and lack others: the same ones, perhaps, but not where they "
        "are. The wheels drift; does every wall seen again correct the pose?",
        _turned,
    ),
    Diagnosis(
        "ghosts-kept",
        "Your maps hold walls that are none. A thing that stands for a dozen scans is sighted as "
        "often as some walls; but what of the scans in which it should have been sighted?",
        lambda inputs, outputs: np.greater(*wrong(inputs, outputs).mean(axis=0)),
    ),
    Diagnosis(
        "walls-lost",
        "Your maps lack walls that were seen well. That a wall is not sighted says something only "
        "while it is in view.",
        lambda inputs, outputs: np.less(*wrong(inputs, outputs).mean(axis=0)),
    ),
)


def _walls_only(rng):
    return rooms.drives(rng, 5, 0, 0)  # both drives of a room go astray with one seed in 170


GHOSTS = Task(
    id="09-ghosts",
    title="Make it better: a map without ghosts",
    drive=DRIVES["09-ghosts"],
    inputs=rooms.drives,
    probes=(Probe("nothing but walls", _walls_only, ("better",)),),
    shapes=lambda inputs: {"walls": (None, 2), "counts": inputs["x"].shape[:1]},
    rounds=False,
    laws=STEPS,
    diagnoses=MISTAKES,
    needs=("09-place", "09-update"),
)
