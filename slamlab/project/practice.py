"""Practice: an own SLAM driven through public worlds, told in a table, drawn beside the truth."""

import functools
from dataclasses import dataclass

from slamlab.exercises.time_limit import capture_output, time_limit
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
    families : sequence of str, of :data:`PUBLIC`, or one of them
    worlds : int, of each family
    seed : int, another one draws other worlds

    Returns
    -------
    list of Trial
    """
    budget, found = Budget(guard=functools.partial(time_limit, cpu=True)), []
    with capture_output() as printed:
        for family in [families] if isinstance(families, str) else families:
            for arena in practice_arenas(family, worlds, seed):
                driven = drive(make, arena.readings, budget)
                found.append(Trial(arena, driven, arena.judge(driven)))
    if printed.text:
        print(f"your code printed:\n{printed.text}\n")
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
    head = f"{'world':<12}{'points':>7}   error [m] over{over}{'map':>7}{'NEES':>10}{'CPU':>9}"
    lines = [head]
    for trial in trials:
        m = trial.result.measures
        errors = "".join(f"{error:8.3f}" for error in m.errors)
        nees = "none" if m.nees != m.nees else f"{m.nees:.1f}"
        lines.append(
            f"{trial.result.family:<12}{trial.result.points:7.0f}{'':17}{errors}{m.map:7.2f}"
            f"{nees:>10}{trial.drive.seconds:7.1f} s"
        )
        lines += [f"    {mistake}" for mistake in trial.result.mistakes]
        if not len(trial.drive.points) and not trial.result.mistakes:
            lines.append("    map() gives no points: its fifth of the score is lost")
    return "\n".join(lines)
