"""Run a contest: judge a folder of submissions, write the board, reveal the seed."""

import csv
import json
import secrets
from functools import partial

import numpy as np

from classroom.contest import leaderboard, seed_commitment
from classroom.contest.class_judging import ContestSetup, judge_class, last_submissions
from classroom.contest.open_leaderboard import (
    SHOWN_SCORES,
    update_shown_scores,
    write_open_leaderboard,
)
from classroom.contest.seed_commitment import ContestError
from classroom.contest.student_pseudonyms import draw_pseudonyms
from classroom.grading.records import write_atomically
from classroom.grading.submissions import SubmissionError, read_notebook
from classroom.project.estimator_runs import Budget
from classroom.project.scores import prepare, prepared_worlds
from classroom.project.world_parameters import WORLD_FAMILIES

BOARD, RUNS, PSEUDONYMS = "board", "drives", "pseudonyms.json"
"""Names in the folder of results: files to publish, saved runs, and pseudonyms by student."""
WORLDS = "worlds.csv"  # in the board's folder: the points of each world


def prepare_contest_worlds(contest, logs=()):
    """Draw and prepare the worlds of a contest, then its logs, and yield PreparedWorlds."""
    families = [WORLD_FAMILIES[name] for name in contest.families]
    yield from prepared_worlds(contest.number, families, contest.worlds)
    yield from map(prepare, logs)


def run_contest(contest, found, out, prepared, workers, *, jobs=1, names=False, again=None,
                 stays_open=False, code=False, report=None):  # fmt: skip
    """Judge a class, write the board, and return the lines to print.

    again : board folder of an earlier judging of the same contest. stays_open : whether more
    submissions may follow; if so, write the open board. code : whether to publish the students'
    code, too. report : called with the name of a submission after each of its worlds. Raises
    SubmissionError, ContestError."""
    found = last_submissions(found)
    if not found:
        raise SubmissionError("no notebook to judge was found")
    revealed = out / BOARD / seed_commitment.REVEALED
    over = revealed.exists() and again is None
    if over and stays_open:
        raise ContestError(f"this contest is over: {revealed} contains its random seed")
    carried = late_points(again, contest) if again else {}
    budget = partial(Budget, *[np.inf] * 4) if again else partial(Budget, **contest.budget)
    setup = ContestSetup(prepared, out / RUNS, budget, over, carried)
    entries = list(judge_class(found, setup, workers, jobs, report))
    shown = _names(out, [entry.student for entry in entries], names)
    if stays_open:
        return _update_open_leaderboard(contest, entries, out, shown)
    rows, marks = leaderboard.rank(entries, shown, prepared)
    unjudged = sorted((shown[e.student], e.reason) for e in entries if e.reason is not None)
    opened = _codes(found, entries) if code else None
    leaderboard.write_leaderboard(out / BOARD, rows, marks, prepared, contest, unjudged, opened)
    lines = [f"{len(rows)} judged, {len(unjudged)} not: {out / BOARD / 'index.html'}"]
    lines += [f"{e.student}: {e.reason}" for e in entries if e.reason is not None]
    lines += [] if again else _late(entries)
    if not names:
        lines.append(f"{out / PSEUDONYMS} lists students and pseudonyms. Do not publish it.")
    if any(entry.failed for entry in entries):
        return [*lines, "The worlds are not revealed yet: run the command again to judge the rest."]
    write_atomically(revealed, contest.text)
    write_atomically(
        out / BOARD / seed_commitment.COMMITMENT, seed_commitment.commitment_text(contest)
    )
    return lines + (_compared(entries, again, contest) if again else [])


def _codes(found, entries):
    judged = {entry.student: entry.sha256 for entry in entries if entry.reason is None}
    codes = {}
    for submission in found:
        if submission.student in judged:
            notebook = read_notebook(submission)
            if notebook.sha256 == judged[submission.student]:
                cells = (f"# cell {number}\n{source}\n" for number, source in notebook.cells)
                codes[submission.student] = "\n".join(cells)
    return codes


def _update_open_leaderboard(contest, entries, out, names):
    points = {entry.student: entry.table for entry in entries if entry.reason is None}
    scores = update_shown_scores(out / SHOWN_SCORES, points)
    known = {names[student]: score for student, score in scores.items() if student in names}
    write_open_leaderboard(out / BOARD, known, contest)
    lines = [
        f"{len(points)} judged, {len(entries) - len(points)} not: {out / BOARD / 'index.html'}"
    ]
    lines += [f"{e.student}: {e.reason}" for e in entries if e.reason is not None]
    lines += _late(entries)
    return [*lines, "The contest is open. The worlds are revealed when you judge without --open."]


def _late(entries):
    """Report the students whose runs were stopped by a time limit."""
    late = {entry.student: sum(run.late for run in entry.runs) for entry in entries}
    students = ", ".join(f"{student} ({count})" for student, count in late.items() if count)
    more = "On a busy machine, the same work takes more CPU time."
    return [f"A time limit ended runs of: {students}. {more}"] if students else []


def read_published_contest(folder):
    """Read the contest of a published board to judge it again. Raises ContestError."""
    return seed_commitment.read_contest(
        folder / seed_commitment.REVEALED, folder / seed_commitment.COMMITMENT
    )


def late_points(folder, contest):
    """Return the points of runs stopped by a time limit: {(SHA-256, number of the world): …}."""
    return {
        key: points for key, (points, late) in _published_points(folder, contest).items() if late
    }


def _published_points(folder, contest):
    """Read {(SHA-256, number of the world): (points, whether a time limit ended the run)}."""
    index = {world: k for k, world in enumerate(contest.worlds_in_order)}
    try:
        with open(folder / WORLDS, newline="", encoding="utf-8") as file:
            return {
                (row["sha256"], index[row["family"], int(row["world"])]): (
                    float(row["points"]), row["late"] == "1")
                for row in csv.DictReader(file)
            }  # fmt: skip
    except (OSError, KeyError, ValueError) as error:
        raise ContestError(f"{folder / WORLDS} cannot be read: {error}") from None


def _compared(entries, again, contest):
    before = _published_points(again, contest)
    differ, count = [], 0
    for entry in entries:
        for k, result in enumerate(entry.results):
            if (entry.sha256, k) in before:
                count += 1
                differ.append(abs(result.points - before[entry.sha256, k][0]))
    most = max(differ, default=0.0)
    return [f"{count} runs compared: points differ by at most {most:.3g}"]


def _names(out, students, names):
    """Return the name of each student on the board; keep pseudonyms that were drawn before."""
    if names:
        return {student: student for student in students}
    file, kept = out / PSEUDONYMS, {}
    if file.exists():
        kept = json.loads(file.read_text("utf-8"))
    given = draw_pseudonyms(sorted(students), kept, secrets.choice)
    write_atomically(file, json.dumps(given, indent=1, sort_keys=True) + "\n")
    return given
