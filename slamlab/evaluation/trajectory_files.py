"""Loading and saving of trajectories: TUM trajectory format, EuRoC, KITTI, tables with headers."""

import warnings
from pathlib import Path

import numpy as np

from slamlab.evaluation.planar_projection import orientation_faults, planar, planar_in_other_order
from slamlab.evaluation.text_table import TextTable
from slamlab.evaluation.trajectory_formats import FORMATS, LATEST, columns_of
from slamlab.files import SourceError, reason
from slamlab.readings import Trajectory
from slamlab.sources.log_units import TIME_UNITS, headings_in_degrees

EARLIEST = 9e8  # least timestamp of a log in seconds since 1970 (1998)
W_AT = {"TUM": (-1, "first"), "EuRoC": (1, "last")}  # alternative position of w
# with a tenth of other damage, the file has another format
EXPECTED = "rows that are not finite", "quaternions of length 0", "file truncated"


def save_tum(trajectory, path):
    """Save a Trajectory as TUM with all digits of times and positions. Raises SourceError."""
    x, y, theta = trajectory.poses.T
    zero = np.zeros(len(trajectory))
    half = theta / 2
    table = [trajectory.times, x, y, zero, zero, zero, np.sin(half), np.cos(half)]
    rows = np.column_stack(table).tolist()
    text = "".join(" ".join(map(repr, row)) + "\n" for row in rows)
    try:
        Path(path).write_text(text, encoding="ascii")
    except OSError as error:
        raise SourceError(f"{path} cannot be written: {reason(error)}") from None


def load_trajectory(path):
    """Load a trajectory from a TUM, EuRoC or KITTI file, or from a table with a header, such as
    ``trajectory.csv`` of ``slamlab run``. A warning reports skipped rows and assumptions.

    path : str or Path, plain or gzip. Returns a Trajectory, times [s], poses [m, m, rad] projected
    to the plane. Raises SourceError if there is no trajectory, or for timestamps that are not
    ascending.
    """
    table = TextTable(path, f"pose: {FORMATS}")
    kind, columns = columns_of(table)
    what = f"{path}, read as {kind}"
    numbers, values = table.read((i for i, _ in columns.values()), "rows that are not poses")
    values *= [factor or 1.0 for _, factor in columns.values()]
    usable = np.ones(len(numbers), bool)
    for fault, bad in orientation_faults(dict(zip(columns, values.T, strict=True))).items():
        table.count(fault, numbers[bad])
        usable &= ~bad
    numbers, got = numbers[usable], dict(zip(columns, values[usable].T, strict=True))
    malformed = sum(n for fault, n in table.damage.items() if fault not in EXPECTED)
    if not len(numbers) or 10 * malformed > len(numbers) + malformed:
        raise SourceError(
            f"{what}: {len(numbers)} usable poses; {table.damage_summary()}; {FORMATS}"
        )
    notes = [f"skipped {table.damage_summary()}"] if table.damage else []
    times = _timed(table, columns, got, notes)
    _check_rising(what, times, numbers)
    if "theta" in columns and columns["theta"][1] is None:
        _check_radians(what, got)
    if kind in W_AT and planar_in_other_order(got, W_AT[kind][0]):
        raise SourceError(
            f"{what}: its poses are tilted, but not if qw is the {W_AT[kind][1]} of the four "
            "numbers: name the columns in the first line"
        )
    poses, projection = planar(got)
    if notes + projection:
        warnings.warn(f"{what}: {'; '.join(notes + projection)}", stacklevel=2)
    return Trajectory(times, poses)


def _timed(table, columns, got, notes):
    """Return timestamps (n,) in seconds: from the file, from times.txt, or the indices."""
    if "t" in got:
        return got["t"] * (1.0 if columns["t"][1] else _unit(got["t"], notes))
    if "sec" in got or "nsec" in got:
        return got.get("sec", 0.0) + 1e-9 * got.get("nsec", 0.0)
    if table.damage:
        raise SourceError(
            f"{table.path}: {table.damage_summary()}; without timestamps the poses are numbered, "
            "so no row may be skipped: correct the row"
        )
    path, count = Path(table.path), len(got["x"])
    in_kitti = path.parent.with_name("sequences") / path.stem / "times.txt"
    for beside in (path.with_name("times.txt"), in_kitti):
        if beside.is_file():
            stamps = TextTable(beside, "time: a row has one, in seconds")
            times = stamps.read([0], "rows that are not times")[1][:, 0]
            if len(times) == count and not stamps.damage:
                return times
            raise SourceError(
                f"{beside} has {len(times)} times, but {path} has {count} poses "
                f"{stamps.damage_summary()}"
            )
    notes.append("without times.txt, the times of the poses are their indices 0, 1, 2, …")
    return np.arange(float(count))


def _unit(times, notes):
    """Return the factor to seconds if timestamps since 1970 have another unit, otherwise 1."""
    for factor, unit in TIME_UNITS.items():
        if factor < 1 and times.min() * factor >= EARLIEST and times.max() * factor <= LATEST:
            notes.append(f"its timestamps are {unit} since 1970, multiplied by {factor:g}")
            return factor
    if times.max() > LATEST:
        notes.append(
            f"its timestamps reach {times.max():.3g} s: if they are in another unit, name it in a "
            "header, such as time [ns]"
        )
    return 1.0


def _check_rising(what, times, numbers):
    """Raise SourceError if the timestamps are not ascending."""
    wrong = np.flatnonzero(np.diff(times) <= 0)
    if not len(wrong):
        return
    before, line = numbers[wrong[0]], numbers[wrong[0] + 1]
    if times[wrong[0]] == times[wrong[0] + 1]:
        why = f"repeats that of line {before}: remove one of them, or write more digits"
    else:
        why = f"is before that of line {before}: sort the rows, or split off a second trajectory"
    raise SourceError(f"{what}, line {line}: its timestamp {why}")


def _check_radians(what, got):
    """Raise SourceError if headings seem to be in degrees and no unit is stated."""
    if headings_in_degrees(np.column_stack([got["x"], got["y"], got["theta"]])):
        raise SourceError(
            f"{what}: headings up to {np.abs(got['theta']).max():.4g} match the path in degrees, "
            "not in radians; name their unit in the first line, such as theta [deg]"
        )
