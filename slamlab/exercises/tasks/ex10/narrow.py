"""Exercise 10, open: boxes that stay sound and become as small as possible, by any method."""

import numpy as np

from slamlab.exercises.drives.ex10 import DRIVES
from slamlab.exercises.law import Law
from slamlab.exercises.task import Probe, Task
from slamlab.exercises.tasks.ex10 import poses
from slamlab.exercises.tasks.ex10.boxes import turned
from slamlab.filters.bor.clipping import clip_all
from slamlab.filters.bor.contraction import contract_heading
from slamlab.filters.bor.half_planes import absolute_bearing, reversed_edges

SOUND = 1e-6
"""What a pose may be outside [m], [rad]: solvers of linear programs stop at 1e-7."""
STEPS = {"less": (1, 1.85), "small": (1.5, 1.6), "smallest": (2, 1.4)}
"""Points, and how many times as wide as the smallest boxes may be on average.

Rounds of the lesson's filter, repeated until nothing shrinks, come to 3.0
(1.9 to 4.1 over 31 seeds).
"""
FEW = 5  # robots
NAMES = "x", "y", "the heading"


def widths(out):
    """(n, 3) of the box in x and y, and of the heading."""
    sides = np.hstack([out["robot"], out["heading"]])
    return sides[:, 1::2] - sides[:, ::2]


def one_round(given):
    """What one round of the lesson's filter leaves: box cut, heading sharpened, one by one."""
    found = [
        _one_round(*row) for row in zip(*(given[name].tolist() for name in given), strict=True)
    ]
    return {
        name: np.array(a)
        for name, a in zip(("robot", "heading"), zip(*found, strict=True), strict=True)
    }


def _one_round(robot, heading, objects, sights, bounds):
    for (x, y), z in zip(objects, sights, strict=True):
        box, (direction, d_abs) = (x, x, y, y), absolute_bearing(heading, z, bounds)
        if d_abs < np.pi / 2:
            robot = clip_all(robot, reversed_edges(z, bounds, direction, d_abs, box))
        heading = contract_heading(heading, robot, box, z, bounds)
    return robot, heading


def _ratios(of, to):
    """(n, 3) how many times as wide, and (3,) on average over all robots; unknown ones left out."""
    some = np.isfinite(to).all(axis=1)
    with np.errstate(invalid="ignore"):
        return of / to, of[some].sum(axis=0) / to[some].sum(axis=0)


def _within(reference, most):
    """That all is sound, and on average at most so many times as wide as a reference."""

    def holds(given, out):
        sound = poses.outside_each(given, out).max(axis=1) <= SOUND
        each, average = _ratios(widths(out), reference(given))
        if not sound.all() or average.mean() <= most:
            return sound
        return sound & ~(each > most).any(axis=1)  # NaN where the smallest is not known

    return holds


def _why(most, *references):
    def why(given, out):
        by = poses.outside_each(given, out)
        if by.max() > SOUND:
            row, which = np.unravel_index(by.argmax(), by.shape)
            x, y, theta = poses.extremes(given)[row, which]
            return (
                f"The pose ({x:.3f} m, {y:.3f} m, {theta:.3f} rad) agrees with every sighting and "
                f"with all that was known before, and lies {by.max():.2g} outside."
            )
        ratios = ((_ratios(widths(out), of(given))[0], name) for of, name in references)
        each, name = next((each, name) for each, name in ratios if (each > most).any())
        told = ", ".join(f"{w} {ratio:.2f}" for w, ratio in zip(NAMES, each[0], strict=True))
        return f"This is {told} times as wide as {name}; {most:g} on average is allowed."

    return why


def _known(given):
    return widths(given) + SOUND


def _look(given):
    return widths(one_round(given)) + SOUND


def _lesson(given):
    """What a round of look leaves; of a few robots, whose average says little, what was known."""
    return (_known if len(given["robot"]) < FEW else _look)(given)


def _step(name, asks):
    points, most = STEPS[name]
    says = (
        f"the same, and on average all is at most {most:g} times as wide as the smallest there is"
    )
    why = _why(most, (poses.tightest, "the smallest there is"))
    holds = _within(poses.tightest, most)
    return Law(name, points, says, holds, why=why, asks=asks, after=("sound",))


def _wide(rng):
    return poses.inputs(rng, 2, half=(1.6, 2.0))


def _across_pi(rng):
    at = np.column_stack([rng.uniform(-3, 3, (2, 2)), np.pi + rng.uniform(-0.1, 0.1, 2)])
    return poses.sightings(rng, at)


NARROW = Task(
    id="10-narrow",
    title="As small as can be",
    drive=DRIVES["10-narrow"],
    inputs=poses.inputs,
    shapes=lambda given: {"robot": (len(given["robot"]), 4), "heading": (len(given["robot"]), 2)},
    laws=(
        Law(
            "sound",
            0.5,
            "no pose that agrees with all is outside, and no more is left than by a round of look",
            _within(_lesson, 1.0),
            why=_why(
                1.0, (_known, "what was known before"), (_look, "what a round of look leaves")
            ),
            asks="Which poses does each line give up? Has each of them been shown to be "
            "impossible?",
        ),
        _step(
            "less", "Which of the three, x, y or θ, makes d_abs wide? What if you knew it better?"
        ),
        _step("small", "Once much has been given up, what may be tried again?"),
        _step(
            "smallest",
            "Where does a box grow round what is left, although nobody asked for a box yet?",
        ),
    ),
    needs=("10-edges",),
    probes=(
        Probe("no object at all", lambda rng: poses.inputs(rng, 2, 0), ("sound",)),
        Probe("a single object", lambda rng: poses.inputs(rng, 2, 1), ("sound",)),
        Probe("seven objects", lambda rng: poses.inputs(rng, 2, 7), ("sound",)),
        Probe("a wide heading", _wide, ("sound",)),
        Probe("a heading across π", _across_pi, ("sound",)),
        Probe(
            "objects inside the robot's box",
            lambda rng: poses.inputs(rng, 2, far=(0.6, 1)),
            ("sound",),
        ),
    ),
    parts=lambda given, out: {"all": np.column_stack([out["robot"], turned(out["heading"])])},
    rounds=False,
)
