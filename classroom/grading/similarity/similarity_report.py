"""Similarity report on the submissions stored in a gradebook, without the original notebooks."""

import functools
from dataclasses import dataclass
from pathlib import Path

import classroom
from classroom.coursework import originals
from classroom.grading.ledger.contents import ContentError
from classroom.grading.notebooks import SubmissionError, parse
from classroom.grading.rejudging import NotStored, stored_cells
from classroom.grading.similarity.class_similarity import ClassSimilarity
from classroom.grading.similarity.code_tokens import grams

COURSE = Path(classroom.__file__).parents[1]
"""The folder of the course's pack or clone that contains this package."""


@dataclass(frozen=True)
class SimilarityReport:
    """The result of comparing a class's submissions."""

    comparison: ClassSimilarity  # by student
    not_compared: dict  # student to the reason
    originals_excluded: bool  # whether the original notebooks were found and excluded


def compare_submissions(book, records):
    """Return the SimilarityReport on an exercise's submissions, a dict from student to Record."""
    kept = book.contents(r.kept["cells"] for r in records.values() if r.kept.get("cells"))
    cells, not_compared = {}, {}
    for student, record in records.items():
        try:
            cells[student] = stored_cells(record, kept)
        except NotStored:
            not_compared[student] = record.reason or "its cells are not stored"
        except (ContentError, ValueError) as error:
            not_compared[student] = str(error)
    given = original_grams()
    found = ClassSimilarity(cells, given or frozenset())
    too_long = dict.fromkeys(found.too_long, "its code is too long to be written by hand")
    return SimilarityReport(found, not_compared | too_long, given is not None)


@functools.cache
def original_grams(course=COURSE):
    """Return the k-grams of all original notebooks, or None if they are not found."""
    try:
        cells = {
            source
            for name in originals.names(course)
            for _, source in parse(originals.original(course, name), lesson=True).cells
        }
    except (originals.OriginalError, SubmissionError):
        return None
    # a package installed inside another project's clone finds that git repository, and no notebooks
    return frozenset(gram for source in cells for gram, _, _ in grams(source)) or None
