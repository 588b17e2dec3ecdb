"""The folder of a term: its course file, roster and sheet, and attempts in its gradebook."""

from classroom.exercises.verdict import Verdict
from classroom.grading import submissions
from classroom.grading.gradebook import Gradebook, default_url
from classroom.grading.records import Record
from classroom.grading.term import term
from tests.classroom.grading.conftest import table, workers

COURSE = """
time_zone = "Europe/Zagreb"
attempts = "{attempts}"
isolation = "{level}"
[late]
per_day = 0.25
[exercises.99]
due = 2026-12-01T12:00:00
"""
ROSTER = """id,name,email,section,canvas,99
s1,Ana Kos,ana@uni.hr,Mon,1021,
s2,Ben Ivo,ben@uni.hr,Tue,1022,2026-12-03 12:00
s3,=Ćiro Šarić,,Tue,1023,
"""
SHEET = """\ufeffIdentifier,Full name,Email address,Status,Grade,Maximum grade,\
Last modified (submission),Last modified (grade),Feedback comments
Participant 501,Ana Kos,ana@uni.hr,,,10,"Wednesday, 2 December 2026, 9:00 AM",-,
Participant 502,Ben Ivo,ben@uni.hr,,,10,"Wednesday, 2 December 2026, 9:00 AM",-,
Participant 503,Ćiro,,,,10,-,-,
"""


def begin(folder, attempts="last"):
    text = COURSE.format(attempts=attempts, level=workers().level)
    (folder / "course.toml").write_text(text, "utf-8")
    (folder / "roster.csv").write_text(ROSTER, "utf-8")
    (folder / "sheet.csv").write_text(SHEET, "utf-8")


def scores(folder):
    return {row["id"]: row["score"] for row in table(folder / "results/99/grades.csv")}


def attempt(student, points, when=None, sha="a", name=None):
    verdicts = (Verdict("99-double", points, 8),)
    return Record(name or f"{student}.ipynb", student, "99", verdicts=verdicts, handed_in=when,
                  sha256=sha * 64, seed="b" * 64, titles={"99-double": "Double"})  # fmt: skip


def stored(folder, *records):
    """The term, with these attempts in its gradebook, in this order."""
    made = term.load(folder / "course.toml")
    made.course.results.mkdir(exist_ok=True)
    with Gradebook(default_url(made.course.results)) as book:
        for record in records:
            book.add(record)
        made.write(book)
        return made, made.exercise_results(book)


LATER = "2026-12-01T11:00:01+00:00"  # a second after noon in Zagreb


def match_students(folder, *names, sheet=True):
    made = term.load(folder / "course.toml")
    made.keep_worksheet("99", folder / "sheet.csv", [])
    found = [submissions._submission(folder, folder / name) for name in names]
    return [s.student for s in made.join(found, "99" if sheet else None)]
