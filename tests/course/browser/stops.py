"""Checks at every stop of a lesson's lecture, forwards and backwards."""

import json

from course.source import ROOT

SCREENS = ((1280, 720), (1920, 1080))
SMALLEST = 0.75  # of the usual letters
BASE = 18  # letters at 720 lines [pixels]
FIGURE_LETTERS = 12  # in figures, at 720 lines [pixels]
FIGURE = 0.8  # of the width or height that is free, for a figure alone on its page


def walk_there_and_back(lecture, lesson, screen):
    """Go through a lecture from its first stop to the last and back: each is whole and legible.

    Parameters
    ----------
    lecture : Lecture
    lesson : str, path of the notebook in the course
    screen : (int, int), width and height of the window [pixels]
    """
    _, height = screen
    stops = list(lecture.walk())
    assert [seen["stop"] for seen in stops] == list(range(stops[-1]["stops"]))
    assert len({seen["shown"] for seen in stops}) == len(stops)  # each key shows something new
    assert cells_of(stops) == on_slides(lesson)  # and none goes over something
    small = [seen["stop"] for seen in stops if seen["shrink"] < SMALLEST]
    faint = [seen["stop"] for seen in stops if seen["letters"] < BASE * height / 720 - 0.01]
    assert ([seen["stop"] for seen in stops if seen["cut"]], small, faint) == ([], [], [])
    least = FIGURE_LETTERS * height / 720 - 0.01
    assert [seen["stop"] for seen in stops if seen["figure_letters"] < least] == []
    assert [seen["stop"] for seen in stops if seen["figure"] < FIGURE] == []
    torn = [line for seen in stops for line in seen["telling"] if line.endswith(("(", "[", "{"))]
    assert torn == []  # the caption of folded code is not empty
    for seen in reversed(stops[:-1]):
        assert lecture.see("PageUp")["shown"] == seen["shown"]
    assert lecture.visit.faults == []
    assert lecture.visit.foreign_requests == []


def cells_of(stops):
    """Positions of the cells that were shown at some stop."""
    return {int(cell) for seen in stops for cell in seen["shown"].split("/")[0].split(",")}


def on_slides(lesson):
    """Positions of the cells on slides: neither notes nor skipped, and with something to see."""
    cells = json.loads((ROOT / lesson).read_text())["cells"]
    return {n for n, cell in enumerate(cells) if not is_for_others(cell["metadata"]) and sees(cell)}


def is_for_others(metadata):
    """Whether a cell is for the speaker or for the kernel alone."""
    return metadata.get("slideshow", {}).get("slide_type") in ("notes", "skip")


def sees(cell):
    """Whether a cell shows anything: text, an output, or code that is not folded away."""
    hidden = cell["metadata"].get("jupyter", {}).get("source_hidden")
    return cell["cell_type"] == "markdown" or bool(cell["outputs"]) or not hidden
