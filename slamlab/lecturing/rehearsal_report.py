"""What a rehearsal tells: a table by section, then what to mend, to start early, to have ready."""

from rich.table import Table

from slamlab.lecturing.rehearsal import SLOW, SMALL


def report(rehearsed, console):
    """Print a rehearsal.

    Parameters
    ----------
    rehearsed : Rehearsed
    console : rich Console
    """
    console.print(table(rehearsed))
    sections = rehearsed.sections
    if not rehearsed.said and rehearsed.promised:
        console.print("The lesson plans no minutes: its whole time was spread by the stops.")
    wrong = [*rehearsed.wrong, *_listed(sections, lambda section: section.wrong)]
    _tell(console, "To be mended:", wrong)
    _tell(console, "Needed:", _listed(sections, lambda section: section.needs))
    _tell(console, f"Slow (over {SLOW:g} s):", _listed(sections, _slow))
    whole = sum(section.seconds for section in sections)
    console.print(
        f"To start early: all cells take {whole:.0f} s on this machine; run them before the class "
        "comes (Run → Run All Cells)."
    )
    console.print("Nothing is wrong." if rehearsed.is_sound else "Something is wrong: see above.")


def table(rehearsed):
    """A row for each section.

    Parameters
    ----------
    rehearsed : Rehearsed

    Returns
    -------
    rich Table
    """
    made = Table()
    made.add_column("slides")
    made.add_column("title", ratio=1)
    for head in ("stops", "kernel [s]", "minutes", "letters"):
        made.add_column(head, justify="right")
    made.add_column("")
    for section in rehearsed.sections:
        first, last = section.slides
        made.add_row(
            str(first) if first == last else f"{first}–{last}",
            section.title or "—",
            str(section.stops),
            f"{section.seconds:.1f}",
            str(section.minutes or ""),
            f"{100 * section.letters:.0f} %",
            ", ".join(marks(section)),
        )
    made.add_section()
    made.add_row(
        "",
        "all",
        str(sum(section.stops for section in rehearsed.sections)),
        f"{sum(section.seconds for section in rehearsed.sections):.1f}",
        str(sum(section.minutes for section in rehearsed.sections) or ""),
        f"{100 * min(section.letters for section in rehearsed.sections):.0f} %",
    )
    return made


def marks(section):
    """Words that make a section stand out.

    Parameters
    ----------
    section : Section

    Returns
    -------
    list of str
    """
    found = {
        "wrong": section.wrong,
        "small": section.letters < SMALL,
        "slow": section.slow,
        "needs": section.needs,
    }
    return [word for word, is_so in found.items() if is_so]


def _slow(section):
    return [f"{place}: {seconds:.1f} s" for place, seconds in section.slow]


def _listed(sections, of):
    return [f"{section.title or '—'}: {text}" for section in sections for text in of(section)]


def _tell(console, head, lines):
    if lines:
        console.print(head)
        for line in lines:
            console.print(f"  {line}", markup=False, highlight=False)
