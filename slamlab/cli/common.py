"""Helpers shared by the commands: generator, source that ends at Ctrl-C, damage, course file."""

import contextlib
import signal
import threading
from pathlib import Path

from slamlab.estimators.options import OPTIONS, Number, takers

SOURCES = (
    "a log file, a ROS bag, a raw recording of devices, sim:WORLD, a recording's name, or, live, "
    "devices:LIDAR_PORT,EMIR_PORT, or emulated:WORLD"
)
COURSE = "the course file; default: course.toml here, where there is one and no --out is given"
INTERRUPTED = 130  # the exit code after Ctrl-C, as of shells


class UsageError(Exception):
    """A command was given in a way that means nothing; the text says how it is meant."""


def generator(seed):
    """The random generator of ``--seed``; ValueError where the seed is negative."""
    import numpy as np  # late: a help text should come at once

    if seed < 0:
        raise ValueError(f"--seed must not be negative, got {seed}")
    return np.random.default_rng(seed)


def damage_line(source):
    """Count a source's corrupt data (damage), as the end of a line; empty where there is none."""
    kinds = ", ".join(f"{kind}: {count}" for kind, count in source.damage.items())
    return f"; damage: {kinds}" if kinds else ""


def add_estimator_options(parser):
    """Add the choice of an estimator, and the options that some of them take."""
    parser.add_argument(
        "--estimator",
        metavar="NAME",
        default="icp",
        help="such as odometry, icp, mak or walls; a name there is none of lists them all (icp)",
    )
    of_estimators = parser.add_argument_group("options of some estimators")
    for name, option in OPTIONS.items():
        of_estimators.add_argument(
            f"--{name}",
            metavar=name[0].upper() if isinstance(option, Number) else "WORD",
            help=f"{option.help}: {option.range}; of {', '.join(takers(name))}",
        )


def estimator_options(arguments):
    """The estimator's options that were given, as they were typed: {name: str}."""
    given = {name: getattr(arguments, name) for name in OPTIONS}
    return {name: value for name, value in given.items() if value is not None}


def add_course_options(parser, policy=True):
    """Add the options of every command on a gradebook; a course file gives what is left out."""
    parser.add_argument("--course", metavar="FILE", type=Path, help=COURSE)
    parser.add_argument(
        "--out", metavar="DIR", type=Path, help="folder of the results; default: the course file's"
    )
    parser.add_argument(
        "--db",
        metavar="URL",
        help="the gradebook, a database that SQLAlchemy speaks to; default: DIR/grades.db, SQLite",
    )
    add_who_option(parser)
    if not policy:
        return
    parser.add_argument(
        "--policy",
        metavar="FILE",
        type=Path,
        help='late policy: per_day = 0.1, at_most = 0.5, [due], "04" = 2026-12-01T23:59Z; '
        "stored with each mark. A course file has its own",
    )


def add_who_option(parser):
    """Add the option that says who acts."""
    parser.add_argument(
        "--as",
        metavar="NAME",
        dest="who",
        help="who acts, as it stands with each change; default: the account of the database, or "
        "of this machine",
    )


def term_of(arguments):
    """The term that a command is given in, which fills in what was left out; None without one.

    Parameters
    ----------
    arguments : Namespace, of :func:`add_course_options`; changed

    Returns
    -------
    Term or None

    Raises
    ------
    UsageError
    TermError : the course file or the roster cannot be used
    """
    from slamlab.grading.term import course_file, term

    file = arguments.course or Path(course_file.NAME)
    if arguments.course is None and (arguments.out or not file.exists()):
        if arguments.out is None:
            raise UsageError("say --out DIR, or make a course file: slamlab grade init")
        return None
    for option in ("out", "policy"):
        if getattr(arguments, option):
            raise UsageError(f"{file} says what --{option} says; leave one of them out")
    found = term.load(file)
    arguments.out = found.course.results
    arguments.db = arguments.db or found.course.gradebook
    return found


def exercise_of(term, id):
    """The number of the exercise that was said, such as "04" for "4".

    Parameters
    ----------
    term : Term or None
    id : str

    Returns
    -------
    str

    Raises
    ------
    KeyError : there is none
    UsageError : the course file has none
    """
    from slamlab.exercises import catalogue

    id = catalogue.exercise(id).id
    if term and id not in term.course.exercises:
        known = ", ".join(term.course.exercises)
        raise UsageError(f"the course file has no exercise {id}; it has {known}")
    return id


def add_page_options(parser):
    """Add the options of every command that serves a page to this machine's browser."""
    parser.add_argument("--port", metavar="N", type=int, default=0, help="any free one by default")
    parser.add_argument("--no-open", action="store_true", help="only print the page's address")


def check_port(arguments):
    """Refuse a port that there is none of; another one would be taken.

    Raises
    ------
    UsageError
    """
    if not 0 <= arguments.port <= 65_535:
        raise UsageError(f"--port is 0 to 65535, not {arguments.port}")


def open_page(address):
    """Open a page in a browser, or say that there is none."""
    import webbrowser

    if not webbrowser.open(address):
        print("no browser was found: open that address in one", flush=True)


class Interruptible:
    """Wrapper of a source that ends it, not the program, at Ctrl-C or when devices are lost.

    At Ctrl-C a live one is closed at once, so that its robot stops; pressed again it ends the
    program, too. In all else it is the source. ``ended`` says why it ended early, empty if it did
    not, and ``code`` is the exit code for that.

    Parameters
    ----------
    source : Source
    """

    def __init__(self, source):
        self._source, self.ended, self.code = source, "", 0

    def __getattr__(self, name):
        return getattr(self._source, name)

    def __len__(self):
        return len(self._source)

    def __iter__(self):
        from slamlab.files.errors import SourceError  # late, as above

        begun, in_main = False, threading.current_thread() is threading.main_thread()
        before = signal.signal(signal.SIGINT, self._pressed) if in_main else None
        try:
            for reading in self._source:
                if self.ended:
                    return
                begun = True
                yield reading
        except SourceError as error:
            if not begun:
                raise
            self.ended, self.code = str(error), 2
        finally:
            if in_main:  # no other thread hears of Ctrl-C
                signal.signal(signal.SIGINT, before)

    def _pressed(self, number, frame):
        if self.ended:
            raise KeyboardInterrupt
        self.ended, self.code = "ended by Ctrl-C", INTERRUPTED
        self._source.close()


@contextlib.contextmanager
def signals_as_interrupt():
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
