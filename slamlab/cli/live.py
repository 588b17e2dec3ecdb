"""``slamlab live SOURCE --estimator NAME``: SLAM in a page of the browser, driven there."""

import asyncio
import sys
from contextlib import nullcontext
from pathlib import Path

from slamlab.cli.common import (
    SOURCES,
    UsageError,
    add_estimator_options,
    add_page_options,
    check_port,
    estimator_options,
    generator,
    open_page,
)

FIRST_READING_TIMEOUT = 10.0  # [s]: a lidar's motor takes some seconds to turn evenly


def add_parser(subparsers):
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "live",
        help="watch and drive a SLAM live in the browser",
        description=(
            "Run an estimator over a source and show it in a page of the browser, which only this "
            "machine can open. Driven by buttons, keys and lines such as 0.5, 30 (metres, "
            "degrees), typed in the page or here; an empty line stops, exit ends. A robot moves "
            "only while its driver's page is open and in sight: else it stands within a second."
        ),
    )
    parser.add_argument("source", metavar="SOURCE", help=SOURCES)
    parser.add_argument("--map", metavar="FILE", type=Path, help="a new PNG to save the map to")
    parser.add_argument("--film", metavar="FILE", type=Path, help="where to film the run")
    parser.add_argument(
        "--record", metavar="FILE", type=Path, help="a new file for every byte of devices"
    )
    parser.add_argument("--speed", metavar="N", type=int, default=20, help="steps a second (20)")
    parser.add_argument(
        "--tour", action="store_true", help="a simulated robot drives its tour before it waits"
    )
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="of a simulation's noise")
    parser.add_argument(
        "--merge", metavar="N", type=int, help="turns of a lidar that become one scan (1)"
    )
    add_page_options(parser)
    add_estimator_options(parser)
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Serve until exit or Ctrl-C; 0 then, 2 when something cannot be used."""
    # imported late: what a help text needs should come at once
    from functools import partial

    from slamlab import estimators
    from slamlab.console.filmed_stepper import FilmedStepper
    from slamlab.console.live_sources import source_for

    make = partial(estimators.make, arguments.estimator, **estimator_options(arguments))
    try:
        check_port(arguments)
        generator(arguments.seed)  # says what is wrong with a seed
        if not 0 < arguments.speed <= 1000:
            raise ValueError(f"--speed is 1 to 1000 steps a second, not {arguments.speed}")
        if arguments.map is not None and arguments.map.exists():
            raise ValueError(f"{arguments.map} is there already: name a new file")
        opened = source_for(arguments.source, arguments.merge, arguments.tour, arguments.record)
        with opened as source, _film(arguments) as film:
            stepper = FilmedStepper(source, make, film)
            try:
                stepper.reset(arguments.seed, FIRST_READING_TIMEOUT)
                asyncio.run(_served(arguments, stepper))
            finally:
                stepper.close()
    except OSError as error:
        print(f"slamlab live: {error.filename or ''} {error.strerror or error}", file=sys.stderr)
        return 2
    except (UsageError, ValueError) as error:
        print(f"slamlab live: {error}", file=sys.stderr)
        return 2
    for name in ("map", "film", "record"):
        path = getattr(arguments, name)
        if path is not None and path.exists():
            print(f"written to {path}: the {name}")
    return 0


def _film(arguments):
    if arguments.film is None:
        return nullcontext()
    from slamlab.films import FilmRecorder

    title = f"{arguments.estimator} on {arguments.source}"
    alt = f"Film of a map as it grows, x across, y up: {title}."
    return FilmRecorder(arguments.film, title, alt)


async def _served(arguments, stepper):
    from slamlab.console import terminal
    from slamlab.console.desk import Desk
    from slamlab.console.serving import serve

    title = f"{arguments.estimator} on {arguments.source}"
    desk = Desk(stepper, title, arguments.seed, arguments.speed, arguments.map)

    def begun(address):
        print(f"open {address}")
        print("0.5, 30 drives (metres, degrees); an empty line stops; reset; exit", flush=True)
        if not arguments.no_open:
            open_page(address)
        terminal.hear(desk, asyncio.get_running_loop())

    await serve(desk, arguments.port, begun)
