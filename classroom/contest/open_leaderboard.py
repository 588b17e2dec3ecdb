"""The board of an open contest shows only significant gains (the Ladder of Blum, Hardt 2015).

A new score is shown only if it is significantly better than the shown score, and by at least one
step."""

import json

import numpy as np

from classroom.contest.leaderboard import TEMPLATES
from classroom.contest.ranking import LEVEL, scores, standings
from classroom.grading.grade_tables import write_table
from classroom.grading.records import write_atomically

SHOWN_SCORES = "ladder.json"
"""A private file of the contest: the points of each student's version that is shown."""
STEP = 3.0  # least gain in points: about the variation of a score between seeds
BOOTSTRAP_SEED = 0  # fixed, so that the result is reproducible


def is_significant_gain(shown, points):
    """Whether a new version is better, both significantly and by at least STEP points.

    shown, points : points (families, worlds) of the shown version and of the new version."""
    if scores(np.asarray(points)) - scores(np.asarray(shown)) < STEP:
        return False
    old, new = standings([shown, points], np.random.default_rng(BOOTSTRAP_SEED))
    return new.rank < old.rank


def update_shown_scores(file, points):
    """Replace shown points with significantly better ones, store them, return rounded scores.

    points : maps each student to the points (families, worlds) of the new version."""
    shown = json.loads(file.read_text("utf-8")) if file.exists() else {}
    for student, found in points.items():
        if student not in shown or is_significant_gain(shown[student], found):
            shown[student] = np.asarray(found).tolist()
    write_atomically(file, json.dumps(shown, sort_keys=True) + "\n")
    return {student: round(float(scores(np.array(found)))) for student, found in shown.items()}


def write_open_leaderboard(out, shown, contest):
    """Write the board of an open contest: names and shown scores."""
    rows = sorted(shown.items(), key=lambda row: (-row[1], row[0]))
    known = {"rows": rows, "contest": contest, "level": LEVEL, "step": STEP}
    write_atomically(
        out / "index.html", TEMPLATES.get_template("open_leaderboard.html").render(known)
    )
    write_table(out / "board.csv", [["name", "score"], *([n, str(score)] for n, score in rows)])
