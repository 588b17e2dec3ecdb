"""A contest from hash to board: resumed, revealed, judged again; names and cheaters stay out."""

import hashlib
import json
import re
import shutil
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from classroom.contest import contest_run, seed_commitment
from classroom.contest.class_judging import last_submissions
from classroom.contest.run_files import read_run, write_run
from classroom.grading.submissions import find_submissions
from classroom.grading.worker_pool import WorkerPool, WorkerStartError
from classroom.project.estimator_runs import EstimatorRun
from classroom.project.world_parameters import WORLD_FAMILIES, WorldFamily
from slamlab.cli import main
from tests.classroom.contest import cheaters
from tests.classroom.grading.conftest import notebook, table, workers

SMALL = WorldFamily("small", plans=(("crc", "rcr"),), metres=(20.0, 22.0))
CLASS = {
    "ada": [cheaters.SOLUTION],
    "bob": [cheaters.TEMPLATE],
    "cem": [source for _, source in cheaters.HARM["raises"]],
    "<b>dora": ["x = 1"],
    "fay": ["class MySlam: pass"],
}
JUDGED = ("ada", "bob", "cem", "fay")
NOBODY = SimpleNamespace(
    start=lambda exercise: (_ for _ in ()).throw(WorkerStartError("nobody is to be driven")),
    close=lambda: None,
)


def pool():
    return WorkerPool(workers().level, warm=False)


def run(held, out, by=NOBODY, found=None, **more):
    """Run the held contest (again); its messages."""
    found = held.found if found is None else found
    return contest_run.run_contest(held.contest, found, out, held.prepared_worlds, by, **more)


def lay(folder, **notebooks):
    folder.mkdir(exist_ok=True)
    for name, cells in notebooks.items():
        (folder / f"{name}.ipynb").write_text(notebook(*cells, exercise=None), "utf-8")
    return find_submissions(folder)


def pages(names):
    """The pages of these students."""
    return {f"{name}{end}.html" for name in names for end in ("", "-film")}


@pytest.fixture(scope="module")
def held(tmp_path_factory):
    """A contest in three worlds, held once for all tests of this module."""
    place = tmp_path_factory.mktemp("contest")
    WORLD_FAMILIES["small"] = SMALL
    contest = seed_commitment.draw_contest(("small",), 3)
    made = SimpleNamespace(
        contest=contest, found=lay(place / "class", **CLASS), out=place / "out",
        board=place / "out" / "board", messages=[], folder=place / "class",
        prepared_worlds=list(contest_run.prepare_contest_worlds(contest)),
    )  # fmt: skip
    made.summary = run(made, made.out, pool(), jobs=2, report=made.messages.append)
    made.given = json.loads((made.out / contest_run.PSEUDONYMS).read_text())
    yield made
    del WORLD_FAMILIES["small"]


def rows(folder, name="board.csv"):
    return table(folder / name)


@pytest.mark.slow
def test_the_better_is_ahead_and_who_fails_in_every_world_is_last(held):
    found = {row["name"]: row for row in rows(held.board)}
    ada, bob, cem = (found[held.given[name]] for name in ("ada", "bob", "cem"))
    assert ada["rank"] == "1"
    assert float(ada["score"]) > 50
    assert bob["rank"] == cem["rank"] == "2"
    assert bob["score"] == cem["score"] == "0.00"
    assert sorted(held.messages) == [f"{n}.ipynb" for n in JUDGED for _ in "123"]


def test_nothing_that_may_be_published_holds_a_name(held):
    for path in held.board.rglob("*"):
        text = path.read_text("utf-8") if path.is_file() else ""
        text = re.sub(r"[\w+/=]{1000,}", "", text)  # a film's bytes may spell any short word
        assert not re.search(r"\b(ada|bob|cem|dora|fay)\b", text), path
        assert path.stem not in CLASS


def test_the_revealed_seed_is_the_committed_one(held):
    revealed = (held.board / seed_commitment.REVEALED).read_bytes()
    assert hashlib.sha256(revealed).hexdigest() == held.contest.commitment
    assert held.contest.commitment in (held.board / "index.html").read_text("utf-8")
    assert held.contest.commitment in (held.board / seed_commitment.COMMITMENT).read_text()


