"""Reset and update: the handed-out form comes back, a new edition comes in, no answer is lost."""

import contextlib
import json
import subprocess
import zipfile
from datetime import datetime
from pathlib import Path

import pytest

from classroom.coursework import file_writing, notebook_reset, notebook_update, originals
from classroom.coursework.file_writing import json_bytes
from classroom.coursework.notebook_reset import ResetError
from course.pack import write_zip
from slamlab.cli import main

NOW = datetime(2026, 11, 22, 18, 0, 0)
EXERCISE, LESSON = "exercises/ex04_models.ipynb", "notebooks/04_models.ipynb"


def code(id, source, **nbgrader):
    metadata = {"nbgrader": {"grade_id": id, **nbgrader}} if nbgrader else {}
    return {
        "cell_type": "code", "id": id, "metadata": metadata, "source": source,
        "outputs": [], "execution_count": None,
    }  # fmt: skip


def text(id, source):
    return {"cell_type": "markdown", "id": id, "metadata": {}, "source": source}


def handed_out(edition=1):
    """An exercise with two tasks; the second edition has new text and one more cell."""
    stub = "raise NotImplementedError"
    cells = [
        text("head", f"Edition {edition}"),
        code("a", f"def a():\n    {stub}", solution=True),
        code("a2", f"def a2():\n    {stub}", solution=True),
        code("04-a", 'check("04-a")', grade=True, points=edition),
        code("b", f"def b():\n    {stub}", solution=True),
        code("04-b", 'check("04-b")', grade=True, points=2),
    ]
    if edition > 1:
        cells.insert(3, text("more", "A hint"))
    return {"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}


def make_pack(place, edition=1):
    for name, notebook in ((EXERCISE, handed_out(edition)), (LESSON, handed_out(1))):
        file_writing.write(place / name, json_bytes(notebook))
    file_writing.write(place / "lab.py", b"edition %d" % edition)
    file_writing.write(place / "slamlab" / "new.py", b"edition %d" % edition)
    file_writing.write(place / "pages" / f"film-{edition}.js", b"edition %d" % edition)
    (place / originals.ARCHIVE).parent.mkdir(parents=True)
    names = (EXERCISE, LESSON)
    write_zip(place / originals.ARCHIVE, {n: (place / n).read_bytes() for n in names})
    return place


@pytest.fixture
def pack(tmp_path):
    """The file of the second edition."""
    place, target = make_pack(tmp_path / "new", 2), tmp_path / "new.zip"
    with zipfile.ZipFile(target, "w") as packed:
        for path in filter(Path.is_file, place.rglob("*")):
            packed.write(path, f"slam-course/{path.relative_to(place).as_posix()}")
    return target


@pytest.fixture
def course(tmp_path):
    """A students' pack in which task a was solved, and a cell written."""
    folder = make_pack(tmp_path / "course")
    solve(folder / EXERCISE)
    return folder


@contextlib.contextmanager
def edited(path):
    """The cells of a notebook, which are saved again."""
    notebook = json.loads(path.read_bytes())
    yield notebook["cells"]
    file_writing.write(path, json_bytes(notebook))


def solve(path):
    with edited(path) as cells:
        cells[1]["source"] = "def a():\n    return 1"
        cells.insert(3, code("mine", "print(a())"))


def read(path):
    return {cell["id"]: cell["source"] for cell in json.loads(path.read_bytes())["cells"]}


def kept(course):
    return [path for path in course.rglob("* 2026-11-22 18-00-00*.ipynb")]


@pytest.mark.parametrize("what", ["04", "4", "ex04", EXERCISE])
def test_an_exercise_is_as_it_was_handed_out_and_the_old_form_is_kept(course, what, monkeypatch):
    monkeypatch.chdir(course)
    before = (course / EXERCISE).read_bytes()
    reported = notebook_reset.reset(course, what, NOW)
    assert (course / EXERCISE).read_bytes() == json_bytes(handed_out())
    (copy,) = kept(course)
    assert copy.read_bytes() == before
    assert any(copy.name in line for line in reported)


def test_a_lesson_is_reset_and_a_lost_file_comes_back(course):
    (course / LESSON).unlink()
    notebook_reset.reset(course, "lesson-04", NOW)
    assert (course / LESSON).read_bytes() == json_bytes(handed_out())
    assert kept(course) == []


def test_a_tasks_cells_are_reset_with_the_output_of_its_check_and_all_else_stays(course):
    message = {"output_type": "stream", "name": "stdout", "text": "full marks"}
    with edited(course / EXERCISE) as cells:
        for cell in cells:
            if cell["id"] in ("04-a", "04-b"):
                cell["outputs"] = [message]
    notebook_reset.reset(course, "04-a", NOW)
    after = read(course / EXERCISE)
    assert "NotImplementedError" in after["a"]
    assert after["mine"] == "print(a())"
    cells = json.loads((course / EXERCISE).read_bytes())["cells"]
    outputs = {cell["id"]: cell.get("outputs") for cell in cells}
    assert not outputs["04-a"]
    assert outputs["04-b"] == [message]


def test_a_tasks_cell_that_was_deleted_comes_back_before_its_check(course):
    with edited(course / EXERCISE) as cells:
        cells[:] = [cell for cell in cells if cell["id"] not in ("a", "a2", "b")]
    notebook_reset.reset(course, "04-a", NOW)
    assert list(read(course / EXERCISE)) == ["head", "mine", "a", "a2", "04-a", "04-b"]


def test_resets_in_one_second_overwrite_nothing_and_what_is_as_handed_out_is_not_copied(course):
    for _ in range(3):
        solve(course / EXERCISE)
        notebook_reset.reset(course, "04", NOW)
    assert "nothing to reset" in notebook_reset.reset(course, "04", NOW)[0]
    assert len(kept(course)) == 3


def test_what_is_not_there_is_refused_in_words(course):
    before = (course / EXERCISE).read_bytes()
    for what in ("99", "04-none", "nothing", "", "../secret", "exercises"):
        with pytest.raises(ResetError, match=r"was handed out|no task"):
            notebook_reset.reset(course, what, NOW)
    with pytest.raises(ResetError, match="its tasks are 04-a, 04-b"):
        notebook_reset.reset(course, "04-h-robots", NOW)
    assert (course / EXERCISE).read_bytes() == before


def test_a_task_of_a_notebook_that_cannot_be_read_is_refused_and_all_of_it_can_be_reset(course):
    (course / EXERCISE).write_text("{")
    with pytest.raises(ResetError, match="slamlab reset 04"):
        notebook_reset.reset(course, "04-a", NOW)
    notebook_reset.reset(course, "04", NOW)
    assert [path.read_text() for path in kept(course)] == ["{"]


def test_a_clone_is_reset_from_git(tmp_path):
    folder = make_pack(tmp_path)
    (folder / originals.ARCHIVE).unlink()
    with pytest.raises(ResetError, match="git has no copy"):
        notebook_reset.reset(folder, "04", NOW)
    who = ["-c", "user.name=x", "-c", "user.email=x@example.org"]
    for words in (["init", "-q"], ["add", "."], [*who, "commit", "-qm", "handed out"]):
        subprocess.run(["git", *words], cwd=folder, check=True)
    solve(folder / EXERCISE)
    notebook_reset.reset(folder, "04", NOW)
    assert (folder / EXERCISE).read_bytes() == json_bytes(handed_out())


class Killed(BaseException):
    """Stands for the end of the process."""


def raise_killed(*given):
    raise Killed


def moments(monkeypatch, act):
    """Kill an act before its first write, its second, and so on; yields after each."""
    files_write = file_writing.write
    for moment in range(100):
        left = [moment]

        def write(path, data, left=left):
            if left[0] == 0:
                raise Killed
            left[0] -= 1
            files_write(path, data)

        with monkeypatch.context() as patch:
            for module in (file_writing, notebook_reset, notebook_update):
                patch.setattr(module, "write", write)
            try:
                act()
            except Killed:
                yield moment
            else:
                return
    raise AssertionError("never done")


def test_a_reset_killed_at_any_moment_loses_nothing(course, monkeypatch):
    before = (course / EXERCISE).read_bytes()
    for _ in moments(monkeypatch, lambda: notebook_reset.reset(course, "04", NOW)):
        assert (course / EXERCISE).read_bytes() == before
    assert before in [path.read_bytes() for path in kept(course)]


def test_a_write_that_is_killed_leaves_the_old_file_whole(tmp_path, monkeypatch):
    path = tmp_path / "x"
    file_writing.write(path, b"old")
    monkeypatch.setattr(file_writing.os, "replace", raise_killed)
    with pytest.raises(Killed):
        file_writing.write(path, b"new")
    assert path.read_bytes() == b"old"


def test_a_new_edition_replaces_what_was_not_touched_and_keeps_answers(course, pack):
    before = (course / EXERCISE).read_bytes()
    notebook_update.update(course, pack, NOW)
    after = read(course / EXERCISE)
    assert list(after) == ["head", "a", "a2", "mine", "more", "04-a", "b", "04-b"]
    assert (after["head"], after["a"]) == ("Edition 2", "def a():\n    return 1")
    cells = {cell["id"]: cell for cell in json.loads((course / EXERCISE).read_bytes())["cells"]}
    assert cells["04-a"]["metadata"]["nbgrader"]["points"] == 2
    assert [path.read_bytes() for path in kept(course)] == [before]
    assert (course / "lab.py").read_bytes() == b"edition 2"
    assert (course / "slamlab" / "new.py").read_bytes() == b"edition 2"
    assert [path.name for path in (course / "pages").iterdir()] == ["film-2.js"]
    assert originals.original(course, EXERCISE) == json_bytes(handed_out(2))
    assert list(course.glob(".update-*")) == []


def test_an_exercise_that_was_only_run_counts_as_untouched(tmp_path, pack):
    course = make_pack(tmp_path / "course")
    with edited(course / EXERCISE) as cells:
        cells[1] |= {"outputs": [{"output_type": "stream"}], "execution_count": 1}
    notebook_update.update(course, pack, NOW)
    assert (course / EXERCISE).read_bytes() == json_bytes(handed_out(2))


def test_an_update_killed_at_any_moment_loses_nothing_and_can_be_run_again(
    course, pack, monkeypatch
):
    before = (course / EXERCISE).read_bytes()
    for _ in moments(monkeypatch, lambda: notebook_update.update(course, pack, NOW)):
        there = [(course / EXERCISE).read_bytes(), *(path.read_bytes() for path in kept(course))]
        assert before in there
    after = read(course / EXERCISE)
    assert (after["head"], after["a"]) == ("Edition 2", "def a():\n    return 1")


def test_a_file_that_is_not_a_pack_is_refused(course, tmp_path):
    for content in (b"", b"PK nonsense"):
        (tmp_path / "x.zip").write_bytes(content)
        with pytest.raises(notebook_update.UpdateError, match=r"x\.zip"):
            notebook_update.update(course, tmp_path / "x.zip", NOW)
    with zipfile.ZipFile(tmp_path / "y.zip", "w") as other:
        other.writestr("a", "b")
    with pytest.raises(notebook_update.UpdateError, match="not a students' pack"):
        notebook_update.update(course, tmp_path / "y.zip", NOW)


def test_the_commands_report_what_they_did_and_what_is_wrong(course, monkeypatch, capsys, tmp_path):
    monkeypatch.chdir(course / "exercises")
    assert main(["reset", "04-a"]) == 0
    assert "reset to the handed-out version" in capsys.readouterr().out
    assert main(["reset", "77"]) == 2
    assert main(["update", "none.zip"]) == 2
    assert main(["progress"]) == 0
    monkeypatch.chdir(tmp_path)
    for words in (["reset", "04"], ["update", "x.zip"], ["progress"]):
        assert main(words) == 2
        assert "course folder" in capsys.readouterr().err


def test_a_milestone_without_cells_of_its_own_has_those_of_the_task_before():
    cells = handed_out()["cells"]
    cells.insert(4, code("04-a-too", 'check("04-a-too")', grade=True, points=1))
    of = {
        task: [cell["id"] for cell in notebook_reset.task_cells(cells, task)]
        for task in ("04-a", "04-a-too", "04-b", "04-none")
    }
    assert of == {"04-a": ["a", "a2"], "04-a-too": ["a", "a2"], "04-b": ["b"], "04-none": []}
