"""``slamlab grade take``: a grader decides for which student and exercise a file counts."""

import zipfile

import pytest

from slamlab.cli import main
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import notebook, table
from tests.classroom.grading.term_folder import scores

GRADE = ["grade", "download.zip", "--exercise", "99", "--worksheet", "sheet.csv"]
OTHER = notebook(fake.SOLUTION, exercise="04")
FILES = {  # name in the download, and content
    "another exercise": ("hw.ipynb", OTHER),
    "another suffix": ("hw.ipynb.txt", notebook(fake.SOLUTION)),
}


def download(folder, name, text):
    with zipfile.ZipFile(folder / "download.zip", "w") as archive:
        archive.writestr(f"Ana Kos_501_assignsubmission_file/{name}", text)
    (folder / "mine").write_text(text, "utf-8")


@pytest.mark.slow
@pytest.mark.parametrize("kind", FILES)
def test_a_taken_file_counts_with_its_time_whenever_it_is_graded_again(folder, kind, capsys):
    download(folder, *FILES[kind])
    assert main(GRADE) == 1 and scores(folder)["s1"] == ""
    assert main(["grade", "take", "mine", "--exercise", "99", "--student", "Kos Ana"]) == 0
    assert "time of submission: as of Ana Kos_501" in " ".join(capsys.readouterr().out.split())
    for command in (GRADE, [*GRADE, "--regrade"]):
        assert scores(folder)["s1"] == "6", "it is late, and has the time of the worksheet"
        assert main(command) == 0
    assert scores(folder)["s1"] == "6"
    assert table(folder / "results/99/grades.csv")[0]["attempts"] == "1"


def test_a_file_that_is_not_in_a_download_has_the_time_of_the_last_attempt(folder, capsys):
    download(folder, "work.docx", "in words")
    main(GRADE)
    (folder / "mine.ipynb").write_text(OTHER, "utf-8")
    assert main(["grade", "take", "mine.ipynb", "--exercise", "99", "--student", "s1"]) == 0
    assert scores(folder)["s1"] == "6"
    assert main(["grade", "take", "mine.ipynb", "--exercise", "99", "--student", "s3"]) == 0
    assert "unknown, so there is no late penalty" in capsys.readouterr().out
    assert scores(folder) == {"s1": "6", "s2": "", "s3": "8"}, "s1 keeps the same file"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["mine", "--exercise", "04", "--student", "s1"], "the course file has no exercise 04"),
        (["mine", "--exercise", "99", "--student", "Eve"], "'Eve' is not in the roster"),
        (["none", "--exercise", "99", "--student", "s1"], "none is not a file"),
    ],
)
def test_a_file_that_cannot_be_taken_is_reported_in_one_line(folder, words, message, capsys):
    download(folder, "hw.ipynb", OTHER)
    assert main(["grade", "take", *words]) == 2
    error = capsys.readouterr().err
    assert message in error and error.count("\n") == 1
