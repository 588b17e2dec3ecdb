"""Release scores and feedback to students, Moodle and Canvas. Moodle imports its completed grading
worksheet, and a zip of feedback whose folders have the same names as in Moodle's download. Canvas
imports a table, and a zip of files with the same prefixes as in Canvas's download.
"""

import csv
import json
import os
import re
import shutil
import zipfile

from classroom.exercises import catalogue
from classroom.exercises.verdict_text import number
from classroom.grading import feedback
from classroom.grading.grade_tables import moodle_comment, write_table
from classroom.grading.records import write_atomically
from classroom.grading.term.course_file import TermError
from classroom.grading.term.exercise_results import points_of
from classroom.grading.term.lms_names import CANVAS, MOODLE
from classroom.grading.term.term_tables import exercise_rows

SCORES = "scores.json"  # of a release, for grade passback
_OF_CANVAS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
_MOST = "Maximum Grade", "Maximum grade"


class ReleaseError(TermError):
    """There is nothing to release; the message states why."""


def release(course, roster, exercise, exercise_results, worksheet=None):
    """Replace the folder ``RESULTS/NN/release``; return lines for the lecturer. Raises ReleaseError
    if there are no submissions.
    """
    handed_in = [result for result in exercise_results if result.mark]
    if not handed_in:
        raise ReleaseError(f"exercise {exercise} has no submissions; grade them first")
    final = course.results / exercise / "release"
    before = _scores(final / "grades.csv")
    made = final.with_name(".release.part")
    shutil.rmtree(made, ignore_errors=True)
    made.mkdir(parents=True, mode=0o700)
    write_table(made / "grades.csv", exercise_rows(exercise_results, course.zone))
    _write_scores(made, exercise_results)
    pages = {}
    for result in handed_in:
        words = result.mark, result.student.name, course.zone
        pages[result.student.id] = feedback.feedback_page(*words)
        stem = made / "feedback" / file_name(result.student.id)
        write_atomically(stem.with_name(f"{stem.name}.html"), pages[result.student.id])
        write_atomically(stem.with_name(f"{stem.name}.txt"), feedback.feedback_text(*words))
    lines = [f"{len(handed_in)} of {len(exercise_results)} students submitted"]
    ungraded = [s.student.name for s in handed_in if s.total is None]
    lines += [f"without a score: {', '.join(ungraded)}"] if ungraded else []
    lines += _for_moodle(made, exercise, roster, handed_in, pages, worksheet)
    lines += _for_canvas(made, course, roster, exercise, exercise_results, pages)
    shutil.rmtree(final, ignore_errors=True)
    os.replace(made, final)
    return lines + _changes(before, _scores(final / "grades.csv"))


def _write_scores(folder, exercise_results):
    scores = [
        {"student": one.student.id, "score": round(one.total, 6), "of": points_of(one.exercise),
         "note": one.mark.note}
        for one in exercise_results if one.total is not None
    ]  # fmt: skip
    write_atomically(folder / SCORES, json.dumps(scores, ensure_ascii=False, indent=1))


def released_scores(course, exercise):
    """Return the last released scores as dicts with the keys student, score, of and note. Raises
    TermError.
    """
    file = course.results / exercise / "release" / SCORES
    try:
        return json.loads(file.read_text("utf-8"))
    except FileNotFoundError:
        raise TermError(
            f"{file} does not exist. Release the scores first: slamlab grade release {exercise}"
        ) from None
    except (OSError, ValueError) as error:
        raise TermError(f"{file} cannot be read ({error}). Release {exercise} again") from None


def file_name(id):
    return re.sub(r"[^\w.@+-]|^\.", lambda match: f"%{ord(match[0]):02x}", id)


