"""Marks from verdicts: overrides, late penalty, grade tables, class report."""

import csv
import os
import shutil
from dataclasses import replace

import pytest

from classroom.exercises.verdict import Verdict
from classroom.grading import class_report, grade_tables, judge, late_policy, submissions
from classroom.grading.gradebook import Gradebook
from classroom.grading.late_policy import LatePolicyError
from classroom.grading.marks import mark
from classroom.grading.records import Record
from slamlab.cli import main
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import know_the_fake, notebook, workers

POLICY = """
grace_minutes = 10
per_day = 0.1
at_most = 0.5
[due]
"99" = 2026-12-01T12:00:00+01:00
"""
VERDICTS = (Verdict("99-double", 3, 3), Verdict("99-turn", 1, 2, problem="<b>turned</b> right"))


def record(name="anna.ipynb", when=None, **more):
    made = {"exercise": "99", "verdicts": VERDICTS, "handed_in": when, "titles": {}}
    return Record(name, name.removesuffix(".ipynb"), **(made | more))


@pytest.fixture
def policy(tmp_path):
    file = tmp_path / "policy.toml"
    file.write_text(POLICY)
    return late_policy.load(file)


@pytest.mark.parametrize(
    ("when", "taken"),
    [
        (None, 0),
        ("2026-12-01T10:00:00+00:00", 0),
        ("2026-12-01T11:10:00+00:00", 0),  # within the grace: noon in the zone is 11 UTC
        ("2026-12-01T11:11:00+00:00", 0.4),
        ("2026-12-02T11:00:00+00:00", 0.4),
        ("2026-12-02T11:00:01+00:00", 0.8),
        ("2027-12-01T12:00:00+00:00", 2),
    ],
)
def test_the_late_penalty_is_a_share_of_the_points_for_each_started_day(policy, when, taken):
    made = mark(record(when=when), policy=policy)
    assert made.late_penalty == pytest.approx(taken)
    assert made.total == pytest.approx(4 - taken)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "there are no due dates"),
        ('[due]\n"04" = 2026-12-01T12:00:00', "a time with its zone"),
        ('per_day = 2\n[due]\n"04" = 2026-12-01T12:00:00Z', "a share from 0 to 1"),
        ('per_week = 0.1\n[due]\n"04" = 2026-12-01T12:00:00Z', "setting 'per_week' does not exist"),
        ("[due", "policy.toml: "),
        *(
            (f'grace_minutes = {value}\n[due]\n"04" = 2026-12-01T12:00:00Z', "grace_minutes")
            for value in ("inf", "nan", "-1", "1e300", "true", '"10"')
        ),
        *(
            (f'[due]\n"{id}" = 2026-12-01T12:00:00Z', f"exercise '{id}' does not exist; the exer")
            for id in ("4", "98", "004", "x")
        ),
        (None, "No such file"),
    ],
)
def test_a_policy_that_cannot_be_used_is_reported(tmp_path, text, message):
    file = tmp_path / "policy.toml"
    if text is not None:
        file.write_text(text)
    with pytest.raises(LatePolicyError, match=message):
        late_policy.load(file)


def test_an_override_replaces_the_judges_points_and_is_reported():
    overrides = {
        ("anna.ipynb", None, "99-turn"): (2.0, "right idea"),
        ("ben.ipynb", None, "99-double"): (0, ""),
    }
    made = mark(record(), overrides)
    assert made.points == {"99-double": 3, "99-turn": 2}
    assert "Turn a vector: set by hand to 2 points (right idea)" in made.note


def test_an_ungraded_submission_has_no_mark_until_an_override():
    lost = record(reason="empty", verdicts=(), exercise=None)
    assert mark(lost).total is None
    made = mark(lost, {("anna.ipynb", None, "99-turn"): (2.0, "read on paper")})
    assert (made.total, made.record.exercise) == (2, "99")


def read(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.reader(file))


def test_moodle_and_canvas_get_their_columns(tmp_path):
    kos, ivo = record("Ana Kos.ipynb", number="123"), record("=ivo.ipynb", number="77")
    grade_tables.write_tables(tmp_path, [mark(kos), mark(ivo)])
    moodle = {row[0]: row for row in read(tmp_path / "moodle.csv")}
    assert moodle["Identifier"] == [
        "Identifier", "Full name", "Grade", "Maximum Grade", "Last modified (grade)",
        "Feedback comments",
    ]  # fmt: skip
    assert moodle["Participant 123"][1:4] == ["Ana Kos", "4", "5"]
    assert moodle["Participant 77"][1] == "'=ivo"
    canvas = read(tmp_path / "canvas.csv")
    assert canvas[0][:2] == ["Student", "ID"]
    assert canvas[0][5:] == [fake.EXERCISE.title]
    assert canvas[1] == ["Points Possible", "", "", "", "", "8"]
    assert ["Ana Kos", "123", "", "", "", "4"] in canvas


