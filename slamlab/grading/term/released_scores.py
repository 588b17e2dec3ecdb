"""The scores of a release, as another program takes them: what grade passback sends."""

import json

from slamlab.grading.records import write_atomically
from slamlab.grading.term.course_file import TermError
from slamlab.grading.term.standings import points_of

NAME = "scores.json"


def write_scores(folder, standings):
    """Write the scores of those who have one.

    Parameters
    ----------
    folder : Path, of the release
    standings : list of Standing, of one exercise
    """
    scores = [
        {"student": one.student.id, "score": round(one.total, 6), "of": points_of(one.exercise),
         "note": one.mark.note}
        for one in standings if one.total is not None
    ]  # fmt: skip
    write_atomically(folder / NAME, json.dumps(scores, ensure_ascii=False, indent=1))


def released_scores(course, exercise):
    """The scores of an exercise as they were released last.

    Parameters
    ----------
    course : Course
    exercise : str

    Returns
    -------
    list of dict: student, score, of, note

    Raises
    ------
    TermError : there is no release
    """
    file = course.results / exercise / "release" / NAME
    try:
        return json.loads(file.read_text("utf-8"))
    except FileNotFoundError:
        raise TermError(f"{file} is not there: slamlab grade release {exercise}") from None
    except (OSError, ValueError) as error:
        raise TermError(f"{file} cannot be read ({error}): release {exercise} again") from None
