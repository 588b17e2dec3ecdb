"""``slamlab completion SHELL``: print a script that completes commands and options (shtab)."""

import argparse

from slamlab.cli import listings
from slamlab.cli.parsers import add_command
from slamlab.estimators.options import OPTIONS
from slamlab.extras import needs

SHELLS = "bash", "zsh", "fish"
FILES = "SOURCE", "FILE", "FOLDER", "DIR", "NOTEBOOK", "ZIP", "PAGE", "PDF", "BOOK"


def add_parser(subparsers):
    parser = add_command(
        subparsers,
        "completion",
        "Print a shell script that completes slamlab's arguments.",
        "bash > ~/.local/share/bash-completion/completions/slamlab",
        "zsh > ~/.zfunc/_slamlab",
    )
    parser.add_argument("shell", choices=SHELLS, help="Shell that runs the script")
    parser.set_defaults(run=run)


def run(arguments) -> int:
    from slamlab.cli import command_parsers  # late: it imports this module

    with needs("completion"):
        import shtab

    print(shtab.complete(_tree(command_parsers()[1], shtab.FILE), arguments.shell))
    return 0


def _tree(commands, file):
    """Return a parser that only describes the commands for shtab; two-word commands are nested."""
    root, nested = argparse.ArgumentParser("slamlab"), {}
    top = root.add_subparsers()
    for name, parser in commands.items():
        first, _, verb = name.partition(" ")
        if any(other.startswith(f"{name} ") for other in commands):
            made = top.add_parser(name, help=parser.description, add_help=False)
            nested[name] = made.add_subparsers()
            for action in parser._actions:
                if action.option_strings:
                    made._add_action(action)
        else:
            options = {"help": parser.description, "parents": [parser], "add_help": False}
            (nested[first] if verb else top).add_parser(verb or first, **options)
        for action in parser._actions:
            if action.metavar in FILES:
                action.complete = file
            elif action.dest == "estimator":
                action.choices = listings.ESTIMATORS
            elif action.dest == "param":
                # of numbers only NAME=
                words = {name: getattr(each, "values", [""]) for name, each in OPTIONS.items()}
                action.choices = [f"{name}={word}" for name in words for word in words[name]]
    return root
