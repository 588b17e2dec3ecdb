"""Grade tables of a term, for all exercises and for each one, with a row per enrolled student."""

from classroom.exercises import catalogue
from classroom.exercises.verdict_text import number
from classroom.grading.grade_tables import (
    detail_cells,
    detail_titles,
    submission_rows,
    write_table,
)
from classroom.grading.local_times import local_time
from classroom.grading.term.exercise_results import points_of

WHO = ("id", "name", "email", "section")


def write_term(course, exercise_results, marks):
    """Write ``grades.csv`` for all exercises and for each one, and ``submissions.csv``. Return the
    results whose rows have changed.
    """
    write_table(course.results / "grades.csv", _over_all(exercise_results))
    changed = []
    for id, of_exercise in exercise_results.items():
        table = course.results / id / "grades.csv"
        if table.exists() or any(result.attempts for result in of_exercise):
            before = set(_lines(table))
            write_table(table, exercise_rows(of_exercise, course.zone))
            now = zip(of_exercise, _lines(table)[1:], strict=True)
            changed += [result for result, line in now if line not in before]
    newest = sorted(marks, key=lambda made: made.record.submission)
    write_table(course.results / "submissions.csv", submission_rows(newest, zone=course.zone))
    return changed


def _lines(table):
    """Return the lines of a table, one for each row, because no cell contains a line break."""
    return table.read_text("utf-8").splitlines() if table.exists() else []


def exercise_rows(exercise_results, zone):
    """Yield column titles, then one row per student."""
    exercises = [catalogue.exercise(exercise_results[0].exercise)]
    yield [*WHO, "status", "score", "max_score", "late_penalty", "submitted", "due", "attempts",
           "note", "submission", *detail_titles(exercises)]  # fmt: skip
    for result in exercise_results:
        made, record = result.mark, result.mark and result.mark.record
        yield [
            *_who(result.student),
            result.status,
            _points(result.total),
            number(exercises[0].points),
            _points(made.late_penalty or None) if made else "",
            local_time(record.handed_in, zone) if record else "",
            local_time(result.due, zone),
            str(result.attempts),
            _note(result),
            record.submission if record else "",
            *(detail_cells(made, exercises) if made else [""] * len(detail_titles(exercises))),
        ]


def _over_all(exercise_results):
    yield [*WHO, *exercise_results, "total", "of"]
    of = sum(
        points_of(id) for id, some in exercise_results.items() if any(s.attempts for s in some)
    )
    for mine in zip(*exercise_results.values(), strict=True):
        totals = [result.total for result in mine]
        cells = ["ungraded" if s.attempts and s.total is None else _points(s.total) for s in mine]
        yield [*_who(mine[0].student), *cells, number(sum(filter(None, totals))), number(of)]


def _note(result):
    if result.mark is None:
        return ""
    notes = [f"to be decided: {clause}" for clause in result.undecided.values()]
    of_lms = result.of_download
    if of_lms and of_lms.late and not result.mark.record.handed_in:
        notes.append("Canvas marks it as late without a time, so there is no late penalty")
    return "; ".join(filter(None, [result.mark.note, *notes]))


def _who(student):
    return student.id, student.name, student.email, student.section


def _points(value):
    return "" if value is None else number(round(value, 6))
