"""Progress is kept where a student works, by several kernels at once, and nowhere else."""

import json
import multiprocessing
import os
import signal
import subprocess
import sys
from datetime import datetime

import pytest

from classroom import coursework
from classroom.checks import check
from classroom.coursework import folder, progress_file, progress_overview, progress_records

NOW = datetime(2026, 11, 22, 18, 0, 0)


@pytest.fixture
def course(tmp_path, monkeypatch):
    """A course's folder, in which a student works."""
    for name in folder.FOLDERS:
        (tmp_path / name).mkdir()
    monkeypatch.delenv("PYTEST_VERSION")
    monkeypatch.chdir(tmp_path / "exercises")
    return tmp_path


def test_a_check_an_answer_and_a_validation_are_kept(course):
    progress_records.record_check("04-h-robot", 2.0, 4.5)
    progress_records.record_check("04-h-robot", 1.0, 4.5)
    progress_records.record_answer("04-leaning", "A", False)
    progress_records.record_answer("04-leaning", "B", True)
    progress_records.record_answer("ex04-left", "C", True)
    progress_records.record_validation("04", 12.0, 22.0)
    kept = progress_file.read(course)
    task, question = kept["tasks"]["04-h-robot"], kept["questions"]["04-leaning"]
    assert (task["points"], task["best"], task["of"], task["times"]) == (1.0, 2.0, 4.5, 2)
    assert (question["first"], question["answer"], question["right"]) == ("A", "B", True)
    assert kept["questions"]["ex04-left"]["right"]
    assert kept["validated"]["04"]["points"] == 12.0
    assert set(kept["minutes"]) == {"04", "ex04"}


def test_a_check_before_its_cell_takes_no_points_back(course, capsys):
    """A fresh kernel knows no function yet; one that is worse than before counts."""
    progress_records.record_check("04-jxr-jz", 3.0, 3.0)
    eval("check('04-jxr-jz')", {"check": check})
    assert "not defined yet" in capsys.readouterr().out
    assert progress_file.read(course)["tasks"]["04-jxr-jz"]["points"] == 3.0
    eval("check('04-jxr-jz')", {"check": check, "J_xr": lambda *_: 0, "J_z": lambda *_: 0})
    assert progress_file.read(course)["tasks"]["04-jxr-jz"]["points"] == 0.0


@pytest.mark.parametrize("name", [folder.OFF, "NBGRADER_EXECUTION", "PYTEST_VERSION"])
def test_nothing_is_recorded_without_a_student(course, monkeypatch, name):
    monkeypatch.setenv(name, "1")
    progress_records.record_check("04-h-robot", 2.0, 4.5)
    assert not (course / progress_file.NAME).exists()


def test_nothing_is_kept_outside_the_course(course, tmp_path_factory, monkeypatch):
    elsewhere = tmp_path_factory.mktemp("elsewhere")
    monkeypatch.chdir(elsewhere)
    progress_records.record_check("04-h-robot", 2.0, 4.5)
    assert list(elsewhere.iterdir()) == []


def test_a_pause_counts_ten_minutes_at_most():
    times = iter([0.0, 90.0, 90.0 + 3600, 3700.0])
    watch = progress_records.Stopwatch(lambda: next(times))
    assert [watch.lap(), watch.lap()] == [1.5, 10.0]


BROKEN = ['{"tasks": 3}', '{"tasks": {"04-a": 3}}', '{"tasks": {"04-a": {"points": "all"}}}',
          '{"minutes": {"ex04": "long"}}']  # fmt: skip


@pytest.mark.parametrize("text", ["", "{", "[]", "null", *BROKEN])
def test_a_damaged_file_stops_nothing_and_a_copy_is_saved(course, text):
    (course / progress_file.NAME).write_text(text)
    progress_overview.overview(course, progress_file.read(course))
    progress_records.record_check("04-a", 2.0, 4.5)
    assert progress_file.read(course)["tasks"]["04-a"]["points"] == 2.0
    copies = [path.read_text() for path in course.glob("progress 2*.json")]
    assert copies == ([text] if not text.startswith('{"') else [])
    progress_overview.overview(course, progress_file.read(course))


