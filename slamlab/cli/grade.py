"""``slamlab grade FOLDER --out DIR``: grade the submissions of a class."""

import os
import sys
import tempfile
from datetime import UTC, datetime
from pathlib import Path

from slamlab.cli.common import (
    UsageError,
    add_course_options,
    exercise_of,
    signals_as_interrupt,
    term_of,
)
from slamlab.cli.grade_output import print_summary, with_progress


def add_parser(subparsers):
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "grade",
        help="grade a folder of submissions",
        description=(
            "Grade every notebook below FOLDER: flat files, STUDENT/EXERCISE folders, nbgrader's "
            "submitted/STUDENT/ASSIGNMENT, or a download from Moodle or Canvas. Writes grades.csv, "
            "a feedback page per submission and a gradebook: started again, it goes on. Student "
            "code runs in processes of its own, kept from this machine's files, network and "
            "processes."
        ),
        epilog=(
            "A term: slamlab grade init begins it; grade, review, adjust, release serve each "
            "exercise; likeness, rejudge, verify, forget, merge, export and lti are there when "
            "they are needed. slamlab grade release --help says more of one."
        ),
    )
    parser.add_argument(
        "folder", metavar="FOLDER", type=Path, help="where the submissions are: a folder or a zip"
    )
    add_course_options(parser)
    parser.add_argument(
        "--exercise",
        metavar="ID",
        help="the exercise that all are to be of, such as 04; what tells another is not graded",
    )
    parser.add_argument(
        "--worksheet",
        metavar="FILE",
        type=Path,
        help="Moodle's grading worksheet of the assignment: whose each number is, and the times",
    )
    parser.add_argument(
        "--secret",
        metavar="FILE",
        type=Path,
        help="what inputs are drawn from; default: DIR/secret, made at the first run",
    )
    parser.add_argument(
        "--jobs",
        metavar="N",
        type=int,
        default=os.cpu_count() or 1,
        help="submissions graded at once; default: one a processor",
    )
    parser.add_argument(
        "--isolation",
        choices=("strict", "basic", "none"),
        help="sandbox of student code, default strict. strict: bubblewrap, Landlock, seccomp; "
        "basic: the last two (Linux, as an ordinary user); none: only resource limits, for "
        "notebooks you trust. Nothing is graded where the level asked for is not available",
    )
    parser.add_argument(
        "--shard",
        metavar="I/N",
        help="grade only the I-th of N parts; slamlab grade merge puts their gradebooks together",
    )
    parser.add_argument(
        "--scheduler",
        metavar="URL",
        help="a Dask cluster to grade on, such as tls://host:8786; its machines run student code "
        "in their own sandbox and see the secret: use TLS and machines you trust",
    )
    parser.add_argument(
        "--regrade",
        action="store_true",
        help="grade again what the gradebook knows; points set by hand stay",
    )
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Grade; 0 when every submission was graded or listed, 2 for wrong use or no sandbox."""
    # imported late: what a help text needs should come at once
    from slamlab.grading.gradebook import GradebookError
    from slamlab.grading.isolation import IsolationError
    from slamlab.grading.late_policy import LatePolicyError
    from slamlab.grading.submissions import SubmissionError
    from slamlab.grading.term.course_file import TermError
    from slamlab.parallel import RunError

    told = (UsageError, SubmissionError, GradebookError, IsolationError, LatePolicyError, TermError)
    try:
        with tempfile.TemporaryDirectory(prefix="slamlab-zips-") as scratch:
            records, *said = _grade(arguments, Path(scratch))
    except (*told, RunError, KeyError) as error:
        print(f"slamlab grade: {error.args[0]}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"slamlab grade: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    print_summary(records, arguments.out, *said)
    return 0


def _grade(arguments, scratch):
    """The records of a run, and what else :func:`print_summary` is to tell of it."""
    from slamlab.grading import batch, hand_in_times, isolation, late_policy, storing
    from slamlab.grading.gradebook import Gradebook, default_url
    from slamlab.grading.judges import Judges
    from slamlab.grading.worker_pool import WorkerPool

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
        WorkerPool(arguments.isolation, preload=batch.named_modules(found)) as workers,
        Judges(jobs, secret, workers, arguments.exercise) as judges,
        Gradebook(arguments.db or default_url(arguments.out), arguments.who) as book,
        signals_as_interrupt(),
    ):
        kept = storing.kept_policies(book)
        listed, known = batch.content_hashes(everything), book.attempts()
        seen = book.sight(listed)
        found = hand_in_times.without_future(found, listed, known.values(), datetime.now(UTC))
        known = {} if arguments.regrade else known
        graded = _graded(arguments, found, secret, judges, known)
        words = arguments.out, book, arguments.exercise, policy, arguments.regrade, kept
        records = with_progress(storing.store_records(graded, *words, term, seen), len(found))
        return (records, term.summary(book, records), "student") if term else (records,)


def _check(arguments, term):
    """Check what was said against the course file, and fill in what was not."""
    if arguments.jobs < 1:
        raise UsageError("--jobs must be at least 1")
    if arguments.exercise is not None:
        arguments.exercise = exercise_of(term, arguments.exercise)
    if arguments.worksheet and not (term and arguments.exercise):
        raise UsageError("--worksheet needs a course file, and --exercise, which it is of")
    if arguments.isolation is None:
        arguments.isolation = term.course.isolation if term else "strict"


def _graded(arguments, found, secret, judges, known):
    """Records as they are done, on this machine or a cluster."""
    from slamlab.grading import batch, dask_cluster

    if not arguments.scheduler:
        return batch.grade_locally(found, judges, known)
    level, exercise = arguments.isolation, arguments.exercise
    return dask_cluster.grade_on_cluster(arguments.scheduler, found, secret, level, exercise, known)
