"""The overview: a table of students and exercises as plain data, short, for it has many cells."""

from slamlab.grading import hostile_signs

NOTHING, UNGRADED, FULL, PART, NONE = "nothing", "ungraded", "full", "part", "none"


def overview(state):
    """The table.

    Parameters
    ----------
    state : ClassState

    Returns
    -------
    dict of plain values; ``rows`` has a list of cells for each student
    """
    columns = [state.standings[id] for id in state.term.course.exercises]
    asked = open_requests(state)
    most = [exercise.points for exercise in state.exercises]  # at each cell it would take long
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
    """(student, exercise) to how many requests wait for an answer.

    Parameters
    ----------
    state : ClassState
    """
    found = {}
    for key, body in state.requests.items():
        if key not in state.answers:
            place = body["student"], body["exercise"]
            found[place] = found.get(place, 0) + 1
    return found


def signs(record):
    """All hostile signs of a submission.

    Parameters
    ----------
    record : Record

    Returns
    -------
    list of str
    """
    return [*record.signs, *hostile_signs.behaviour(record)]


def cell(standing, asked, most):
    """A cell of the table.

    Parameters
    ----------
    standing : Standing
    asked : dict, of :func:`open_requests`
    most : float, the points of the exercise

    Returns
    -------
    dict of plain values; what is not so is left out
    """
    mark = standing.mark
    if mark is None:
        return {"state": NOTHING}
    made = {"state": _state(standing, most), "total": standing.total and round(standing.total, 6)}
    told = {
        "late": mark.late_penalty > 0,
        "hand": bool(mark.override_reasons or mark.remarks),
        "flag": bool(signs(mark.record)),
        "asked": asked.get((standing.student.id, standing.exercise), 0) > 0,
    }
    return made | {name: True for name, there in told.items() if there}


def _state(standing, most):
    if standing.total is None:
        return UNGRADED
    earned = sum(standing.mark.points.values())
    return FULL if earned >= most else PART if earned > 0 else NONE
