"""Report of a rehearsal: a table of sections, problems, requirements and run times."""

from rich.table import Table

from classroom.lecturing.rehearsal import SLOW, SMALL


def report(rehearsed, console):
    console.print(table(rehearsed))
    sections = rehearsed.sections
    if not rehearsed.planned and rehearsed.stated:
        console.print("The lesson plans no minutes: its total time is distributed over the stops.")
    wrong = [*rehearsed.wrong, *_listed(sections, lambda section: section.wrong)]
    _print_list(console, "To fix:", wrong)
    _print_list(console, "Required:", _listed(sections, lambda section: section.requirements))
    _print_list(console, f"Slow (over {SLOW:g} s):", _listed(sections, _slow))
    whole = sum(section.seconds for section in sections)
    console.print(
        f"All cells take {whole:.0f} s on this machine. Run them before the lecture "
        "(Run → Run All Cells)."
    )
    console.print(
        "No problems were found." if rehearsed.is_sound else "Problems were found; see above."
    )


def table(rehearsed):
    made = Table()
    made.add_column("slides")
    made.add_column("title", ratio=1)
    for head in ("stops", "kernel [s]", "minutes", "text size"):
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
    """Return keywords for a section's findings."""
    found = {
        "wrong": section.wrong,
        "small text": section.letters < SMALL,
        "slow": section.slow,
        "requires": section.requirements,
    }
    return [word for word, is_so in found.items() if is_so]


def _slow(section):
    return [f"{place}: {seconds:.1f} s" for place, seconds in section.slow]


def _listed(sections, of):
    return [f"{section.title or '—'}: {text}" for section in sections for text in of(section)]


def _print_list(console, head, lines):
    if lines:
        console.print(head)
        for line in lines:
            console.print(f"  {line}", markup=False, highlight=False)
