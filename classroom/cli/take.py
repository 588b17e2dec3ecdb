"""``slamlab grade take``: grade one file for a student, whatever exercise or name the file has."""

from pathlib import Path

from classroom.cli.common import (
    COURSE,
    add_isolation_option,
    add_who_option,
    answered,
    exercise_of,
    term_of,
)
from classroom.cli.grade_output import print_summary
from slamlab.cli.common import FAILED
from slamlab.cli.parsers import UsageError, add_command


def add_parser(subparsers):
    description = "Grade one file as a student's notebook of an exercise."
    examples = (
        "ex03.ipynb.txt --exercise 03 --student s026",
        "ex04.ipynb --exercise 03 --student s027",
    )
    parser = add_command(subparsers, "grade take", description, *examples)
    parser.add_argument("file", metavar="FILE", type=Path, help="Notebook, under any name")
    exercise = "Exercise, such as 03, even if the notebook names another one"
    parser.add_argument("--exercise", metavar="ID", required=True, help=exercise)
    student = "Student's id, e-mail address or full name in the roster"
    parser.add_argument("--student", metavar="ID", required=True, help=student)
    parser.add_argument("--course", metavar="FILE", type=Path, help=COURSE)
    add_who_option(parser)
    add_isolation_option(parser)
    parser.set_defaults(run=run, out=None, db=None, policy=None)


def run(arguments) -> int:
    """Return 0 if the file was graded, 1 if it was not, 2 if the command cannot run."""
    from classroom.grading.gradebook import GradebookError
    from classroom.grading.isolation import IsolationError
    from classroom.grading.submissions import SubmissionError
    from classroom.grading.term.course_file import TermError

    refusals = (UsageError, SubmissionError, GradebookError, IsolationError, TermError, KeyError)
    return answered("grade take", refusals, lambda: _take(arguments))


def _take(arguments):
    from classroom.grading import batch, isolation, judge, result_storage, submissions
    from classroom.grading.gradebook import Gradebook, default_url
    from classroom.grading.judge_pool import JudgePool
    from classroom.grading.records import private_folder
    from classroom.grading.worker_pool import WorkerPool

    term = term_of(arguments)
    if term is None:
        raise UsageError("take needs a course file. Write one with slamlab grade init")
    id, student = exercise_of(term, arguments.exercise), _student(arguments.student, term)
    level = arguments.isolation or term.course.isolation
    isolation.ensure_level(level)
    private_folder(arguments.out)
    secret = judge.load_secret(term.course.secret, make=True)
    content = submissions.content_hash(arguments.file)
    if content is None:
        raise UsageError(f"{arguments.file} is not a file")
    with (
        Gradebook(arguments.db or default_url(arguments.out), arguments.who) as book,
        WorkerPool(level) as workers,
        JudgePool(1, secret, workers, id) as judges,
    ):
        taken, known = _submission(arguments.file, content, student, id, book, term)
        body = {"exercise": id, "student": student.id, "sha256": content}
        book.note("take", body, taken.name)
        seen = book.number_submissions([(taken.name, content)])
        graded = batch.grade_locally([taken], judges)
        records = list(
            result_storage.store_records(graded, arguments.out, book, id, term.policy, term=term,
                                         seen=seen)
        )  # fmt: skip
        notes = [f"time of submission: {known}", *term.summary(book, records)]
    print_summary(records, arguments.out, notes, "student")
    return 0 if records[0].graded else FAILED


def _student(name, term):
    found = term.roster.find_any(name)
    if len(found) != 1:
        raise UsageError(term.roster.not_one(name))
    return found[0]


def _submission(file, content, student, exercise, book, term):
    """Return the Submission, and a text that states how its time is known. The time is that of an
    attempt with the same content, unless another student of the roster made it. If there is none,
    the time is that of the student's last attempt at the exercise.
    """
    from classroom.grading.submissions import Submission

    attempts = list(book.attempts().values())
    others = {*term.roster.students} - {student.id}
    same = [r for r in attempts if r.sha256 == content and r.student not in others]
    mine = [r for r in attempts if (r.student, r.exercise) == (student.id, exercise)]
    before = next((some[-1] for some in (same, mine) if some), None)
    name = same[-1].submission if same else f"{student.id}/{file.name}"
    when = before and before.handed_in
    known = f"as of {before.submission}" if when else "unknown, so there is no late penalty"
    number = same[-1].number if same else None
    taken = Submission(name, student.id, file, None, number, when=when or "", sha256=content,
                       taken_as=exercise)  # fmt: skip
    return taken, known
