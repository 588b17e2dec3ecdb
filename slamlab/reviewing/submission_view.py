"""One submission as plain data: its cells beside its verdict, and how the class did."""

from slamlab.exercises import catalogue
from slamlab.exercises.report import broken_by, reason
from slamlab.grading import feedback, remarks
from slamlab.grading.ledger.contents import ContentError
from slamlab.grading.local_times import local_time
from slamlab.grading.rejudging import NotKept, kept_cells
from slamlab.reviewing.class_overview import cell, open_requests, signs
from slamlab.reviewing.class_state import OVERRIDE


def submission_view(state, standing):
    """All that a page shows of a submission.

    Parameters
    ----------
    state : ClassState
    standing : Standing

    Returns
    -------
    dict of plain values
    """
    exercise = catalogue.exercise(standing.exercise)
    told = {
        "student": {"id": standing.student.id, "name": standing.student.name or standing.student.id,
                    "section": standing.student.section},
        "exercise": {"id": exercise.id, "title": exercise.title, "points": exercise.points},
        "status": standing.status, "attempts": standing.attempts, "unread": standing.unread,
        "due": local_time(standing.due, state.term.course.zone),
        "cell": cell(standing, open_requests(state), exercise.points),
    }  # fmt: skip
    return told | (_handed_in(state, standing, exercise) if standing.mark else {})


def _handed_in(state, standing, exercise):
    mark, record = standing.mark, standing.mark.record
    done = state.history.get(record.submission, [])
    comments = [body["text"] for row, body in done if row["kind"] == remarks.COMMENT]
    zone = state.term.course.zone
    return {
        "submission": record.submission,
        "total": standing.total,
        "late": mark.late_penalty,
        "handed_in": local_time(record.handed_in, zone),
        "reason": record.reason,
        "notes": list(record.notes),
        "signs": signs(record),
        "tasks": [_task(state, mark, task) for task in exercise.tasks],
        "comment": comments[-1] if comments else "",
        "requests": [
            {"key": body["request"], "text": body["text"],
             "answer": state.answers.get(body["request"], "")}
            for body in state.requests_of(standing.student.id, exercise.id)
        ],
        "history": [_deed(row, body, zone) for row, body in done],
        "seen": len(done),
        **_code(state, record),
    }  # fmt: skip


def _task(state, mark, task):
    """A task's verdict; one of what could not be graded has no laws, but points by hand."""
    verdict = next((v for v in mark.record.verdicts if v.task == task.id), None)
    class_report = state.mistakes[task.id]
    mine = verdict and (verdict.hint or verdict.problem)
    laws = feedback.laws_of(verdict) if verdict else ()
    return {
        "id": task.id,
        "title": task.title,
        "points": mark.points.get(task.id),
        "judged": verdict.points if verdict else None,
        "most": task.points,
        "by_hand": mark.override_reasons.get(task.id),
        "problem": verdict.problem if verdict else None,
        "hint": verdict.hint if verdict else None,
        "laws": [
            {"mark": mark, "kind": feedback.CLASSES[mark], "says": law.says, "points": law.points,
             "most": law.max_points, "why": reason(law, mark) or broken_by(law, task)}
            for law, mark in laws
        ],
        "class": class_report.counts,
        "mistakes": [
            {"text": text, "count": count, "own": text == mine}
            for text, count in class_report.mistakes
        ],
    }  # fmt: skip


def _code(state, record):
    if not record.kept.get("cells"):
        return {"code": [], "no_code": "its cells are not kept: it could not be read, was too "
                "large, or was graded by an older version"}  # fmt: skip
    try:
        cells = kept_cells(record, state.book.contents([record.kept["cells"]]))
    except (NotKept, ContentError, ValueError) as error:
        return {"code": [], "no_code": str(error)}
    return {
        "code": [
            {"number": number, "source": source, "problem": record.cells.get(number)}
            for number, source in cells
        ]
    }


def _deed(row, body, zone):
    words = {
        OVERRIDE: lambda: f"{body['task']} set to {body['points']:g}: {body['reason']}",
        remarks.COMMENT: lambda: (
            f"comment: {body['text']}" if body["text"] else "comment taken away"
        ),
        remarks.REQUEST: lambda: f"request read: {body['text']}",
        remarks.ANSWER: lambda: f"answered: {body['text']}",
    }
    return {"at": local_time(row["at"], zone), "who": row["who"], "what": words[row["kind"]]()}
