"""``slamlab run SOURCE --estimator NAME``: run SLAM over a source; summary, map, trajectory."""

import csv
import json
import sys
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

from slamlab.cli.common import (
    SOURCES,
    Interruptible,
    add_estimator_options,
    damage_line,
    estimator_options,
    generator,
)
from slamlab.estimators.options import checked

COLUMNS = ("time", "x", "y", "theta", "naive_x", "naive_y", "naive_theta")


def add_parser(subparsers):
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "run",
        help="run a SLAM over a log or a simulation",
        description=(
            "Run an estimator over a source and say how far it got. With --out it writes "
            "trajectory.csv, map.png (odometry alone beside the estimate) and summary.json. Ctrl-C "
            "ends a run early, which is how a live one ends: its robot stops, and what it came to "
            "until then is told and written."
        ),
    )
    parser.add_argument("source", metavar="SOURCE", help=SOURCES)
    parser.add_argument("--out", metavar="DIR", type=Path, help="a folder for the results")
    parser.add_argument(
        "--tum",
        metavar="FILE",
        type=Path,
        help="where to write the trajectory as TUM text, which evo reads",
    )
    parser.add_argument(
        "--film",
        metavar="FILE",
        type=Path,
        help="where to record a film of the run, which slamlab film plays",
    )
    parser.add_argument(
        "--relations",
        metavar="FILE",
        help="trusted relative poses to judge by, lines of t1 t2 x y z roll pitch yaw",
    )
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="of a simulation's noise")
    parser.add_argument(
        "--merge", metavar="N", type=int, help="turns of a lidar that become one scan (1)"
    )
    add_estimator_options(parser)
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Run; 0 when done, 130 after Ctrl-C, 2 when something cannot be read or written."""
    # imported late: what a help text needs should come at once
    from slamlab import estimators, evaluation, sources

    try:
        # whatever can be wrong is found before the long run, not after it
        relations = None
        if arguments.relations is not None:
            relations = evaluation.load_relations(arguments.relations)
        with sources.open(arguments.source, generator(arguments.seed)) as opened:
            if arguments.merge is not None:
                opened.merge(arguments.merge)
            source = Interruptible(opened)
            estimator = estimators.make(arguments.estimator, source, **estimator_options(arguments))
            if arguments.out is not None:
                arguments.out.mkdir(parents=True, exist_ok=True)
            if arguments.tum is not None:
                arguments.tum.touch()
            naive = _naive_beside(estimator)
            with _film(arguments, opened) as film:
                result = _with_progress(source, estimator, naive, film)
        if not result.frames:
            raise sources.SourceError(f"{source.name} gave no reading")
        summary = summarise(result, arguments.estimator, relations, estimator_options(arguments))
        if arguments.out is not None:
            write(result, summary, arguments.out, naive)
        if arguments.tum is not None:
            evaluation.save_tum(result.trajectory, arguments.tum)
    except OSError as error:
        where = error.filename or arguments.out
        what = "a file, not a folder" if isinstance(error, FileExistsError) else error.strerror
        print(f"slamlab run: {where}: {what}", file=sys.stderr)
        return 2
    except ValueError as error:
        print(f"slamlab run: {error}", file=sys.stderr)
        return 2
    _print(summary)
    if estimator.status:
        print(f"{arguments.estimator}: {estimator.status}")
    print(f"{result.skipped} of {result.frames} readings skipped{damage_line(source)}")
    if source.ended:
        print(
            f"slamlab run: {source.ended} (all this is of the readings until then)", file=sys.stderr
        )
    if arguments.out is not None:
        print(f"written to {arguments.out}: trajectory.csv, map.png, summary.json")
    if arguments.tum is not None:
        print(f"written to {arguments.tum}: the trajectory as TUM text")
    if arguments.film is not None:
        print(f"written to {arguments.film}: the film; slamlab film {arguments.film} plays it")
    return source.code


def summarise(result, estimator, relations=None, options=None):
    """Summarise a run (trajectory errors, counts) as plain numbers for summary.json.

    Parameters
    ----------
    result : Run
    estimator : str, its name
    relations : Relations or None
    options : {name: value} of the estimator, or None

    Returns
    -------
    dict

    Raises
    ------
    ValueError : no relation belongs to this source
    """
    from slamlab.evaluation import absolute_error, relations_error

    summary = {
        "source": result.source.name,
        "estimator": estimator,
        "options": checked(estimator, options or {}),
        "frames": result.frames,
        "skipped": result.skipped,
        "seconds": round(result.seconds, 3),
        "damage": dict(result.source.damage),
        "warnings": list(result.estimator.warnings),
    }
    if relations is not None:
        summary["relations"] = _errors(relations_error, result, relations)
    truth = result.source.truth
    # readings lost to damage leave no true pose for each estimate
    if truth is not None and len(truth) == result.frames:
        summary["truth"] = _errors(absolute_error, result, truth)
    return summary


def _errors(measure, result, trusted):
    """How far the naive and the corrected trajectory are off by a measure, as plain numbers."""
    naive, corrected = (measure(t, trusted) for t in (result.naive, result.trajectory))
    return {
        "count": corrected.count,
        "naive_m": naive.translation,
        "corrected_m": corrected.translation,
        "naive_rad": naive.rotation,
        "corrected_rad": corrected.rotation,
    }


def write(result, summary, folder, beside=None):
    """Write trajectory.csv, map.png and summary.json.

    Parameters
    ----------
    result : Run
    summary : dict
    folder : Path, there already
    beside : DeadReckoning or None, see :func:`picture`
    """
    from slamlab.views import png

    with (folder / "trajectory.csv").open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(COLUMNS)
        for time, pose, naive in zip(
            result.trajectory.times, result.trajectory.poses, result.naive.poses, strict=True
        ):
            table.writerow([repr(float(v)) for v in (time, *pose, *naive)])
    (folder / "map.png").write_bytes(png(picture(result, beside)))
    text = json.dumps(summary, indent=2, ensure_ascii=False)
    (folder / "summary.json").write_text(text + "\n", encoding="utf-8")


def picture(result, naive=None):
    """Draw the map by odometry alone beside the estimated one, with trajectories.

    Parameters
    ----------
    result : Run
    naive : DeadReckoning or None, run over the same readings; None where the estimator keeps a
        map by odometry alone itself

    Returns
    -------
    Figure
    """
    from slamlab.layers import Ellipses, Grid, Points, Poses
    from slamlab.views import COLOURS, draw, legend_below, panels
    from slamlab.views.colours import in_legends

    layers = [] if naive is result.estimator else result.estimator.layers()
    groups = {"naive": [], "corrected": []}
    for layer in layers:
        groups["naive" if layer.name == "naive" else "corrected"].append(layer)
    if naive is not None:
        groups["naive"] = [replace(layer, name="naive") for layer in naive.layers()]
    shown = [(name, group) for name, group in groups.items() if group]
    titles = [in_legends(name) for name, _ in shown]
    fig, all_axes = panels(titles, size=(6 * len(shown), 6))
    for ax, title, (name, group) in zip(all_axes, titles, shown, strict=True):
        for layer in group:
            around = f"{layer.name} 95 %"
            points = "landmark" if layer.name == "landmark" else "map"
            kinds = {Points: points, Grid: "map", Poses: "track", Ellipses: around}
            what = kinds.get(type(layer), layer.name)
            colour = COLOURS["robot"] if what == "track" else COLOURS.get(layer.name, COLOURS[name])
            draw(ax, layer, label=f"{title}: {what}", color=colour)
    legend_below(fig)
    fig.suptitle(result.source.name.rpartition("/")[2])
    return fig


def _naive_beside(estimator):
    """Dead reckoning to run beside an estimator that has no such map; None where it has one."""
    from slamlab.estimators.dead_reckoning import DeadReckoning

    if isinstance(estimator, DeadReckoning):
        return estimator
    has_one = any(layer.name == "naive" for layer in estimator.layers())
    return None if has_one else DeadReckoning()


def _film(arguments, source):
    """The recorder of --film; a context of nothing where none is wanted."""
    if arguments.film is None:
        return nullcontext()
    from slamlab.films import FilmRecorder

    title = f"{arguments.estimator} on {source.name.rpartition('/')[2]}"
    return FilmRecorder(
        arguments.film, title, f"Film of a map as it grows, x across, y up: {title}."
    )


def _with_progress(source, estimator, naive=None, film=None):
    from rich.console import Console
    from rich.progress import Progress

    from slamlab.estimators.runner import run as feed

    if film is not None:
        from slamlab.views.live.run_scene import run_scene  # late: it takes a plotting library

    beside = {"naive": naive} if naive not in (None, estimator) else {}
    # in a notebook, too, a command's progress goes where its errors go
    console = Console(stderr=True, force_jupyter=False)
    with Progress(console=console, transient=True) as progress:
        bar = progress.add_task("running", total=len(source) or None)

        def on_step(reading, estimator):
            if naive not in (None, estimator):
                naive.step(reading)
            if film is not None:
                count = film.frames + 1
                film.add(run_scene(source, estimator, beside, count, reading.time))
            progress.advance(bar)

        return feed(source, estimator, on_step)


def _print(summary):
    from rich.console import Console
    from rich.table import Table

    table = Table("error", "odometry alone", summary["estimator"])
    for key, title in (("relations", "relations"), ("truth", "true poses")):
        if key in summary:
            row = summary[key]
            for unit, name in (("m", "position [m]"), ("rad", "heading [rad]")):
                table.add_row(
                    f"{name}, {row['count']} {title}",
                    f"{row[f'naive_{unit}']:.3f}",
                    f"{row[f'corrected_{unit}']:.3f}",
                )
    if table.row_count:
        Console(markup=False).print(table)  # which would take [m] for a style
    print(f"{summary['frames']} readings of {summary['source']} in {summary['seconds']:.1f} s")
