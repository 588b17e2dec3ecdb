"""Regression tests for faults in the grading of a term."""

import argparse

import pytest

from classroom.grading import notebooks, submissions
from classroom.grading.submissions import Submission, SubmissionError
from slamlab.cli import main
from slamlab.cli.groups import all_groups
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import notebook, table, workers

SILENT = notebook(exercise=None)


def identified(name, text, bound=None):
    """The exercise that a notebook of some name and text is taken for."""
    submission = Submission(name, "anna", None)
    return submissions.identify_exercise(submission, notebooks.parse(text.encode()), bound).id


def rows(out):
    return {row["submission"]: row for row in table(out / "grades.csv")}


# (4) a solved 01 submitted as 04 earned full marks


def test_the_exercise_on_the_command_line_binds_and_the_metadata_precede_the_name():
    assert identified("homework.ipynb", SILENT, "04") == "04"
    assert identified("homework.ipynb", notebook(exercise="04"), "04") == "04"
    assert identified("work.ipynb", notebook(exercise="99")) == "99"
    for odd in (5, {"slamlab": 5}, {"slamlab": {"exercise": []}}):
        assert identified("99_x.ipynb", notebook(exercise=None, metadata=odd)) == "99"
    with pytest.raises(
        SubmissionError, match="exercise 01 according to its metadata, but exercise 04"
    ):
        identified("homework.ipynb", notebook(exercise="01"), "04")
    with pytest.raises(
        SubmissionError, match="exercise 01 according to its file name, but exercise 04"
    ):
        identified("ex01_why_slam.ipynb", SILENT, "04")
    with pytest.raises(SubmissionError, match="name exercise '77', which"):
        identified("99_fake.ipynb", notebook(exercise="77"))


# (5) without metadata a number in a name outranked --exercise


@pytest.mark.parametrize(
    "name",
    [
        "2026-11-15 homework.ipynb",
        "team_12/hw.ipynb",
        "anna 1999.ipynb",
        "anna_04.ipynb",
        "ex041.ipynb",
    ],
)
def test_a_number_somewhere_in_a_name_determines_no_exercise(name):
    assert identified(name, SILENT, "04") == "04"
    with pytest.raises(SubmissionError, match="name the file as its exercise"):
        identified(name, SILENT)


@pytest.mark.parametrize(
    "name", ["99_fake.ipynb", "ex99_fake-1.ipynb", "EX99.ipynb", "ex99 (1).ipynb"]
)
def test_a_number_at_the_start_of_a_file_name_determines_the_exercise_last(name):
    assert identified(f"team_12/{name}", SILENT) == "99"
    assert identified(f"Ana Kos_12_assignsubmission_file_{name}", SILENT) == "99"
    assert identified(f"kosana_LATE_1021_55031_{name}", SILENT) == "99"
    with pytest.raises(
        SubmissionError, match="made from the notebook of exercise 04, but is named as 99"
    ):
        identified(name, notebook(exercise="04"))
    assert identified(name, notebook(exercise="04"), "04") == "04"


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
    for command in (by_hand, words, [*words, "--regrade"]):
        assert main(command) == 0
        assert rows(out)["anna.ipynb"]["score"] == "3.25"
    policy.write_text('[due]\n"99" = 2999-01-01T00:00:00Z')
    for command in ([*by_hand, "--policy", str(policy)], by_hand):
        assert main(command) == 0
        assert rows(out)["anna.ipynb"]["score"] == "6.5"


# (16) Moodle's marker inside a name made a second participant


@pytest.mark.parametrize(
    ("name", "who"),
    [
        ("kosana_1021_55031_Eve_99_assignsubmission_file_x.ipynb", ("kosana", "1021")),
        ("Ana Kos_12_assignsubmission_file_a_1_2_x.ipynb", ("Ana Kos", "12")),
        ("Kos_12_assignsubmission_file_/Eve_99_assignsubmission_file_x.ipynb", ("Kos", "12")),
        ("Ana Marija Kos_12_assignsubmission_file_/99_fake.ipynb", ("Ana Marija Kos", "12")),
        ("kosana_LATE_1021_55031_novak_7_8_x.ipynb", ("kosana", "1021")),
        ("anna/Eve_99_assignsubmission_file_x.ipynb", ("anna", None)),
        ("novakiva_1021_55031_99_fake-2.ipynb", ("novakiva", "1021")),
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
    output = capsys.readouterr().out
    subparsers = argparse.ArgumentParser().add_subparsers()
    for group in all_groups():
        group.add_parsers(subparsers)
    words = [name.split()[1] for name in subparsers.choices if name.startswith("grade ")]
    assert len(words) > 8
    assert [word for word in words if word not in output] == []


def test_a_command_of_two_words_without_what_it_needs_is_refused_in_one_line(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["grade", "merge"])
    assert ended.value.code == 2
    output = capsys.readouterr().err
    assert "BOOK" in output and output.count("\n") == 1 and "--help' lists" in output
