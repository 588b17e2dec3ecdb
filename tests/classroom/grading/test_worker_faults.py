"""What a worker may not do: descriptors, deep folders, hidden packages, the whole disk."""

import dataclasses
import importlib.util
import mmap
import os
from pathlib import Path

import pytest

from classroom.exercises import catalogue
from classroom.grading import hidden_packages, judge, quotas, sandbox, tree_removal
from classroom.grading.worker_pool import WorkerPool
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import lacks, posix, workers


def cells_of(*cells, exercise=fake.EXERCISE, by=None):
    """What went wrong in each cell."""
    numbered = list(enumerate(cells, 1))
    return judge.judge_notebook(exercise, numbered, b"seed", by or workers())["cells"]


@posix
def test_a_worker_has_no_descriptor_of_the_judge():
    spy = """
import os
import sqlite3
found = []
for number in range(3, 3000):
    try: found.append((number, os.fstat(number).st_mode))
    except OSError: pass
raise ValueError(len(found))
"""
    opened = [os.open(os.devnull, os.O_RDONLY) for _ in range(400)]
    try:
        with WorkerPool(workers().level, warm=False) as pool:  # its sockets have large numbers
            assert cells_of(spy, by=pool)[1].startswith("ValueError: 2 (")  # the pipe's two ends
    finally:
        for number in opened:
            os.close(number)


@posix
def test_where_close_range_is_refused_descriptors_are_closed_one_by_one(monkeypatch):
    monkeypatch.setattr(sandbox, "CLOSE_RANGE", -1)  # no such call
    reading, writing = os.pipe()
    pid = os.fork()
    if pid == 0:
        sandbox.close_from(3, kept=writing)
        with open(f"/proc/{os.getpid()}/fd/{writing}", "wb", 0):
            left = len([n for n in os.listdir("/proc/self/fd") if int(n) >= 3])
        os.write(writing, str(left).encode())
        os._exit(0)
    os.close(writing)
    os.waitpid(pid, 0)
    assert os.read(reading, 9) == b"3"  # the kept one, the one opened by it, the list's own
    os.close(reading)


def deep_folders(top, depth):
    """Folders in folders below an open one."""
    at = os.dup(top)
    for _ in range(depth):
        os.mkdir("d", dir_fd=at)
        below = os.open("d", os.O_RDONLY, dir_fd=at)
        os.close(at)
        at = below
    os.close(os.open("file", os.O_CREAT | os.O_WRONLY, dir_fd=at))
    os.close(at)


@posix
def test_deep_trees_are_removed_and_links_out_of_them_are_not_followed(tmp_path):
    kept, tree = tmp_path / "kept", tmp_path / "tree"
    kept.mkdir()
    (kept / "file").write_text("x")
    tree.mkdir()
    (tree / "to a folder").symlink_to(kept)
    (tree / "to a file").symlink_to(kept / "file")
    top = os.open(tree, os.O_RDONLY)
    deep_folders(top, 3000)
    os.close(top)
    (tree / "shut" / "below").mkdir(parents=True)
    (tree / "shut" / "below").chmod(0)
    (tree / "shut").chmod(0o300)
    tree_removal.remove_tree(tree)
    assert not tree.exists()
    assert (kept / "file").read_text() == "x"


def test_libraries_that_solve_an_exercise_are_hidden():
    for id in ("03", "05", "06", "11"):
        assert "filterpy" in catalogue.exercise(id).hides
    assert "gtsam" in catalogue.exercise("15").hides


