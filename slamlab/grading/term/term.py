"""A term: course file, roster and gradebook together, and what is written of them."""

import csv
import io
import shutil
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from slamlab.grading import class_report, feedback
from slamlab.grading.marks import mark
from slamlab.grading.records import private_folder, write_atomically
from slamlab.grading.term import course_file, enrolment, roster, term_tables
from slamlab.grading.term.releases import file_name
from slamlab.grading.term.standings import standings
from slamlab.grading.term.worksheet import Worksheet


@dataclass(frozen=True)
class Term:
    """A course file and what it names, checked.

    Parameters
    ----------
    course : Course
    roster : Roster
    policy : LatePolicy, extensions included
    """

    course: course_file.Course
    roster: roster.Roster
    policy: object

    def worksheet(self, exercise):
        """Moodle's worksheet that was given when an exercise was graded; None for none."""
        file = self._worksheet_file(exercise)
        return Worksheet(file, self.course.zone) if file.is_file() else None

    def keep_worksheet(self, exercise, file, found):
        """Check a worksheet and keep it, so that no later command needs it again.

        Parameters
        ----------
        exercise : str
        file : Path
        found : list of Submission, of which some have to stand in it

        Raises
        ------
        RosterError : it is no worksheet, or one of another assignment
        """
        enrolment.check_worksheet(found, Worksheet(file, self.course.zone), file)
        kept = self._worksheet_file(exercise)
        private_folder(self.course.results)
        private_folder(kept.parent)
        if not (kept.exists() and kept.samefile(file)):
            shutil.copyfile(file, kept)
            kept.chmod(0o600)

    def forget(self, student):
        """Take a student out of all worksheets that are kept.

        Parameters
        ----------
        student : str, an id that is still in the roster
        """
        for exercise in self.course.exercises:
            sheet = self.worksheet(exercise)
            rows = sheet and sheet.without(student, self.roster)
            if rows:
                text = io.StringIO(newline="")  # nothing is escaped: it is read again
                csv.writer(text).writerows(rows)
                write_atomically(self._worksheet_file(exercise), text.getvalue())

    def _worksheet_file(self, exercise):
        return self.course.results / exercise / "worksheet.csv"

    def join(self, found, exercise=None):
        """Join submissions to the roster, and to the exercise's worksheet where there is one."""
        sheet = self.worksheet(exercise) if exercise else None
        return enrolment.joined(found, self.roster, sheet)

    def standings(self, book):
        """The standings of all exercises.

        Parameters
        ----------
        book : Gradebook

        Returns
        -------
        dict, exercise to list of Standing
        """
        return self.standings_of(book.attempts().values(), book.overrides(), book.remarks())

    def standings_of(self, records, overrides, remarks):
        """The standings of all exercises by what a gradebook holds.

        Parameters
        ----------
        records : iterable of Record, all attempts, the oldest first
        overrides, remarks : as of :func:`slamlab.grading.marks.mark`

        Returns
        -------
        dict, exercise to list of Standing
        """
        marks = self._marks(records, overrides, remarks)
        return standings(self.course, self.roster, marks, self.policy)

    def _marks(self, records, overrides, remarks=None):
        mine = {}  # of each submission: with all of them at each, a class would take seconds
        for key, changed in overrides.items():
            mine.setdefault(key[0], {})[key] = changed
        return [mark(r, mine.get(r.submission), self.policy, remarks) for r in records]

    def write(self, book, exercises=None):
        """Write tables and the class report from the whole gradebook, and feedback pages.

        Parameters
        ----------
        book : Gradebook
        exercises : container of str or None, those whose pages are written; None for all

        Returns
        -------
        list of Mark, the newest of each submission
        """
        out, found = self.course.results, self.standings(book)
        newest = self._marks(book.latest_attempts(), book.overrides())
        term_tables.write_term(self.course, found, newest)
        counted = [s for of_one in found.values() for s in of_one if s.mark]
        class_report.write_report(out, [standing.mark for standing in counted])
        for standing in counted:
            if exercises is not None and standing.exercise not in exercises:
                continue
            page = feedback.feedback_page(standing.mark, standing.student.name, self.course.zone)
            name = f"{file_name(standing.student.id)}.html"
            write_atomically(out / standing.exercise / "feedback" / name, page)
        return newest

    def summary(self, book, records):
        """What to tell after a run: who is unknown, and what comes next.

        Parameters
        ----------
        book : Gradebook
        records : list of Record, of this run

        Returns
        -------
        list of str
        """
        unknown = [r for r in records if r.student.startswith(enrolment.STRANGER)]
        names = "; ".join(sorted({r.student.removeprefix(enrolment.STRANGER) for r in unknown}))
        file = self.course.roster.name
        said = [f"not in {file}, in submissions.csv only: {names}"] if unknown else []
        said += self._taken_for_others(book, records)
        ids = {r.exercise for r in records} - {None}
        other = sorted(ids - {*self.course.exercises})
        if other:
            said.append(f"not in the course file, so not in its tables: {', '.join(other)}")
        said += self.gone(book)
        release = [f"slamlab grade release {id}" for id in sorted(ids - {*other})]
        return [*said, f"when it is as it should be: {' or '.join(release)}"] if release else said

    def _taken_for_others(self, book, records):
        """A line on files that could not be graded, and were graded as another exercise before."""
        graded = {(r.submission, r.sha256): r.exercise for r in book.attempts().values()
                  if not r.reason}  # fmt: skip
        now = [graded.get((r.submission, r.sha256)) for r in records if r.reason]
        found = sorted(Counter(filter(None, now)).items())
        return [
            f"{count} of {len(records)} could not be graded, but were as exercise {id} before: "
            f"was --exercise {id} meant? What they earned there stays"
            for id, count in found
        ]

    def gone(self, book):
        """A line on those who handed something in under an id that the roster has no more."""
        ids = {record.student for record in book.latest_attempts()} - {*self.roster.students}
        ids = sorted(id for id in ids if not id.startswith(enrolment.STRANGER))
        if not ids:
            return []
        file, most = self.course.roster.name, 10
        names = ", ".join(ids[:most]) + (f" and {len(ids) - most} more" if ids[most:] else "")
        return [f"no longer in {file}, in submissions.csv only: {names} (where ids were changed, "
                "grade the downloads once more)"]  # fmt: skip


def load(file: Path):
    """Load the term of a course file.

    Parameters
    ----------
    file : Path

    Returns
    -------
    Term

    Raises
    ------
    CourseFileError, RosterError
    """
    course = course_file.load(file)
    who = roster.load(course.roster, course.exercises, course.zone)
    for student, exercise in course.extensions:
        if student not in who.students:
            raise course_file.CourseFileError(
                f"{file}: extensions.{exercise}: {student!r} is not in {course.roster.name}"
            )
    return Term(course, who, course.policy(who.extensions))
