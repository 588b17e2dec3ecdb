"""``slamlab convert SOURCE FILE``: convert any source (log, bag, recording) to a reading log."""

import sys

from slamlab.cli.common import SOURCES, Interruptible, damage_line, generator


def add_parser(subparsers):
    """Add the command to the command line."""
    parser = subparsers.add_parser(
        "convert",
        help="write a source as a reading log",
        description=(
            "Write a source as a reading log: a JSON header, then one reading a line. Ctrl-C ends "
            "it early, which is how a live one ends; what is written until then is a whole log."
        ),
    )
    parser.add_argument("source", metavar="SOURCE", help=SOURCES)
    parser.add_argument("file", metavar="FILE", help="what to write; .gz at its end packs it")
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="of a simulation's noise")
    parser.set_defaults(run=run)


def run(arguments) -> int:
    """Convert; 0 when done, 130 after Ctrl-C, 2 when something cannot be read or written."""
    # imported late: what a help text needs should come at once
    from slamlab import sources

    try:
        with sources.open(arguments.source, generator(arguments.seed)) as opened:
            source = Interruptible(opened)
            count = sources.write(source, arguments.file)
    except ValueError as error:
        print(f"slamlab convert: {error}", file=sys.stderr)
        return 2
    print(f"{count} readings written to {arguments.file}{damage_line(source)}")
    if source.ended:
        print(f"slamlab convert: {source.ended} (written until then)", file=sys.stderr)
    return source.code
