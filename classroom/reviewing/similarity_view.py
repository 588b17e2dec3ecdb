"""Similarity of submissions as plain data: all pairs of a class, or one pair side by side."""

from classroom.exercises import catalogue


def pairs_view(state, id):
    """Return the most similar pairs of an exercise; students are given as row numbers of the
    table."""
    found, rows = state.similarity(id), _rows(state)
    return {
        "exercise": {"id": id, "title": catalogue.exercise(id).title},
        "pairs": [
            {"rows": [rows[pair.left], rows[pair.right]], "share": round(pair.share, 3)}
            for pair in found.comparison.pairs
        ],
        "compared": found.comparison.count,
        "not_compared": [
            {"row": rows[student], "why": why} for student, why in found.not_compared.items()
        ],
        "originals_excluded": found.originals_excluded,
    }


def pair_view(state, id, left, right):
    """Return two submissions, given as row numbers of the table, side by side; raise KeyError if
    one is missing.

    Each side has cells, and each cell has lines [text, kind, position of the similar line]."""
    students = {row: student for student, row in _rows(state).items()}
    both = state.similarity(id).comparison.side_by_side(students[left], students[right])
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
