"""Rejudge report: the scores that change when attempts are rejudged, and the reasons."""

from classroom.exercises.task import UNCHANGED
from classroom.exercises.verdict_text import number
from classroom.grading.grade_tables import write_table
from classroom.grading.marks import mark

COLUMNS = ("exercise", "student", "submission", "old_score", "new_score", "reason")


def changes(judged, overrides, policy=None):
    """Return changed scores as (change of points, row of COLUMNS), largest losses first. Scores
    include overrides and late penalties.
    """
    found = []
    for one in judged:
        if not one.changed:
            continue
        old, new = (mark(record, overrides, policy) for record in (one.before, one.after))
        why = reasons(one.before, one.after) or ["only texts changed"]
        by_hand = [f"{task} is set by hand" for task in new.override_reasons]
        who = one.after.exercise, one.after.student, one.after.submission
        points = (number(round(made.total, 6)) for made in (old, new))
        row = (*who, *points, "; ".join([*why, *by_hand]))
        found.append((round(new.total - old.total, 6), row))
    return sorted(found)


def write_changes(out, found):
    write_table(out / "rejudged.csv", [COLUMNS, *(row for _, row in found)])


def reasons(before, after):
    """List the reasons for changed points, by task and law."""
    old, new = ({v.task: v for v in record.verdicts} for record in (before, after))
    found = [f"{task} was removed" for task in old if task not in new]
    for task, verdict in new.items():
        was = old.get(task)
        if was is None:
            found.append(f"{task} is new: {number(verdict.points)}")
        elif (was.points, was.max_points, was.problem) != (
            verdict.points, verdict.max_points, verdict.problem,
        ):  # fmt: skip
            points = f"{number(was.points)} → {number(verdict.points)}"
            why = _of_laws(was, verdict) or [f"{was.problem or 'judged'}, now {verdict.problem}"]
            found.append(f"{task} {points}: {', '.join(why)}")
    return found


def _of_laws(was, verdict):
    old, new = ({law.name: law for law in v.laws} for v in (was, verdict))
    if not old or not new:
        return [] if verdict.problem else ["can be judged now"]
    # the law of unchanged arguments is listed only if another law earns points
    found = [f"“{name}” was removed" for name in old if name not in new and name != UNCHANGED.name]
    for name, law in new.items():
        before = old.get(name)
        state = "is broken" if law.failed else "holds"
        if before is None and name != UNCHANGED.name:
            found.append(f"“{name}” is new and {state}")
        elif before is None:
            continue
        elif bool(before.failed) != bool(law.failed):
            found.append(f"“{name}” now {state}")
        elif before.max_points != law.max_points:
            worth = f"{number(law.max_points)} instead of {number(before.max_points)} points"
            found.append(f"“{name}” is worth {worth}")
        elif before.points != law.points:
            found.append(f"“{name}” earns {number(law.points)} with the other laws")
    return found
