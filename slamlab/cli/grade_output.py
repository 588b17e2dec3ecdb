"""What ``slamlab grade`` shows: a bar while it runs, a table at its end."""

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

from slamlab.exercises.report import number

MAX_TABLE_ROWS = 60  # submissions shown; of larger classes only those that failed


def with_progress(graded, count):
    """The records of a run, sorted by submission, with a bar while they are made.

    Parameters
    ----------
    graded : iterable of Record
    count : int, how many there will be

    Returns
    -------
    list of Record
    """
    columns = (BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    text = TextColumn("{task.description}", markup=False)
    records = []
    with Progress(*columns, text, console=Console(stderr=True)) as progress:
        bar = progress.add_task("starting", total=count)
        for record in graded:
            records.append(record)
            progress.update(bar, advance=1, description=printable(record.submission))
    return sorted(records, key=lambda record: record.submission)


def print_summary(records, out, said=(), by="submission"):
    """Print the table of a run and what to know of it.

    Parameters
    ----------
    records : list of Record
    out : Path, where the results are
    said : iterable of str, further lines
    by : "submission", or "student" where a roster tells whose each is
    """
    Console().print(_table(records, by))
    print(_summary_line(records, out))
    for line in said:
        print(printable(line))


def _table(records, by):
    shown = records if len(records) <= MAX_TABLE_ROWS else [r for r in records if not r.graded]
    table = Table(by, "score", "of", "note")
    for record in shown:
        scores = (number(record.score), number(record.max_score)) if record.graded else ("–", "–")
        # as Text, so that a name or a note cannot style the table
        table.add_row(Text(printable(_name(record, by))), *scores, Text(printable(record.note)))
    return table


def _name(record, by):
    return record.submission if by == "submission" else f"{record.student} · {record.exercise}"


def _summary_line(records, out):
    missing = sum(not record.graded for record in records)
    lost = f", {missing} could not be graded" if missing else ""
    return f"{len(records) - missing} graded{lost}: {out / 'grades.csv'}, class.html, feedback/"


def printable(text):
    """Text without what a terminal would take for a command."""
    return "".join(c if c.isprintable() else " " for c in text)