def test_a_folder_that_cannot_be_written_to_stops_nothing(course, monkeypatch):
    def refuse(*given):
        raise PermissionError("read-only")

    monkeypatch.setattr(progress_file, "write", refuse)
    progress_records.record_check("04-h-robot", 2.0, 4.5)


def _kernel(place, number, count):
    os.environ.pop("PYTEST_VERSION", None)
    os.chdir(place)
    for k in range(count):
        progress_records.record_check(f"04-task{number}-{k}", 1.0, 2.0)


def test_kernels_that_write_at_once_lose_nothing(course):
    context = multiprocessing.get_context("spawn")
    kernels = [context.Process(target=_kernel, args=(course, n, 20)) for n in range(3)]
    for kernel in kernels:
        kernel.start()
    for kernel in kernels:
        kernel.join()
    assert len(progress_file.read(course)["tasks"]) == 60


def test_a_kernel_that_is_killed_loses_nothing_that_was_kept(course):
    code = """
from classroom.coursework import progress_records
for k in range(10**6):
    progress_records.record_check(f'04-task-{k}', 1.0, 2.0)
    print(k, flush=True)
"""
    kept = 0
    for _ in range(4):
        kernel = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
        for line in kernel.stdout:
            if int(line) == 12:
                break
        kernel.send_signal(signal.SIGKILL)
        kernel.wait()
        kernel.stdout.close()
        tasks = json.loads((course / progress_file.NAME).read_text())["tasks"]
        assert len(tasks) >= max(13, kept)
        kept = len(tasks)


def test_the_overview_shows_what_is_next(course):
    table = progress_overview.rows(course, progress_file.read(course))
    assert progress_overview.next_step(table).startswith("lesson 01")
    assert "0 of" in progress_overview.overview(None, progress_file.EMPTY)
    first = table[0]
    for task in progress_overview.catalogue.exercise("01").tasks[:-1]:
        progress_records.record_check(task.id, task.points, task.points)
    last = progress_overview.catalogue.exercise("01").tasks[-1]
    progress_records.record_check(last.id, 0.5, last.points)
    table = progress_overview.rows(course, progress_file.read(course))
    assert table[0].marks == "●" * (len(first.marks) - 1) + "◐"
    assert last.id in progress_overview.next_step(table)
    assert "cannot be read" not in progress_overview.overview(course, progress_file.read(course))
    (course / progress_file.NAME).write_text("{", "utf-8")
    assert "cannot be read" in progress_overview.overview(course, progress_file.read(course))


def test_questions_of_a_lesson_and_of_its_exercise_are_counted_and_shown(course):
    notebooks = {"notebooks/01_x": ["01-why"], "exercises/ex01_x": ["ex01-a", "ex01-b"]}
    for name, asked in notebooks.items():
        cells = [{"cell_type": "code", "source": ["ask(\n", f'    "{id}", "?")\n']} for id in asked]
        path = course / f"{name}.ipynb"
        path.parent.mkdir(exist_ok=True)
        path.write_text(json.dumps({"cells": cells}))
    progress_records.record_answer("01-why", "A", True)
    progress_records.record_answer("ex01-b", "A", False)
    kept = progress_file.read(course)
    row = progress_overview.rows(course, kept)[0]
    assert (row.in_lesson, row.in_exercise) == ((1, 1), (1, 2))
    lines = progress_overview.overview(course, kept).splitlines()
    assert "1 of 1   1 of 2" in next(line for line in lines if "01 " in line)


def test_the_overview_in_a_notebook_prints(course, capsys):
    coursework.show_progress()
    assert "next: lesson 01" in capsys.readouterr().out
