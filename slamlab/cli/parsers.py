"""Argument parsers: short usage lines, examples in each help, errors that suggest a spelling."""

import argparse
import difflib


class UsageError(ValueError):
    """The arguments of a command are invalid."""


class Parser(argparse.ArgumentParser):
    """A parser with a short usage line and one-line error messages."""

    def format_help(self):
        shown = [a for a in self._actions if a.required or not a.option_strings]
        formatter = argparse.HelpFormatter(f"{self.prog} [OPTIONS]", width=200)
        formatter.add_usage(None, shown, [])
        self.usage = self.usage or formatter.format_help().removeprefix("usage: ").strip()
        return super().format_help()

    def error(self, message):
        message = message.removeprefix("argument ")
        for kind, noun in (("int", "a whole number"), ("float", "a number")):
            message = message.replace(f"invalid {kind} value:", f"{noun} is needed, not")
        end = "" if message.endswith(("?", ".")) else "."
        self.exit(2, f"{self.prog}: {message}{end} '{self.prog} --help' lists the arguments.\n")

    def refuse_unknown(self, words, meant=""):
        """Reject unknown arguments; suggest ``meant`` or an option with a similar name."""
        meant = meant or did_you_mean(words[0].partition("=")[0], self._option_string_actions)
        self.error(f"unrecognized arguments: {' '.join(words)}{meant and '.'}{meant}")


class Listing(argparse.Action):
    """An option that prints ``lines()`` and ends the program, like --help."""

    def __init__(self, option_strings, dest, lines, help):
        super().__init__(option_strings, argparse.SUPPRESS, nargs=0, help=help)
        self.lines = lines

    def __call__(self, parser, namespace, values, option_string=None):
        print("\n".join(self.lines()))
        parser.exit()


def add_command(subparsers, name, description, *examples):
    """Add a command with a description of one sentence and examples of its arguments."""
    shown = "\n".join(f"  {f'slamlab {name} {example}'.strip()}" for example in examples)
    return subparsers.add_parser(
        name,
        help=description,
        description=description,
        epilog=f"Examples:\n{shown}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )


def did_you_mean(word, known):
    """Return a question that suggests the most similar known word, or "" if none is similar."""
    similar = difflib.get_close_matches(word, list(known), n=1)
    return f" Did you mean {similar[0]!r}?" if similar else ""


def table(rows, indent="  "):
    """Return lines in which the columns of the rows (name, description) are aligned."""
    width = max((len(name) for name, _ in rows), default=0)
    return [f"{indent}{name:{width}}  {description}" for name, description in rows]
