"""``slamlab grade FOLDER --out DIR``: grade the submissions of a class."""

import contextlib
import os
import signal
import sys
import threading
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

from slamlab.exercises import catalogue
from slamlab.exercises.report import number

MAX_TABLE_ROWS = 60  # submissions shown; of larger classes only those that failed


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
    )
    parser.add_argument("folder", metavar="FOLDER", type=Path, help="where the submissions are")
    parser.add_argument("--out", metavar="DIR", type=Path, required=True, help="for the results")
    parser.add_argument(
        "--exercise",
        metavar="ID",
        help="the exercise of notebooks that tell it neither inside nor by their name, such as 04",
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
        default="strict",
        help="sandbox of student code. strict: bubblewrap, Landlock, seccomp; basic: the last two "
        "(Linux, as an ordinary user); none: only resource limits, for notebooks you "
        "trust. Nothing is graded where the level asked for is not available",
    )
    parser.add_argument(
        "--db",
        metavar="URL",
        help="the gradebook, a database that SQLAlchemy speaks to; default: DIR/grades.db, SQLite",
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
        "--policy",
        metavar="FILE",
        type=Path,
        help='late policy: per_day = 0.1, at_most = 0.5, [due], "04" = 2026-12-01T23:59Z',
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
    from slamlab.grading import batch, isolation, late_policy
    from slamlab.grading.gradebook import Gradebook, GradebookError, default_url
    from slamlab.grading.submissions import SubmissionError
    from slamlab.grading.worker_pool import WorkerPool
    from slamlab.parallel import RunError

    foreseen = (
        SubmissionError,
        GradebookError,
        isolation.IsolationError,
        late_policy.LatePolicyError,
        RunError,
        KeyError,
    )
    try:
        if arguments.jobs < 1:
            raise SubmissionError("--jobs must be at least 1")
        if arguments.exercise is not None:
            catalogue.exercise(arguments.exercise)
        found, secret = batch.prepare_grading(arguments.folder, arguments.out, arguments.secret)
        found = batch.select_shard(found, arguments.shard) if arguments.shard else found
        policy = late_policy.load(arguments.policy) if arguments.policy else late_policy.NO_PENALTY
        if not arguments.scheduler:
            isolation.ensure_level(arguments.isolation)
        with (
            Gradebook(arguments.db or default_url(arguments.out)) as book,
            WorkerPool(arguments.isolation) as workers,
            _signals_as_interrupt(),
        ):
            known = {} if arguments.regrade else book.attempts()
            graded = _graded(arguments, found, secret, workers, known)
            written = batch.store_records(
                graded, arguments.out, book, arguments.exercise, policy, arguments.regrade
            )
            records = _with_progress(written, len(found))
    except foreseen as error:
        print(f"slamlab grade: {error.args[0]}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"slamlab grade: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    Console().print(_table(records))
    print(_summary_line(records, arguments.out))
    return 0


def _graded(arguments, found, secret, workers, known):
    """Records as they are done, on this machine or a cluster."""
    from slamlab.grading import batch, dask_cluster

    exercise = arguments.exercise
    if arguments.scheduler:
        level = arguments.isolation
        return dask_cluster.grade_on_cluster(
            arguments.scheduler, found, secret, level, exercise, known
        )
    jobs = min(arguments.jobs, len(found))
    return batch.grade_locally(found, secret, workers, exercise, known, jobs)


@contextlib.contextmanager
def _signals_as_interrupt():
    """Handle SIGTERM and SIGHUP as Ctrl+C, which leaves no worker behind."""
    names = [name for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
    in_main = threading.current_thread() is threading.main_thread()
    old = {n: signal.signal(getattr(signal, n), _interrupt) for n in names if in_main}
    try:
        yield
    finally:
        for name, handler in old.items():
            signal.signal(getattr(signal, name), handler)


def _interrupt(*_):
    raise KeyboardInterrupt


def _with_progress(graded, count):
    columns = (BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    text = TextColumn("{task.description}", markup=False)
    records = []
    with Progress(*columns, text, console=Console(stderr=True)) as progress:
        bar = progress.add_task("starting", total=count)
        for record in graded:
            records.append(record)
            progress.update(bar, advance=1, description=_printable(record.submission))
    return sorted(records, key=lambda record: record.submission)


def _table(records):
    shown = records if len(records) <= MAX_TABLE_ROWS else [r for r in records if not r.graded]
    table = Table("submission", "score", "of", "note")
    for record in shown:
        scores = (number(record.score), number(record.max_score)) if record.graded else ("–", "–")
        # as Text, so that a name or a note cannot style the table
        table.add_row(Text(_printable(record.submission)), *scores, Text(_printable(record.note)))
    return table


def _summary_line(records, out):
    missing = sum(not record.graded for record in records)
    lost = f", {missing} could not be graded" if missing else ""
    return f"{len(records) - missing} graded{lost}: {out / 'grades.csv'}, class.html, feedback/"


def _printable(text):
    return "".join(c if c.isprintable() else " " for c in text)
