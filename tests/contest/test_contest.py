"""A contest from hash to board: resumed, revealed, judged again; names and cheaters stay out."""

import csv
import hashlib
import json
import re
import shutil
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from slamlab.cli import main
from slamlab.contest import commitment, holding
from slamlab.contest.class_judging import entrants
from slamlab.contest.drive_files import read_drive, write_drive
from slamlab.grading.submissions import find_submissions
from slamlab.grading.worker_pool import WorkerPool, WorkerStartError
from slamlab.project.driving import Drive
from slamlab.project.world_families import FAMILIES, Family
from tests.contest import cheaters
from tests.grading.conftest import notebook, workers

SMALL = Family("small", plans=(("crc", "rcr"),), metres=(20.0, 22.0))
CLASS = {
    "ada": [cheaters.SOLUTION],
    "bob": [cheaters.TEMPLATE],
    "cem": [source for _, source in cheaters.HARM["raises"]],
    "<b>dora": ["x = 1"],
    "fay": ["class MySlam: pass"],
}
NOBODY = SimpleNamespace(
    start=lambda exercise: (_ for _ in ()).throw(WorkerStartError("nobody is to be driven")),
    close=lambda: None,
)


def pool():
    return WorkerPool(workers().level, warm=False)


@pytest.fixture(scope="module")
def held(tmp_path_factory):
    """A contest in three worlds, held once for all tests of this module."""
    place = tmp_path_factory.mktemp("contest")
    FAMILIES["small"] = SMALL
    (place / "class").mkdir()
    for name, cells in CLASS.items():
        text = notebook(*cells, exercise=None)
        (place / "class" / f"{name}.ipynb").write_text(text, encoding="utf-8")
    contest = commitment.draw_contest(("small",), 3)
    arenas = list(holding.draw_arenas(contest))
    found = find_submissions(place / "class")
    told = []
    said = holding.hold_contest(
        contest, found, place / "out", arenas, pool(), jobs=2, told=told.append
    )
    yield SimpleNamespace(
        contest=contest, found=found, out=place / "out", board=place / "out" / "board",
        arenas=arenas, said=said, told=told, folder=place / "class",
    )  # fmt: skip
    del FAMILIES["small"]


