"""Who gains and who loses when attempts are judged again, and why."""

from slamlab.exercises.report import number
from slamlab.exercises.task import UNCHANGED
from slamlab.grading.grade_tables import write_table
from slamlab.grading.marks import mark

COLUMNS = ("exercise", "student", "submission", "before", "after", "why")


def changes(judged, overrides, policy=None):
    """The attempts of which something changed, those that lose most first.

    Parameters
    ----------
    judged : list of Rejudged
    overrides : as of :meth:`Gradebook.overrides`
    policy : LatePolicy or None, for that which was stored

    Returns
    -------
    list of (change of points, row of COLUMNS), points after overrides and lateness
    """
    found = []
    for one in judged:
        if not one.changed:
            continue
        old, new = (mark(record, overrides, policy) for record in (one.before, one.after))
        why = reasons(one.before, one.after) or ["the same points, other words"]
        by_hand = [f"{task} was set by hand" for task in new.override_reasons]
        who = one.after.exercise, one.after.student, one.after.submission
        points = (number(round(made.total, 6)) for made in (old, new))
        row = (*who, *points, "; ".join([*why, *by_hand]))
        found.append((round(new.total - old.total, 6), row))
    return sorted(found)


def write_changes(out, found):
    """Write ``rejudged.csv``, a row for each change."""
    write_table(out / "rejudged.csv", [COLUMNS, *(row for _, row in found)])


def reasons(before, after):
    """Why the points of an attempt are others, task by task and law by law.

    Parameters
    ----------
    before, after : Record

    Returns
    -------
    list of str
    """
    old, new = ({v.task: v for v in record.verdicts} for record in (before, after))
    told = [f"{task} is gone" for task in old if task not in new]
    for task, verdict in new.items():
        was = old.get(task)
        if was is None:
            told.append(f"{task} is new: {number(verdict.points)}")
        elif (was.points, was.max_points, was.problem) != (
            verdict.points, verdict.max_points, verdict.problem,
        ):  # fmt: skip
            points = f"{number(was.points)} → {number(verdict.points)}"
            why = _of_laws(was, verdict) or [f"{was.problem or 'judged'}, now {verdict.problem}"]
            told.append(f"{task} {points}: {', '.join(why)}")
    return told


def _of_laws(was, verdict):
    old, new = ({law.name: law for law in v.laws} for v in (was, verdict))
    if not old or not new:
        return [] if verdict.problem else ["it can be judged now"]
    # that of the arguments stands only where another one earns
    told = [f"“{name}” is gone" for name in old if name not in new and name != UNCHANGED.name]
    for name, law in new.items():
        before = old.get(name)
        state = "is broken" if law.failed else "holds"
        if before is None and name != UNCHANGED.name:
            told.append(f"“{name}” is new and {state}")
        elif before is None:
            continue
        elif bool(before.failed) != bool(law.failed):
            told.append(f"“{name}” {state} now")
        elif before.max_points != law.max_points:
            worth = f"{number(law.max_points)} instead of {number(before.max_points)}"
            told.append(f"“{name}” is worth {worth}")
        elif before.points != law.points:
            told.append(f"“{name}” earns {number(law.points)} beside the others")
    return told
