"""A page for the student: each task, what it asked, what held, and what would gain the rest."""

from pathlib import Path

import jinja2

from slamlab.checks.report import number, points
from slamlab.grading.marks import Mark
from slamlab.grading.records import write

PAGES = jinja2.Environment(
    loader=jinja2.FileSystemLoader(Path(__file__).parent),
    autoescape=True,
    undefined=jinja2.StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)
PAGES.filters |= {"number": number, "points": points}


def page(mark: Mark) -> str:
    """The page of a submission; whatever the student wrote stands in it as text only.

    Parameters
    ----------
    mark : Mark

    Returns
    -------
    str, HTML without scripts or anything to load
    """
    return PAGES.get_template("feedback.html").render(mark=mark, record=mark.record)


def write_page(out: Path, mark: Mark):
    """Write the page to ``out/feedback``."""
    write(out / "feedback" / f"{mark.record.stem}.html", page(mark))
