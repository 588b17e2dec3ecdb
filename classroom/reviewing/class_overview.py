"""Overview of a class: a table of students and exercises, as plain data."""

from classroom.grading import suspicious_code

NOTHING, UNGRADED, FULL, PART, NONE = "nothing", "ungraded", "full", "part", "none"


def overview(state):
    """Return the table of a class; ``rows`` contains a list of cells for each student."""
    columns = [state.exercise_results[id] for id in state.term.course.exercises]
    asked = open_requests(state)
    most = [exercise.points for exercise in state.exercises]  # computed once, because it is slow
    return {
        "course": state.term.course.name,
        "who": state.book.who,
        "exercises": [{"id": e.id, "title": e.title, "points": e.points} for e in state.exercises],
        "students": [
            {"id": s.id, "name": s.name or s.id, "section": s.section} for s in state.students
        ],
        "rows": [
            [cell(one, asked, points) for one, points in zip(mine, most, strict=True)]
            for mine in zip(*columns, strict=True)
        ],
    }


def open_requests(state):
    """Return a dict that maps (student, exercise) to the number of unanswered regrade requests."""
    found = {}
    for key, body in state.requests.items():
        if key not in state.answers:
            place = body["student"], body["exercise"]
            found[place] = found.get(place, 0) + 1
    return found


def flags(record):
    return [*record.signs, *suspicious_code.suspicious_behaviour(record)]


def cell(result, asked, most):
    """Return a cell of the table; flags that are false are omitted.

    asked : the result of :func:`open_requests`. most : the maximum points of the exercise."""
    mark = result.mark
    if mark is None:
        return {"state": NOTHING}
    made = {"state": _state(result, most), "total": result.total and round(result.total, 6)}
    properties = {
        "late": mark.late_penalty > 0,
        "hand": bool(mark.override_reasons or mark.remarks),
        "undecided": bool(result.undecided),
        "flag": bool(flags(mark.record)),
        "asked": asked.get((result.student.id, result.exercise), 0) > 0,
    }
    return made | {name: True for name, holds in properties.items() if holds}


def _state(result, most):
    if result.total is None:
        return UNGRADED
    earned = sum(result.mark.points.values())
    return FULL if earned >= most else PART if earned > 0 else NONE