def rows(folder, name="board.csv"):
    with open(folder / name, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.mark.slow
def test_the_better_is_ahead_and_who_fails_in_every_world_is_last(held):
    given = json.loads((held.out / holding.PSEUDONYMS).read_text())
    found = {row["name"]: row for row in rows(held.board)}
    ada, bob, cem = (found[given[name]] for name in ("ada", "bob", "cem"))
    assert ada["rank"] == "1"
    assert float(ada["score"]) > 50
    assert bob["rank"] == cem["rank"] == "2"
    assert bob["score"] == cem["score"] == "0.00"
    assert sorted(held.told) == sorted(
        f"{n}.ipynb" for n in ("ada", "bob", "cem", "fay") for _ in "123"
    )


def test_nothing_that_may_be_published_holds_a_name(held):
    for path in held.board.rglob("*"):
        text = path.read_text("utf-8") if path.is_file() else ""
        text = re.sub(r"[\w+/=]{1000,}", "", text)  # a film's bytes may spell any short word
        assert not re.search(r"\b(ada|bob|cem|dora|fay)\b", text), path
        assert path.stem not in CLASS


def test_what_is_revealed_is_what_was_committed(held):
    revealed = (held.board / commitment.REVEALED).read_bytes()
    assert hashlib.sha256(revealed).hexdigest() == held.contest.commitment
    assert held.contest.commitment in (held.board / "index.html").read_text("utf-8")
    assert held.contest.commitment in (held.board / commitment.COMMITMENT).read_text()


def test_a_student_is_told_where_it_went_wrong_and_shown(held):
    given = json.loads((held.out / holding.PSEUDONYMS).read_text())
    slug = given["bob"].lower().replace(" ", "-")
    page = (held.board / "students" / f"{slug}.html").read_text("utf-8")
    assert "more than the 0.25 m of the band" in page
    assert "<circle" in page
    assert f"{slug}-film.html" in page
    film = (held.board / "students" / f"{slug}-film.html").read_text("utf-8")
    assert 'id="film"' in film
    cem = given["cem"].lower().replace(" ", "-")
    assert "ValueError: lost" in (held.board / "students" / f"{cem}.html").read_text("utf-8")


def test_it_goes_on_where_it_was_left_and_drives_nobody_again(held, tmp_path):
    shutil.copytree(held.out / "drives", tmp_path / "drives")
    (lost,) = [*sorted((tmp_path / "drives").rglob("001.npz"))][:1]
    lost.write_bytes(lost.read_bytes()[:100])  # half written
    said = holding.hold_contest(held.contest, held.found, tmp_path, held.arenas, NOBODY)
    assert "3 judged" in said[0]
    assert any("nobody is to be driven" in line for line in said)
    assert not (tmp_path / "board" / commitment.REVEALED).exists()
    holding.hold_contest(held.contest, held.found, tmp_path, held.arenas, pool())
    before, after = (
        sorted((r["sha256"], r["world"], r["points"]) for r in rows(place, "worlds.csv"))
        for place in (held.board, tmp_path / "board")
    )
    assert before == after


def test_what_comes_after_the_worlds_were_revealed_is_not_driven(held, tmp_path):
    shutil.copytree(held.out, tmp_path / "out")
    late = tmp_path / "class"
    shutil.copytree(held.folder, late)
    (late / "zoe.ipynb").write_text(notebook(cheaters.TEMPLATE, exercise=None))
    found = find_submissions(late)
    said = holding.hold_contest(held.contest, found, tmp_path / "out", held.arenas, NOBODY)
    assert "4 judged, 2 not" in said[0]
    assert any(line.startswith("zoe: it came after") for line in said)


def test_names_are_shown_where_they_are_asked_for_and_escaped_and_no_old_page_stays(held, tmp_path):
    shutil.copytree(held.out, tmp_path / "out")
    holding.hold_contest(
        held.contest, held.found, tmp_path / "out", held.arenas, NOBODY, names=True
    )
    board = tmp_path / "out" / "board"
    assert {row["name"] for row in rows(board)} == {"ada", "bob", "cem", "fay"}
    page = (board / "index.html").read_text("utf-8")
    assert "&lt;b&gt;dora" in page
    assert "<b>dora" not in page
    assert {p.name for p in (board / "students").iterdir()} == {
        f"{name}{end}.html" for name in ("ada", "bob", "cem", "fay") for end in ("", "-film")
    }


@pytest.mark.slow
def test_anyone_can_judge_again_and_what_was_late_is_carried_over(held, tmp_path):
    told = tmp_path / "told"
    shutil.copytree(held.board, told)
    text = (told / "worlds.csv").read_text("utf-8").splitlines()
    of_bob = next(k for k, line in enumerate(text) if line.split(",")[4] == "0.0")
    cells = text[of_bob].split(",")
    cells[4], cells[13] = "12.5", "1"  # as if a limit of time had ended it there
    text[of_bob] = ",".join(cells)
    (told / "worlds.csv").write_text("\n".join(text) + "\n", encoding="utf-8")
    contest = holding.contest_again(told)
    assert contest == held.contest
    out = tmp_path / "again"
    said = holding.hold_contest(contest, held.found, out, held.arenas, pool(), jobs=2, again=told)
    assert said[-1] == "12 worlds compared: points differ by 0 at most"
    found = {(r["sha256"], r["world"]): r for r in rows(out / "board", "worlds.csv")}
    assert found[cells[1], cells[3]]["points"] == "12.5"


def test_the_last_notebook_with_the_class_takes_part(tmp_path):
    for name, cells in {"a": ["class MySlam: pass"], "b": ["y = 2"]}.items():
        (tmp_path / "eva").mkdir(exist_ok=True)
        (tmp_path / "eva" / f"{name}.ipynb").write_text(notebook(*cells, exercise=None))
    (tmp_path / "broken.ipynb").write_text("{")
    found = entrants(find_submissions(tmp_path))
    assert [(s.student, s.problem is None) for s in found] == [("broken", False), ("eva", True)]
    assert found[1].name == "eva/a.ipynb"


def test_whom_a_limit_of_time_ended_is_told_to_the_judge(held, tmp_path):
    shutil.copytree(held.out / "drives", tmp_path / "drives")
    assert not any("limit of time" in line for line in held.said)
    (file, *_) = sorted((tmp_path / "drives").rglob("002.npz"))
    write_drive(file, replace(read_drive(file), late=True))
    keep = {"workers": NOBODY, "prepared": held.arenas, "out": tmp_path}
    for stays_open in (True, False):
        said = holding.hold_contest(held.contest, held.found, stays_open=stays_open, **keep)
        (told,) = [line for line in said if "limit of time" in line]
        assert re.search(r"worlds of (ada|bob|cem|fay) \(1\); on a machine", told)


@pytest.mark.parametrize(
    ("cell", "takes_part"),
    [
        ("class MySlam(Best):\n    pass", True),
        ("class Best:\n    pass\nMySlam = Best", True),
        ("class MySlam2: pass", False),
        ("print(MySlam == 1)", False),
        ("MySlam == 1", False),
    ],
)
def test_whoever_gives_a_class_the_name_takes_part(tmp_path, cell, takes_part):
    (tmp_path / "eva.ipynb").write_text(notebook("import numpy", cell, exercise=None))
    (found,) = entrants(find_submissions(tmp_path))
    assert (found.problem is None) == takes_part


@pytest.mark.parametrize("cut", [0, 40, -20])
def test_a_drive_is_kept_as_it_is_and_half_a_file_is_none(tmp_path, cut):
    rng = np.random.default_rng(0)
    drive = Drive(rng.random((5, 3)), rng.random((5, 3, 3)), rng.random((5, 3)),
                  rng.random((9, 2)), ("a mistake",), 1.25, True)  # fmt: skip
    file = tmp_path / "drives" / "0.npz"
    write_drive(file, drive)
    kept = read_drive(file)
    np.testing.assert_array_equal(kept.points, drive.points)
    assert (kept.mistakes, kept.seconds, kept.late) == (("a mistake",), 1.25, True)
    file.write_bytes(file.read_bytes()[:cut])
    assert read_drive(file) is None


@pytest.mark.slow
@pytest.mark.usefixtures("held")
def test_the_command_judges_a_folder_and_tells_who_is_driven(tmp_path, capsys, monkeypatch):
    draw = commitment.draw_contest
    monkeypatch.setattr(commitment, "draw_contest", lambda worlds, logs: draw(("small",), 1))
    (tmp_path / "class").mkdir()
    (tmp_path / "class" / "gil.ipynb").write_text(notebook(cheaters.TEMPLATE, exercise=None))
    out = tmp_path / "out"
    words = ["--out", str(out), "--isolation", workers().level]
    assert main(["contest", str(tmp_path / "class"), *words]) == 0
    said = capsys.readouterr()
    assert "1 judged, 0 not" in said.out
    assert "gil.ipynb" in said.err
    (row,) = rows(out / "board")
    assert float(row["score"]) == 0


def test_without_a_folder_the_command_only_commits(tmp_path, capsys):
    assert main(["contest", "--out", str(tmp_path / "out")]) == 0
    told = capsys.readouterr().out.split()[0]
    assert told == (tmp_path / "out" / commitment.COMMITMENT).read_text().split()[0]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--jobs", "0"], "--jobs must be at least 1"),
        (["--again", "{tmp}/nothing"], "--again needs the FOLDER"),
        (["{tmp}", "--again", "{tmp}/nothing", "--open"], "--open for one that is not"),
        (["{tmp}", "--open", "--code"], "leave out --open"),
        (["{tmp}/nothing"], "nothing is not there"),
        (["{tmp}", "--again", "{tmp}/nothing"], "cannot be read"),
    ],
)
def test_wrong_use_is_told_in_a_line(tmp_path, words, told, capsys):
    words = [word.format(tmp=tmp_path) for word in words]
    assert main(["contest", *words, "--out", str(tmp_path / "out")]) == 2
    assert told in capsys.readouterr().err


