"""``slamlab grade review`` from its first line to its end."""

import os
import re
import signal
import subprocess

import pytest

from classroom.exercises.verdict import Verdict
from classroom.grading.gradebook import Gradebook, default_url
from classroom.grading.records import Record
from slamlab.cli import main
from tests.classroom.grading.conftest import slamlab, table
from tests.slamlab.web_server.client import Client, run
from tests.timeouts import PATIENCE

COURSE = 'time_zone = "UTC"\n[exercises.04]\n'


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A term of one student who has handed in 04."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "course.toml").write_text(COURSE, "utf-8")
    (tmp_path / "roster.csv").write_text("id,name\ns1,Ana Kos\n", "utf-8")
    (tmp_path / "results").mkdir()
    record = Record("s1.ipynb", "s1", "04", verdicts=(Verdict("04-h-robot", 1.0, 3.5),),
                    sha256="a" * 64, seed="b" * 64, titles={"04-h-robot": "H"})  # fmt: skip
    with Gradebook(default_url(tmp_path / "results")) as book:
        book.add(record)
    return tmp_path


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="a process is asked to end by SIGINT")
@pytest.mark.parametrize("end", ["SIGINT", "SIGTERM"])
def test_changes_are_in_the_tables_at_the_end(folder, end):
    (folder / "results/04/release").mkdir(parents=True)
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    process = slamlab("grade", "review", "--no-open", "--as", "Tutor", **pipes)
    try:
        first = process.stdout.readline()
        port, token = re.fullmatch(r"open http://127\.0\.0\.1:(\d+)/#(\S+)\n", first).groups()
        message = {"seen": 0, "task": "04-h-robot", "points": 3, "text": "nearly"}

        async def changed():
            client = Client(int(port))
            assert await client.log_in(token) == 200
            return (await client.ask("POST", "/submission/0/04", message))[0]

        assert run(changed()) == 200
        process.send_signal(getattr(signal, end))
        rest = process.stdout.read()
        process.wait(PATIENCE)
    finally:
        process.kill()
    assert process.returncode == 0 and "made by Tutor" in rest
    assert "Release it again: slamlab grade release 04" in rest
    (row,) = table(folder / "results/04/grades.csv")
    assert row["score"] == "3" and "nearly" in row["note"]
    assert "nearly" in (folder / "results/04/feedback/s1.html").read_text("utf-8")


def test_without_a_term_or_a_gradebook_it_states_what_to_do(folder, capsys):
    for words, lost, message in (
        (["--requests", "nowhere.csv"], None, "nowhere.csv: No such file"),
        (["--port", "99999"], None, "0 to 65535"),
        ([], "results/grades.db", "grade submissions first"),
        ([], "course.toml", "slamlab grade init"),
    ):
        if lost:
            (folder / lost).unlink()
        assert main(["grade", "review", "--no-open", *words]) == 2
        assert message in capsys.readouterr().err
