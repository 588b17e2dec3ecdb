"""Tables of a term: over all and per exercise, a row for everybody who is enrolled."""

from slamlab.exercises import catalogue
from slamlab.exercises.report import number
from slamlab.grading.grade_tables import (
    detail_cells,
    detail_titles,
    submission_rows,
    write_table,
)
from slamlab.grading.local_times import local_time
from slamlab.grading.term.standings import points_of

WHO = ("id", "name", "email", "section")


def write_term(course, standings, marks):
    """Write ``grades.csv`` over all and per exercise, and ``submissions.csv``.

    Parameters
    ----------
    course : Course
    standings : exercise to list of Standing
    marks : list of Mark, the newest of each submission
    """
    write_table(course.results / "grades.csv", _over_all(standings))
    for id, of_exercise in standings.items():
        table = course.results / id / "grades.csv"
        if table.exists() or any(standing.attempts for standing in of_exercise):
            write_table(table, exercise_rows(of_exercise, course.zone))
    exercises = [catalogue.exercise(id) for id in course.exercises]
    newest = sorted(marks, key=lambda made: made.record.submission)
    write_table(course.results / "submissions.csv", submission_rows(newest, exercises))


def exercise_rows(standings, zone):
    """The table of an exercise, the titles first.

    Parameters
    ----------
    standings : list of Standing, of one exercise
    zone : ZoneInfo, of the times

    Yields
    ------
    list of str
    """
    exercises = [catalogue.exercise(standings[0].exercise)]
    yield [*WHO, "status", "score", "max_score", "late", "handed_in", "due", "attempts", "note",
           "submission", *detail_titles(exercises)]  # fmt: skip
    for standing in standings:
        made, record = standing.mark, standing.mark and standing.mark.record
        yield [
            *_who(standing.student),
            standing.status,
            _points(standing.total),
            number(exercises[0].points),
            _points(made.late_penalty or None) if made else "",
            local_time(record.handed_in, zone) if record else "",
            local_time(standing.due, zone),
            str(standing.attempts),
            _note(standing),
            record.submission if record else "",
            *(detail_cells(made, exercises) if made else [""] * len(detail_titles(exercises))),
        ]


def _over_all(standings):
    yield [*WHO, *standings, "total", "of"]
    of = sum(points_of(id) for id, some in standings.items() if any(s.attempts for s in some))
    for mine in zip(*standings.values(), strict=True):
        totals = [standing.total for standing in mine]
        cells = ["ungraded" if s.attempts and s.total is None else _points(s.total) for s in mine]
        yield [*_who(mine[0].student), *cells, number(sum(filter(None, totals))), number(of)]


def _note(standing):
    if standing.mark is None:
        return ""
    unread = standing.unread if standing.total is not None else 0
    told = [f"{unread} more could not be graded"] if unread else []
    of_lms = standing.of_download
    if of_lms and of_lms.late and not standing.mark.record.handed_in:
        told.append("late as Canvas says, which does not tell when: nothing taken")
    return "; ".join(filter(None, [standing.mark.note, *told]))


def _who(student):
    return student.id, student.name, student.email, student.section


def _points(value):
    return "" if value is None else number(round(value, 6))
