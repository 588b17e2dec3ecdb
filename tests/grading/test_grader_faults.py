"""Faults of the grader, found by attacking it or by running it for a term: none is left."""

import dataclasses
import errno
import importlib.util
import io
import mmap
import os
import sqlite3
import stat
import threading
from pathlib import Path

import pytest
import sqlalchemy as sa

from slamlab.cli import main
from slamlab.devices.clock import SimulatedClock
from slamlab.exercises import catalogue
from slamlab.grading import (
    batch,
    database,
    gradebook_rows,
    hidden_packages,
    judge,
    quotas,
    sandbox,
    storing,
    tree_removal,
)
from slamlab.grading.gradebook import Gradebook, GradebookError
from slamlab.grading.submissions import Submission
from slamlab.grading.worker_pool import WorkerPool
from tests.grading import fake
from tests.grading.conftest import lacks, notebook, workers
from tests.grading.test_gradebook import forget, postgres, record, server  # noqa: F401

posix = pytest.mark.skipif(os.name != "posix", reason="folders and rights of POSIX")


def cells_of(*cells, exercise=fake.EXERCISE, by=None):
    """What went wrong in each cell."""
    numbered = list(enumerate(cells, 1))
    return judge.judge_notebook(exercise, numbered, b"seed", by or workers())["cells"]


# descriptors


@posix
def test_no_descriptor_of_the_judges_is_left_in_a_worker_however_many_are_open():
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


# deep trees


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


@pytest.mark.slow
@posix
@pytest.mark.parametrize("level", [sandbox.NONE, sandbox.BASIC])
def test_a_notebook_that_nests_folders_beyond_reason_ends_nothing(monkeypatch, tmp_path, level):
    if lacks(level):
        pytest.skip(lacks(level))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    nests = "import os\nfor _ in range(1500): os.mkdir('d'); os.chdir('d')\n"
    with WorkerPool(level, warm=False) as pool:
        for _ in range(2):
            assert cells_of(nests, by=pool) == {}
            assert cells_of("import os; 1 / len(os.listdir())", by=pool)[1].startswith("ZeroDiv")
    assert list(tmp_path.iterdir()) == []


# packages that an exercise hides


def test_ready_made_filters_and_solvers_are_hidden_where_they_would_answer():
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


def test_all_that_belongs_to_a_hidden_package_is_hidden_and_nothing_else(tmp_path):
    names = ["filterpy", "filterpy-1.4.dist-info", "filterpy.py", "Filterpy-1.4-py3.11.egg"]
    others = ["filters", "filterpy_plots", "numpy", "numpy-2.dist-info"]
    for name in (*names, *others, "__pycache__", "slamlab"):
        (tmp_path / name).mkdir()
    found = {path.name for path in hidden_packages.entries(tmp_path, ("filterpy",))}
    assert found == {*names, "__pycache__", "slamlab"}
    assert {path.name for path in hidden_packages.entries(tmp_path)} == {"slamlab"}


@posix
def test_what_may_be_read_of_an_interpreters_folder_leaves_hidden_packages_out(tmp_path):
    library = tmp_path / "lib" / "python3.11" / "site-packages"
    (library / "filterpy").mkdir(parents=True)
    (library / "numpy").mkdir()
    (tmp_path / "lib" / "python3.11" / "json").mkdir()
    (tmp_path / "lib" / "loop").symlink_to(tmp_path)
    (tmp_path / "bin").mkdir()
    hidden = hidden_packages.places([tmp_path], ("filterpy",))
    assert library / "filterpy" in hidden
    readable, listed = hidden_packages.readable_around(tmp_path, hidden)
    names = {str(path.relative_to(tmp_path)) for path in readable}
    assert names == {"bin", "lib/python3.11/json", "lib/python3.11/site-packages/numpy"}
    assert listed == [tmp_path]


# disk space of deleted files


@posix
@pytest.mark.parametrize("held", ["open", "mapped"])
def test_files_that_were_deleted_count_while_they_are_held(tmp_path, monkeypatch, held):
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


def test_a_worker_that_fills_the_disk_with_deleted_files_is_ended():
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
        assert cells_of(hoards, by=pool) == {1: "ended the whole Python process"}


