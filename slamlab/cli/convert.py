"""``slamlab convert SOURCE FILE``: write the readings of any source to a reading log."""

import sys

from slamlab.cli.common import Interruptible, add_source, damage_line, open_source, refuse
from slamlab.cli.parsers import add_command


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "convert",
        "Write the readings of any source to a reading log.",
        "robot.log.gz robot.readings",
        "sim:room room.readings.gz --seed 3",
    )
    add_source(parser)
    help = "Reading log to write; compressed if its name ends in .gz"
    parser.add_argument("file", metavar="FILE", help=help)
    parser.set_defaults(run=run)


def run(arguments) -> int:
    # imported late: a help text should come at once
    from slamlab import sources

    try:
        with open_source(arguments) as opened:
            source = Interruptible(opened)
            count = sources.write(source, arguments.file)
    except ValueError as error:
        return refuse("convert", error)
    print(f"{count} readings written to {arguments.file}{damage_line(source)}")
    if source.ended:
        ended = f"{source.ended}; {arguments.file} is complete up to that point"
        print(f"slamlab convert: {ended}", file=sys.stderr)
    return source.code
