"""Collecting from homes and returning to them: traps of students, links, exchanges in between."""

import contextlib
import os
import shutil
import threading
from datetime import datetime

import pytest

from classroom.coursework import originals
from classroom.exercises import catalogue
from classroom.hub import exchange
from classroom.hub.student_server import FOLDER, hand_out
from course.pack import write_zip
from slamlab.cli import main
from tests.course.setup import ROOT

NAME = catalogue.exercise("04").file
ORIGINAL = (ROOT / "exercises" / NAME).read_bytes()
SOLVED = ORIGINAL.replace(b"    raise NotImplementedError", b"    return 1")
SECRET = b"another student's answer"


@pytest.fixture
def school(tmp_path, monkeypatch):
    """An installation, and the homes of three students; the solved notebook is Ada's alone."""
    installation = tmp_path / "installed"
    (installation / originals.ARCHIVE).parent.mkdir(parents=True)
    write_zip(installation / originals.ARCHIVE, {f"exercises/{NAME}": ORIGINAL})
    monkeypatch.setattr(exchange, "INSTALLATION", installation)
    for student in ("ada", "alan", "eve"):
        (tmp_path / "home" / student / FOLDER / "exercises").mkdir(parents=True)
    notebook(tmp_path, "ada").write_bytes(SOLVED)
    notebook(tmp_path, "alan").write_bytes(ORIGINAL)
    (tmp_path / "secret").write_bytes(SECRET)
    return tmp_path


def notebook(school, student):
    return school / "home" / student / FOLDER / "exercises" / NAME


def collected(school):
    new, same, problems = exchange.collect(
        exchange.users_in(school / "home"), school / "home", "04", school / "in"
    )
    assert not [p for p in (school / "in").rglob("*") if p.is_file() and SECRET in p.read_bytes()]
    return new, same, {line.partition(":")[0]: line for line in problems}


def test_changed_notebooks_are_collected_once_and_keep_their_first_time(school):
    new, same, problems = collected(school)
    assert (new, same, set(problems)) == (1, 0, {"alan", "eve"})
    assert "as it was handed out" in problems["alan"] and "missing" in problems["eve"]
    found = school / "in" / "ada" / NAME
    assert found.read_bytes() == SOLVED
    os.utime(found, (1, 1))
    assert collected(school)[:2] == (0, 1) and found.stat().st_mtime == 1
    notebook(school, "ada").write_bytes(SOLVED + b" ")
    assert collected(school)[:2] == (1, 0) and found.stat().st_mtime > 1


def link(path, target):
    path.symlink_to(target)


def folder_link(path, target):
    path.parent.rmdir()
    path.parent.symlink_to(target.parent)


TRAPS = {
    "a link": link,
    "a second name": lambda path, target: os.link(target, path),
    "a link in place of the folder": folder_link,
    "a pipe": lambda path, target: os.mkfifo(path),
    "a folder": lambda path, target: path.mkdir(),
    "a huge file": lambda path, target: (path.touch(), os.truncate(path, 10 << 30)),
}


@pytest.mark.parametrize("trap", TRAPS)
def test_a_trap_is_refused_and_the_others_are_collected(school, trap):
    target = school / NAME
    target.write_bytes(SECRET)
    TRAPS[trap](notebook(school, "eve"), target)
    new, _, problems = collected(school)
    assert new == 1 and "eve" in problems and not (school / "in" / "eve").exists()


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give a file away")
def test_a_file_or_folder_of_another_user_is_refused(school):
    for path in (notebook(school, "ada"), notebook(school, "alan").parent):
        os.chown(path, 12345, 12345)
    assert collected(school)[0] == 0 and {"ada", "alan"} <= set(collected(school)[2])


@pytest.mark.parametrize("name", ["../ada", "/etc", ".", "..", ".hidden", "nobody", ""])
def test_a_name_that_is_no_folder_of_a_user_is_refused(school, name):
    problems = exchange.collect([name], school / "home", "04", school / "in")[2]
    assert len(problems) == 1 and not (school / "in").exists()


