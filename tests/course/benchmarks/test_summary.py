"""Summary of the benchmarks: the README's table is replaced, and nothing else."""

import pytest

from benchmarks import summary
from benchmarks.common import row

ROWS = [
    row("N = 200: slamlab", 0.25, "ms", "filterpy EKF", 512),
    row("N = 200: slamlab", 0.25, "ms", "textbook dense EKF", 30),
]


def test_the_table_replaces_the_one_between_the_marks(tmp_path, capsys):
    readme = tmp_path / "README.md"
    readme.write_text(f"before\n{summary.BEGIN}old\n{summary.END}after\n", "utf-8")
    summary.write(ROWS, readme)
    text = readme.read_text("utf-8")
    assert text.startswith(f"before\n{summary.BEGIN}")
    assert text.endswith(f"{summary.END}after\n")
    assert "| EKF-SLAM, one step, 200 landmarks | filterpy | 0.25 ms | 510 |" in text
    assert summary.machine() in text
    assert "old" not in text
    assert len(summary.chief_rows(ROWS)) == 1
    assert "not measured: EKF-SLAM, one step, 1000 landmarks" in capsys.readouterr().err


def test_a_readme_without_the_marks_is_refused(tmp_path):
    readme = tmp_path / "README.md"
    readme.write_text(summary.BEGIN, "utf-8")
    with pytest.raises(ValueError, match="has no line"):
        summary.write(ROWS, readme)


def test_the_projects_readme_has_the_marks():
    text = summary.README.read_text("utf-8")
    assert text.index(summary.BEGIN) < text.index(summary.END)
