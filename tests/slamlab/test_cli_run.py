"""``slamlab run`` and ``slamlab convert`` as a user meets them."""

import csv
import io
import json
import os
import subprocess
import sys

import numpy as np
import pytest

from slamlab import estimators, sources
from slamlab.cli import main
from slamlab.cli.progress_line import progress_line
from slamlab.cli.run_results import COLUMNS, picture
from slamlab.estimators.runner import run
from tests.slamlab.support import public
from tests.timeouts import PATIENCE


def refused(capsys, *words):
    """The one line that a refused command prints."""
    assert main(list(words)) == 2
    output = capsys.readouterr()
    lines = [line for line in output.err.splitlines() if line.startswith("slamlab ")]
    assert len(lines) == 1
    assert "Traceback" not in output.err
    return lines[0]


def test_run_writes_trajectory_map_and_summary(tmp_path, capsys):
    out = tmp_path / "new" / "folder"
    assert main(["run", "sim:polygon-wrong", "--seed", "3", "--out", str(out)]) == 0
    rows = list(csv.reader((out / "trajectory.csv").open()))
    source = sources.open("sim:polygon-wrong", np.random.default_rng(3))
    result = run(source, estimators.make("icp", source))
    expected = np.column_stack([result.naive.times, result.trajectory.poses, result.naive.poses])
    assert tuple(rows[0]) == COLUMNS
    assert np.array_equal(np.array(rows[1:], dtype=float), expected)
    assert (out / "map.png").read_bytes().startswith(b"\x89PNG")
    summary = json.loads((out / "summary.json").read_text())
    assert {"source", "estimator", "frames", "skipped", "seconds"} <= set(summary)
    assert summary["truth"]["corrected_m"] < summary["truth"]["naive_m"]
    printed = capsys.readouterr().out
    assert "4 readings of sim:polygon-wrong" in printed
    assert "position [m]" in printed and "heading [rad]" in printed


@pytest.mark.parametrize("estimator", estimators.NAMES)
def test_every_estimator_runs_and_draws_odometrys_map_beside_its_own(
    tmp_path, estimator, monkeypatch
):
    world = "sim:landmarks" if estimator.startswith("mak") else "sim:polygon"
    figures = []

    def drawn(*results):
        figures.append(picture(*results))
        return figures[-1]

    monkeypatch.setattr("slamlab.cli.run_results.picture", drawn)
    assert main(["run", world, "--estimator", estimator, "--out", str(tmp_path)]) == 0
    assert (tmp_path / "map.png").stat().st_size > 5000
    titles = [ax.get_title() for ax in figures[0].axes]
    assert titles == ["odometry alone", "estimate"][: 1 if estimator == "odometry" else 2]
    labels = {text.get_text() for text in figures[0].legends[0].get_texts()}
    assert {"odometry alone: map", "odometry alone: track"} <= labels


def test_the_errors_stand_in_aligned_columns(capsys):
    assert main(["run", "sim:polygon-wrong"]) == 0
    head, *rows = capsys.readouterr().out.splitlines()[:3]
    assert head.split() == ["error", "odometry", "alone", "icp"]
    assert {len(head), *map(len, rows)} == {len(head)}
    assert all(row[head.index("alone") + len("alone")] == " " for row in rows)


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.mark.parametrize(("total", "message"), [(4, "25 %"), (0, "1 readings")])
def test_progress_is_shown_on_a_terminal_and_erased(monkeypatch, total, message):
    monkeypatch.setattr(sys, "stderr", Terminal())
    with progress_line(total) as advance:
        advance()
        assert sys.stderr.getvalue() == f"\rrunning: {message}"
    *_, blank, end = sys.stderr.getvalue().split("\r")
    assert blank == " " * len(f"running: {message}") and end == ""


def test_no_progress_is_shown_where_there_is_no_terminal(capsys):
    assert main(["run", "sim:polygon"]) == 0
    assert capsys.readouterr().err == ""


def test_convert_writes_what_run_reads(tmp_path, capsys):
    log = str(tmp_path / "log.gz")
    assert main(["convert", "sim:polygon", log, "--seed", "5"]) == 0
    assert "4 readings written" in capsys.readouterr().out
    assert main(["run", log, "--out", str(tmp_path)]) == 0
    assert json.loads((tmp_path / "summary.json").read_text())["frames"] == 4


