"""Class report: scores of each task, most frequent mistakes, ungraded submissions."""

from collections import Counter
from dataclasses import dataclass
from statistics import median

from classroom.exercises import catalogue
from classroom.grading.feedback import TEMPLATES
from classroom.grading.records import write_atomically

MOST_COMMON = 5  # mistakes (hints, problems) shown for each task


@dataclass(frozen=True)
class TaskReport:
    """Counts and shares [1] of the submissions that have all, some or no points for a task."""

    id: str
    title: str
    shares: tuple
    counts: tuple
    mistakes: list  # (text, count), the most frequent first


def write_report(out, marks):
    records = [mark.record for mark in marks]
    graded = [record for record in records if record.graded]
    exercises = {}
    for id in sorted({record.exercise for record in graded}):
        of_this = [record for record in graded if record.exercise == id]
        mine = [m for m in marks if m.record.graded and m.record.exercise == id]
        totals = [m.total for m in mine if m.total is not None]
        exercises[id] = {
            "exercise": catalogue.exercise(id),
            "count": len(of_this),
            "median": median(totals),
            "tasks": [task_report(task, of_this) for task in catalogue.exercise(id).tasks],
        }
    page = TEMPLATES.get_template("class.html").render(
        exercises=exercises,
        ungraded=[record for record in records if not record.graded],
        levels=sorted({record.isolation for record in graded if record.isolation}),
    )
    write_atomically(out / "class.html", page)


def task_report(task, records):
    verdicts = [v for record in records for v in record.verdicts if v.task == task.id]
    counts = [
        sum(verdict.full for verdict in verdicts),
        sum(v.points > 0 and not v.full for v in verdicts),
        sum(v.points == 0 and not v.full for v in verdicts),
    ]
    mistakes = Counter(v.hint or v.problem for v in verdicts if v.hint or v.problem)
    most = max(1, len(verdicts))
    shares = tuple(count / most for count in counts)
    return TaskReport(task.id, task.title, shares, tuple(counts), mistakes.most_common(MOST_COMMON))
