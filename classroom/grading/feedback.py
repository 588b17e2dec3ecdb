"""Feedback page for the student: the tasks, their laws, points and hints."""

from pathlib import Path

from classroom.exercises import catalogue
from classroom.exercises.verdict_text import (
    BROKEN,
    KEPT,
    WAITS,
    marked_laws,
    number,
    points,
    reason,
)
from classroom.grading.local_times import local_time
from classroom.grading.marks import Mark
from classroom.grading.page_templates import templates
from classroom.grading.records import write_atomically

TEMPLATES = templates(Path(__file__).parent)
CLASSES = {KEPT: "kept", BROKEN: "broken", WAITS: "waits"}


def feedback_page(mark: Mark, student=None, zone=None) -> str:
    """Return an HTML page without scripts or external files, with the student's texts escaped.
    ``student`` is the name to show (default: the name in the record).
    """
    return TEMPLATES.get_template("feedback.html").render(
        mark=mark,
        record=mark.record,
        title=title(mark, student),
        handed_in=local_time(mark.record.handed_in, zone, named=True),
        text=feedback_text(mark, student, zone),
    )


def feedback_text(mark: Mark, student=None, zone=None) -> str:
    """Return the feedback as plain text."""
    record, lines = mark.record, [title(mark, student)]
    if record.graded:
        lines.append(f"{number(mark.total)} of {points(record.max_score)}")
    else:
        manual = f" Score set by hand: {points(mark.total)}." if mark.total is not None else ""
        lines.append(f"Your submission could not be graded: {record.reason}.{manual}")
    lines += [*filter(None, [mark.late]), *mark.overrides, *mark.others, *mark.remarks]
    cells = [f"  cell {cell}: {problem}" for cell, problem in record.cells.items()]
    lines += ["", "Cells that failed", *cells] if cells else []
    for verdict in record.verdicts:
        earned = f"{number(mark.points[verdict.task])} of {points(verdict.max_points)}"
        overridden = verdict.task in mark.override_reasons
        earned += f", set by hand; {number(verdict.points)} by the autograder" * overridden
        lines += ["", f"{mark.title(verdict.task)}: {earned}"]
        lines += [f"  {text}" for text in (verdict.carried, verdict.problem) if text]
        lines += [f"  {sign} {law.says}{_why(law, sign)}" for law, sign in laws_of(verdict)]
        lines += [f"  Hint: {verdict.hint}"] if verdict.hint else []
    return "\n".join(lines) + "\n"


def laws_of(verdict):
    try:
        task = catalogue.task(verdict.task)
    except KeyError:  # the task is of another version
        task = None
    return marked_laws(verdict, task)


def _why(law, mark):
    return f": {why}" if (why := reason(law, mark)) else ""


def title(mark: Mark, student=None) -> str:
    of = mark.record.exercise
    known = of in catalogue.EXERCISES if of else False
    what = f"Exercise {of}: {catalogue.exercise(of).title}" if known else "Unknown exercise"
    return f"{what} · {student or mark.record.student}"


TEMPLATES.filters |= {"number": number, "points": points}
TEMPLATES.globals |= {"laws_of": laws_of, "classes": CLASSES, "reason": reason}


def write_feedback_page(out: Path, mark: Mark):
    """Write the page into ``out/feedback``; delete the page that was written while the exercise was
    unknown.
    """
    folder, record = out / "feedback", mark.record
    write_atomically(folder / f"{record.stem}.html", feedback_page(mark))
    if record.exercise:
        (folder / f"{record.stem_of_unknown}.html").unlink(missing_ok=True)
