"""Feedback page for the student: each task, its laws, the points, and what would gain the rest."""

from pathlib import Path

import jinja2

from slamlab.exercises import catalogue
from slamlab.exercises.report import BROKEN, KEPT, WAITS, marked_laws, number, points, reason
from slamlab.grading.local_times import local_time
from slamlab.grading.marks import Mark
from slamlab.grading.records import write_atomically

TEMPLATES = jinja2.Environment(
    loader=jinja2.FileSystemLoader(Path(__file__).parent),
    autoescape=True,
    undefined=jinja2.StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)
CLASSES = {KEPT: "kept", BROKEN: "broken", WAITS: "waits"}


def feedback_page(mark: Mark, student=None, zone=None) -> str:
    """The feedback page of a submission; whatever the student wrote is escaped.

    Parameters
    ----------
    mark : Mark
    student : str or None, the name to show; None: as the record has it
    zone : ZoneInfo or None, of the times shown; None: UTC

    Returns
    -------
    str, HTML without scripts or anything to load
    """
    return TEMPLATES.get_template("feedback.html").render(
        mark=mark,
        record=mark.record,
        title=title(mark, student),
        handed_in=local_time(mark.record.handed_in, zone, named=True),
        text=feedback_text(mark, student, zone),
    )


def feedback_text(mark: Mark, student=None, zone=None) -> str:
    """The feedback as plain text, to be copied into a message.

    Parameters
    ----------
    mark, student, zone : as of :func:`feedback_page`

    Returns
    -------
    str, lines
    """
    record, lines = mark.record, [title(mark, student)]
    if record.graded:
        lines.append(f"{number(mark.total)} of {points(record.max_score)}")
    else:
        by_hand = f", {points(mark.total)} by hand" if mark.total is not None else ""
        lines.append(f"Could not be graded{by_hand}: {record.reason}")
    if mark.late_penalty:
        when = local_time(record.handed_in, zone, named=True)
        lines.append(f"{points(mark.late_penalty)} taken for lateness, handed in {when}")
    for task, why in mark.override_reasons.items():
        lines.append(f"{task} set by hand to {points(mark.points[task])}: {why}")
    lines += mark.remarks
    for verdict in record.verdicts:
        earned = f"{number(mark.points[verdict.task])} of {points(verdict.max_points)}"
        by_hand = verdict.task in mark.override_reasons
        earned += f", set by hand; {number(verdict.points)} by the laws" * by_hand
        lines += ["", f"{record.titles.get(verdict.task, verdict.task)}: {earned}"]
        lines += [f"  {verdict.problem}"] if verdict.problem else []
        lines += [f"  {sign} {law.says}{_why(law, sign)}" for law, sign in laws_of(verdict)]
        lines += [f"  Hint: {verdict.hint}"] if verdict.hint else []
    cells = [f"  cell {cell}: {problem}" for cell, problem in record.cells.items()]
    lines += ["", "Cells that did not run to their end", *cells] if cells else []
    return "\n".join(lines) + "\n"


def laws_of(verdict):
    """The laws of a verdict with their marks, as the notebook tells them; see ``marked_laws``."""
    try:
        task = catalogue.task(verdict.task)
    except KeyError:  # of another version
        task = None
    return marked_laws(verdict, task)


def _why(law, mark):
    return f": {why}" if (why := reason(law, mark)) else ""


def title(mark: Mark, student=None) -> str:
    """The title of a page: exercise and student."""
    of = mark.record.exercise
    known = of in catalogue.EXERCISES if of else False
    what = f"Exercise {of}: {catalogue.exercise(of).title}" if known else "An exercise"
    return f"{what} · {student or mark.record.student}"


TEMPLATES.filters |= {"number": number, "points": points}
TEMPLATES.globals |= {"laws_of": laws_of, "classes": CLASSES, "reason": reason}


def write_feedback_page(out: Path, mark: Mark):
    """Write the feedback page to ``out/feedback``; one of before its exercise was known goes."""
    folder, record = out / "feedback", mark.record
    write_atomically(folder / f"{record.stem}.html", feedback_page(mark))
    if record.exercise:
        (folder / f"{record.stem_of_unknown}.html").unlink(missing_ok=True)