def test_a_students_page_shows_the_position_of_the_first_large_error(held):
    slugs = {name: held.given[name].lower().replace(" ", "-") for name in ("bob", "cem")}
    page, film, other = (
        (held.board / "students" / f"{name}.html").read_text("utf-8")
        for name in (slugs["bob"], f"{slugs['bob']}-film", slugs["cem"])
    )
    for text in ("more than 0.25 m:", "<circle", f"{slugs['bob']}-film.html"):
        assert text in page
    assert 'id="film"' in film
    assert "ValueError: lost" in other


def test_it_continues_where_it_was_left_and_repeats_no_run(held, tmp_path):
    shutil.copytree(held.out / "drives", tmp_path / "drives")
    (lost,) = [*sorted((tmp_path / "drives").rglob("001.npz"))][:1]
    lost.write_bytes(lost.read_bytes()[:100])  # half written
    message = run(held, tmp_path)
    assert "3 judged" in message[0]
    assert any("nobody is to be driven" in line for line in message)
    assert not (tmp_path / "board" / seed_commitment.REVEALED).exists()
    run(held, tmp_path, pool())
    before, after = (
        sorted((r["sha256"], r["world"], r["points"]) for r in rows(place, "worlds.csv"))
        for place in (held.board, tmp_path / "board")
    )
    assert before == after


def test_a_submission_after_the_worlds_were_revealed_is_not_run(held, tmp_path):
    shutil.copytree(held.out, tmp_path / "out")
    found = lay(tmp_path / "class", **CLASS, zoe=[cheaters.TEMPLATE])
    message = run(held, tmp_path / "out", found=found)
    assert "4 judged, 2 not" in message[0]
    assert any(line.startswith("zoe: it was submitted after") for line in message)


def test_names_and_code_are_shown_where_they_are_asked_for_and_no_old_page_stays(held, tmp_path):
    shutil.copytree(held.out, tmp_path / "out")
    board = tmp_path / "out" / "board"
    assert not list(board.rglob("*-code.txt"))
    run(held, tmp_path / "out", names=True)
    assert {row["name"] for row in rows(board)} == set(JUDGED)
    page = (board / "index.html").read_text("utf-8")
    assert "&lt;b&gt;dora" in page and "<b>dora" not in page
    assert {p.name for p in (board / "students").iterdir()} == pages(JUDGED)
    run(held, tmp_path / "out", names=True, code=True)
    opened = {path.name: path.read_text("utf-8") for path in board.rglob("*-code.txt")}
    assert set(opened) == {f"{name}-code.txt" for name in JUDGED}
    assert cheaters.SOLUTION in opened["ada-code.txt"]
    assert 'href="ada-code.txt"' in (board / "students" / "ada.html").read_text("utf-8")


@pytest.mark.slow
def test_anyone_can_judge_again_and_what_was_late_is_carried_over(held, tmp_path):
    reported = tmp_path / "told"
    shutil.copytree(held.board, reported)
    text = (reported / "worlds.csv").read_text("utf-8").splitlines()
    of_bob = next(k for k, line in enumerate(text) if line.split(",")[4] == "0.0")
    cells = text[of_bob].split(",")
    cells[4], cells[13] = "12.5", "1"  # as if a limit of time had ended it there
    text[of_bob] = ",".join(cells)
    (reported / "worlds.csv").write_text("\n".join(text) + "\n", encoding="utf-8")
    assert contest_run.read_published_contest(reported) == held.contest
    out = tmp_path / "again"
    message = run(held, out, pool(), jobs=2, again=reported)
    assert message[-1] == "12 runs compared: points differ by at most 0"
    found = {(r["sha256"], r["world"]): r for r in rows(out / "board", "worlds.csv")}
    assert found[cells[1], cells[3]]["points"] == "12.5"


def test_the_last_notebook_with_the_class_takes_part(tmp_path):
    lay(tmp_path / "eva", a=["class MySlam: pass"], b=["y = 2"])
    (tmp_path / "broken.ipynb").write_text("{")
    found = last_submissions(find_submissions(tmp_path))
    assert [(s.student, s.problem is None) for s in found] == [("broken", False), ("eva", True)]
    assert found[1].name == "eva/a.ipynb"


def test_a_worker_that_exceeded_the_time_limit_is_reported_to_the_judge(held, tmp_path):
    shutil.copytree(held.out / "drives", tmp_path / "drives")
    assert not any("time limit" in line for line in held.summary)
    (file, *_) = sorted((tmp_path / "drives").rglob("002.npz"))
    write_run(file, replace(read_run(file), late=True))
    for stays_open in (True, False):
        message = run(held, tmp_path, stays_open=stays_open)
        (messages,) = [line for line in message if "time limit" in line]
        assert re.search(r"runs of: (ada|bob|cem|fay) \(1\)\. On a busy machine", messages)


