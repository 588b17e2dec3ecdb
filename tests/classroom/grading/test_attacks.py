"""A hostile class forges, leaks and harms nothing, and ordinary notebooks get their marks."""

import contextlib
import os
import socket
import sys
import time
from pathlib import Path

import pytest

from classroom.grading import sandbox, worker_client
from classroom.grading.gradebook import Gradebook
from slamlab.cli import main
from tests.classroom.grading import attacks, fake
from tests.classroom.grading.conftest import know_the_fake, lacks, notebook

ROOT = Path(__file__).resolve().parents[3]
SECRET = "the canary sings"
ODD_NAMES = ["with space", "quo'te\"d", "line\nbreak", "Zoë", "=1+1", "-rf", "$(touch x)", "04"]
ODD_NAMES += ["\x1b[31mred\x07", "anna;=1+1", "\u202egnp", "x" * 200, "[bold]", "%s%n"]


def submissions():
    """Name to the text or bytes of every notebook of the class."""
    ordinary = notebook("import numpy as np", fake.SOLUTION)
    made = {"ordinary": ordinary}
    for name, cell in attacks.FORGERIES.items():
        made[f"forges {name}"] = notebook("import numpy as np", attacks.WRONG, cell)
    for name, cell in attacks.SPIES.items():
        made[f"spies {name}"] = notebook("HEAD", attacks.LEAK, cell, attacks.WRONG)
    for name, cell in attacks.HARMS.items():
        made[f"harms {name}"] = notebook("HEAD", attacks.HARM, fake.SOLUTION, cell)
    for name, damage in attacks.DAMAGED.items():
        made[f"damaged {name}"] = damage(ordinary)
    for name in ODD_NAMES:
        made[name] = ordinary
    return made


@pytest.fixture(scope="module", params=[sandbox.STRICT, sandbox.BASIC])
def graded(tmp_path_factory, request):
    """The class as graded, with what to look at afterwards, at each isolation level."""
    level = request.param
    if lacks(level):
        pytest.skip(lacks(level))
    folder, out, judges = (tmp_path_factory.mktemp(n) for n in ("class", "out", "judges"))
    temporary = tmp_path_factory.mktemp("temporary")
    canary = judges / "canary"
    canary.write_text(SECRET)
    with socket.socket() as server, pytest.MonkeyPatch.context() as patch:
        server.bind(("127.0.0.1", 0))
        server.listen()
        server.settimeout(0.2)
        reported = {"CANARY": str(canary), "OUT": str(out), "CLASS": str(folder), "ROOT": str(ROOT)}
        reported |= {"JUDGE": os.getpid(), "PORT": server.getsockname()[1]}
        head = "\\n".join(f"{name} = {value!r}" for name, value in reported.items())
        for name, content in submissions().items():
            path = folder / f"{name}.ipynb"
            if content is None:
                path.mkdir()
                continue
            if isinstance(content, str):
                content = content.replace("HEAD", head).encode()
            path.write_bytes(content)
        know_the_fake(patch)
        patch.setattr(worker_client, "CELL_TIMEOUT", 3.0)
        patch.setattr("tempfile.tempdir", str(temporary))
        words = [str(folder), "--out", str(out), "--jobs", "2", "--exercise", "99"]
        code = main(["grade", *words, "--isolation", level])
        received = True
        try:
            server.accept()
        except TimeoutError:
            received = False
    with Gradebook(f"sqlite:///{out / 'grades.db'}") as book:
        records = {
            record.submission.removesuffix(".ipynb"): record for record in book.latest_attempts()
        }
    return {"code": code, "records": records, "out": out, "canary": canary, "heard": received,
            "temporary": temporary, "level": level}  # fmt: skip


def of(graded, kind):
    return {name: r for name, r in graded["records"].items() if name.startswith(kind + " ")}


@pytest.mark.slow
def test_the_class_is_graded_to_its_end_and_everybody_is_listed(graded):
    assert graded["code"] == 1
    assert len(graded["records"]) == len(submissions()) > 40
    assert {r.isolation for r in graded["records"].values()} <= {graded["level"], None}


def test_no_point_is_forged(graded):
    forged = {name: r.score for name, r in of(graded, "forges").items() if r.score}
    assert forged == {}
    assert len(of(graded, "forges")) == len(attacks.FORGERIES)


def test_nothing_is_leaked(graded):
    spied = of(graded, "spies")
    reported = {name: r.cells for name, r in spied.items() if "LEAKED" in str(r.cells)}
    assert reported == {}
    written = [path for path in graded["out"].rglob("*") if path.is_file()]
    found = [p.name for p in written if p.name != "secret" and SECRET.encode() in p.read_bytes()]
    assert found == []


def test_attacking_submissions_are_graded_like_others(graded):
    assert {name: r.score for name, r in of(graded, "spies").items() if r.score != 0} == {}
    lost = {name: r.score for name, r in of(graded, "harms").items() if r.score != 8}
    # whose process is gone in the middle of a cell has lost no more than that cell
    assert lost == {}


def test_nothing_outside_is_touched(graded):
    assert graded["canary"].read_text() == SECRET
    assert [path.name for path in graded["canary"].parent.iterdir()] == ["canary"]
    assert {path.name for path in graded["out"].iterdir()} == {
        "grades.csv", "moodle.csv", "canvas.csv", "class.html", "grades.db", "feedback", "secret",
    }  # fmt: skip
    assert not Path("/tmp/forged-by-a-student").exists()
    assert not graded["heard"]


@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
def test_no_process_and_no_file_is_left(graded):
    time.sleep(0.3)
    left, folder = [], os.fsencode(graded["temporary"])
    for path in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):  # it has just ended
            left += [path] * (folder in path.read_bytes())
    assert left == []
    assert list(graded["temporary"].iterdir()) == []


def test_ordinary_notebooks_get_full_marks_whatever_their_names(graded):
    for name in ("ordinary", *ODD_NAMES):
        (score,) = {r.score for n, r in graded["records"].items() if same(n, name)}
        assert score == 8, name


def same(name, wanted):
    return name.replace("\\n", "\n") == wanted


def test_damaged_submissions_are_graded_or_listed_with_the_reason(graded):
    damaged = of(graded, "damaged")
    assert len(damaged) == len(attacks.DAMAGED)
    for name, record in damaged.items():
        assert record.graded or record.reason, name
    full = {name.removeprefix("damaged ") for name, r in damaged.items() if r.score == 8}
    assert full == attacks.GRADED


def test_no_script_of_a_submission_reaches_a_page(graded):
    for page in (graded["out"] / "class.html", *(graded["out"] / "feedback").iterdir()):
        assert "<script" not in page.read_text("utf-8")
