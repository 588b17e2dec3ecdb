"""A class from folders to marks: late, repeated, unknown, hostile; regrades."""

import os
from datetime import UTC, datetime

from slamlab.cli import main
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import notebook, table, workers
from tests.classroom.grading.test_rejudging import FAILS, LAZY, WRONG, know, milder

DUE = datetime(2025, 12, 1, 11, tzinfo=UTC).timestamp()
HOSTILE = fake.SOLUTION + "\nimport os\ndef double(a):\n    os.kill(os.getppid(), 9); os._exit(0)\n"
# submissions: days late, the cell, its points, and its points by the milder law
KINDS = [
    [(0, fake.SOLUTION, 8, 8)],
    [(0, LAZY, 5.5, 8)],
    [(2, fake.SOLUTION, 8, 8)],
    [(0, WRONG, 4, 4), (1, LAZY, 5.5, 8)],
    [(0, fake.SOLUTION, 8, 8), (0, "x = 1", 0, 0)],
    [(0, FAILS, 5.5, 5.5), (0, None, None, None)],
    [(0, "another exercise", None, None)],
    [],
    [(0, HOSTILE, 4.5, 4.5)],
    [(3, None, None, None)],
]
STUDENTS = 20  # each kind that is late with and without an extension


def points(student, milder):
    """The mark of a student, an extension of two days for every third, a tenth taken a day."""
    scored = [(late, made[milder]) for late, _, *made in KINDS[student % len(KINDS)]]
    scored = [(late, earned) for late, earned in scored if earned is not None]
    if not scored:
        return ""
    late, earned = scored[-1]
    days = max(0, late - (2 if student % 3 == 0 else 0))
    return f"{round(earned * (1 - 0.1 * days), 6):g}"


def make_class(folder):
    head = f'time_zone = "UTC"\nisolation = "{workers().level}"\n[late]\nper_day = 0.1\n'
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
    (folder / "class" / "unknown.ipynb").write_text(notebook(fake.SOLUTION))


def scores(folder):
    return {row["id"]: row["score"] for row in table(folder / "results/99/grades.csv")}


def test_every_mark_equals_that_of_a_plain_table(tmp_path, monkeypatch, capsys):
    make_class(tmp_path)
    monkeypatch.chdir(tmp_path)
    for more in ([], ["--regrade"], []):
        assert main(["grade", "class", "--exercise", "99", "--jobs", "2", *more]) == 1
        assert scores(tmp_path) == {f"s{i}": points(i, 0) for i in range(STUDENTS)}
    assert main(["grade", "verify"]) == 0
    know(monkeypatch, milder())
    capsys.readouterr()
    assert main(["grade", "rejudge", "--accept"]) == 0
    assert "0 of them by running the code: 4 gain points, 0 lose" in capsys.readouterr().out
    assert scores(tmp_path) == {f"s{i}": points(i, 1) for i in range(STUDENTS)}
    assert main(["grade", "verify"]) == 0
