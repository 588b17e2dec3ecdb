"""Results of ``slamlab run``: summary, report with a table of errors, files, picture."""

import csv
import json
from dataclasses import replace

from slamlab.cli.common import damage_line
from slamlab.estimators.options import checked

MAX_SKIPPED = 0.01  # share of the readings that may be unusable without a warning [1]
COLUMNS = ("time", "x", "y", "theta", "naive_x", "naive_y", "naive_theta")


def summarise(result, estimator, relations=None, options=None):
    """Return the errors and counts for summary.json. ValueError: no relation matches the Run."""
    from slamlab.evaluation import absolute_error, relations_error

    summary = {
        "source": result.source.name,
        "estimator": estimator,
        "options": checked(estimator, options or {}),
        "frames": result.frames,
        "skipped": result.skipped,
        "seconds": round(result.seconds, 3),
        "damage": dict(result.source.damage),
        "counts": dict(result.estimator.counts),
        "notes": list(result.source.notes),
        "warnings": [*result.estimator.warnings, *checks(result)],
    }
    if relations is not None:
        summary["relations"] = _errors(relations_error, result, relations, len(relations.poses))
        summary["relations"]["damage"] = dict(relations.damage)
    truth = result.source.truth
    if truth is not None and len(truth):
        try:
            summary["truth"] = _errors(absolute_error, result, truth, result.frames)
        except ValueError as error:  # clocks that jump: the rest of the summary is still valid
            summary["no_truth"] = str(error)
    return summary


def checks(result):
    """Return the warnings that a Run gives about its source."""
    whole = result.frames + result.source.skipped
    if result.skipped <= MAX_SKIPPED * whole:
        return result.warnings
    share = 100 * result.skipped / whole
    many = f"{result.skipped} of {whole} readings could not be used ({share:.0f} %)"
    return [f"{many}; the result uses only the others", *result.warnings]


def _errors(measure, result, trusted, of):
    """Return errors of the estimate and of odometry (or None), and numbers of compared poses."""
    corrected = measure(result.trajectory, trusted)
    naive = None if result.naive is None else measure(result.naive, trusted)
    return {
        "count": corrected.count,
        "of": of,
        "naive_m": naive and naive.translation,
        "corrected_m": corrected.translation,
        "naive_rad": naive and naive.rotation,
        "corrected_rad": corrected.rotation,
    }


def report(result, summary, verbose=False):
    """Return lines with errors, counts and notes; ``verbose`` adds parameters and timing."""
    source, estimator = result.source, result.estimator
    lines = error_table(summary)
    lines.append(f"{result.frames} readings of {source.name} in {summary['seconds']:.1f} s")
    if estimator.status:
        lines.append(f"{summary['estimator']}: {estimator.status}")
    lines.append(f"{result.skipped} of {result.frames} readings skipped{damage_line(source)}")
    lines += [f"note: {note}" for note in source.notes]
    if verbose:
        lines += [f"parameter {name}: {value}" for name, value in summary["options"].items()]
        lines += [f"count of {what}: {count}" for what, count in sorted(estimator.counts.items())]
        lines.append(f"time per reading: {1000 * result.seconds / result.frames:.2f} ms")
    return lines


def error_table(summary):
    """Return a summary's errors as an aligned table, and lines that explain missing errors."""
    rows, titles = [], {"relations": "relations", "truth": "true poses"}
    for key in (key for key in titles if key in summary):
        found = summary[key]
        for unit, name in (("m", "position [m]"), ("rad", "heading [rad]")):
            errors = (found[f"{whose}_{unit}"] for whose in ("naive", "corrected"))
            texts = ("none" if error is None else f"{error:.3f}" for error in errors)
            rows.append((f"{name}, {found['count']} {titles[key]}", *texts))
    if not rows:
        return list(_left_out(summary))
    rows.insert(0, ("error", "odometry alone", summary["estimator"]))
    first, second, third = (max(map(len, column)) for column in zip(*rows, strict=True))
    table = [f"{what:{first}}  {naive:>{second}}  {own:>{third}}" for what, naive, own in rows]
    return table + list(_left_out(summary))


def _left_out(summary):
    """Yield lines that state what the errors of a summary do not include, and why."""
    if "no_truth" in summary:
        yield f"no errors relative to the true poses: {summary['no_truth']}"
    for key, what in (("relations", "relations"), ("truth", "readings")):
        found = summary.get(key, {"count": 0, "of": 0})
        if found["count"] < found["of"]:
            compared = f"{found['count']} of {found['of']} {what} were compared"
            yield f"{compared}; the others have no counterpart at the same time"
        for kind, count in found.get("damage", {}).items():
            yield f"damage of the {what}: {kind}: {count}"


def write(result, summary, folder, beside=None):
    """Write trajectory.csv, summary.json and map.png (see :func:`picture`) to a folder."""
    from slamlab.views import png

    with (folder / "trajectory.csv").open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(COLUMNS)
        times, poses = result.trajectory.times, result.trajectory.poses
        # without odometry its columns stay empty
        alone = [()] * len(poses) if result.naive is None else result.naive.poses
        for time, pose, naive in zip(times, poses, alone, strict=True):
            row = [repr(float(v)) for v in (time, *pose, *naive)]
            table.writerow(row + [""] * (len(COLUMNS) - len(row)))
    (folder / "map.png").write_bytes(png(picture(result, beside)))
    text = json.dumps(summary, indent=2, ensure_ascii=False)
    (folder / "summary.json").write_text(text + "\n", encoding="utf-8")


def picture(result, naive=None):
    """Return a figure of two maps side by side: by odometry alone, and as estimated.

    ``naive`` is dead reckoning on the same readings, or None if the estimator contains its own.
    """
    from slamlab.layers import Ellipses, Grid, Points, Poses
    from slamlab.views import COLOURS, draw, legend_below, panels
    from slamlab.views.colours import in_legends

    groups = {"naive": [], "corrected": []}
    for layer in [] if naive is result.estimator else result.estimator.layers():
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
