"""Likeness as plain data: a class's pairs, and two submissions side by side."""

from slamlab.exercises import catalogue


def pairs_view(state, id):
    """The pairs of an exercise that are most alike.

    Parameters
    ----------
    state : ClassState
    id : str, of an exercise

    Returns
    -------
    dict of plain values; students are rows of the table
    """
    found, rows = state.likeness(id), _rows(state)
    return {
        "exercise": {"id": id, "title": catalogue.exercise(id).title},
        "pairs": [
            {"rows": [rows[pair.left], rows[pair.right]], "share": round(pair.share, 3)}
            for pair in found.of_class.pairs
        ],
        "compared": found.of_class.count,
        "not_compared": [
            {"row": rows[student], "why": why} for student, why in found.not_compared.items()
        ],
        "knows_handed_out": found.knows_handed_out,
    }


def pair_view(state, id, left, right):
    """Two submissions side by side.

    Parameters
    ----------
    state : ClassState
    id : str, of an exercise
    left, right : int, rows of the table

    Returns
    -------
    dict of plain values: of each side cells, of each cell lines [text, kind, place of its like]

    Raises
    ------
    KeyError : one of them is not among those that were compared
    """
    students = {row: student for student, row in _rows(state).items()}
    both = state.likeness(id).of_class.side_by_side(students[left], students[right])
    return {
        "sides": [
            [
                {
                    "number": number,
                    "lines": [
                        [text, kind, f"{place[0]}:{place[1]}" if place else ""]
                        for text, kind, place in lines
                    ],
                }
                for number, lines in side
            ]
            for side in both
        ]
    }


def _rows(state):
    return {student.id: row for row, student in enumerate(state.students)}