# the gradebook


def test_a_regrade_that_is_ended_leaves_every_older_mark(tmp_path):
    older = [record(f"{name}.ipynb") for name in "abc"]
    newer = [dataclasses.replace(each, seconds={"wall": 1.0}) for each in older]

    def ended():
        yield from newer[:2]
        raise KeyboardInterrupt

    with Gradebook(f"sqlite:///{tmp_path / 'grades.db'}") as book:
        list(storing.store_records((each for each in older), tmp_path, book))
        before = {path: path.read_bytes() for path in tmp_path.rglob("*.*")}
        with pytest.raises(KeyboardInterrupt):
            list(storing.store_records(ended(), tmp_path, book, regrade=True))
        assert book.latest_attempts() == older
        assert {path: path.read_bytes() for path in tmp_path.rglob("*.*")} == before
        list(storing.store_records((each for each in newer), tmp_path, book, regrade=True))
        assert book.latest_attempts() == newer
        assert len(book.attempts()) == 3


def test_results_of_a_moment_are_stored_at_once_and_when_it_is_broken_off(tmp_path, monkeypatch):
    monkeypatch.setattr(storing.time, "monotonic", lambda: 0.0)  # all of it in one moment
    made, stored = [record(f"{k}.ipynb") for k in range(6)], []

    def broken_off():
        yield from made
        raise KeyboardInterrupt

    with Gradebook(f"sqlite:///{tmp_path / 'grades.db'}") as book:
        add_all = book.add_all
        monkeypatch.setattr(book, "add_all", lambda some: stored.append(len(some)) or add_all(some))
        told = storing.store_records(broken_off(), tmp_path, book)
        assert next(told) == made[0]
        assert stored == [1]  # the first of a moment waits for nobody
        with pytest.raises(KeyboardInterrupt):
            list(told)
        assert stored == [1, 5]
        assert book.latest_attempts() == made
        assert len(list((tmp_path / "feedback").iterdir())) == 6


def test_what_the_grader_fails_at_in_a_regrade_keeps_its_mark(tmp_path):
    older = record()
    failed = dataclasses.replace(older, verdicts=(), reason="no worker", failed=True)
    with Gradebook(f"sqlite:///{tmp_path / 'grades.db'}") as book:
        book.add(older)
        list(storing.store_records((each for each in [failed]), tmp_path, book, regrade=True))
        assert book.latest_attempts() == [older]
    assert ",1,3," in (tmp_path / "grades.csv").read_text("utf-8")