def _for_moodle(folder, exercise, roster, handed_in, pages, worksheet):
    """Write the files for Moodle; return lines for the lecturer."""
    mine = _participants(roster, handed_in, worksheet)
    if not mine:
        return []
    files = {
        f"{prefix}_/{_page(exercise)}": pages[result.student.id] for prefix, result in mine.values()
    }
    _write_zip(folder / "moodle-feedback.zip", files)
    lines = [f"moodle-feedback.zip: {len(files)} feedback pages"]
    if worksheet is None:
        return [
            *lines,
            "moodle.csv is not written: grade with --worksheet, Moodle's grading worksheet",
        ]
    grades = {
        participant: (
            "" if result.total is None else number(result.total),
            moodle_comment(result.mark),
        )
        for participant, (_, result) in mine.items()
        if participant in worksheet.rows
    }
    write_table(folder / "moodle.csv", worksheet.filled(grades))
    lines.append(f"moodle.csv: {sum(grade != '' for grade, _ in grades.values())} grades")
    points = catalogue.exercise(exercise).points
    most = {row[title] for row in worksheet.rows.values() for title in _MOST if row.get(title)}
    other = [text for text in most if _as_number(text) != points]
    if other:
        lines.append(
            f"the assignment has {', '.join(other)} points in Moodle, but {points:g} here; set its "
            f"maximum grade in Moodle to {points:g} before the import"
        )
    return lines


def _participants(roster, handed_in, worksheet):
    """Return a dict from Moodle's participant number to (prefix of the folder name,
    ExerciseResult).
    """
    found = {}
    for result in handed_in:
        name = result.of_download
        if name and name.lms == MOODLE:
            found[name.number] = (name.prefix, result)
    by_id = {result.student.id: result for result in handed_in}
    for participant, row in worksheet.rows.items() if worksheet else ():
        student = worksheet.student(participant, roster)
        if student and student.id in by_id:  # also students who did not submit in Moodle
            name = re.sub(r"[_/\\]", " ", row.get("Full name", "")) or "Participant"
            prefix = f"{name}_{participant}_assignsubmission_file"
            found.setdefault(participant, (prefix, by_id[student.id]))
    return found


def _for_canvas(folder, course, roster, exercise, exercise_results, pages):
    """Write the files for Canvas; return lines for the lecturer."""
    if not any(result.student.canvas for result in exercise_results):
        return []
    column = course.canvas.get(exercise) or _canvas_column(roster, exercise)
    title = column or catalogue.exercise(exercise).title
    rows = [[*_OF_CANVAS, title], ["Points Possible", "", "", "", ""]]
    rows[1].append(number(catalogue.exercise(exercise).points))
    files = {}
    for result in exercise_results:
        who = {"Student": result.student.name, "Section": result.student.section}
        who |= result.student.row | {"ID": result.student.canvas}
        total = "" if result.total is None else number(result.total)
        rows.append([*(who.get(title, "") for title in _OF_CANVAS), total])
        name = result.of_download
        if name and name.lms == CANVAS:
            files[f"{name.prefix}_{_page(exercise)}"] = pages[result.student.id]
    write_table(folder / "canvas.csv", rows)
    lines = [f"canvas.csv: column {title!r}"]
    if column is None:
        lines.append("Canvas imports the column as the assignment of that name; for another, set "
                     f'canvas = "TITLE (NUMBER)" in [exercises.{exercise}]')  # fmt: skip
    if files:
        _write_zip(folder / "canvas-feedback.zip", files)
        lines.append(f"canvas-feedback.zip: {len(files)} feedback pages")
    return lines


def _canvas_column(roster, exercise):
    """Return the title (with number) of the exercise's column in a Canvas export, or None."""
    names = {catalogue.exercise(exercise).title, catalogue.exercise(exercise).notebook}
    found = [t for t in roster.titles if re.sub(r" \(\d+\)$", "", t) in names]
    return found[0] if len(found) == 1 else None


def _page(exercise):
    return f"exercise-{exercise}-feedback.html"


def _write_zip(path, files):
    """Write a reproducible zip: the same bytes for the same files."""
    handle = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
    with os.fdopen(handle, "wb") as stream, zipfile.ZipFile(stream, "w") as archive:
        for name, text in sorted(files.items()):
            member = zipfile.ZipInfo(name)
            member.compress_type = zipfile.ZIP_DEFLATED
            member.external_attr = 0o644 << 16
            archive.writestr(member, text.encode("utf-8", "backslashreplace"))


def _scores(table):
    """Return a released table as a dict from id to (name, score)."""
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
