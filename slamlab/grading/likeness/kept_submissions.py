"""The likeness of what a gradebook keeps of a class."""

from dataclasses import dataclass

from slamlab.grading.ledger.contents import ContentError
from slamlab.grading.likeness.class_likeness import ClassLikeness
from slamlab.grading.likeness.handed_out import handed_out
from slamlab.grading.rejudging import NotKept, kept_cells


@dataclass(frozen=True)
class Likeness:
    """What was compared, and what came of it.

    Parameters
    ----------
    of_class : ClassLikeness, by student
    not_compared : student to why
    knows_handed_out : bool, whether the notebooks handed out were there to be taken away
    """

    of_class: ClassLikeness
    not_compared: dict
    knows_handed_out: bool


def likeness_of(book, records):
    """The likeness of the submissions of an exercise.

    Parameters
    ----------
    book : Gradebook
    records : student to Record

    Returns
    -------
    Likeness
    """
    kept = book.contents(r.kept["cells"] for r in records.values() if r.kept.get("cells"))
    cells, not_compared = {}, {}
    for student, record in records.items():
        try:
            cells[student] = kept_cells(record, kept)
        except NotKept:
            not_compared[student] = record.reason or "its cells are not kept"
        except (ContentError, ValueError) as error:
            not_compared[student] = str(error)
    given = handed_out()
    found = ClassLikeness(cells, given or frozenset())
    too_long = dict.fromkeys(found.too_long, "longer than anybody writes by hand")
    return Likeness(found, not_compared | too_long, given is not None)
