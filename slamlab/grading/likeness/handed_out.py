"""What everybody was given: the k-grams of the code in the lessons and exercises handed out."""

import functools
from pathlib import Path

import slamlab
from slamlab.coursework import originals
from slamlab.grading.likeness.code_tokens import grams
from slamlab.grading.notebooks import SubmissionError, parse

COURSE = Path(slamlab.__file__).parents[1]
"""The folder of a course's pack, or of its clone, that this package stands in."""


@functools.cache
def handed_out(course=COURSE):
    """The k-grams of all notebooks handed out.

    Parameters
    ----------
    course : Path

    Returns
    -------
    frozenset of int; None where the notebooks are not there, as beside an installed package
    """
    try:
        cells = {
            source
            for name in originals.names(course)
            for _, source in parse(originals.original(course, name), lesson=True).cells
        }
    except (originals.OriginalError, SubmissionError):
        return None
    # a package that is installed within another project's clone finds that one's git, and nothing
    return frozenset(gram for source in cells for gram, _, _ in grams(source)) or None
