"""``slamlab grade review`` from its first line to its end."""

import csv
import os
import re
import signal
import subprocess
import sys

import pytest

from slamlab.cli import main
from slamlab.exercises.verdict import Verdict
from slamlab.grading.gradebook import Gradebook, default_url
from slamlab.grading.records import Record
from tests.listening.client import Client, run
from tests.patience import PATIENCE

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


def review(*words):
    """The command as a process."""
    code = "import sys; from slamlab.cli import main; sys.exit(main(sys.argv[1:]))"
    return subprocess.Popen(
        [sys.executable, "-c", code, "grade", "review", "--no-open", *words],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="a process is asked to end by SIGINT")
@pytest.mark.parametrize("end", ["SIGINT", "SIGTERM"])
def test_what_is_changed_stands_in_the_tables_at_the_end(folder, end):
    (folder / "results/04/release").mkdir(parents=True)
    process = review("--as", "Tutor")
    try:
        first = process.stdout.readline()
        port, token = re.fullmatch(r"open http://127\.0\.0\.1:(\d+)/#(\S+)\n", first).groups()
        said = {"seen": 0, "task": "04-h-robot", "points": 3, "text": "nearly"}

        async def changed():
            client = Client(int(port))
            assert await client.enter(token) == 200
            return (await client.ask("POST", "/submission/0/04", said))[0]

        assert run(changed()) == 200
        process.send_signal(getattr(signal, end))
        rest = process.stdout.read()
        process.wait(PATIENCE)
    finally:
        process.kill()
    assert process.returncode == 0 and "made by Tutor" in rest
    assert "released already: slamlab grade release 04" in rest
    with open(folder / "results/04/grades.csv", encoding="utf-8", newline="") as file:
        (row,) = csv.DictReader(file)
    assert row["score"] == "3" and "nearly" in row["note"]
    assert "nearly" in (folder / "results/04/feedback/s1.html").read_text("utf-8")


def test_without_a_term_or_a_gradebook_it_says_what_to_do(folder, capsys):
    words = ["grade", "review", "--no-open"]
    assert main([*words, "--requests", "nowhere.csv"]) == 2
    assert "nowhere.csv: No such file" in capsys.readouterr().err
    assert main([*words, "--port", "99999"]) == 2
    assert "0 to 65535" in capsys.readouterr().err
    (folder / "results/grades.db").unlink()
    assert main(words) == 2
    assert "grade first" in capsys.readouterr().err
    (folder / "course.toml").unlink()
    assert main(words) == 2
    assert "slamlab grade init" in capsys.readouterr().err
