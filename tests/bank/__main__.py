"""Print how often each entry of the bank came out as it should, and what solutions cost."""

import argparse
import time

from rich.console import Console
from rich.table import Table

from tests.bank import harness


def main():
    parser = argparse.ArgumentParser(prog="python -m tests.bank", description=__doc__)
    parser.add_argument("exercise", nargs="*", help="such as 04; default: all that have a bank")
    parser.add_argument("--seeds", type=int, default=1000)
    arguments = parser.parse_args()
    for id in arguments.exercise or harness.banked():
        bank = harness.load(id)
        Console().print(rates(bank, arguments.seeds), cost(bank))


def rates(bank, seeds):
    """A table of the entries and the share of seeds that came out as they should."""
    table = Table("kind", "entry", "as it should", "else, for instance", title=bank.exercise.title)
    for entry in bank.entries:
        missed = harness.missed(bank, entry, seeds)
        first = next((f"seed {seed}: {how}" for seed, how in missed.items()), "")
        kind = type(entry).__name__.lower()
        table.add_row(kind, entry.name, f"{seeds - len(missed)}/{seeds}", first)
    return table


def cost(bank, rounds=10):
    """What driving and judging the solutions takes."""
    names = harness.namespace(bank, bank.entries[0])
    harness.verdicts(bank, names, 0)
    begin = time.process_time()
    for seed in range(rounds):
        harness.verdicts(bank, names, seed)
    taken = (time.process_time() - begin) / rounds
    return f"solutions of exercise {bank.exercise.id}: {taken:.3f} s CPU (limit 0.150)"


if __name__ == "__main__":
    main()