def test_the_class_report_counts_mistakes_and_escapes_students_texts(tmp_path):
    lost = record("<script>.ipynb", reason="<script>empty</script>", verdicts=())
    class_report.write_report(tmp_path, [mark(record()), mark(record("b.ipynb")), mark(lost)])
    page = (tmp_path / "class.html").read_text("utf-8")
    assert "2 all, 0 some, 0 none" in page  # 99-double
    assert "0 all, 2 some, 0 none" in page  # 99-turn
    assert "2 × &lt;b&gt;turned" in page
    assert "<script" not in page


def test_the_median_of_an_even_number_of_totals_is_half_way_between_the_middle_two(tmp_path):
    some = [mark(record()), mark(record("b.ipynb", verdicts=VERDICTS[:1]))]  # 4 and 3 points
    class_report.write_report(tmp_path, some)
    assert "median 3.5 of" in (tmp_path / "class.html").read_text("utf-8")


@pytest.fixture(scope="module")
def graded(tmp_path_factory):
    """A class with one submission of exercise 99, and its results."""
    folder = tmp_path_factory.mktemp("graded")
    (folder / "class").mkdir()
    (folder / "class" / "anna.ipynb").write_text(notebook(fake.SOLUTION))
    out = str(folder / "out")
    words = ["grade", str(folder / "class"), "--out", out, "--isolation", workers().level]
    with pytest.MonkeyPatch.context() as patch:
        know_the_fake(patch)
        assert main(words) == 0
    return folder


@pytest.fixture
def results(tmp_path, graded, capsys):
    """A folder of results of its own, beside the class's."""
    shutil.copytree(graded, tmp_path, dirs_exist_ok=True)
    capsys.readouterr()
    return tmp_path / "out"


def score(out):
    header, row = read(out / "grades.csv")
    return row[header.index("score")]


@pytest.mark.slow
def test_an_override_from_the_command_line_stays_after_a_regrade(results, tmp_path, capsys):
    words = ["grade", "adjust", "anna.ipynb", "99-turn", "1", "--reason", "as agreed"]
    assert main([*words, "--out", str(results)]) == 0
    assert score(results) == "6.5"
    again = ["grade", str(tmp_path / "class"), "--out", str(results)]
    again += ["--isolation", workers().level]
    assert main([*again, "--regrade"]) == 0
    assert score(results) == "6.5"
    (tmp_path / "class" / "anna.ipynb").write_text(notebook(fake.SOLUTION, "# a new attempt"))
    assert main(again) == 0
    assert score(results) == "8"
    line = "anna.ipynb: Turn a vector was set by hand to 1 point (as agreed) on anna.ipynb; the"
    assert line in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["adjust", "ben.ipynb", "99-turn", "1", "--reason", "x"], "no submission 'ben.ipynb'"),
        (["adjust", "anna.ipynb", "99-turn", "3", "--reason", "x"], "have 0 to 2.5 points, not 3"),
        (["adjust", "anna.ipynb", "99-none", "1", "--reason", "x"], "no task '99-none'"),
        (["adjust", "anna.ipynb", "04-h-robot", "1", "--reason", "x"], "is for exercise 99"),
        (["merge", "nowhere"], "the gradebook nowhere/grades.db does not exist"),
    ],
)
def test_wrong_use_is_reported_in_one_line(results, words, message, capsys):
    assert main(["grade", *words, "--out", str(results)]) == 2
    assert message in capsys.readouterr().err


def test_gradebooks_of_shards_are_merged_without_doubling(results, tmp_path, capsys):
    main(["grade", "adjust", "anna.ipynb", "99-turn", "1", "--reason", "x", "--out", str(results)])
    merged = tmp_path / "merged"
    for _ in range(2):
        assert main(["grade", "merge", str(results), str(results), "--out", str(merged)]) == 0
    with Gradebook(f"sqlite:///{merged / 'grades.db'}") as book:
        assert len(book.attempts()) == len(book.overrides()) == 1
    assert score(merged) == "6.5"