@posix
@pytest.mark.parametrize("level", [sandbox.BASIC, sandbox.STRICT])
def test_a_hidden_package_can_neither_be_imported_nor_read(level):
    if lacks(level):
        pytest.skip(lacks(level))
    package = Path(importlib.util.find_spec("filterpy").origin).parent
    cells = [
        "import filterpy",
        "from filterpy.kalman import KalmanFilter",
        f"open({str(package / '__init__.py')!r}).read()",
        f"import os; os.listdir({str(package / 'kalman')!r})[0]",
        f"import sys; sys.path.insert(0, {str(package.parent)!r})\nimport filterpy.kalman",
        "import importlib.metadata; importlib.metadata.version('filterpy')",
        "import scipy.linalg, sympy, matplotlib.pyplot, IPython",
        "import json, sqlite3, ctypes.util",
    ]
    hiding = dataclasses.replace(fake.EXERCISE, hides=("filterpy",))
    with WorkerPool(level, warm=False) as pool:
        assert list(cells_of(*cells, exercise=hiding, by=pool)) == [1, 2, 3, 4, 5, 6]
        assert list(cells_of(*cells[:2], by=pool)) == []  # elsewhere it is a library like others


def test_exactly_the_files_of_a_hidden_package_are_hidden(tmp_path):
    names = ["filterpy", "filterpy-1.4.dist-info", "filterpy.py", "Filterpy-1.4-py3.11.egg"]
    others = ["filters", "filterpy_plots", "numpy", "numpy-2.dist-info"]
    for name in (*names, *others, "__pycache__", "slamlab"):
        (tmp_path / name).mkdir()
    found = {path.name for path in hidden_packages.entries(tmp_path, ("filterpy",))}
    assert found == {*names, "__pycache__", "slamlab"}
    assert {path.name for path in hidden_packages.entries(tmp_path)} == {"slamlab"}


@posix
def test_readable_paths_of_an_interpreter_exclude_hidden_packages(tmp_path):
    library = tmp_path / "lib" / "python3.11" / "site-packages"
    (library / "filterpy").mkdir(parents=True)
    (library / "numpy").mkdir()
    (tmp_path / "lib" / "python3.11" / "json").mkdir()
    (tmp_path / "lib" / "loop").symlink_to(tmp_path)
    (tmp_path / "bin").mkdir()
    hidden = hidden_packages.hidden_paths([tmp_path], ("filterpy",))
    assert library / "filterpy" in hidden
    readable, listed = hidden_packages.readable_around(tmp_path, hidden)
    names = {str(path.relative_to(tmp_path)) for path in readable}
    assert names == {"bin", "lib/python3.11/json", "lib/python3.11/site-packages/numpy"}
    assert listed == [tmp_path]


@posix
@pytest.mark.parametrize("held", ["open", "mapped"])
def test_deleted_files_count_while_they_are_open(tmp_path, monkeypatch, held):
    monkeypatch.setattr(quotas, "MAX_BYTES", 4 << 20)
    assert not quotas.quota_exceeded(os.getpid(), tmp_path)
    with open(tmp_path / "gone", "w+b") as file:
        file.write(os.urandom(6 << 20))
        file.flush()
        mapped = mmap.mmap(file.fileno(), 4096) if held == "mapped" else None
        os.unlink(tmp_path / "gone")
        if mapped:
            file.close()
        assert quotas.quota_exceeded(os.getpid(), tmp_path)
    if mapped:
        mapped.close()
    assert not quotas.quota_exceeded(os.getpid(), tmp_path)


def test_a_worker_that_fills_the_disk_with_deleted_files_is_killed():
    if lacks(sandbox.BASIC):
        pytest.skip(lacks(sandbox.BASIC))
    hoards = """
import os, time
held = []
for i in range(30):
    file = open('f', 'wb'); os.unlink('f')
    file.write(bytes(15 << 20)); file.flush(); held.append(file)
time.sleep(8)
"""
    with WorkerPool(sandbox.BASIC, warm=False) as pool:
        assert "using too much memory" in cells_of(hoards, by=pool)[1]


def test_problems_of_cells_run_again_after_inputs_are_not_recorded(tmp_path):
    kept = str(tmp_path / "kept")  # without a sandbox; in one, a file's time or the clock will do
    report = f"import os\nif os.path.exists({kept!r}): raise ValueError(open({kept!r}).read())"
    dies = f"def double(a):\n    open({kept!r}, 'w').write(str(a)); os._exit(0)\n"
    with WorkerPool(sandbox.NONE, warm=False) as pool:
        assert cells_of(report, fake.SOLUTION + dies, by=pool) == {}
    assert Path(kept).exists()