def test_relations_that_do_not_fit_are_refused_in_one_line(tmp_path, capsys):
    relations = tmp_path / "relations"
    relations.write_text("5000 6000 1 0 0 0 0 0\n")
    output = refused(capsys, "run", "sim:polygon", "--relations", str(relations))
    assert "do they belong to this log" in output


def test_relations_are_judged_and_stand_in_the_summary(tmp_path):
    relations = tmp_path / "relations"
    relations.write_text("0 1.5 0 0 0 0 0 0\n")
    words = ["run", "sim:polygon", "--relations", str(relations), "--out", str(tmp_path)]
    assert main(words) == 0
    found = json.loads((tmp_path / "summary.json").read_text())["relations"]
    errors = {"naive_m", "corrected_m", "naive_rad", "corrected_rad"}
    assert set(found) == {"count", "of", "damage", *errors}
    assert (found["count"], found["of"]) == (1, 1)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["run", "/nowhere/log"], "does not exist"),
        (["run", "sim:landmarks", "--estimator", "walls"], "has no scans"),
        (["run", "sim:polygon", "--seed", "-1"], "--seed"),
        (["run", "sim:polygon", "--relations", "/nowhere"], "does not exist"),
        (["convert", "/nowhere/log", "x"], "does not exist"),
        (["convert", "sim:polygon", "/nowhere/x"], "cannot be written"),
    ],
)
def test_wrong_use_is_refused_in_one_line(capsys, words, message):
    assert message in refused(capsys, *words)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("run sim:polygon --merge two", "--merge: a whole number is needed, not 'two'"),
        ("run sim:polygon more", "unrecognized arguments: more"),
    ],
)
def test_words_that_no_command_takes_are_refused_in_one_line(capsys, words, message):
    with pytest.raises(SystemExit) as ended:
        main(words.split())
    assert ended.value.code == 2
    output = capsys.readouterr().err
    assert message in output and output.count("\n") == 1 and "--help' lists" in output


def test_folders_junk_and_an_out_that_is_a_file_are_refused(tmp_path, capsys):
    junk = tmp_path / "junk"
    junk.write_bytes(bytes(range(256)) * 50)
    assert "is a folder" in refused(capsys, "run", str(tmp_path))
    assert "has no format that slamlab" in refused(capsys, "run", str(junk))
    assert str(junk) in refused(capsys, "run", "sim:polygon", "--out", str(junk))
    assert "is a directory" in refused(capsys, "convert", "sim:polygon", str(tmp_path))


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write all")
def test_an_out_that_cannot_be_written_is_refused(tmp_path, capsys):
    tmp_path.chmod(0o500)
    assert str(tmp_path) in refused(capsys, "run", "sim:polygon", "--out", str(tmp_path / "x"))


def test_an_interrupt_ends_quietly(monkeypatch, capsys):
    def interrupted(arguments):
        raise KeyboardInterrupt

    monkeypatch.setattr("slamlab.cli.run.run", interrupted)
    assert main(["run", "sim:polygon"]) == 130
    assert capsys.readouterr().err == ""


def test_help_imports_nothing_heavy():
    code = (
        "import sys; from slamlab.cli import main\n"
        "try: main(['--help'])\n"
        "except SystemExit as end: assert end.code == 0\n"
        "heavy = {'matplotlib', 'scipy', 'sympy', 'filterpy'} & set(sys.modules)\n"
        "assert not heavy, heavy"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
def test_intel_without_loop_closure_comes_out_ten_times_better_than_odometry(tmp_path):
    log, relations = public("intel"), public("intel-relations")
    assert main(["run", str(log), "--relations", str(relations), "--out", str(tmp_path)]) == 0
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert (summary["frames"], summary["skipped"]) == (910, 0)
    found = summary["relations"]
    assert found["count"] == 108
    assert found["naive_m"] == pytest.approx(4.09, abs=0.01)
    assert found["corrected_m"] < 0.32
    assert found["corrected_rad"] < 0.1 * found["naive_rad"]


def test_python_runs_the_command_where_its_name_is_not_on_the_path():
    words = [sys.executable, "-m", "slamlab", "--version"]
    process = subprocess.run(words, capture_output=True, text=True, check=True, timeout=PATIENCE)
    assert process.stdout.startswith("slamlab ")
