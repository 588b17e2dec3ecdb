"""Helper functions that the commands share."""

import contextlib
import signal
import sys
import threading

from slamlab.cli import listings
from slamlab.cli.parsers import Listing, UsageError
from slamlab.devices import LIDARS

SOURCES = (
    "Log file, ROS bag, raw recording of devices, name of a published recording, sim:WORLD, "
    f"emulated:WORLD or {', '.join(f'{prefix}LIDAR_PORT,EMIR_PORT' for prefix in LIDARS)}"
)
ADJUSTMENTS = (
    ("lidar-yaw", "DEG", "Mounting angle of the lidar, counter-clockwise [deg] (default: 0)"),
    ("field-of-view", "DEG", "Field of view of the lidar [deg] (default: as in the source)"),
    ("range-scale", "M", "Unit of the ranges [m], 0.001 for millimetres (default: 1)"),
    ("odometry-scale", "M", "Unit of odometry distances [m] (default: 1)"),
    ("turn-scale", "RAD", "Unit of odometry angles [rad], 0.0174533 for degrees (default: 1)"),
)
SEED = "Random seed of the simulation (default: 0)"
FAILED, INTERRUPTED = 1, 130  # exit codes beside 0 and 2; 130 as of shells


def refuse(command, error):
    """Print in one line why a command failed, and return its exit code."""
    if isinstance(error, BrokenPipeError):
        raise error
    why = error.args[0] if isinstance(error, KeyError) else error
    if getattr(error, "strerror", None):
        where = error.filename or "a file"
        why = f"{where} cannot be opened or written: {error.strerror.lower()}"
    print(f"slamlab {command}: {printable(str(why))}", file=sys.stderr)
    return 2


def printable(text):
    """Replace control characters with spaces, because a terminal would interpret them."""
    return "".join(c if c.isprintable() else " " for c in text)


def generator(seed):
    """Return the random generator that ``--seed`` specifies. Raises ValueError."""
    import numpy as np  # late: a help text should come at once

    if seed < 0:
        raise ValueError(f"--seed must not be negative, got {seed}")
    return np.random.default_rng(seed)


def add_source(parser, merge=False):
    """Add the argument SOURCE and the options for reading it."""
    add = parser.add_argument
    add("source", metavar="SOURCE", help=SOURCES)
    listing = "List the kinds of sources, the worlds and the recordings, and exit"
    add("--list-sources", action=Listing, lines=listings.sources, help=listing)
    add("--seed", metavar="N", type=int, default=0, help=SEED)
    add("--carried", action="store_true", help="Carry the lidar of emulated:WORLD by hand")
    if merge:
        help = "Number of revolutions of the lidar that are merged into one scan (default: 1)"
        add("--merge", metavar="N", type=int, help=help)
    add = parser.add_argument_group("how the source is read").add_argument
    add("--upside-down", action="store_true", help="Mirror the scans of an upside-down lidar")
    add("--ignore-odometry", action="store_true", help="Use the scans alone")
    for name, unit, help in ADJUSTMENTS:
        add(f"--{name}", metavar=unit, type=float, help=help)


def open_source(arguments):
    """Open the source that the arguments of a command name. Raises ValueError."""
    from slamlab.sources.calibration_overrides import override_calibration
    from slamlab.sources.opener import open

    listings.check_source(arguments.source)
    opened = open(arguments.source, generator(arguments.seed), carried=arguments.carried)
    if getattr(arguments, "merge", None) is not None:
        opened.merge(arguments.merge)
    return override_calibration(opened, adjustments(arguments))


def adjustments(arguments):
    """Return the calibration overrides that a command's arguments contain. Raises SourceError."""
    from slamlab.sources.calibration_overrides import CalibrationOverrides

    names = ["upside_down", "ignore_odometry"]
    names += [name.replace("-", "_") for name, _, _ in ADJUSTMENTS]
    given = {name: getattr(arguments, name) for name in names}
    return CalibrationOverrides(
        **{name: value for name, value in given.items() if value is not None}
    )


def film_recorder(path, estimator, source):
    """Return the film recorder for --film, or an empty context manager without --film."""
    if path is None:
        return contextlib.nullcontext()
    from slamlab.live.films import FilmRecorder

    title = f"{estimator} on {source}"
    return FilmRecorder(path, title, f"Film of a map as it grows, x across, y up: {title}.")


def damage_line(source):
    """Return text that counts the damage of a source by kind, for the end of a line, or ""."""
    kinds = ", ".join(f"{kind}: {count}" for kind, count in source.damage.items())
    return f"; damage: {kinds}" if kinds else ""


def add_estimator_options(parser):
    add = parser.add_argument
    add("--estimator", metavar="NAME", default="icp", help="Estimator to run (default: icp)")
    param = "Parameter of the estimator; repeatable"
    add("-p", "--param", metavar="NAME=VALUE", action="append", default=[], help=param)
    listing = "List the estimators and their parameters, and exit"
    add("--list-estimators", action=Listing, lines=listings.estimators, help=listing)


def estimator_parameters(arguments):
    """Return the --param values by name, with the options' types. Raises ValueError."""
    from slamlab.estimators.options import checked

    listings.check_estimator(arguments.estimator)
    if wrong := [text for text in arguments.param if "=" not in text]:
        raise UsageError(f"--param needs NAME=VALUE, not {wrong[0]!r}")
    return checked(arguments.estimator, dict(text.split("=", 1) for text in arguments.param))


def add_page_options(parser):
    """Add the options of a command that shows a web page in the browser of this computer."""
    help = "TCP port of the page (default: any free port)"
    parser.add_argument("--port", metavar="N", type=int, default=0, help=help)
    parser.add_argument("--no-open", action="store_true", help="Only print the page's address")


def check_port(arguments):
    """Raise UsageError for an invalid port number; otherwise, another port would be selected."""
    if not 0 <= arguments.port <= 65_535:
        raise UsageError(f"--port must be from 0 to 65535, not {arguments.port}")


def open_page(address):
    import webbrowser

    if not webbrowser.open(address):
        print("No browser was found. Open this address in a browser.", flush=True)


class Interruptible:
    """A source that ends at Ctrl-C or when devices are lost; a second Ctrl-C ends the program.

    Ctrl-C closes a live source at once, so that its robot stops. ``ended`` states why the
    source ended, and ``code`` is the exit code.
    """

    def __init__(self, source):
        self._source, self.ended, self.code = source, "", 0

    def __getattr__(self, name):
        return getattr(self._source, name)

    def __len__(self):
        return len(self._source)

    def __iter__(self):
        from slamlab.files import SourceError  # late, as above

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
            self.ended, self.code = str(error), FAILED
        finally:
            if in_main:  # no other thread receives Ctrl-C
                signal.signal(signal.SIGINT, before)

    def _pressed(self, number, frame):
        if self.ended:
            raise KeyboardInterrupt
        self.ended, self.code = "ended by Ctrl-C", INTERRUPTED
        self._source.close()


@contextlib.contextmanager
def signals_as_interrupt():
    """Handle SIGTERM and SIGHUP like Ctrl-C, so that no worker process continues to run."""
    names = [name for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
    in_main = threading.current_thread() is threading.main_thread()
    old = {
        n: signal.signal(getattr(signal, n), signal.default_int_handler) for n in names if in_main
    }
    try:
        yield
    finally:
        for name, handler in old.items():
            signal.signal(getattr(signal, name), handler)
