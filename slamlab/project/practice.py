"""Practice: an own SLAM driven through public worlds, told in a table, drawn beside the truth."""

import functools
from dataclasses import dataclass

from slamlab.geometry import compose, transform
from slamlab.layers import Points, Poses, Segments
from slamlab.project.drive_errors import LENGTHS, aligned
from slamlab.project.driving import Budget, Drive, drive
from slamlab.project.scores import Arena, Result, arenas
from slamlab.project.world_families import FAMILIES, LANDMARKS

PUBLIC = FAMILIES | {LANDMARKS.name: LANDMARKS}
"""The families to practise in, by name."""


@dataclass(frozen=True)
class Trial:
    """A drive through a practice world.

    Parameters
    ----------
    arena : Arena
    drive : Drive
    result : Result
    """

    arena: Arena
    drive: Drive
    result: Result

    def layers(self):
        """Walls, the map, and three tracks, all laid on the truth: list of Layer."""
        truth, wheels = self.arena.world.truth.poses, self.arena.drives["odometry"].trajectory
        motion = aligned(self.drive.trajectory, truth)
        return [
            Segments("walls", self.arena.world.floor.outline()),
            Points("map", transform(motion, self.drive.points)),
            Poses("truth", truth),
            Poses("naive", compose(aligned(wheels, truth), wheels)),
            Poses("corrected", compose(motion, self.drive.trajectory)),
        ]


@functools.cache
def practice_arenas(family, worlds=1, seed=1):
    """The worlds of a family that a seed draws, prepared once: tuple of Arena.

    Parameters
    ----------
    family : str, of :data:`PUBLIC`
    worlds, seed : int

    Raises
    ------
    ValueError : there is no such family
    """
    if family not in PUBLIC:
        raise ValueError(f"no family {family!r}: there are {', '.join(PUBLIC)}")
    return tuple(arenas(seed, [PUBLIC[family]], worlds))


def practise(make, families=("plain",), worlds=1, seed=1):
    """Drive an own SLAM through practice worlds, with the budget of a contest for all of them.

    Parameters
    ----------
    make : callable that makes the estimator, its class
    families : sequence of str, of :data:`PUBLIC`
    worlds : int, of each family
    seed : int, another one draws other worlds

    Returns
    -------
    list of Trial
    """
    budget, found = Budget(), []
    for family in families:
        for arena in practice_arenas(family, worlds, seed):
            driven = drive(make, arena.readings, budget)
            found.append(Trial(arena, driven, arena.judge(driven)))
    return found


def table(trials):
    """What came of some drives, a line each, and what went wrong.

    Parameters
    ----------
    trials : list of Trial

    Returns
    -------
    str
    """
    over = "".join(f"{f'{length:g} m':>8}" for length in LENGTHS)
    lines = [f"{'world':<12}{'points':>7}   error over{over}{'map':>7}{'NEES':>8}{'CPU':>8}"]
    for trial in trials:
        m = trial.result.measures
        errors = "".join(f"{error:8.2f}" for error in m.errors)
        nees = "none" if m.nees != m.nees else f"{m.nees:.3g}"
        lines.append(
            f"{trial.result.family:<12}{trial.result.points:7.0f}{'':13}{errors}{m.map:7.2f}"
            f"{nees:>8}{trial.drive.seconds:6.1f} s"
        )
        lines += [f"    {mistake}" for mistake in trial.result.mistakes]
    return "\n".join(lines)
