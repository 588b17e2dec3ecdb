"""Releases: what goes back to students and into Moodle and Canvas, made when the lecturer says so.

Moodle takes in its worksheet with the grades filled in, and a zip of feedback whose folders are
called as those of its download; Canvas a table for its gradebook, and a zip of files whose names
begin as those of its download do.
"""

import csv
import os
import re
import shutil
import zipfile

from slamlab.exercises import catalogue
from slamlab.exercises.report import number
from slamlab.grading import feedback
from slamlab.grading.grade_tables import write_table
from slamlab.grading.records import write_atomically
from slamlab.grading.term.course_file import TermError
from slamlab.grading.term.lms_names import CANVAS, MOODLE
from slamlab.grading.term.released_scores import write_scores
from slamlab.grading.term.term_tables import exercise_rows

_OF_CANVAS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
_MOST = "Maximum Grade", "Maximum grade"


class ReleaseError(TermError):
    """There is nothing to release; the text says why."""


def release(course, roster, exercise, standings, worksheet=None):
    """Make the release of an exercise in ``RESULTS/NN/release``; an older one is replaced whole.

    Parameters
    ----------
    course : Course
    roster : Roster
    exercise : str
    standings : list of Standing, of this exercise
    worksheet : Worksheet or None, Moodle's of this assignment

    Returns
    -------
    list of str, what a lecturer should know: what was made, what has no score, what changed

    Raises
    ------
    ReleaseError
    """
    handed_in = [standing for standing in standings if standing.mark]
    if not handed_in:
        raise ReleaseError(f"nobody has handed in exercise {exercise}; grade it first")
    final = course.results / exercise / "release"
    before = _scores(final / "grades.csv")
    made = final.with_name(".release.part")
    shutil.rmtree(made, ignore_errors=True)
    made.mkdir(parents=True, mode=0o700)
    write_table(made / "grades.csv", exercise_rows(standings, course.zone))
    write_scores(made, standings)
    pages = {}
    for standing in handed_in:
        words = standing.mark, standing.student.name, course.zone
        pages[standing.student.id] = feedback.feedback_page(*words)
        stem = made / "feedback" / file_name(standing.student.id)
        write_atomically(stem.with_name(f"{stem.name}.html"), pages[standing.student.id])
        write_atomically(stem.with_name(f"{stem.name}.txt"), feedback.feedback_text(*words))
    said = [f"{len(handed_in)} of {len(standings)} handed in"]
    ungraded = [s.student.name for s in handed_in if s.total is None]
    said += [f"no score yet: {', '.join(ungraded)}"] if ungraded else []
    said += _for_moodle(made, exercise, roster, handed_in, pages, worksheet)
    said += _for_canvas(made, course, roster, exercise, standings, pages)
    shutil.rmtree(final, ignore_errors=True)
    os.replace(made, final)
    return said + _changes(before, _scores(final / "grades.csv"))


def file_name(id):
    """A student's id as a file's name."""
    return re.sub(r"[^\w.@+-]|^\.", lambda match: f"%{ord(match[0]):02x}", id)


def _for_moodle(folder, exercise, roster, handed_in, pages, worksheet):
    """Write the worksheet and the zip of feedback; what to say of them."""
    mine = _participants(roster, handed_in, worksheet)
    if not mine:
        return []
    files = {
        f"{prefix}_/{_page(exercise)}": pages[standing.student.id]
        for prefix, standing in mine.values()
    }
    _write_zip(folder / "moodle-feedback.zip", files)
    said = [f"moodle-feedback.zip: {len(files)} pages"]
    if worksheet is None:
        return [*said, "no moodle.csv: it needs the grading worksheet (--worksheet, when grading)"]
    grades = {
        participant: ("" if standing.total is None else number(standing.total), standing.mark.note)
        for participant, (_, standing) in mine.items()
        if participant in worksheet.rows
    }
    write_table(folder / "moodle.csv", worksheet.filled(grades))
    said.append(f"moodle.csv: {sum(grade != '' for grade, _ in grades.values())} grades")
    points = catalogue.exercise(exercise).points
    most = {row[title] for row in worksheet.rows.values() for title in _MOST if row.get(title)}
    other = [text for text in most if _as_number(text) != points]
    if other:
        said.append(f"in Moodle this assignment has {', '.join(other)} points, here {points:g}: "
                    f"set its maximum grade to {points:g} first")  # fmt: skip
    return said


