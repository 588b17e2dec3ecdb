"""Faults once found round the judge: each stays mended."""

import csv

import pytest

from slamlab.cli import SUBCOMMANDS, main
from slamlab.grading import late_policy, notebooks, submissions
from slamlab.grading.late_policy import LatePolicyError
from slamlab.grading.submissions import Submission, SubmissionError
from tests.grading import fake
from tests.grading.conftest import notebook, workers

SILENT = notebook(exercise=None)


def identified(name, text, bound=None):
    """The exercise that a notebook of some name and text is taken for."""
    submission = Submission(name, "anna", None)
    return submissions.identify_exercise(submission, notebooks.parse(text.encode()), bound).id


def rows(out):
    with open(out / "grades.csv", encoding="utf-8", newline="") as file:
        return {row["submission"]: row for row in csv.DictReader(file)}


# (4) a solved 01 handed in as 04 earned full marks


def test_the_exercise_on_the_command_line_binds():
    assert identified("homework.ipynb", SILENT, "04") == "04"
    assert identified("homework.ipynb", notebook(exercise="04"), "04") == "04"
    with pytest.raises(SubmissionError, match="01 by its metadata, 04 by --exercise"):
        identified("homework.ipynb", notebook(exercise="01"), "04")
    with pytest.raises(SubmissionError, match="01 by its name, 04 by --exercise"):
        identified("ex01_why_slam.ipynb", SILENT, "04")


def test_a_solved_exercise_handed_in_as_another_earns_nothing(tmp_path):
    (tmp_path / "class").mkdir()
    (tmp_path / "class" / "anna.ipynb").write_text(notebook(fake.SOLUTION))
    words = ["grade", str(tmp_path / "class"), "--out", str(tmp_path / "out"), "--exercise", "04"]
    assert main([*words, "--isolation", workers().level]) == 0
    (row,) = rows(tmp_path / "out").values()
    assert row["score"] == ""
    assert "99 by its metadata, 04 by --exercise" in row["note"]


# (5) without metadata a number in a name outranked --exercise


@pytest.mark.parametrize(
    "name", ["2026-11-15 homework.ipynb", "team_12/hw.ipynb", "12-11.ipynb", "anna_04.ipynb"]
)
def test_a_number_somewhere_in_a_name_tells_no_exercise(name):
    assert identified(name, SILENT, "04") == "04"
    with pytest.raises(SubmissionError, match="say --exercise"):
        identified(name, SILENT)


@pytest.mark.parametrize("name", ["99_fake.ipynb", "ex99_fake-1.ipynb", "EX99_x.ipynb"])
def test_a_number_at_the_start_of_a_files_name_tells_the_exercise_last(name):
    assert identified(f"team_12/{name}", SILENT) == "99"
    assert identified(f"Ana Kos_12_assignsubmission_file_{name}", SILENT) == "99"
    assert identified(f"kosana_LATE_1021_55031_{name}", SILENT) == "99"
    with pytest.raises(SubmissionError, match="04 by its metadata, 99 by its name"):
        identified(name, notebook(exercise="04"))
    assert identified(name, notebook(exercise="04"), "04") == "04"


def test_an_exercise_that_does_not_exist_is_not_replaced_by_a_guess():
    with pytest.raises(SubmissionError, match="its metadata name exercise '77', which"):
        identified("99_fake.ipynb", notebook(exercise="77"))


# (7) adjust without --policy undid lateness


@pytest.mark.slow
def test_the_late_policy_is_kept_with_each_mark(tmp_path, capsys):
    folder, out = tmp_path / "class", tmp_path / "out"
    folder.mkdir()
    (folder / "anna.ipynb").write_text(notebook(fake.SOLUTION))
    policy = tmp_path / "policy.toml"
    policy.write_text('per_day = 1\nat_most = 0.5\n[due]\n"99" = 2001-01-01T00:00:00Z')
    level = ["--isolation", workers().level]
    words = ["grade", str(folder), "--out", str(out), *level]
    assert main([*words, "--policy", str(policy)]) == 0
    assert rows(out)["anna.ipynb"]["score"] == "4"
    by_hand = ["grade", "adjust", "anna.ipynb", "99-turn", "1", "--reason", "x", "--out", str(out)]
    assert main(by_hand) == 0
    assert rows(out)["anna.ipynb"]["score"] == "3.25"
    assert main(words) == 0
    assert rows(out)["anna.ipynb"]["score"] == "3.25"
    assert main([*words, "--regrade"]) == 0
    assert rows(out)["anna.ipynb"]["score"] == "3.25"
    policy.write_text('[due]\n"99" = 2999-01-01T00:00:00Z')
    assert main([*by_hand, "--policy", str(policy)]) == 0
    assert rows(out)["anna.ipynb"]["score"] == "6.5"
    assert main(by_hand) == 0
    assert rows(out)["anna.ipynb"]["score"] == "6.5"


# (8) an infinite grace ended in a traceback, and due dates of no exercise were taken


@pytest.mark.parametrize("value", ["inf", "nan", "-1", "1e300", "true", '"10"'])
def test_a_grace_that_is_no_span_of_time_is_refused_by_name(tmp_path, value):
    file = tmp_path / "policy.toml"
    file.write_text(f'grace_minutes = {value}\n[due]\n"04" = 2026-12-01T12:00:00Z')
    with pytest.raises(LatePolicyError, match="grace_minutes"):
        late_policy.load(file)


@pytest.mark.parametrize("id", ["4", "98", "004", "x"])
def test_a_due_date_of_no_exercise_is_refused_by_name(tmp_path, id):
    file = tmp_path / "policy.toml"
    file.write_text(f'[due]\n"{id}" = 2026-12-01T12:00:00Z')
    with pytest.raises(LatePolicyError, match=f"no exercise '{id}'; there are 01, 02"):
        late_policy.load(file)


# (16) Moodle's marker inside a name made a second participant


@pytest.mark.parametrize(
    ("name", "who"),
    [
        ("kosana_1021_55031_Eve_99_assignsubmission_file_x.ipynb", ("kosana", "1021")),
        ("Ana Kos_12_assignsubmission_file_a_1_2_x.ipynb", ("Ana Kos", "12")),
        ("Kos_12_assignsubmission_file_/Eve_99_assignsubmission_file_x.ipynb", ("Kos", "12")),
        ("Kos_12_assignsubmission_file_Eve_99_assignsubmission_file_x.ipynb", ("Kos", "12")),
        ("kosana_LATE_1021_55031_novak_7_8_x.ipynb", ("kosana", "1021")),
        ("anna/Eve_99_assignsubmission_file_x.ipynb", ("anna", None)),
        ("anna/novak_7_8_x.ipynb", ("anna", None)),
        ("my_Eve_99_assignsubmission_file_x.ipynb", ("my_Eve_99_assignsubmission_file_x", None)),
    ],
)
def test_a_marker_inside_a_name_makes_no_second_participant(tmp_path, name, who):
    (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / name).write_text("{}")
    (found,) = submissions.find_submissions(tmp_path)
    assert (found.student, found.number) == who


# (help) a newcomer did not learn from --help that there are other words behind grade


def test_help_names_every_word_behind_grade(capsys):
    with pytest.raises(SystemExit):
        main(["grade", "--help"])
    told = capsys.readouterr().out
    assert [word for word in SUBCOMMANDS["grade"] if word not in told] == []
