"""``slamlab run SOURCE --estimator NAME``: run SLAM on a source; save map and trajectory."""

import json
import sys
from pathlib import Path

from slamlab.cli.common import (
    Interruptible,
    add_estimator_options,
    add_source,
    estimator_parameters,
    film_recorder,
    open_source,
    refuse,
)
from slamlab.cli.parsers import UsageError, add_command
from slamlab.cli.progress_line import progress_line


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "run",
        "Run an estimator on a source of readings and report its errors.",
        "intel --estimator graph --out result",
        "sim:situation-1 --estimator walls --seed 3 --json",
    )
    add = parser.add_argument
    add("--out", metavar="DIR", type=Path, help="Folder for trajectory.csv, map.png, summary.json")
    add("--tum", metavar="FILE", type=Path, help="File for the trajectory as TUM text, for evo")
    add("--film", metavar="FILE", type=Path, help="File for a film, which slamlab film plays")
    relations = "True relative poses to compare with, as lines of t1 t2 x y z roll pitch yaw"
    add("--relations", metavar="FILE", help=relations)
    add_source(parser, merge=True)
    add_estimator_options(parser)
    add = parser.add_argument_group("what is printed").add_argument
    add("--json", action="store_true", help="Print the summary as JSON; messages go to stderr")
    add("-q", "--quiet", action="store_true", help="Print only warnings, errors and JSON")
    add("-v", "--verbose", action="store_true", help="Also print parameters, counts and timing")
    parser.set_defaults(run=run)


def run(arguments) -> int:
    # imported late: a help text should come at once
    from slamlab import estimators, evaluation
    from slamlab.cli.run_results import summarise, write
    from slamlab.files import SourceError

    name = arguments.estimator
    try:
        # whatever can be wrong is found before the long run, not after it
        parameters = estimator_parameters(arguments)
        relations = None
        if arguments.relations is not None:
            relations = evaluation.load_relations(arguments.relations)
        with open_source(arguments) as opened:
            source = Interruptible(opened)
            estimator = estimators.make(name, source, **parameters)
            if arguments.out is not None:
                arguments.out.mkdir(parents=True, exist_ok=True)
            if arguments.tum is not None:
                arguments.tum.touch()
            naive = _naive_beside(estimator) if source.has_odometry else None
            with film_recorder(arguments.film, name, opened.name.rpartition("/")[2]) as film:
                result = _with_progress(source, estimator, naive, film)
        if not result.frames:
            raise SourceError(f"{source.name} contains no readings")
        summary = summarise(result, name, relations, parameters)
        if arguments.out is not None:
            write(result, summary, arguments.out, naive)
        if arguments.tum is not None:
            evaluation.save_tum(result.trajectory, arguments.tum)
    except OSError as error:
        if isinstance(error, FileExistsError):
            error = UsageError(f"{error.filename} is a file, not a folder")
        return refuse("run", error)
    except ValueError as error:
        return refuse("run", error)
    _report(arguments, result, summary)
    return source.code


def _naive_beside(estimator):
    """Return the dead reckoning for comparison, or None if the estimator contains its own."""
    from slamlab.estimators.dead_reckoning import DeadReckoning

    if isinstance(estimator, DeadReckoning):
        return estimator
    has_one = any(layer.name == "naive" for layer in estimator.layers())
    return None if has_one else DeadReckoning()


def _with_progress(source, estimator, naive, film):
    from slamlab.estimators.runner import run as feed

    if film is not None:
        from slamlab.live.run_scene import run_scene  # late: it imports a plotting library

    beside = {} if naive in (None, estimator) else {"naive": naive}
    with progress_line(len(source)) as advance:

        def on_step(reading, estimator):
            if beside:
                naive.step(reading)
            if film is not None:
                film.add(run_scene(source, estimator, beside, film.frames + 1, reading.time))
            advance()

        return feed(source, estimator, on_step)


def _report(arguments, result, summary):
    from slamlab.cli.run_results import checks, report

    # the report shows the estimator's own warnings
    for warning in summary["warnings"] if arguments.quiet else checks(result):
        print(f"slamlab run: warning: {warning}", file=sys.stderr)
    if result.source.ended:
        ended = f"{result.source.ended}. The results cover the readings up to that point."
        print(f"slamlab run: {ended}", file=sys.stderr)
    if arguments.json:
        print(json.dumps(summary, ensure_ascii=False))
    lines = report(result, summary, arguments.verbose)
    written = {
        arguments.out: "trajectory.csv, map.png, summary.json",
        arguments.tum: "the trajectory as TUM text",
        arguments.film: f"the film; slamlab film {arguments.film} plays it",
    }
    lines += [f"written to {path}: {what}" for path, what in written.items() if path is not None]
    if not arguments.quiet:
        print("\n".join(lines), file=sys.stderr if arguments.json else sys.stdout)
