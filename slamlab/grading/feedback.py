"""Feedback page for the student: each task, its laws, the points, and what would gain the rest."""

from pathlib import Path

import jinja2

from slamlab.exercises.report import number, points
from slamlab.grading.marks import Mark
from slamlab.grading.records import write_atomically

TEMPLATES = jinja2.Environment(
    loader=jinja2.FileSystemLoader(Path(__file__).parent),
    autoescape=True,
    undefined=jinja2.StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)
TEMPLATES.filters |= {"number": number, "points": points}


def feedback_page(mark: Mark) -> str:
    """The feedback page of a submission; whatever the student wrote is escaped.

    Parameters
    ----------
    mark : Mark

    Returns
    -------
    str, HTML without scripts or anything to load
    """
    return TEMPLATES.get_template("feedback.html").render(mark=mark, record=mark.record)


def write_feedback_page(out: Path, mark: Mark):
    """Write the feedback page to ``out/feedback``."""
    write_atomically(out / "feedback" / f"{mark.record.stem}.html", feedback_page(mark))
