"""Rehearsal: a lesson run as in the lecture, cell by cell, and stepped through stop by stop."""

from dataclasses import dataclass, field
from itertools import groupby

import nbformat

from slamlab.lecturing.needs import needs
from slamlab.lecturing.planning import planned, total
from slamlab.lecturing.shown_lesson import SCREEN, ShowError, shown

SLOW = 2.0  # [s] that a class waits without asking
SMALL = 0.75  # of their full size: smaller letters cannot be read from the last row
PATIENCE = 30  # minutes for all cells: a guard against hanging


@dataclass
class Section:
    """What was found of the slides under one title.

    Parameters
    ----------
    title : str
    slides : (int, int), the first and the last, from 1
    stops : int, key presses
    seconds : float, of the kernel
    minutes : int, planned; 0 where nothing is
    letters : float, the smallest, as a part of their full size
    wrong : list of str, what must be mended before the lecture
    slow : list of (str, float), where cells over SLOW stand, and their seconds
    needs : list of str
    """

    title: str
    slides: tuple[int, int]
    stops: int
    seconds: float = 0.0
    minutes: int = 0
    letters: float = 1.0
    wrong: list = field(default_factory=list)
    slow: list = field(default_factory=list)
    needs: list = field(default_factory=list)


@dataclass
class Rehearsed:
    """A rehearsal's findings.

    Parameters
    ----------
    sections : list of Section
    promised : int or None, minutes that the lesson's head says
    said : bool, whether the lesson itself plans its sections (else a rule did)
    wrong : list of str, what is wrong with the lesson as a whole
    """

    sections: list
    promised: int | None
    said: bool
    wrong: list

    @property
    def is_sound(self):
        """bool, whether nothing is wrong."""
        return not self.wrong and not any(section.wrong for section in self.sections)


def rehearse(notebook, screen=SCREEN, patience=PATIENCE):
    """Rehearse a lesson on a copy of it.

    Parameters
    ----------
    notebook : Path
    screen : (width, height) of the projector [pixels]
    patience : float, minutes that all its cells may take

    Returns
    -------
    Rehearsed

    Raises
    ------
    Unavailable : no browser, or no JupyterLab
    ShowError : it cannot be shown, or does not come to its end
    """
    with shown(notebook, screen) as page:
        ran = page.ask("rehearsal.js", "run", patience * 60_000)
        if ran["late"]:
            waiting = [cell for cell in ran["cells"] if cell["error"] == "was not run"]
            last = waiting[0] if waiting else ran["cells"][-1]
            raise ShowError(
                f"after {patience:g} minutes the cells were not done; they got as far as "
                f"{last['title']}: {_place(last)}"
            )
        page.begin()
        stops = page.ask("rehearsal.js", "walk")
    head = nbformat.read(notebook, as_version=4).cells[0].source
    return findings(ran["cells"], stops, total(head), page.errors, page.abroad)


def findings(cells, stops, promised=None, errors=(), abroad=()):
    """Put together what was found of cells and stops.

    Parameters
    ----------
    cells : list of dict, as ``run`` of ``rehearsal.js`` reports them
    stops : list of dict, as ``walk`` does
    promised : int or None, minutes of the whole lesson
    errors, abroad : lists of str, errors of the page and addresses it asked

    Returns
    -------
    Rehearsed
    """
    by_title = groupby(stops, key=lambda stop: stop["title"])
    sections = [_section(title, list(group)) for title, group in by_title]
    needed = needs([cell["code"] for cell in cells])
    for cell, needs_of in zip(cells, needed, strict=True):
        section = next(one for one in sections if cell["slide"] <= one.slides[1])
        _add_cell(section, cell, needs_of)
    said = any(section.minutes for section in sections)
    plans = [{"minutes": section.minutes, "stops": section.stops} for section in sections]
    for section, minutes in zip(sections, planned(plans, promised), strict=True):
        section.minutes = minutes
    wrong = [f"the page says: {error}" for error in dict.fromkeys(errors)]
    wrong += [f"asks another machine: {address}" for address in dict.fromkeys(abroad)]
    whole = sum(section.minutes for section in sections)
    if said and promised and whole != promised:
        wrong.append(f"its sections are planned for {whole} minutes, its head says {promised}")
    return Rehearsed(sections, promised, said, wrong)


def _section(title, stops):
    """A section from its stops."""
    minutes = {stop["slide"]: stop["minutes"] for stop in stops}
    section = Section(title, (stops[0]["slide"], stops[-1]["slide"]), len(stops))
    section.minutes = sum(minutes.values())
    section.letters = min(stop["letters"] for stop in stops)
    for stop in stops:
        place = _place(stop)
        if stop["letters"] < SMALL:
            section.wrong.append(f"{place}: letters of {100 * stop['letters']:.0f} %")
        if not stop["fits"]:
            section.wrong.append(f"{place}: does not fit the screen")
    section.wrong = list(dict.fromkeys(section.wrong))
    return section


def _add_cell(section, cell, needed):
    """Add what running a cell of a section found."""
    place = _place(cell)
    section.seconds += cell["seconds"]
    if cell["seconds"] > SLOW:
        section.slow.append((place, cell["seconds"]))
    if cell["error"]:
        section.wrong.append(f"{place}: {cell['error']}")
    section.needs += [f"{place}: {need}" for need in needed]


def _place(cell):
    """Where a lecturer finds a cell: below its section's title, on this slide."""
    return f"slide {cell['slide']}, cell {cell['id']}"
