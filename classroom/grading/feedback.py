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
FAILED = "Cells that failed"
RAN = (
    "Grading runs all code cells once, from top to bottom, in a new kernel and without your other "
    "files; it goes on after a failed cell. Kernel → Restart Kernel and Run All Cells does so "
    "with your files, as far as the first error. Numbers count all cells, those with text, too."
)
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
    lines += ["", f"{FAILED}. {how_cells_ran(record)}", *cells] if cells else []
    for verdict in record.verdicts:
        earned = f"{number(mark.points[verdict.task])} of {points(verdict.max_points)}"
        overridden = verdict.task in mark.override_reasons
        earned += f", set by hand; {number(verdict.points)} by the autograder" * overridden
        lines += ["", f"{mark.title(verdict.task)}: {earned}"]
        lines += [f"  {text}" for text in (verdict.carried, verdict.problem) if text]
        lines += [f"  {sign} {law.says}{_why(law, sign)}" for law, sign in laws_of(verdict)]
        lines += [f"  Hint: {verdict.hint}"] if verdict.hint else []
    return "\n".join(lines) + "\n"


def how_cells_ran(record):
    """Explain to the student how the cells were run."""
    free = " The failed cells cost no points, so you need not submit again." * all(
        verdict.full for verdict in record.verdicts
    )
    return f"{RAN}{free}"


def advice(record, verdict):
    """State what gains the points that a task lost, as far as "… with check(…)"."""
    if verdict.laws:
        return "correct your function so that the statements marked ✗ are true, and test it"
    if verdict.kind == "not attempted":
        return "solve the task, save the notebook before you submit it, and test your function"
    if record.cells and verdict.kind in ("missing", "raised"):
        return f"first correct the cells under “{FAILED}”, then test your function"
    if verdict.kind == "missing":
        return (
            "no code cell defines the function: it may be renamed or deleted, or stand in a text "
            "cell; correct this, and test it"
        )
    return "correct your function, and test it"


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
TEMPLATES.globals |= {"laws_of": laws_of, "classes": CLASSES, "reason": reason, "failed": FAILED,
                      "advice": advice, "how_cells_ran": how_cells_ran}  # fmt: skip


def write_feedback_page(out: Path, mark: Mark):
    """Write the page into ``out/feedback``; delete the page that was written while the exercise was
    unknown.
    """
    folder, record = out / "feedback", mark.record
    write_atomically(folder / f"{record.stem}.html", feedback_page(mark))
    if record.exercise:
        (folder / f"{record.stem_of_unknown}.html").unlink(missing_ok=True)
