"""Ladder: a board that stays open shows only gains that luck does not explain (Blum, Hardt 2015).

Who may hand in again and again, and sees each score, finds a lucky version sooner or later. So a
new score shows only where it is better beyond doubt, and by a step; else the old one stays.
"""

import json

import numpy as np

from slamlab.contest.ranking import LEVEL, scores, standings
from slamlab.contest.scoreboard import TEMPLATES
from slamlab.grading.grade_tables import write_table
from slamlab.grading.records import write_atomically

LADDER = "ladder.json"
"""File of a contest, the judge's own: the points of each student's version that shows."""
STEP = 3.0  # points that a gain has to reach: about what a score varies between seeds
BOOTSTRAP_SEED = 0  # so that the same points climb again


def climbs(shown, points):
    """Whether a new version shows: better beyond doubt on the same worlds, and by a step.

    Parameters
    ----------
    shown, points : (families, worlds) points of the version that shows, and of the new one

    Returns
    -------
    bool
    """
    if scores(np.asarray(points)) - scores(np.asarray(shown)) < STEP:
        return False
    old, new = standings([shown, points], np.random.default_rng(BOOTSTRAP_SEED))
    return new.rank < old.rank


def climb(file, points):
    """Let students climb, and keep what shows now.

    Parameters
    ----------
    file : Path, of the ladder
    points : dict, student to (families, worlds) of the present version

    Returns
    -------
    dict, student to the score that shows, rounded to whole points: all that may be told
    """
    shown = json.loads(file.read_text("utf-8")) if file.exists() else {}
    for student, found in points.items():
        if student not in shown or climbs(shown[student], found):
            shown[student] = np.asarray(found).tolist()
    write_atomically(file, json.dumps(shown, sort_keys=True) + "\n")
    return {student: round(float(scores(np.array(found)))) for student, found in shown.items()}


def write_open_board(out, shown, contest):
    """Write the board of a contest that is open: names and the scores that show, and no more.

    Parameters
    ----------
    out : Path
    shown : dict, name to score
    contest : Contest
    """
    rows = sorted(shown.items(), key=lambda row: (-row[1], row[0]))
    known = {"rows": rows, "contest": contest, "level": LEVEL, "step": STEP}
    write_atomically(out / "index.html", TEMPLATES.get_template("open_board.html").render(known))
    write_table(out / "board.csv", [["name", "score"], *([n, str(score)] for n, score in rows)])
