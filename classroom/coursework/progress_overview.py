"""Overview of a student's progress: lessons, tasks, points, next step."""

import json
import re
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from classroom.coursework import progress_file
from classroom.exercises import catalogue
from classroom.exercises.verdict_text import number

QUESTION = re.compile(r"\bask\(\s*\"([^\"\\]+)\"")
"""Pattern of a question in the source of a cell; the group is the id of the question."""


class Answers(NamedTuple):
    """The number of answered questions in a notebook, and the number of all questions."""

    given: int
    asked: int

    def __str__(self):
        return f"{self.given} of {self.asked}" if self.asked else "–"


@dataclass(frozen=True)
class Row:
    """Progress in one lesson and its exercise."""

    id: str
    title: str
    in_lesson: Answers
    in_exercise: Answers
    marks: str  # a letter per task: ● all points, ◐ some, ○ none yet
    points: float
    of: float
    minutes: float


def rows(folder: Path | None, progress: dict) -> list[Row]:
    """Return the progress by lesson, and count the questions of the course folder ``folder``."""
    found = []
    for id, exercise in catalogue.EXERCISES.items():
        marks, points = [], 0.0
        for task in exercise.tasks:
            entry = _entry(progress["tasks"].get(task.id))
            earned = _number(entry.get("points"))
            points += earned
            marks.append("●" if earned >= task.points else "◐" if entry else "○")
        asked = _questions(folder, id) if folder else ([], [])
        answers = [
            Answers(sum(each in progress["questions"] for each in ids), len(ids)) for ids in asked
        ]
        minutes = sum(_number(progress["minutes"].get(name)) for name in (id, f"ex{id}"))
        found.append(
            Row(id, exercise.title, *answers, "".join(marks), points, exercise.points, minutes)
        )
    return found


def overview(folder: Path | None, progress: dict) -> str:
    """Format the overview: a line per lesson, totals, next step."""
    table = rows(folder, progress)
    width = max(len(row.title) for row in table)
    lines = [
        f"{'':<{width + 3}}  questions of",
        f"{'lesson':<{width + 3}}  lesson   exercise  tasks       points",
    ]
    for row in table:
        asked = f"{row.in_lesson!s:<7}  {row.in_exercise!s:<8}"
        score = f"{number(row.points):>4} of {number(row.of)}"
        lines.append(f"{row.id} {row.title:<{width}}  {asked}  {row.marks:<9} {score}")
    whole = sum(row.marks.count("●") for row in table)
    tasks = sum(len(row.marks) for row in table)
    points, of = sum(row.points for row in table), sum(row.of for row in table)
    hours, minutes = divmod(round(sum(row.minutes for row in table)), 60)
    spent = f"{hours} h {minutes} min" if hours else f"{minutes} min"
    lines += [
        "",
        f"{whole} of {tasks} tasks, {number(points)} of {number(of)} points, {spent} of work",
        f"next: {next_step(table)}",
    ]
    if folder and progress_file.is_damaged(folder):
        lines.append(f"{progress_file.NAME} cannot be read: the next check saves and replaces it")
    return "\n".join(lines)


def next_step(table) -> str:
    for row in table:
        if row.marks.count("●") == len(row.marks):
            continue
        begun = row.minutes > 0 or row.in_lesson.given
        exercise = catalogue.exercise(row.id)
        open_ = next(t for t, mark in zip(exercise.tasks, row.marks, strict=True) if mark != "●")
        if begun:
            return f"task {open_.id}, {open_.title}, in exercises/{exercise.file}"
        return f"lesson {row.id}, then its exercise exercises/{exercise.file}"
    return "nothing: every task has full points"


def _questions(folder, id):
    return _asked(folder / "notebooks", f"{id}_*"), _asked(folder / "exercises", f"ex{id}_*")


def _asked(folder, stem):
    asked = []
    for path in sorted(folder.glob(f"{stem}.ipynb"))[:1]:
        try:
            cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        except (OSError, ValueError, KeyError):
            continue
        for cell in cells:
            if cell.get("cell_type") == "code":
                asked += QUESTION.findall("".join(cell.get("source", "")))
    return asked


def _entry(value):
    return value if isinstance(value, dict) else {}


def _number(value):
    return float(value) if isinstance(value, int | float) else 0.0
