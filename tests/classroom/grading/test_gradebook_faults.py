"""Results are kept: interruptions, lost or locked databases, full disks, clocks, shards, rights."""

import dataclasses
import errno
import io
import os
import sqlite3
import stat
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest
import sqlalchemy as sa

from classroom.grading import batch, database, gradebook_rows, judge, result_storage
from classroom.grading.gradebook import Gradebook, GradebookError
from classroom.grading.submissions import Submission, SubmissionError
from slamlab.cli import main
from slamlab.devices.clock import SimulatedClock
from tests.classroom.grading import fake
from tests.classroom.grading.conftest import forget, notebook, posix, workers
from tests.classroom.grading.test_gradebook import record


@pytest.fixture
def book(tmp_path):
    with Gradebook(f"sqlite:///{tmp_path / 'grades.db'}") as opened:
        yield opened


def store(folder, book, records, **how):
    """Store records, reported one by one."""
    return list(result_storage.store_records((each for each in records), folder, book, **how))


def broken_off(records):
    yield from records
    raise KeyboardInterrupt


def test_an_interrupted_regrade_keeps_all_older_marks(tmp_path, book):
    older = [record(f"{name}.ipynb") for name in "abc"]
    newer = [dataclasses.replace(each, seconds={"wall": 1.0}) for each in older]
    store(tmp_path, book, older)
    before = {path: path.read_bytes() for path in tmp_path.rglob("*.*")}
    with pytest.raises(KeyboardInterrupt):
        store(tmp_path, book, broken_off(newer[:2]), regrade=True)
    assert book.latest_attempts() == older
    assert {path: path.read_bytes() for path in tmp_path.rglob("*.*")} == before
    store(tmp_path, book, newer, regrade=True)
    assert book.latest_attempts() == newer
    assert len(book.attempts()) == 3


def test_results_are_stored_in_batches_and_at_an_interruption(tmp_path, book, monkeypatch):
    monkeypatch.setattr(result_storage.time, "monotonic", lambda: 0.0)  # all of it in one moment
    made, stored, add_all = [record(f"{k}.ipynb") for k in range(6)], [], book.add_all
    monkeypatch.setattr(book, "add_all", lambda some: stored.append(len(some)) or add_all(some))
    reported = result_storage.store_records(broken_off(made), tmp_path, book)
    assert next(reported) == made[0]
    assert stored == [1]  # the first result of a batch is stored at once
    with pytest.raises(KeyboardInterrupt):
        list(reported)
    assert stored == [1, 5]
    assert book.latest_attempts() == made
    assert len(list((tmp_path / "feedback").iterdir())) == 6


def test_a_submission_at_which_a_regrade_fails_keeps_its_mark(tmp_path, book):
    older = record()
    failed = dataclasses.replace(older, verdicts=(), reason="no worker", failed=True)
    book.add(older)
    store(tmp_path, book, [failed], regrade=True)
    assert book.latest_attempts() == [older]
    assert ",1,3," in (tmp_path / "grades.csv").read_text("utf-8")


def test_concurrent_processes_create_the_tables_once(url):
    start = threading.Barrier(8)

    def come(number):
        start.wait()
        with Gradebook(url) as book:
            return book.add(record(f"{number}.ipynb"))

    with ThreadPoolExecutor(8) as threads:
        assert all(threads.map(come, range(8)))
    with Gradebook(url) as book:
        assert len(book.attempts()) == 8


@pytest.mark.parametrize("tries", [5, None])
def test_a_lost_database_is_awaited_for_a_minute_and_then_reported_in_one_line(tmp_path, tries):
    clock, messages, tried = SimulatedClock(), [], []
    place = f"sqlite:///{tmp_path / 'grades.db'}"
    opened = database.Database(place, database.TABLES, clock, messages.append)

    def work(connection):
        tried.append(clock.now())
        if len(tried) == tries:
            return "done"
        raise sa.exc.OperationalError("SELECT 1", {}, Exception("server closed the connection"))

    if tries:
        assert opened.transact(work) == "done"
    else:
        with pytest.raises(GradebookError, match="did not answer within 60 s") as raised:
            opened.transact(work)
        assert "\n" not in str(raised.value)
        assert clock.now() == pytest.approx(60, abs=2)
    (message,) = messages
    assert "waiting up to 60 s" in message


class ClockThat(SimulatedClock):
    """A clock that does something as soon as somebody sleeps."""

    def __init__(self, does):
        super().__init__()
        self._does = does

    def sleep(self, seconds):
        self._does()
        super().sleep(seconds)


