"""Command-line interface: ``slamlab COMMAND``; each subcommand is a module with ``add_parser``.

Read in this order:

- ``run``, ``convert``: estimators over sources, sources into reading logs; ``live``: estimators in
  the browser; ``film``: films of runs
- ``emulate``, ``record``, ``replay``: devices
- ``progress``, ``reset`` (and update): a student's own folder
- ``check``, ``grade``, ``grade_output``, ``term_verbs`` (init, release), ``gradebook_verbs``
  (merge, adjust, export), ``ledger_verbs`` (rejudge, verify, forget), ``review``,
  ``likeness``, ``lti``: exercises; ``contest``: students' own SLAMs
- ``rehearse``, ``print_handout``: a lesson before and after its lecture
- ``common``: what several share

Exit codes: 0 done, 1 a task that is not passed, 2 wrong use or unreadable input, 130 interrupted.
"""

import argparse
import sys
from importlib import import_module

from slamlab import __version__

COMMANDS = ("run", "live", "film", "convert", "emulate", "record", "replay", "check", "grade",
            "term_verbs", "gradebook_verbs", "ledger_verbs", "review", "likeness", "lti", "contest",
            "progress", "reset", "rehearse", "print_handout")  # fmt: skip
SUBCOMMANDS = {
    "grade": (
        "init",
        "review",
        "likeness",
        "lti",
        "release",
        "merge",
        "adjust",
        "export",
        "rejudge",
        "verify",
        "forget",
    )
}
"""Subcommands, written as two words; a folder of such a name is given as ./merge."""


class Parser(argparse.ArgumentParser):
    """A parser that says in one line what is wrong with its words; its subparsers do, too."""

    def error(self, message):
        """Say what is wrong and where to read more, and exit with 2."""
        for kind, says in (("int", "a whole number"), ("float", "a number")):
            message = message.replace(f"invalid {kind} value:", f"{says} is needed, not")
        self.exit(2, f"{self.prog}: {message}; '{self.prog} --help' tells what it takes\n")


def main(argv=None):
    """Parse the command line and run a command (entry point).

    Parameters
    ----------
    argv : list of str or None, the words after ``slamlab``; those it was started with by default

    Returns
    -------
    int, the exit code
    """
    parser = Parser(
        prog="slamlab",
        description="Simultaneous localisation and mapping: run it, check it, grade it.",
        epilog="slamlab COMMAND --help says more of a command.",
    )
    parser.add_argument("--version", action="version", version=f"slamlab {__version__}")
    subparsers = parser.add_subparsers(metavar="COMMAND", required=True)
    for command in COMMANDS:
        import_module(f"slamlab.cli.{command}").add_parser(subparsers)
    words = list(sys.argv[1:] if argv is None else argv)
    if words[1:2] and words[1] in SUBCOMMANDS.get(words[0], ()):
        words[:2] = [" ".join(words[:2])]
    arguments, rest = parser.parse_known_args(words)
    if rest:  # of the command, whose help tells what it takes
        Parser(prog=f"slamlab {words[0]}").error(f"unrecognized arguments: {' '.join(rest)}")
    try:
        return arguments.run(arguments)
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:
        # whoever read the output has gone: nothing is left to be said
        sys.stderr.close()
        return 0