def test_while_it_is_open_only_scores_leave_and_then_it_closes(held, tmp_path):
    shutil.copytree(held.out / "drives", tmp_path / "drives")
    keep = {"workers": NOBODY, "prepared": held.arenas, "out": tmp_path}
    found = [s for s in held.found if s.name != "fay.ipynb"]
    said = holding.hold_contest(held.contest, found, stays_open=True, **keep)
    board = tmp_path / "board"
    assert {path.name for path in board.rglob("*")} == {"index.html", "board.csv"}
    given = json.loads((tmp_path / holding.PSEUDONYMS).read_text())
    shown = {row["name"]: row for row in rows(board)}
    assert set(shown[given["ada"]]) == {"name", "score"}
    assert int(shown[given["ada"]]["score"]) > 50
    assert shown[given["bob"]]["score"] == shown[given["cem"]]["score"] == "0"
    text = (board / "index.html").read_text("utf-8")
    assert held.contest.commitment in text
    assert held.contest.seed not in text
    assert "ValueError" not in text
    assert "open" in said[-1]
    holding.hold_contest(held.contest, found, **keep)
    assert (board / commitment.REVEALED).exists()
    assert len(rows(board, "worlds.csv")) == 9
    with pytest.raises(commitment.ContestError, match="is over"):
        holding.hold_contest(held.contest, found, stays_open=True, **keep)


def test_a_second_phase_opens_the_code_of_those_who_were_judged_and_no_other(held, tmp_path):
    shutil.copytree(held.out, tmp_path / "out")
    board = tmp_path / "out" / "board"
    assert not list(board.rglob("*-code.txt"))
    holding.hold_contest(
        held.contest, held.found, tmp_path / "out", held.arenas, NOBODY, names=True, code=True
    )
    opened = {path.name: path.read_text("utf-8") for path in board.rglob("*-code.txt")}
    assert set(opened) == {f"{name}-code.txt" for name in ("ada", "bob", "cem", "fay")}
    assert cheaters.SOLUTION in opened["ada-code.txt"]
    assert 'href="ada-code.txt"' in (board / "students" / "ada.html").read_text("utf-8")
