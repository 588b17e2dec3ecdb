"""Rehearsal of a lesson: run all cells, then step through all stops of its slides."""

from dataclasses import dataclass, field
from itertools import groupby

import nbformat

from classroom.lecturing.lesson_page import SCREEN, LessonError, open_lesson
from classroom.lecturing.requirements import requirements
from classroom.lecturing.time_plan import section_minutes, total_minutes

SLOW = 2.0  # a cell that takes longer is reported [s]
SMALL = 0.75  # of the full size; smaller text is illegible from the last row
PATIENCE = 30  # timeout for all cells [min]


@dataclass
class Section:
    """Findings on the slides under one title."""

    title: str
    slides: tuple[int, int]  # the first and the last, from 1
    stops: int  # key presses
    seconds: float = 0.0  # of the kernel
    minutes: int = 0  # planned; 0 if there is no plan
    letters: float = 1.0  # smallest text size, relative to full size
    wrong: list = field(default_factory=list)  # problems to fix before the lecture
    slow: list = field(default_factory=list)  # (where, seconds) of cells over SLOW
    requirements: list = field(default_factory=list)


@dataclass
class RehearsalResult:
    """A rehearsal's findings."""

    sections: list
    stated: int | None  # minutes in the lesson's first cell
    planned: bool  # whether the lesson plans its sections (otherwise minutes are distributed)
    wrong: list  # problems of the lesson as a whole

    @property
    def is_sound(self):
        """Whether no problems were found."""
        return not self.wrong and not any(section.wrong for section in self.sections)


def rehearse(notebook, screen=SCREEN, patience=PATIENCE):
    """Rehearse a copy of a lesson; raise Unavailable or LessonError if this is impossible.

    screen : (width, height) [pixels]. patience : timeout for all cells [min]."""
    with open_lesson(notebook, screen) as page:
        ran = page.call("rehearsal.js", "run", patience * 60_000)
        if ran["late"]:
            waiting = [cell for cell in ran["cells"] if cell["error"] == "was not run"]
            last = waiting[0] if waiting else ran["cells"][-1]
            raise LessonError(
                f"the cells did not finish within {patience:g} minutes; they stopped at "
                f"{last['title']}: {_place(last)}"
            )
        page.start()
        stops = page.call("rehearsal.js", "walk")
    head = nbformat.read(notebook, as_version=4).cells[0].source
    return findings(ran["cells"], stops, total_minutes(head), page.errors, page.external_requests)


def findings(cells, stops, stated=None, errors=(), external_requests=()):
    """Return the findings from the reports of ``run`` and ``walk`` in ``rehearsal.js``.

    stated : minutes that the lesson states. errors : errors of the page. external_requests :
    addresses."""
    by_title = groupby(stops, key=lambda stop: stop["title"])
    sections = [_section(title, list(group)) for title, group in by_title]
    requirements_of_cells = requirements([cell["code"] for cell in cells])
    for cell, required in zip(cells, requirements_of_cells, strict=True):
        section = next(one for one in sections if cell["slide"] <= one.slides[1])
        _add_cell(section, cell, required)
    planned = any(section.minutes for section in sections)
    plans = [{"minutes": section.minutes, "stops": section.stops} for section in sections]
    for section, minutes in zip(sections, section_minutes(plans, stated), strict=True):
        section.minutes = minutes
    wrong = [f"error in the page: {error}" for error in dict.fromkeys(errors)]
    wrong += [
        f"request to another machine: {address}" for address in dict.fromkeys(external_requests)
    ]
    whole = sum(section.minutes for section in sections)
    if planned and stated and whole != stated:
        wrong.append(
            f"its sections are planned for {whole} minutes, but its first cell states {stated}"
        )
    return RehearsalResult(sections, stated, planned, wrong)


def _section(title, stops):
    minutes = {stop["slide"]: stop["minutes"] for stop in stops}
    section = Section(title, (stops[0]["slide"], stops[-1]["slide"]), len(stops))
    section.minutes = sum(minutes.values())
    section.letters = min(stop["letters"] for stop in stops)
    for stop in stops:
        place = _place(stop)
        if stop["letters"] < SMALL:
            section.wrong.append(f"{place}: text size of {100 * stop['letters']:.0f} %")
        if not stop["fits"]:
            section.wrong.append(f"{place}: does not fit the screen")
        section.wrong += [f"{place}: {fault}" for fault in stop["faults"]]
    section.wrong = list(dict.fromkeys(section.wrong))
    return section


def _add_cell(section, cell, required):
    place = _place(cell)
    section.seconds += cell["seconds"]
    if cell["seconds"] > SLOW:
        section.slow.append((place, cell["seconds"]))
    if cell["error"]:
        section.wrong.append(f"{place}: {cell['error']}")
    section.requirements += [f"{place}: {one}" for one in required]


def _place(cell):
    return f"slide {cell['slide']}, cell {cell['id']}"