def test_a_gradebook_of_another_secret_is_refused_and_nothing_is_left(tmp_path, capsys):
    for name, secret in (("one", b"a" * 20), ("other", b"b" * 20)):
        (tmp_path / name).mkdir()
        (tmp_path / name / "secret").write_bytes(secret)
        seed = judge.seed_for(secret, "99", "c" * 64).hex()
        with Gradebook(f"sqlite:///{tmp_path / name / 'grades.db'}") as book:
            book.add(record(f"{name}.ipynb", sha256="c" * 64, seed=seed))
    books = [str(tmp_path / name) for name in ("one", "other")]
    assert main(["grade", "merge", *books, "--out", str(tmp_path / "all")]) == 2
    assert f"{books[1]} was graded with another secret" in capsys.readouterr().err
    assert not (tmp_path / "all").exists()
    assert main(["grade", "merge", books[0], "--out", str(tmp_path / "all")]) == 0
    assert "rows added to the ledger: 4; submissions in total: 1" in capsys.readouterr().out


@pytest.mark.slow
def test_marks_are_exported_to_nbgraders_gradebook(results, tmp_path, capsys):
    from nbgrader.api import Gradebook as Theirs

    lost = record("ben.ipynb", reason="empty", verdicts=(), exercise=None)
    with Gradebook(f"sqlite:///{results / 'grades.db'}") as book:
        book.add(lost)
        book.override_points(lost, "99-turn", 1.5, "read on paper")
    url = f"sqlite:///{tmp_path / 'gradebook.db'}"
    words = ["grade", "export", "--out", str(results), "--nbgrader-gradebook", url]
    assert main(words) == main(words) == 0
    with Theirs(url) as theirs:
        submission = theirs.find_submission(fake.EXERCISE.notebook, "anna")
        assert (submission.score, submission.max_score) == (8, 8)
        assert not submission.needs_manual_grade
        assert theirs.find_submission(fake.EXERCISE.notebook, "ben").score == 1.5


def handed_in(folder):
    (found,) = submissions.find_submissions(folder)
    return found.handed_in


def test_a_submission_has_its_time(tmp_path):
    folder = tmp_path / "submitted" / "anna" / "99_fake"
    folder.mkdir(parents=True)
    (folder / "99_fake.ipynb").write_text("{}")
    assert handed_in(tmp_path).endswith("+00:00")
    note = folder / "timestamp.txt"
    note.write_text("2026-12-01 11:00:00.5 UTC\n")
    assert handed_in(tmp_path) == "2026-12-01T11:00:00.500000+00:00"
    for odd in ("yesterday", "", "9" * 200):
        note.write_text(odd)
        assert handed_in(tmp_path) is None
    with open(note, "wb") as file:
        file.truncate(1 << 40)  # read whole it would be the end
    assert handed_in(tmp_path) is None
    note.unlink()
    os.utime(folder / "99_fake.ipynb", (2**33, 2**33))
    assert handed_in(tmp_path) is None or handed_in(tmp_path).startswith("2242")


@pytest.mark.parametrize("name", ["anna/99_fake", "Anna_12_assignsubmission_file_"])
def test_a_timestamp_that_a_student_may_have_written_is_ignored(tmp_path, name):
    (tmp_path / name).mkdir(parents=True)
    (tmp_path / name / "99_fake.ipynb").write_text("{}")
    (tmp_path / name / "timestamp.txt").write_text("2001-01-01 11:00:00 UTC")
    assert not handed_in(tmp_path).startswith("2001")


@pytest.mark.slow
def test_a_cluster_gives_the_same_marks_as_this_machine(tmp_path, capsys):
    distributed = pytest.importorskip("distributed")
    (tmp_path / "class").mkdir()
    solved = notebook("x = 1", exercise="04")
    (tmp_path / "class" / "anna.ipynb").write_text(solved)
    (tmp_path / "class" / "cut.ipynb").write_text(solved[:50])
    words = ["grade", str(tmp_path / "class"), "--isolation", workers().level, "--secret"]
    (tmp_path / "secret").write_text("0123456789abcdef")
    words += [str(tmp_path / "secret"), "--exercise", "04", "--out"]
    assert main([*words, str(tmp_path / "here")]) == 1  # one notebook could not be graded
    cluster = distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None)
    with cluster:
        there = [*words, str(tmp_path / "there"), "--scheduler", cluster.scheduler_address]
        assert main(there) == 1
    books = [Gradebook(f"sqlite:///{tmp_path / name / 'grades.db'}") for name in ("here", "there")]
    one, other = ([replace(r, seconds={}) for r in book.latest_attempts()] for book in books)
    assert one == other
    assert [r.graded for r in one] == [True, False]


def test_an_unreachable_cluster_is_reported_in_one_line(results, tmp_path, capsys):
    words = ["grade", str(tmp_path / "class"), "--out", str(tmp_path / "x")]
    assert main([*words, "--scheduler", "nonsense"]) == 2
    assert "the Dask scheduler at" in capsys.readouterr().err