@pytest.mark.parametrize("made_before", [True, False])
def test_a_gradebook_locked_by_another_program_is_awaited(tmp_path, made_before):
    file, messages = tmp_path / "grades.db", []
    if made_before:
        database.Database(f"sqlite:///{file}", database.TABLES).close()
    other = sqlite3.connect(file)
    other.execute("BEGIN EXCLUSIVE")
    clock = ClockThat(other.rollback)
    opened = database.Database(
        f"sqlite:///{file}?timeout=0.01", database.TABLES, clock, messages.append
    )
    assert opened.transact(lambda connection: "done", writes=True) == "done"
    assert len(messages) == 1
    assert "another program has locked the file" in messages[0]


def test_a_read_only_gradebook_is_not_awaited(tmp_path):
    database.Database(f"sqlite:///{tmp_path / 'grades.db'}", database.TABLES).close()
    place = f"sqlite:///file:{tmp_path / 'grades.db'}?mode=ro&uri=true"
    clock = ClockThat(lambda: pytest.fail("waited"))
    opened = database.Database(place, database.TABLES, clock)
    with pytest.raises(GradebookError, match="error: attempt to write a readonly database"):
        opened.transact(lambda c: c.exec_driver_sql("DELETE FROM ledger"), writes=True)


def test_a_secret_is_created_atomically(tmp_path, monkeypatch):
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


def test_lost_connections_to_a_server_are_replaced(postgres):
    forget(postgres)
    messages = []
    with Gradebook(postgres) as book:
        book._database._notify = messages.append
        book.add(record())
        engine = sa.create_engine(postgres)
        with engine.begin() as other:
            ends = "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE pid <> {}"
            other.exec_driver_sql(ends.format("pg_backend_pid()"))
        engine.dispose()
        assert book.add(record(sha="c" * 64))
        assert len(book.attempts()) == 2
    assert len(messages) == 1


def test_a_counter_and_no_clock_determines_the_newest_attempt(tmp_path, monkeypatch):
    first, second, third = record(), record(sha="c" * 64), record(sha="d" * 64)
    books = [Gradebook(f"sqlite:///{tmp_path / name}.db") for name in ("one", "two", "all")]

    def attempt(made):
        return made.submission, made.sha256

    def stored(book, made, at):
        monkeypatch.setattr(gradebook_rows, "timestamp", lambda: at)
        book.add(made)
        book.override_points(made, "99-double", float(at[:4]) - 2000, at)

    stored(books[0], first, "2031-01-01T00:00:00+00:00")
    stored(books[0], second, "2026-01-01T00:00:00+00:00")
    assert books[0].latest_attempts() == [second]
    assert books[0].overrides()[*attempt(second), "99-double"][0] == 26
    for each in (books[0], books[1], books[0]):
        books[2].merge(each)
    assert books[2].latest_attempts() == [second]
    stored(books[2], third, "2027-01-01T00:00:00+00:00")
    assert books[2].latest_attempts() == [third]
    assert books[2].overrides()[*attempt(third), "99-double"][0] == 27
    books[2].merge(books[0])
    assert books[2].latest_attempts() == [third]
    assert len(books[2].attempts()) == 3


def test_every_submission_is_in_one_of_some_shards_of_equal_size_or_less(tmp_path, capsys):
    found = [Submission(f"s{i}.ipynb", f"s{i}", tmp_path) for i in range(40)]
    shards = [batch.select_shard(found, f"{i}/7") for i in range(1, 8)]
    assert {len(shard) for shard in shards} == {5, 6}
    assert sorted(s.name for shard in shards for s in shard) == sorted(s.name for s in found)
    for wrong in ("0/3", "4/3", "1", "a/b", "1/0"):
        with pytest.raises(SubmissionError, match="--shard must be I/N"):
            batch.select_shard(found, wrong)
    outs = [str(tmp_path / f"out{i}") for i in (1, 2)]
    for i, out in enumerate(outs, 1):  # one of the two is empty
        assert main([*grading_one(tmp_path), "--out", out, "--shard", f"{i}/2"]) == 0
    assert main(["grade", "merge", *outs, "--out", str(tmp_path / "all")]) == 0
    assert "submissions in total: 1;" in capsys.readouterr().out


def grading_one(place):
    """Words of a command that grades one submission."""
    (place / "class").mkdir(exist_ok=True)
    (place / "class" / "anna.ipynb").write_text(notebook(fake.SOLUTION))
    return ["grade", str(place / "class"), "--isolation", workers().level]


@posix
def test_only_their_owner_can_read_results(tmp_path):
    out = tmp_path / "out"
    words = [*grading_one(tmp_path), "--out", str(out)]
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