@pytest.mark.parametrize("kind", ["sqlite", "postgresql"])
def test_many_that_come_at_once_to_an_empty_database_make_its_tables_once(kind, tmp_path, request):
    url = f"sqlite:///{tmp_path / 'grades.db'}"
    if kind == "postgresql":
        url = request.getfixturevalue("postgres")
        forget(url)
    start, failed = threading.Barrier(8), []

    def come(name):
        start.wait()
        try:
            with Gradebook(url) as book:
                book.add(record(name))
        except Exception as error:
            failed.append(error)

    threads = [threading.Thread(target=come, args=(f"{i}.ipynb",)) for i in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failed == []
    with Gradebook(url) as book:
        assert len(book.attempts()) == 8


def lost():
    return sa.exc.OperationalError("SELECT 1", {}, Exception("server closed the connection"))


def test_a_lost_database_is_waited_for_and_nothing_is_doubled(tmp_path):
    clock, told = SimulatedClock(), []
    url = f"sqlite:///{tmp_path / 'grades.db'}"
    opened = database.Database(url, gradebook_rows.TABLES, clock, told.append)
    tries = []

    def work(connection):
        tries.append(clock.now())
        if len(tries) < 5:
            raise lost()
        return "done"

    assert opened.transact(work) == "done"
    assert len(tries) == 5
    assert len(told) == 1
    assert "waiting up to 60 s" in told[0]


def test_a_database_that_does_not_come_back_is_told_in_one_line(tmp_path):
    clock = SimulatedClock()
    url = f"sqlite:///{tmp_path / 'grades.db'}"
    opened = database.Database(url, gradebook_rows.TABLES, clock, lambda said: None)

    def work(connection):
        raise lost()

    with pytest.raises(GradebookError, match="did not come back within 60 s") as told:
        opened.transact(work)
    assert "\n" not in str(told.value)
    assert clock.now() == pytest.approx(60, abs=2)


class ClockThat(SimulatedClock):
    """A clock that does something as soon as somebody sleeps."""

    def __init__(self, does):
        super().__init__()
        self._does = does

    def sleep(self, seconds):
        self._does()
        super().sleep(seconds)


@pytest.mark.parametrize("made_before", [True, False])
def test_a_gradebook_that_another_program_has_locked_is_waited_for(tmp_path, made_before):
    file, told = tmp_path / "grades.db", []
    if made_before:
        database.Database(f"sqlite:///{file}", gradebook_rows.TABLES).close()
    other = sqlite3.connect(file)
    other.execute("BEGIN EXCLUSIVE")
    clock = ClockThat(other.rollback)
    opened = database.Database(
        f"sqlite:///{file}?timeout=0.01", gradebook_rows.TABLES, clock, told.append
    )
    assert opened.transact(lambda connection: "done", writes=True) == "done"
    assert len(told) == 1
    assert "another program has locked it" in told[0]


def test_a_gradebook_that_cannot_be_written_to_is_not_waited_for(tmp_path):
    database.Database(f"sqlite:///{tmp_path / 'grades.db'}", gradebook_rows.TABLES).close()
    url = f"sqlite:///file:{tmp_path / 'grades.db'}?mode=ro&uri=true"
    clock = ClockThat(lambda: pytest.fail("waited"))
    opened = database.Database(url, gradebook_rows.TABLES, clock)
    with pytest.raises(GradebookError, match="refuses: attempt to write a readonly database"):
        opened.transact(lambda c: c.exec_driver_sql("DELETE FROM ledger"), writes=True)


def test_a_secret_is_made_whole_or_not_at_all(tmp_path, monkeypatch):
    class Full(io.StringIO):
        def write(self, text):
            raise OSError(errno.ENOSPC, "No space left on device")

    def opened(handle, mode):
        os.close(handle)
        return Full()

    with monkeypatch.context() as full:
        full.setattr(judge.os, "fdopen", opened)
        with pytest.raises(OSError, match="No space left"):
            judge.load_secret(tmp_path / "secret", make=True)
    assert list(tmp_path.iterdir()) == []
    made = judge.load_secret(tmp_path / "secret", make=True)
    assert judge.load_secret(tmp_path / "secret", make=True) == made
    assert [path.name for path in tmp_path.iterdir()] == ["secret"]
    assert (tmp_path / "secret").stat().st_mode & 0o777 == 0o600


def test_a_server_that_ends_all_connections_is_connected_to_again(postgres):  # noqa: F811
    forget(postgres)
    told = []
    with Gradebook(postgres) as book:
        book._database._tell = told.append
        book.add(record())
        engine = sa.create_engine(postgres)
        with engine.begin() as other:
            ends = "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE pid <> {}"
            other.exec_driver_sql(ends.format("pg_backend_pid()"))
        engine.dispose()
        assert book.add(record(sha="c" * 64))
        assert len(book.attempts()) == 2
    assert len(told) == 1


def test_the_newest_attempt_is_told_by_a_counter_whatever_the_clock_says(tmp_path, monkeypatch):
    first, second, third = record(), record(sha="c" * 64), record(sha="d" * 64)
    books = [Gradebook(f"sqlite:///{tmp_path / name}.db") for name in ("one", "two", "all")]

    def stored(book, made, at):
        monkeypatch.setattr(gradebook_rows, "timestamp", lambda: at)
        book.add(made)
        book.override_points("anna.ipynb", "99", "99-double", float(at[:4]) - 2000, at)

    stored(books[0], first, "2031-01-01T00:00:00+00:00")
    stored(books[0], second, "2026-01-01T00:00:00+00:00")
    assert books[0].latest_attempts() == [second]
    assert books[0].overrides()["anna.ipynb", "99-double"][0] == 26
    for each in (books[0], books[1], books[0]):
        books[2].merge(each)
    assert books[2].latest_attempts() == [second]
    stored(books[2], third, "2027-01-01T00:00:00+00:00")
    assert books[2].latest_attempts() == [third]
    assert books[2].overrides()["anna.ipynb", "99-double"][0] == 27
    books[2].merge(books[0])
    assert books[2].latest_attempts() == [third]
    assert len(books[2].attempts()) == 3


def test_shards_differ_by_one_submission_at_most_and_an_empty_one_is_fine(tmp_path, capsys):
    found = [Submission(f"s{i}.ipynb", f"s{i}", tmp_path) for i in range(40)]
    sizes = [len(batch.select_shard(found, f"{i}/7")) for i in range(1, 8)]
    assert (min(sizes), max(sizes)) == (5, 6)
    folder = tmp_path / "class"
    folder.mkdir()
    (folder / "anna.ipynb").write_text(notebook(fake.SOLUTION))
    outs = [str(tmp_path / f"out{i}") for i in (1, 2)]
    for i, out in enumerate(outs, 1):
        words = [str(folder), "--out", out, "--shard", f"{i}/2", "--isolation", workers().level]
        assert main(["grade", *words]) == 0
    assert main(["grade", "merge", *outs, "--out", str(tmp_path / "all")]) == 0
    assert "1 submissions" in capsys.readouterr().out


@posix
def test_results_are_read_by_their_owner_only(tmp_path):
    folder, out = tmp_path / "class", tmp_path / "out"
    folder.mkdir()
    (folder / "anna.ipynb").write_text(notebook(fake.SOLUTION))
    words = ["grade", str(folder), "--out", str(out), "--isolation", workers().level]
    before = os.umask(0)
    try:
        assert main(words) == 0
        os.chmod(out / "grades.db", 0o644)  # as an older grader left it
        assert main(words) == 0
    finally:
        os.umask(before)
    modes = {path: stat.S_IMODE(path.stat().st_mode) for path in (out, *out.rglob("*"))}
    assert len(modes) == 9
    assert {path: oct(mode) for path, mode in modes.items() if mode & 0o077} == {}


# what a page could tell of the inputs

BY_LINE = """
def turn(v, angle):
    if angle < 0.6: raise ValueError('x')
    if angle < 0.9: raise ValueError('x')
    raise ValueError('x')
"""
BY_NUMBER = "def turn(v, angle):\n    return np.zeros(int(1000 * angle))\n"
BY_SIGNS = """
import slamlab.exercises.drives as d
def turn(v, angle):
    signs = ''.join(chr(0x2800 + int(c)) for c in str(angle) if c.isdigit())
    raise d.StudentError('malformed', f'turn is of type {signs}, not a function')
"""
BY_NAME = "def turn(v, angle):\n    raise [KeyError, EOFError, OSError][int(9 * angle) % 3]('x')\n"
BY_TYPE = "def turn(v, angle):\n    return ['x', {}, object(), b''][int(9 * angle) % 4]\n"


@pytest.mark.parametrize("cell", [BY_LINE, BY_NUMBER, BY_SIGNS, BY_NAME, BY_TYPE])
def test_what_is_said_of_a_failure_is_the_same_whatever_the_inputs(cell):
    said = set()
    for seed in range(6):
        numbered = list(enumerate((fake.SOLUTION, cell), 1))
        found = judge.judge_notebook(fake.EXERCISE, numbered, bytes([seed]), workers())
        said.add(found["verdicts"][1].problem)
    assert len(said) == 1


def test_a_cell_that_is_run_again_when_inputs_were_seen_tells_nothing(tmp_path):
    kept = str(tmp_path / "kept")  # without a sandbox; in one, a file's time or the clock will do
    tells = f"import os\nif os.path.exists({kept!r}): raise ValueError(open({kept!r}).read())"
    dies = f"def double(a):\n    open({kept!r}, 'w').write(str(a)); os._exit(0)\n"
    with WorkerPool(sandbox.NONE, warm=False) as pool:
        assert cells_of(tells, fake.SOLUTION + dies, by=pool) == {}
    assert Path(kept).exists()
