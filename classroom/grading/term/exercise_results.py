"""Students' results in exercises: the attempt that counts, or the status "not submitted"."""

import shlex
from collections import defaultdict
from dataclasses import dataclass, replace
from datetime import datetime

from classroom.exercises import catalogue
from classroom.exercises.verdict_text import number, points
from classroom.grading.local_times import local_time
from classroom.grading.marks import Mark
from classroom.grading.term.lms_names import lms_name
from classroom.grading.term.roster import Student

MAX_OTHERS = 3  # other attempts that a table or page describes, the newest first


@dataclass(frozen=True)
class ExerciseResult:
    """A student's result in an exercise."""

    student: Student
    exercise: str
    mark: Mark | None  # of the attempt that counts; None if nothing was submitted
    others: tuple  # the marks of the other attempts, oldest first
    due: datetime | None  # for this student

    @property
    def attempts(self):
        return len(self.others) + (self.mark is not None)

    @property
    def submissions(self):
        """The names of all submissions of the student in this exercise."""
        return {made.record.submission for made in (*self.others, self.mark) if made}

    @property
    def status(self):
        if self.mark is None:
            return "not submitted"
        return "could not be graded" if self.mark.total is None else "graded"

    @property
    def of_download(self):
        """The LmsName of the attempt that counts, or None."""
        return lms_name(self.mark.record.submission) if self.mark else None

    @property
    def total(self):
        """Points, or None if there is no score."""
        return self.mark.total if self.mark else None

    @property
    def undecided(self):
        return undecided(self.mark, self.others)


def undecided(counted, others):
    """Return the undecided tasks, whose points were set by hand on another attempt and differ from
    those of the attempt that counts. The dict maps each task to a clause that states both points.
    ``others`` are sorted, oldest first.
    """
    by_hand, clauses = {}, {}
    for made in others:
        by_hand |= dict.fromkeys(made.decided, made)
    for task, made in by_hand.items():
        mine, value = counted.points.get(task, 0), made.points.get(task, 0)
        if task in made.override_reasons and task not in counted.decided and mine != value:
            clauses[task] = (
                f"{made.title(task)} was set by hand to {points(value)} "
                f"({made.override_reasons[task]}) on {file_of(made.record)}; the attempt that "
                f"counts earns {number(mine)}"
            )
    return clauses


def decision(name, task, clause):
    """Return a line about an undecided task of a student or submission."""
    return (
        f"{name}: {clause}. Decide: slamlab grade adjust {shlex.quote(name)} {task} POINTS "
        "--reason TEXT (auto in place of POINTS: as the autograder)"
    )


def exercise_results(course, roster, marks, policy):
    """Return the results of each exercise in the roster's order. ``marks`` are the marks of all
    attempts in the gradebook's order.
    """
    attempts = defaultdict(list)
    for order, made in enumerate(_newest_of_each_content(marks)):
        attempts[made.record.student, made.record.exercise].append((order, made))
    found = {}
    for id in course.exercises:
        found[id] = []
        for student in roster.students.values():
            mine = attempts.get((student.id, id), [])
            counted = _counted(mine, course.attempts)
            others = tuple(pair[1] for pair in sorted(mine, key=_when) if pair[1] is not counted)
            due = policy.due_for(id, student.id)
            counted = counted and _with_others(counted, others, course)
            found[id].append(ExerciseResult(student, id, counted, others, due))
    return found


def file_of(record):
    """Return the name that the student gave to a file."""
    of_lms = lms_name(record.submission)
    return (of_lms and of_lms.file) or record.submission.partition("/")[2] or record.submission


def _with_others(counted, others, course):
    """Return the mark that counts with sentences on the other attempts, and with their remarks."""
    sentences = []
    for made in others[: -MAX_OTHERS - 1 : -1]:
        when = local_time(made.record.handed_in, course.zone, named=True)
        file = f"{file_of(made.record)}{when and f' ({when})'}"
        worked = made.total is not None and not made.record.unsolved
        because = f", because the {course.attempts} attempt counts" if worked else ""
        sentences.append(f"Another attempt, {file}, does not count{because}; {made.outcome()}")
        if made.remarks and not counted.remarked:
            sentences += [f"Remark on {file}: {remark}" for remark in made.remarks]
    left = len(others) - MAX_OTHERS
    sentences += [f"Further attempts that do not count: {left}"] if left > 0 else []
    return replace(counted, others=tuple(sentences))


def points_of(exercise):
    return catalogue.exercise(exercise).points


def _counted(attempts, rule):
    """Return the mark that counts. A notebook without any solution counts only if no other attempt
    has a score, and a mark without a score only if no mark has one.
    """
    scored = [pair for pair in attempts if pair[1].total is not None]
    worked = [pair for pair in scored if pair[1].override_reasons or not pair[1].record.unsolved]
    best = (lambda pair: (pair[1].total, *_when(pair))) if rule == "best" else _when
    return max(worked or scored or attempts, key=best, default=(0, None))[1]


def _when(pair):
    """Return the sort key for the order in which the judge first read attempts."""
    order, made = pair
    return made.record.seen or 0, order


def _newest_of_each_content(marks):
    """Return only the newest mark for the same content, name and exercise. A mark that could not be
    graded is replaced by any later mark. A graded mark is kept if the file is later graded as
    another exercise.
    """
    newest, last = {}, {}
    for made in marks:
        content = made.record.submission, made.record.sha256
        key, before = (*content, made.record.exercise), last.get(content)
        if before in newest and newest[before].record.reason:
            newest.pop(before)
        newest.pop(key, None)
        newest[key], last[content] = made, key
    return newest.values()