def _participants(roster, handed_in, worksheet):
    """Moodle's number of each who handed in to (start of the folder's name, Standing)."""
    found = {}
    for standing in handed_in:
        told = standing.of_download
        if told and told.lms == MOODLE:
            found[told.number] = (told.prefix, standing)
    by_id = {standing.student.id: standing for standing in handed_in}
    for participant, row in worksheet.rows.items() if worksheet else ():
        student = worksheet.student(participant, roster)
        if student and student.id in by_id:  # also who handed in by another way
            name = re.sub(r"[_/\\]", " ", row.get("Full name", "")) or "Participant"
            prefix = f"{name}_{participant}_assignsubmission_file"
            found.setdefault(participant, (prefix, by_id[student.id]))
    return found


def _for_canvas(folder, course, roster, exercise, standings, pages):
    """Write the gradebook's table and the zip of feedback; what to say of them."""
    if not any(standing.student.canvas for standing in standings):
        return []
    column = course.canvas.get(exercise) or _canvas_column(roster, exercise)
    title = column or catalogue.exercise(exercise).title
    rows = [[*_OF_CANVAS, title], ["Points Possible", "", "", "", ""]]
    rows[1].append(number(catalogue.exercise(exercise).points))
    files = {}
    for standing in standings:
        who = {"Student": standing.student.name, "Section": standing.student.section}
        who |= standing.student.row | {"ID": standing.student.canvas}
        total = "" if standing.total is None else number(standing.total)
        rows.append([*(who.get(title, "") for title in _OF_CANVAS), total])
        told = standing.of_download
        if told and told.lms == CANVAS:
            files[f"{told.prefix}_{_page(exercise)}"] = pages[standing.student.id]
    write_table(folder / "canvas.csv", rows)
    said = [f"canvas.csv: column {title!r}"]
    if column is None:
        said.append("Canvas joins it to the assignment of that name; to name another, set "
                    f'canvas = "TITLE (NUMBER)" in [exercises.{exercise}]')  # fmt: skip
    if files:
        _write_zip(folder / "canvas-feedback.zip", files)
        said.append(f"canvas-feedback.zip: {len(files)} pages")
    return said


def _canvas_column(roster, exercise):
    """The column of an exercise in Canvas' own export: its title, then its number there."""
    names = {catalogue.exercise(exercise).title, catalogue.exercise(exercise).notebook}
    found = [t for t in roster.titles if re.sub(r" \(\d+\)$", "", t) in names]
    return found[0] if len(found) == 1 else None


def _page(exercise):
    return f"exercise-{exercise}-feedback.html"


def _write_zip(path, files):
    """Write a zip that is the same for the same files."""
    handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
    with os.fdopen(handle, "wb") as stream, zipfile.ZipFile(stream, "w") as archive:
        for name, text in sorted(files.items()):
            member = zipfile.ZipInfo(name)
            member.compress_type = zipfile.ZIP_DEFLATED
            member.external_attr = 0o644 << 16
            archive.writestr(member, text.encode("utf-8", "backslashreplace"))


def _scores(table):
    """Student's id to (name, score) of a table that was released."""
    try:
        with open(table, encoding="utf-8", newline="") as file:
            return {row["id"]: (row["name"], row["score"]) for row in csv.DictReader(file)}
    except OSError:
        return {}


def _changes(before, after):
    changed = [
        f"{name}: {before[id][1] or '–'} → {score or '–'}"
        for id, (name, score) in after.items()
        if id in before and before[id][1] != score
    ]
    return [f"changed since the last release: {'; '.join(changed)}"] if changed else []


def _as_number(text):
    try:
        return float(text.replace(",", "."))
    except ValueError:
        return None
