"""Command-line interface: ``slamlab COMMAND``; each subcommand is a module with ``add_parser``.

Read in this order: ``parsers``, ``groups`` of commands; ``run`` with ``run_results`` and
``progress_line``, ``convert``, ``optimise``, ``live``, ``film``, ``data``; for devices
``emulate``, ``record``, ``replay``; for shells ``completion``; ``listings`` of estimators and
sources; ``common``.
"""

import argparse
import contextlib
import os
import sys

from slamlab import __version__
from slamlab.cli.groups import all_groups
from slamlab.cli.parsers import Parser, did_you_mean, table
from slamlab.extras import ExtraMissing

EPILOG = """\
Examples:
  slamlab run sim:room --estimator graph
  slamlab run --list-estimators

Exit codes: 0 done; 1 finished, but part of the work failed; 2 wrong use or
unreadable input; 130 interrupted. 'slamlab COMMAND --help' describes a command."""


def command_parsers():
    """Return the parser of the command line, and a dict of each command's parser by name."""
    parser = Parser(
        prog="slamlab",
        usage="slamlab [OPTIONS] COMMAND ...",
        description="Run, watch and record simultaneous localisation and mapping (SLAM).",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"slamlab {__version__}")
    # the epilog lists the commands by group
    subparsers = parser.add_subparsers(
        prog="slamlab", metavar="COMMAND", required=True, help=argparse.SUPPRESS
    )
    commands, listed = subparsers.choices, []
    for group in all_groups():
        before = set(commands)
        group.add_parsers(subparsers)
        new = [name for name in commands if name not in before]
        rows = [(name, commands[name].description) for name in new if " " not in name]
        listed.append("\n".join([f"{group.title}:", *table(rows)]))
    parser.epilog = "\n\n".join([*listed, EPILOG])
    for name in [name for name in commands if " " not in name]:
        verbs = [verb for verb in commands if verb.startswith(f"{name} ")]
        if verbs:
            rows = [(verb.removeprefix(f"{name} "), commands[verb].description) for verb in verbs]
            commands[name].add_argument_group("commands", "\n".join(table(rows, "")))
    return parser, commands


def parse(words):
    """Return the parsed arguments of a command line. Raises SystemExit."""
    parser, commands = command_parsers()
    if " ".join(words[:2]) in commands:  # a command of two words
        words = [" ".join(words[:2]), *words[2:]]
    if words and not words[0].startswith("-") and words[0] not in commands:
        parser.error(f"there is no command {words[0]!r}.{did_you_mean(words[0], commands)}")
    arguments, rest = parser.parse_known_args(words)
    if rest:
        verbs = [name for name in commands if name.startswith(f"{words[0]} ")]
        commands[words[0]].refuse_unknown(rest, did_you_mean(" ".join(words[:2]), verbs))
    arguments.command = words[0]
    return arguments


def main(argv=None):
    """Run the command that ``argv`` (default: sys.argv) names, and return its exit code."""
    try:
        arguments = parse(list(sys.argv[1:] if argv is None else argv))
        code = arguments.run(arguments)
        sys.stdout.flush()
        return code
    except ExtraMissing as error:
        print(f"slamlab {arguments.command}: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        # whoever read the output has ended: Python must not flush the rest into the pipe
        with contextlib.suppress(OSError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