@pytest.mark.parametrize(
    ("cell", "takes_part"),
    [
        ("class MySlam(Best):\n    pass", True),
        ("class Best:\n    pass\nMySlam = Best", True),
        ("class MySlam2: pass", False),
        ("MySlam == 1", False),
    ],
)
def test_every_class_with_the_required_name_takes_part(tmp_path, cell, takes_part):
    (found,) = last_submissions(lay(tmp_path, eva=["import numpy", cell]))
    assert (found.problem is None) == takes_part


@pytest.mark.parametrize("cut", [0, 40, -20])
def test_a_run_is_stored_exactly_and_a_truncated_file_is_ignored(tmp_path, cut):
    rng = np.random.default_rng(0)
    run = EstimatorRun(rng.random((5, 3)), rng.random((5, 3, 3)), rng.random((5, 3)),
                  rng.random((9, 2)), ("a mistake",), 1.25, True)  # fmt: skip
    file = tmp_path / "drives" / "0.npz"
    write_run(file, run)
    kept = read_run(file)
    np.testing.assert_array_equal(kept.points, run.points)
    assert (kept.mistakes, kept.seconds, kept.late) == (("a mistake",), 1.25, True)
    file.write_bytes(file.read_bytes()[:cut])
    assert read_run(file) is None


@pytest.mark.slow
@pytest.mark.usefixtures("held")
def test_the_command_judges_a_folder_and_reports_the_running_estimator(
    tmp_path, capsys, monkeypatch
):
    draw = seed_commitment.draw_contest
    monkeypatch.setattr(seed_commitment, "draw_contest", lambda worlds, logs: draw(("small",), 1))
    lay(tmp_path / "class", gil=[cheaters.TEMPLATE])
    out = tmp_path / "out"
    words = ["--out", str(out), "--isolation", workers().level]
    assert main(["contest", str(tmp_path / "class"), *words]) == 0
    output = capsys.readouterr()
    assert "1 judged, 0 not" in output.out
    assert output.err == "", "there is no progress bar without a terminal"
    (row,) = rows(out / "board")
    assert float(row["score"]) == 0


def test_without_a_folder_the_command_only_commits(tmp_path, capsys):
    assert main(["contest", "--out", str(tmp_path / "out")]) == 0
    output = capsys.readouterr().out.split()[0]
    assert output == (tmp_path / "out" / seed_commitment.COMMITMENT).read_text().split()[0]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--jobs", "0"], "--jobs must be at least 1"),
        (["--again", "{tmp}/nothing"], "--again needs the FOLDER"),
        (["{tmp}", "--again", "{tmp}/nothing", "--open"], "Leave out --open"),
        (["{tmp}", "--open", "--code"], "Leave out --open"),
        (["{tmp}/nothing"], "nothing does not exist"),
        (["{tmp}", "--again", "{tmp}/nothing"], "cannot be read"),
    ],
)
def test_wrong_use_is_reported_in_a_line(tmp_path, words, message, capsys):
    words = [word.format(tmp=tmp_path) for word in words]
    assert main(["contest", *words, "--out", str(tmp_path / "out")]) == 2
    assert message in capsys.readouterr().err


def test_while_it_is_open_only_scores_leave_and_then_it_closes(held, tmp_path):
    shutil.copytree(held.out / "drives", tmp_path / "drives")
    found = [s for s in held.found if s.name != "fay.ipynb"]
    message = run(held, tmp_path, found=found, stays_open=True)
    board = tmp_path / "board"
    assert {path.name for path in board.rglob("*")} == {"index.html", "board.csv"}
    given = json.loads((tmp_path / contest_run.PSEUDONYMS).read_text())
    shown = {row["name"]: row for row in rows(board)}
    assert set(shown[given["ada"]]) == {"name", "score"}
    assert int(shown[given["ada"]]["score"]) > 50
    assert shown[given["bob"]]["score"] == shown[given["cem"]]["score"] == "0"
    text = (board / "index.html").read_text("utf-8")
    assert held.contest.commitment in text
    assert held.contest.seed not in text
    assert "ValueError" not in text
    assert "open" in message[-1]
    run(held, tmp_path, found=found)
    assert (board / seed_commitment.REVEALED).exists()
    assert len(rows(board, "worlds.csv")) == 9
    with pytest.raises(seed_commitment.ContestError, match="is over"):
        run(held, tmp_path, found=found, stays_open=True)
