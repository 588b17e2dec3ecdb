"""One submission as plain data: its cells, its verdict, and the results of the class."""

from classroom.exercises import catalogue
from classroom.exercises.verdict_text import broken_by, reason
from classroom.grading import feedback, remarks
from classroom.grading.ledger.contents import ContentError
from classroom.grading.local_times import local_time
from classroom.grading.rejudging import NotStored, stored_cells
from classroom.reviewing.class_overview import cell, flags, open_requests


def submission_view(state, result):
    exercise = catalogue.exercise(result.exercise)
    view = {
        "student": {"id": result.student.id, "name": result.student.name or result.student.id,
                    "section": result.student.section},
        "exercise": {"id": exercise.id, "title": exercise.title, "points": exercise.points},
        "status": result.status, "attempts": result.attempts,
        "due": local_time(result.due, state.term.course.zone),
        "cell": cell(result, open_requests(state), exercise.points),
    }  # fmt: skip
    return view | (_handed_in(state, result, exercise) if result.mark else {})


def _handed_in(state, result, exercise):
    mark, record = result.mark, result.mark.record
    done = state.history_of(result)
    comments = [body["text"] for row, body in done if row["kind"] == remarks.COMMENT
                and remarks.attempt_of(body) == (record.submission, record.sha256)]  # fmt: skip
    zone = state.term.course.zone
    return {
        "submission": record.submission,
        "total": result.total,
        "late": mark.late,
        "others": list(mark.others),
        "handed_in": local_time(record.handed_in, zone),
        "reason": record.reason,
        "notes": list(record.notes),
        "flags": flags(record),
        "tasks": [_task(state, result, task) for task in exercise.tasks],
        "comment": comments[-1] if comments else "",
        "requests": [
            {"key": body["request"], "text": body["text"],
             "answer": state.answers.get(body["request"], "")}
            for body in state.requests_of(result.student.id, exercise.id)
        ],
        "history": [_change(row, body, zone) for row, body in done],
        "seen": len(done),
        **_code(state, record),
    }  # fmt: skip


def _task(state, result, task):
    """Return a task's verdict; an ungraded task has only points set by hand, and no laws."""
    mark = result.mark
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
        "undecided": result.undecided.get(task.id),
        "problem": verdict.problem if verdict else None,
        "hint": verdict.hint if verdict else None,
        "laws": [
            {"mark": mark, "kind": feedback.CLASSES[mark], "text": law.says, "points": law.points,
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
        return {"code": [], "no_code": "The cells are not stored: the file could not be read, was "
                "too large, or was graded by an older version."}  # fmt: skip
    try:
        cells = stored_cells(record, state.book.contents([record.kept["cells"]]))
    except (NotStored, ContentError, ValueError) as error:
        return {"code": [], "no_code": str(error)}
    return {
        "code": [
            {"number": number, "source": source, "problem": record.cells.get(number)}
            for number, source in cells
        ]
    }


def _points(body):
    return "the autograder's points" if body["points"] is None else f"{body['points']:g}"


def _change(row, body, zone):
    texts = {
        remarks.OVERRIDE: lambda: f"{body['task']} set to {_points(body)}: {body['reason']}",
        remarks.COMMENT: lambda: f"comment: {body['text']}" if body["text"] else "comment removed",
        remarks.REQUEST: lambda: f"request recorded: {body['text']}",
        remarks.ANSWER: lambda: f"answered: {body['text']}",
    }
    return {"at": local_time(row["at"], zone), "who": row["who"], "what": texts[row["kind"]]()}
