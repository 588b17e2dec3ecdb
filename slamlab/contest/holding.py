"""Holding a contest: from a folder of submissions to the board, the pages and what is revealed."""

import csv
import json
import secrets
from functools import partial

import numpy as np

from slamlab.contest import commitment, scoreboard
from slamlab.contest.class_judging import Course, entrants, judge_class
from slamlab.contest.commitment import ContestError
from slamlab.contest.open_board import LADDER, climb, write_open_board
from slamlab.contest.pseudonyms import pseudonyms
from slamlab.grading.records import write_atomically
from slamlab.grading.submissions import SubmissionError, read_notebook
from slamlab.project.driving import Budget
from slamlab.project.scores import arenas, prepare
from slamlab.project.world_families import FAMILIES

BOARD, DRIVES, PSEUDONYMS = "board", "drives", "pseudonyms.json"
"""In the folder of results: what may be published; what was driven; whose a pseudonym is."""
WORLDS = "worlds.csv"  # in the board's folder: the points of each world


def draw_arenas(contest, logs=()):
    """Draw the worlds of a contest, and prepare each, and its logs after them.

    Parameters
    ----------
    contest : Contest
    logs : list of RecordedLog, see :func:`slamlab.contest.contest_logs.open_logs`

    Yields
    ------
    Arena
    """
    families = [FAMILIES[name] for name in contest.families]
    yield from arenas(contest.number, families, contest.worlds)
    yield from map(prepare, logs)


def hold_contest(contest, found, out, prepared, workers, *, jobs=1, names=False, again=None,
                 stays_open=False, code=False, told=None):  # fmt: skip
    """Judge a class, and write the board.

    Parameters
    ----------
    contest : Contest
    found : list of Submission
    out : Path
    prepared : list of Arena, of :func:`draw_arenas`
    workers : WorkerPool, closed in the end
    jobs : int, students judged at once
    names : bool, whether names are shown instead of pseudonyms
    again : Path or None, the board's folder of the same contest, judged before
    stays_open : bool, whether more may be handed in: then scores show by the ladder, and no more
    code : bool, whether the code of those who were judged is opened, too
    told : callable that is given a submission's name after each of its worlds, or None

    Returns
    -------
    list of str, what there is to tell

    Raises
    ------
    SubmissionError : nobody takes part
    ContestError
    """
    found = entrants(found)
    if not found:
        raise SubmissionError("there is no notebook to be judged")
    revealed = out / BOARD / commitment.REVEALED
    over = revealed.exists() and again is None
    if over and stays_open:
        raise ContestError(f"this contest is over: {revealed} tells its bits")
    carried = late_points(again, contest) if again else {}
    budget = partial(Budget, *[np.inf] * 4) if again else partial(Budget, **contest.budget)
    course = Course(prepared, out / DRIVES, budget, over, carried)
    entries = list(judge_class(found, course, workers, jobs, told))
    shown = _names(out, [entry.student for entry in entries], names)
    if stays_open:
        return _open_board(contest, entries, out, shown)
    rows, marks = scoreboard.rank(entries, shown, prepared)
    unjudged = sorted((shown[e.student], e.reason) for e in entries if e.reason is not None)
    opened = _codes(found, entries) if code else None
    scoreboard.write_board(out / BOARD, rows, marks, prepared, contest, unjudged, opened)
    said = [f"{len(rows)} judged, {len(unjudged)} not: {out / BOARD / 'index.html'}"]
    said += [f"{e.student}: {e.reason}" for e in entries if e.reason is not None]
    said += [] if again else _late(entries)
    if not names:
        said.append(f"{out / PSEUDONYMS} says whose a pseudonym is: for you alone")
    if any(entry.failed for entry in entries):
        return [*said, "nothing is revealed yet: run it again for those"]
    write_atomically(revealed, contest.text)
    write_atomically(out / BOARD / commitment.COMMITMENT, commitment.commitment_text(contest))
    return said + (_compared(entries, again, contest) if again else [])


def _codes(found, entries):
    """The code cells of each student, of the notebook that was judged."""
    judged = {entry.student: entry.sha256 for entry in entries if entry.reason is None}
    codes = {}
    for submission in found:
        if submission.student in judged:
            notebook = read_notebook(submission)
            if notebook.sha256 == judged[submission.student]:
                cells = (f"# cell {number}\n{source}\n" for number, source in notebook.cells)
                codes[submission.student] = "\n".join(cells)
    return codes


def _open_board(contest, entries, out, names):
    """Write the board of a contest that is open; what there is to tell."""
    points = {entry.student: entry.table for entry in entries if entry.reason is None}
    scores = climb(out / LADDER, points)
    known = {names[student]: score for student, score in scores.items() if student in names}
    write_open_board(out / BOARD, known, contest)
    said = [f"{len(points)} judged, {len(entries) - len(points)} not: {out / BOARD / 'index.html'}"]
    said += [f"{e.student}: {e.reason}" for e in entries if e.reason is not None]
    said += _late(entries)
    return [*said, "the contest is open: nothing is revealed until it is judged without --open"]


def _late(entries):
    """Whom a limit of time ended: on a busy machine that may be no fault of theirs."""
    late = {entry.student: sum(driven.late for driven in entry.drives) for entry in entries}
    told = ", ".join(f"{student} ({count})" for student, count in late.items() if count)
    more = "on a machine that is busy with other work seconds of CPU are longer, too"
    return [f"a limit of time ended worlds of {told}; {more}"] if told else []


def contest_again(folder):
    """The contest of a board, to be judged again.

    Parameters
    ----------
    folder : Path, the board's, with what was told before and revealed after

    Returns
    -------
    Contest

    Raises
    ------
    ContestError
    """
    return commitment.read_contest(folder / commitment.REVEALED, folder / commitment.COMMITMENT)


def late_points(folder, contest):
    """Points of the worlds that a limit of time had ended: {(SHA-256, number of the world): …}."""
    return {key: points for key, (points, late) in _told_points(folder, contest).items() if late}


def _told_points(folder, contest):
    """{(SHA-256, number of the world): (points, whether a limit of time ended it)}."""
    place = {place: k for k, place in enumerate(contest.places)}
    try:
        with open(folder / WORLDS, newline="", encoding="utf-8") as file:
            return {
                (row["sha256"], place[row["family"], int(row["world"])]): (
                    float(row["points"]), row["late"] == "1")
                for row in csv.DictReader(file)
            }  # fmt: skip
    except (OSError, KeyError, ValueError) as error:
        raise ContestError(f"{folder / WORLDS} cannot be read: {error}") from None


def _compared(entries, again, contest):
    """What was found to differ from the points told before."""
    before = _told_points(again, contest)
    differ, count = [], 0
    for entry in entries:
        for k, result in enumerate(entry.results):
            if (entry.sha256, k) in before:
                count += 1
                differ.append(abs(result.points - before[entry.sha256, k][0]))
    most = max(differ, default=0.0)
    return [f"{count} worlds compared: points differ by {most:.3g} at most"]


def _names(out, students, names):
    """What each student is called on the board; pseudonyms are kept, so that they stay."""
    if names:
        return {student: student for student in students}
    file, kept = out / PSEUDONYMS, {}
    if file.exists():
        kept = json.loads(file.read_text("utf-8"))
    given = pseudonyms(sorted(students), kept, secrets.choice)
    write_atomically(file, json.dumps(given, indent=1, sort_keys=True) + "\n")
    return given
