"""Term: course file, roster and gradebook together, and the tables and pages written from them."""

import csv
import io
import shutil
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from classroom.grading import class_report, feedback
from classroom.grading.marks import mark
from classroom.grading.records import private_folder, write_atomically
from classroom.grading.term import course_file, roster, student_matching, term_tables
from classroom.grading.term.exercise_results import decision, exercise_results
from classroom.grading.term.lms_names import CANVAS, lms_name
from classroom.grading.term.releases import file_name
from classroom.grading.term.worksheet import Worksheet


@dataclass(frozen=True)
class Term:
    """A checked course file with its roster."""

    course: course_file.Course
    roster: roster.Roster
    policy: object  # extensions included
    warnings: tuple = ()  # about times and persons that are probably errors

    def worksheet(self, exercise):
        """Return the Moodle worksheet that was given for an exercise, or None if there is none."""
        file = self._worksheet_file(exercise)
        return Worksheet(file, self.course.zone) if file.is_file() else None

    def keep_worksheet(self, exercise, file, found):
        """Check a worksheet and store a copy for later commands. Raises RosterError."""
        student_matching.check_worksheet(found, Worksheet(file, self.course.zone), file)
        kept = self._worksheet_file(exercise)
        private_folder(self.course.results)
        private_folder(kept.parent)
        if not (kept.exists() and kept.samefile(file)):
            shutil.copyfile(file, kept)
            kept.chmod(0o600)

    def forget(self, student):
        """Remove a student, who is still in the roster, from all worksheets."""
        for exercise in self.course.exercises:
            sheet = self.worksheet(exercise)
            rows = sheet and sheet.without(student, self.roster)
            if rows:
                text = io.StringIO(newline="")  # not escaped, because it is read again
                csv.writer(text).writerows(rows)
                write_atomically(self._worksheet_file(exercise), text.getvalue())

    def _worksheet_file(self, exercise):
        return self.course.results / exercise / "worksheet.csv"

    def join(self, found, exercise=None):
        sheet = self.worksheet(exercise) if exercise else None
        return student_matching.match_students(found, self.roster, sheet)

    def exercise_results(self, book):
        return self.exercise_results_of(book.attempts().values(), book.overrides(), book.remarks())

    def exercise_results_of(self, records, overrides, remarks):
        """Return the results of all records, which are given oldest first; see :func:`mark`."""
        marks = self._marks(records, overrides, remarks)
        return exercise_results(self.course, self.roster, marks, self.policy)

    def _marks(self, records, overrides, remarks=None):
        mine = {}  # by submission, because passing all of them to each mark is slow
        for key, changed in overrides.items():
            mine.setdefault(key[0], {})[key] = changed
        return [mark(r, mine.get(r.submission), self.policy, remarks) for r in records]

    def write(self, book, exercises=None):
        """Write tables, class report, the feedback pages of some exercises (default: all), and each
        other page whose row in the table has changed. Return each submission's newest mark.
        """
        out, found = self.course.results, self.exercise_results(book)
        newest = self._marks(book.latest_attempts(), book.overrides())
        changed = term_tables.write_term(self.course, found, newest)
        counted = [s for of_one in found.values() for s in of_one if s.mark]
        class_report.write_report(out, [result.mark for result in counted])
        of_these = [s for s in counted if exercises is None or s.exercise in exercises]
        for result in {(s.exercise, s.student.id): s for s in (*of_these, *changed)}.values():
            if result.mark is None:
                continue
            page = feedback.feedback_page(result.mark, result.student.name, self.course.zone)
            name = f"{file_name(result.student.id)}.html"
            write_atomically(out / result.exercise / "feedback" / name, page)
        return newest

    def summary(self, book, records):
        """Return lines to print after a run."""
        lines = self.unmatched(records) + self._graded_as_other_exercise(book, records)
        ids = {r.exercise for r in records} - {None}
        other = sorted(ids - {*self.course.exercises})
        if other:
            lines.append(f"exercises not in the course file have no tables: {', '.join(other)}")
        lines += self.removed_students(book)
        results = self.exercise_results(book)
        mine = {id for id in ids - {*other} if any(result.mark for result in results[id])}
        lines += [line for id in sorted(mine) for line in undecided(results[id])]
        release = [f"slamlab grade release {id}" for id in sorted(mine)]
        if release:
            lines.append(f"When the scores are correct, release them: {' or '.join(release)}")
        return lines

    def unmatched(self, records):
        """Return lines about submissions whose students are not known."""
        file, lines = self.course.roster.name, []
        known = {r.sha256: r.student for r in records if r.student in self.roster.students}
        unknown, several = (
            sorted(
                r.student.removeprefix(prefix) + (f" (the same file as of {known[r.sha256]})"
                                                  if r.sha256 in known else "")
                for r in {r.student: r for r in records if r.student.startswith(prefix)}.values()
            )
            for prefix in student_matching.UNMATCHED
        )  # fmt: skip
        names = [lms_name(r.submission) for r in records if r.student not in self.roster.students]
        of_canvas = sum(name is not None and name.lms == CANVAS for name in names)
        if of_canvas and not any(student.canvas for student in self.roster.students.values()):
            lines.append(f"files from Canvas that match no student: {of_canvas}, because {file} "
                         "has no user numbers of Canvas. Use Canvas' gradebook export as roster, "
                         "or add the column canvas, and run slamlab grade again")  # fmt: skip
        elif unknown:
            lines.append(f"students not in {file} are only in submissions.csv: "
                         f"{'; '.join(unknown)}. Name their files by id, e-mail or full name, or "
                         "correct the roster, and run the command again")  # fmt: skip
        if several:
            lines.append(f"{file} has several students with this name: {'; '.join(several)}. Grade "
                         "with Moodle's --worksheet, or name students' folders by id")  # fmt: skip
        return lines

    def _graded_as_other_exercise(self, book, records):
        """Return lines about files that failed in this run but were graded as another exercise."""
        graded = {(r.submission, r.sha256): r.exercise for r in book.attempts().values()
                  if not r.reason}  # fmt: skip
        now = [graded.get((r.submission, r.sha256)) for r in records if r.reason]
        found = sorted(Counter(filter(None, now)).items())
        return [
            f"{count} of {len(records)} could not be graded, but were graded as exercise {id} "
            f"before. Did you mean --exercise {id}? The earlier scores are kept"
            for id, count in found
        ]

    def removed_students(self, book):
        """Return a list with one line about students who left the roster, or an empty list."""
        ids = {record.student for record in book.latest_attempts()} - {*self.roster.students}
        ids = sorted(id for id in ids if not id.startswith(student_matching.UNMATCHED))
        if not ids:
            return []
        file, most = self.course.roster.name, 10
        names = ", ".join(ids[:most]) + (f" and {len(ids) - most} more" if ids[most:] else "")
        return [f"students no longer in {file} are only in submissions.csv: {names}. If you "
                "changed their ids, grade the downloads again"]  # fmt: skip


def undecided(results):
    """Return a line for each task set by hand on an attempt that does not count."""
    return [
        decision(result.student.id, task, clause)
        for result in results
        for task, clause in result.undecided.items()
    ]


def load(file: Path):
    """Load a course file and its roster. Raises CourseFileError or RosterError."""
    course = course_file.load(file)
    who = roster.load(course.roster, course.exercises, course.zone)
    for student, exercise in course.extensions:
        if student not in who.students:
            raise course_file.CourseFileError(
                f"{file}: extensions.{exercise}: {student!r} is not in {course.roster.name}"
            )
    policy = course.policy(who.extensions)
    return Term(course, who, policy, (*course.warnings(policy), *who.warnings))
