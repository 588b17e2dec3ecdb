"""Thirty students from folders to marks: late, double, foreign, hostile; regrades, another law."""

import csv
import os
from datetime import UTC, datetime

import pytest

from slamlab.cli import main
from tests.grading import fake
from tests.grading.conftest import notebook, workers
from tests.grading.test_gradebook import forget, postgres, server  # noqa: F401
from tests.grading.test_rejudging import FAILS, LAZY, WRONG, know, milder

DUE = datetime(2025, 12, 1, 11, tzinfo=UTC).timestamp()
HOSTILE = fake.SOLUTION + "\nimport os\ndef double(a):\n    os.kill(os.getppid(), 9); os._exit(0)\n"
# what was handed in: how many days late, the cell, its points, and those by the milder law
KINDS = [
    [(0, fake.SOLUTION, 8, 8)],
    [(0, LAZY, 5.5, 8)],
    [(2, fake.SOLUTION, 8, 8)],
    [(0, WRONG, 4, 4), (1, LAZY, 5.5, 8)],
    [(0, fake.SOLUTION, 8, 8), (0, "x = 1", 0, 0)],
    [(0, FAILS, 5.5, 5.5), (0, None, None, None)],
    [(0, "another exercise", None, None)],
    [],
    [(0, HOSTILE, 2.5, 2.5)],
    [(3, None, None, None)],
]
STUDENTS = 30


def points(student, milder):
    """The mark of a student, an extension of two days for every third, a tenth taken a day."""
    scored = [(late, made[milder]) for late, _, *made in KINDS[student % len(KINDS)]]
    scored = [(late, earned) for late, earned in scored if earned is not None]
    if not scored:
        return ""
    late, earned = scored[-1]
    days = max(0, late - (2 if student % 3 == 0 else 0))
    return f"{round(earned * (1 - 0.1 * days), 6):g}"


def make_class(folder, url):
    head = f'time_zone = "UTC"\nisolation = "{workers().level}"\n{url}\n[late]\nper_day = 0.1\n'
    (folder / "course.toml").write_text(f"{head}[exercises.99]\ndue = 2025-12-01T11:00:00\n")
    rows = ["id,name,section,99"]
    for i in range(STUDENTS):
        rows.append(f"s{i},Name {i},{'ABC'[i % 3]},{'2025-12-03 11:00' if i % 3 == 0 else ''}")
        for number, (late, cell, *_) in enumerate(KINDS[i % len(KINDS)]):
            file = folder / "class" / f"s{i}" / f"{number}.ipynb"
            file.parent.mkdir(parents=True, exist_ok=True)
            text = notebook(
                f"x = {i}", cell or "", exercise="99" if cell != "another exercise" else "04"
            )
            file.write_text(text if cell else text[:50])
            at = DUE + late * 86_400 - 60
            os.utime(file, (at, at))
    (folder / "roster.csv").write_text("\n".join(rows))
    (folder / "class" / "stranger.ipynb").write_text(notebook(fake.SOLUTION))


def scores(folder):
    with open(folder / "results/99/grades.csv", encoding="utf-8", newline="") as file:
        return {row["id"]: row["score"] for row in csv.DictReader(file)}


@pytest.mark.parametrize("kind", ["sqlite", pytest.param("postgresql", marks=pytest.mark.slow)])
def test_every_mark_is_as_a_plain_table_says(tmp_path, monkeypatch, kind, request, capsys):
    url = ""
    if kind == "postgresql":
        forget(request.getfixturevalue("postgres"))
        url = f'gradebook = "{request.getfixturevalue("postgres")}"'
    make_class(tmp_path, url)
    monkeypatch.chdir(tmp_path)
    for more in ([], ["--regrade"], ["--regrade"], []):
        assert main(["grade", "class", "--exercise", "99", "--jobs", "2", *more]) == 0
        assert scores(tmp_path) == {f"s{i}": points(i, 0) for i in range(STUDENTS)}
    assert main(["grade", "verify"]) == 0
    know(monkeypatch, milder())
    capsys.readouterr()
    assert main(["grade", "rejudge", "--accept"]) == 0
    assert "of 0 the code was run: 6 gain, 0 lose" in capsys.readouterr().out
    assert scores(tmp_path) == {f"s{i}": points(i, 1) for i in range(STUDENTS)}
    assert main(["grade", "verify"]) == 0
