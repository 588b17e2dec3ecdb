"""Practice: run a student's SLAM on public worlds; show the results as a table and as layers."""

import functools
from dataclasses import dataclass

from classroom.exercises.time_limit import capture_output, time_limit
from classroom.project.estimate_errors import LENGTHS, aligned
from classroom.project.estimator_runs import Budget, EstimatorRun, run_estimator
from classroom.project.scores import PreparedWorld, WorldResult, prepared_worlds
from classroom.project.world_parameters import LANDMARKS, WORLD_FAMILIES
from slamlab.geometry import compose, transform
from slamlab.layers import Points, Poses, Segments

PUBLIC = WORLD_FAMILIES | {LANDMARKS.name: LANDMARKS}
"""The families for practice, by name."""


@dataclass(frozen=True)
class Trial:
    """A run on a practice world, with its result."""

    prepared_world: PreparedWorld
    run: EstimatorRun
    result: WorldResult

    def layers(self):
        """Return walls, map and three trajectories as layers, all aligned with the ground truth."""
        truth, wheels = (
            self.prepared_world.world.truth.poses,
            self.prepared_world.runs["odometry"].trajectory,
        )
        motion = aligned(self.run.trajectory, truth)
        return [
            Segments("walls", self.prepared_world.world.floor.outline()),
            Points("map", transform(motion, self.run.points)),
            Poses("truth", truth),
            Poses("naive", compose(aligned(wheels, truth), wheels)),
            Poses("corrected", compose(motion, self.run.trajectory)),
        ]


@functools.cache
def practice_worlds(family, worlds=1, seed=1):
    """Prepare the worlds of a family of :data:`PUBLIC` and cache them. Raises ValueError."""
    if family not in PUBLIC:
        raise ValueError(f"no family {family!r}: the families are {', '.join(PUBLIC)}")
    return tuple(prepared_worlds(seed, [PUBLIC[family]], worlds))


def practise(make, families=("plain",), worlds=1, seed=1):
    """Run a student's SLAM (the class) on practice worlds with the budget of a contest.

    families : names in :data:`PUBLIC`, or one name. worlds : number per family. Returns a list of
    Trial."""
    budget, found = Budget(guard=functools.partial(time_limit, cpu=True)), []
    with capture_output() as printed:
        for family in [families] if isinstance(families, str) else families:
            for prepared_world in practice_worlds(family, worlds, seed):
                run = run_estimator(make, prepared_world.readings, budget)
                found.append(Trial(prepared_world, run, prepared_world.judge(run)))
    if printed.text:
        print(f"Your code printed:\n{printed.text}\n")
    return found


def table(trials):
    """Format Trials as a table, with a line and the error messages of each Trial."""
    over = "".join(f"{f'{length:g} m':>8}" for length in LENGTHS)
    head = f"{'world':<12}{'points':>7}   error [m] over{over}{'map':>7}{'NEES':>10}{'CPU':>9}"
    lines = [head]
    for trial in trials:
        m = trial.result.measures
        errors = "".join(f"{error:8.3f}" for error in m.errors)
        nees = "none" if m.nees != m.nees else f"{m.nees:.1f}"
        lines.append(
            f"{trial.result.family:<12}{trial.result.points:7.0f}{'':17}{errors}{m.map:7.2f}"
            f"{nees:>10}{trial.run.seconds:7.1f} s"
        )
        lines += [f"    {mistake}" for mistake in trial.result.mistakes]
        if not len(trial.run.points) and not trial.result.mistakes:
            lines.append("    map() returns no points: the map's fifth of the score is lost")
    return "\n".join(lines)
