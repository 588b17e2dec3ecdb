"""``slamlab grade FOLDER --out DIR``: grade the submissions of a class."""

import os
import sys
import tempfile
from datetime import UTC, datetime
from pathlib import Path

from classroom.cli.common import add_course_options, add_isolation_option, exercise_of, term_of
from classroom.cli.grade_output import print_summary, with_progress
from slamlab.cli.common import FAILED, INTERRUPTED, refuse, signals_as_interrupt
from slamlab.cli.parsers import UsageError, add_command


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "grade",
        "Grade the notebooks of a class.",
        "submissions.zip --exercise 04",
        "submissions --out graded",
    )
    add = parser.add_argument
    add("folder", metavar="FOLDER", type=Path, help="Folder or zip of the submissions")
    add_course_options(parser)
    exercise = "Exercise to grade, such as 04; other exercises are listed but not graded"
    add("--exercise", metavar="ID", help=exercise)
    worksheet = "Moodle's grading worksheet of the assignment, with the submission times"
    add("--worksheet", metavar="FILE", type=Path, help=worksheet)
    secret = "Secret, a seed of random inputs (default: DIR/secret, created at the first run)"
    add("--secret", metavar="FILE", type=Path, help=secret)
    jobs = "Number of submissions graded at once (default: number of processors)"
    add("--jobs", metavar="N", type=int, default=os.cpu_count() or 1, help=jobs)
    add_isolation_option(parser)
    shard = "Part of the submissions to grade, such as 2/8; slamlab grade merge joins the parts"
    add("--shard", metavar="I/N", help=shard)
    scheduler = "Scheduler of a Dask cluster that you trust, such as tls://host:8786"
    add("--scheduler", metavar="URL", help=scheduler)
    regrade = "Grade known submissions again, but keep points set by hand"
    add("--regrade", action="store_true", help=regrade)
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Return 0 if all files were graded, 1 if some were not, 2 if the command cannot run."""
    # imported late: a help text should come at once
    from classroom.grading.gradebook import GradebookError
    from classroom.grading.isolation import IsolationError
    from classroom.grading.late_policy import LatePolicyError
    from classroom.grading.submissions import SubmissionError
    from classroom.grading.term.course_file import TermError
    from slamlab.parallel import RunError

    refusals = (
        UsageError,
        SubmissionError,
        GradebookError,
        IsolationError,
        LatePolicyError,
        TermError,
    )
    try:
        with tempfile.TemporaryDirectory(prefix="slamlab-zips-") as scratch:
            records, *notes = _grade(arguments, Path(scratch))
    except (*refusals, RunError, KeyError, OSError) as error:
        return refuse("grade", error)
    except KeyboardInterrupt:
        print("slamlab grade: stopped. Run the same command again to continue", file=sys.stderr)
        return INTERRUPTED
    print_summary(records, arguments.out, *notes)
    return 0 if all(record.graded for record in records) else FAILED


def _grade(arguments, scratch):
    from classroom.grading import batch, isolation, late_policy, result_storage
    from classroom.grading.gradebook import Gradebook, default_url
    from classroom.grading.judge_pool import JudgePool
    from classroom.grading.worker_pool import WorkerPool

    term = term_of(arguments)
    _check(arguments, term)
    secret = arguments.secret or (term and term.course.secret)
    make = term is not None and arguments.secret is None
    found, secret = batch.prepare_grading(arguments.folder, arguments.out, scratch, secret, make)
    if term and arguments.worksheet:
        term.keep_worksheet(arguments.exercise, arguments.worksheet, found)
    everything = found = term.join(found, arguments.exercise) if term else found
    found = batch.select_shard(found, arguments.shard) if arguments.shard else found
    policy = late_policy.load(arguments.policy) if arguments.policy else term and term.policy
    if not arguments.scheduler:
        isolation.ensure_level(arguments.isolation)
    jobs = 1 if arguments.scheduler else min(arguments.jobs, len(found))
    with (
        WorkerPool(arguments.isolation, preload=batch.modules_to_preload(found)) as workers,
        JudgePool(jobs, secret, workers, arguments.exercise) as judges,
        Gradebook(arguments.db or default_url(arguments.out), arguments.who) as book,
        signals_as_interrupt(),
    ):
        kept = result_storage.stored_policies(book)
        listed, known = batch.content_hashes(everything), book.attempts()
        seen = book.number_submissions(listed)
        found = batch.with_decisions(found, listed, book.notes("take"), arguments.exercise)
        now, zone = datetime.now(UTC), term and term.course.zone
        found = batch.clamp_future_times(found, listed, known.values(), now, zone)
        known = {} if arguments.regrade else known
        graded = _graded(arguments, found, secret, judges, known)
        words = arguments.out, book, arguments.exercise, policy, arguments.regrade, kept
        records = with_progress(
            result_storage.store_records(graded, *words, term, seen), len(found)
        )
        if term is None:
            return records, result_storage.undecided_lines(book, records)
        return records, term.summary(book, records), "student"


def _check(arguments, term):
    if arguments.jobs < 1:
        raise UsageError("--jobs must be at least 1")
    if arguments.exercise is not None:
        arguments.exercise = exercise_of(term, arguments.exercise)
    if arguments.worksheet and not (term and arguments.exercise):
        raise UsageError("--worksheet needs a course file and --exercise")
    if arguments.isolation is None:
        arguments.isolation = term.course.isolation if term else "strict"


def _graded(arguments, found, secret, judges, known):
    from classroom.grading import batch, dask_cluster

    if not arguments.scheduler:
        return batch.grade_locally(found, judges, known)
    level, exercise = arguments.isolation, arguments.exercise
    return dask_cluster.grade_on_cluster(arguments.scheduler, found, secret, level, exercise, known)
