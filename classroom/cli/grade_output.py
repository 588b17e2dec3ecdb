"""Output of ``slamlab grade``: a progress bar and the table of results."""

from classroom.exercises.verdict_text import number
from slamlab.cli.common import printable

MAX_TABLE_ROWS = 60  # submissions shown; of larger classes only those not graded


def progress_bar():
    """Return a progress bar with counts, time and current item, shown if stderr is a terminal."""
    # imported late: a help text should come at once
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    text = TextColumn("{task.description}", markup=False)
    console = Console(stderr=True)
    return Progress(*columns, text, console=console, disable=not console.is_terminal)


def with_progress(graded, count):
    """Return the records of a run, sorted, and show a progress bar during the run."""
    records = []
    with progress_bar() as progress:
        bar = progress.add_task("starting", total=count)
        for record in graded:
            records.append(record)
            progress.update(bar, advance=1, description=printable(record.submission))
    return sorted(records, key=lambda record: record.submission)


def print_summary(records, out, notes=(), by="submission"):
    """Print the table of a run; ``by`` is "submission" or, with a roster, "student"."""
    from rich.console import Console

    Console().print(_table(records, by))
    print(_summary_line(records, out, by))
    for line in notes:
        print(printable(line))


def _table(records, by):
    from rich.table import Table
    from rich.text import Text

    shown = records if len(records) <= MAX_TABLE_ROWS else [r for r in records if not r.graded]
    # the tables in files show scores after both
    table = Table(by, "score", "of", "note", title="Scores before late penalty and overrides")
    for record in shown:
        scores = (number(record.score), number(record.max_score)) if record.graded else ("–", "–")
        # as Text, so that a name or a note cannot style the table
        table.add_row(Text(printable(_name(record, by))), *scores, Text(printable(record.note)))
    return table


def _name(record, by):
    return record.submission if by == "submission" else f"{record.student} · {record.exercise}"


def _summary_line(records, out, by):
    missing = sum(not record.graded for record in records)
    lost = f", {missing} could not be graded" if missing else ""
    ids = sorted({record.exercise for record in records} - {None})
    pages = ["feedback/"] if by == "submission" else [f"{id}/feedback/" for id in ids]
    written = ", ".join(["class.html", *(page for page in pages if (out / page).is_dir())])
    return f"{len(records) - missing} graded{lost}: {out / 'grades.csv'}, {written}"
