"""``slamlab live SOURCE --estimator NAME``: run SLAM live; show it and drive in a browser."""

import asyncio
from pathlib import Path

from slamlab.cli.common import (
    add_estimator_options,
    add_page_options,
    add_source,
    adjustments,
    check_port,
    estimator_parameters,
    film_recorder,
    generator,
    open_page,
    refuse,
)
from slamlab.cli.listings import check_source
from slamlab.cli.parsers import add_command

FIRST_READING_TIMEOUT = 10.0  # [s]: a lidar's motor takes some seconds to turn evenly


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "live",
        "Run an estimator in the browser, where you can drive the robot.",
        "sim:situation-2 --estimator walls",
        "devices: --estimator graph --record flat.rec.gz",
    )
    add = parser.add_argument
    add("--map", metavar="FILE", type=Path, help="New PNG file for the map (saved at the end)")
    add("--film", metavar="FILE", type=Path, help="New file for a film of the run")
    record = "New file for a raw recording of all device bytes"
    add("--record", metavar="FILE", type=Path, help=record)
    speed = "Speed of a log or a simulation [readings/s] (default: 20)"
    add("--speed", metavar="N", type=int, default=20, help=speed)
    add("--tour", action="store_true", help="Drive the world's route before waiting for commands")
    add_source(parser, merge=True)
    add_page_options(parser)
    add_estimator_options(parser)
    parser.set_defaults(run=run)


def run(arguments) -> int:
    # imported late: a help text should come at once
    from functools import partial

    from slamlab import estimators
    from slamlab.live.console.live_sources import source_for
    from slamlab.live.console.recorded_run import RecordedRun

    try:
        make = partial(estimators.make, arguments.estimator, **estimator_parameters(arguments))
        check_source(arguments.source)
        check_port(arguments)
        generator(arguments.seed)  # checks the seed
        if not 0 < arguments.speed <= 1000:
            raise ValueError(f"--speed must be from 1 to 1000 readings/s, not {arguments.speed}")
        if arguments.map is not None and arguments.map.exists():
            raise ValueError(f"{arguments.map} exists. Name a new file with --map")
        # may need an extra: imported before a device is opened
        from slamlab.live.console import console_server

        opened = source_for(
            arguments.source,
            arguments.merge,
            arguments.tour,
            arguments.record,
            arguments.carried,
            adjustments(arguments),
        )
        with (
            opened as source,
            film_recorder(arguments.film, arguments.estimator, arguments.source) as film,
        ):
            live_run = RecordedRun(source, make, film)
            try:
                live_run.reset(arguments.seed, FIRST_READING_TIMEOUT)
                asyncio.run(_serve(arguments, live_run, console_server))
            finally:
                live_run.close()
    except (OSError, ValueError) as error:
        return refuse("live", error)
    for name in ("map", "film", "record"):
        path = getattr(arguments, name)
        if path is not None and path.exists():
            print(f"written to {path}: the {name}")
    return 0


async def _serve(arguments, live_run, console_server):
    from slamlab.live.console.control_panel import ControlPanel

    title = f"{arguments.estimator} on {arguments.source.split(':/')[0]}"
    panel = ControlPanel(live_run, title, arguments.seed, arguments.speed, arguments.map)

    def started(address):
        print(f"open {address}")
        if arguments.no_open:
            print("The run starts when you open the page, or when you type run")
        drive = "0.5, 30 to drive (metres, degrees), an empty line to stop"
        words = f"{drive}, or exit" if live_run.drivable else "pause, run, reset or exit"
        print(f"Type {words}", flush=True)
        if not arguments.no_open:
            open_page(address)
        console_server.read_terminal(panel, asyncio.get_running_loop())

    await console_server.serve(panel, arguments.port, started)
    await panel.save_last_map()
    if arguments.map is not None and not arguments.map.exists():
        print(panel.message)