def race(change, act):
    """Act many times while another thread changes what is there."""
    done = threading.Event()

    def keep_changing():
        while not done.is_set():
            change()

    changing = threading.Thread(target=keep_changing)
    changing.start()
    try:
        for _ in range(300):
            act()
    finally:
        done.set()
        changing.join()


def test_a_file_exchanged_for_a_link_at_any_moment_reveals_nothing(school):
    mine, spare = notebook(school, "eve"), notebook(school, "eve").with_name("spare")

    def change():
        spare.symlink_to(school / "secret")
        spare.replace(mine)
        spare.write_bytes(SOLVED)
        spare.replace(mine)

    race(change, lambda: collected(school))


def test_a_folder_exchanged_for_a_link_at_any_moment_moves_no_page(school):
    course, victim = school / "home" / "eve" / FOLDER, school / "victim"
    victim.mkdir()
    feedback, aside = course / "feedback", course / "aside"
    (school / "pages").mkdir()
    (school / "pages" / "eve.html").write_bytes(b"well done")

    def change():
        with contextlib.suppress(OSError):  # a page was written meanwhile
            if aside.is_dir():
                shutil.rmtree(aside)
            if feedback.is_symlink():
                feedback.unlink()
            else:
                feedback.rename(aside)
        with contextlib.suppress(OSError):
            feedback.symlink_to(victim)

    race(change, lambda: exchange.give_back(["eve"], school / "home", "04", school / "pages"))
    assert list(victim.iterdir()) == []


def test_feedback_is_returned_to_the_student_alone(school):
    (school / "pages").mkdir()
    for student in ("ada", "eve"):
        (school / "pages" / f"{student}.html").write_text(f"for {student}")
    (school / "home" / "eve" / FOLDER / "feedback").symlink_to(school)
    lines = exchange.give_back(["ada", "alan", "eve"], school / "home", "04", school / "pages")
    page = school / "home" / "ada" / FOLDER / "feedback" / "exercise-04.html"
    assert page.read_text() == "for ada" and page.stat().st_mode & 0o777 == 0o600
    assert lines[0].startswith("1 feedback") and lines[1].startswith("not returned: eve")
    exchange.give_back(["ada"], school / "home", "04", school / "pages")
    assert [p.name for p in page.parent.iterdir()] == [page.name]


def test_the_command_collects_what_the_roster_names(school, monkeypatch, capsys):
    monkeypatch.chdir(school)
    words = ["collect", "04", "--homes", str(school / "home"), "--into", "in"]
    assert main(words) == 1  # alan and eve
    assert "1 new or changed notebooks, 0 unchanged" in capsys.readouterr().out
    assert main(["grade", "init"]) == 0
    (school / "roster.csv").write_text("id,name\nada,Ada\nghost,G\n")
    assert main(words) == 1
    out = capsys.readouterr().out
    assert "ghost" in out and "eve" not in out and "0 new or changed notebooks, 1 unchanged" in out


def test_the_hand_out_restores_and_updates_but_never_overwrites_an_answer(school):
    folder, now = school / "home" / "eve" / FOLDER, datetime(2026, 11, 28)
    installation = school / "installed"
    (installation / "docs").mkdir()
    (installation / "docs" / "guide.md").write_text("a guide")
    assert hand_out(folder, installation, now) == [f"exercises/{NAME}: new"]
    assert notebook(school, "eve").read_bytes() == ORIGINAL
    assert (folder / "docs" / "guide.md").read_text() == "a guide"
    assert hand_out(folder, installation, now) == []
    notebook(school, "eve").write_bytes(SOLVED)
    new = ORIGINAL.replace(b"# ", b"# New: ", 1)
    write_zip(installation / originals.ARCHIVE, {f"exercises/{NAME}": new})
    (line,) = hand_out(folder, installation, now)
    assert "updated the text around your cells" in line
    merged = notebook(school, "eve").read_bytes()
    assert b"New: " in merged and merged.count(b"return 1") == SOLVED.count(b"return 1")
    assert SOLVED in [path.read_bytes() for path in notebook(school, "eve").parent.iterdir()]
    notebook(school, "eve").unlink()
    assert hand_out(folder, installation, now) == [f"exercises/{NAME}: restored"]
