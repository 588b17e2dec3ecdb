"""What students get, and what a worker holds, is the course and none of its solutions."""

import io
import json
import posixpath
import re
import subprocess
import sys
import zipfile
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from flit_core import wheel

from course import pack
from course.programs import programs
from slamlab.coursework import originals
from slamlab.exercises import catalogue
from slamlab.grading import staging
from tests.notebooks.test_derived import telling, tokens

PATH = re.compile(r"[\w./-]+\.(ipynb|md|png|svg|py)")  # in code, brackets may stand so
OURS = {"solutions", "course", "tests", "benchmarks"}


@pytest.fixture(scope="module")
def packed(tmp_path_factory):
    target = tmp_path_factory.mktemp("pack") / "student.zip"
    pack.pack(target, pack.contents())
    return target


@pytest.fixture(scope="module", params=["pack", "wheel", "worker"])
def shipped(request, tmp_path_factory):
    """Name to content of every file that goes out: the students' zip, the wheel, the workers'."""
    folder = tmp_path_factory.mktemp(request.param)
    if request.param == "worker":
        for id in catalogue.EXERCISES:
            (folder / id).mkdir()
            staging.copy_modules(folder / id, catalogue.exercise(id))
        files = [path for path in folder.rglob("*") if path.is_file()]
        return {path.relative_to(folder): path.read_bytes() for path in files}
    if request.param == "wheel":
        target = wheel.make_wheel_in(pack.ROOT / "pyproject.toml", folder).file
    else:
        target = request.getfixturevalue("packed")
    with zipfile.ZipFile(target) as opened:
        return {Path(name): opened.read(name) for name in opened.namelist()}


@cache
def all_programs():
    """Every right way and every slip of every task, as source."""
    return {
        source.strip()
        for id in catalogue.EXERCISES
        for one in programs(id)
        for source in [*one.ways.values(), *(one.source(p) for s in one.slips for p in s.programs)]
    }


@cache
def solutions():
    """The code cells of the solved notebooks that are not handed out, as they are and unmarked."""
    found = set()
    for path in (pack.ROOT / "solutions").glob("*.ipynb"):
        handed_out = cells((pack.ROOT / "exercises" / path.name).read_bytes())
        for source in cells(path.read_bytes()):
            if source not in handed_out:
                lines = [line for line in source.splitlines() if "### " not in line]
                found |= {source, "\n".join(lines)}
    return found


@cache
def secrets():
    """All that must not go out, by its first line: where that is not, none of them is."""
    found = {}
    for source in solutions() | all_programs():
        found.setdefault(source.partition("\n")[0], []).append(source)
    return found


def told(text):
    """What a text tells of them."""
    met = (sources for first, sources in secrets().items() if first in text)
    return [source for sources in met for source in sources if source in text]


def cells(notebook):
    """The sources of the cells of a notebook's file."""
    return ["".join(cell["source"]) for cell in json.loads(notebook)["cells"]]


def test_the_same_project_gives_the_same_file(packed, tmp_path):
    pack.pack(tmp_path / "again.zip", pack.contents())
    assert (tmp_path / "again.zip").read_bytes() == packed.read_bytes()


def test_what_was_drawn_in_a_lecture_stays_with_the_lecturer(tmp_path, monkeypatch):
    (tmp_path / "notebooks").mkdir()
    for name in ("07_a.ipynb", "07_a.ink.json", "07_a.ink.damaged.json", "07_a.ink.damaged-2.json"):
        (tmp_path / "notebooks" / name).write_text("{}")
    monkeypatch.setattr(pack, "LECTURERS_FOLDERS", ("notebooks",))
    monkeypatch.setattr(pack, "LECTURERS_FILES", ())
    assert list(pack.lecturers_contents(tmp_path)) == ["notebooks/07_a.ipynb"]


def test_it_holds_every_lesson_and_exercise(packed):
    names = zipfile.ZipFile(packed).namelist()
    for folder in ("notebooks", "exercises"):
        ours = {f"{pack.TOP}/{folder}/{p.name}" for p in (pack.ROOT / folder).glob("*.ipynb")}
        assert ours
        assert ours <= set(names)


def test_students_get_no_notes_and_lecturers_do(packed):
    note = "*For the lecturer:*"
    path = next((pack.ROOT / "notebooks").glob("04_*.ipynb"))
    lecturers = pack.lecturers_contents()
    assert note in lecturers[f"notebooks/{path.name}"].decode()
    assert any(name.startswith("solutions/") for name in lecturers)
    for name, data in opened(packed).items():
        assert note not in data.decode("utf-8", "replace"), name
        if name.endswith(".ipynb"):
            marks = set().union(*(pack.marks(cell) for cell in json.loads(data)["cells"]))
            assert marks.isdisjoint(pack.LECTURER), name


def opened(packed):
    """Name, from the course's folder on, to content of every file in a pack."""
    with zipfile.ZipFile(packed) as found:
        return {name.removeprefix(f"{pack.TOP}/"): found.read(name) for name in found.namelist()}


def test_no_link_that_students_get_leads_nowhere(packed):
    files = opened(packed)
    links = 0
    for name, data in files.items():
        if not name.endswith((".md", ".ipynb")):
            continue
        texts = [data.decode()] if name.endswith(".md") else cells(data)
        for link in re.findall(r"\]\(([^)#\s]+)[^)]*\)", "\n".join(texts)):
            if link.startswith(("http:", "https:", "attachment:")) or not PATH.fullmatch(link):
                continue
            target = posixpath.normpath(posixpath.join(posixpath.dirname(name), link))
            assert target in files, f"{name} links {link}"
            links += 1
    assert links > 60


def test_students_are_told_nothing_of_what_they_do_not_get(packed):
    for name, data in opened(packed).items():
        if name.endswith((".md", ".ipynb")):
            text = "\n".join(cells(data)) if name.endswith(".ipynb") else data.decode()
            for word in ("benchmarks", "`git ", "make test", "make student", "solutions/"):
                assert word not in text, (name, word)


def test_what_a_pack_can_reset_to_is_what_stands_in_it(packed):
    files = opened(packed)
    with zipfile.ZipFile(io.BytesIO(files[originals.ARCHIVE])) as archive:
        kept = {name: archive.read(name) for name in archive.namelist()}
    assert kept == {name: data for name, data in files.items() if name.endswith(".ipynb")}


def test_no_folder_of_ours_goes_out(shipped):
    assert len(shipped) > 20
    assert {part for path in shipped for part in path.parts[:2]}.isdisjoint(OURS)
    ours = {path.name for path in (pack.ROOT / "course").glob("*.py")} - {"__init__.py"}
    stray = [path for path in shipped if path.name in ours and "exercises" not in path.parts]
    assert stray == []


def test_nothing_that_goes_out_imports_the_course_or_needs_it(shipped):
    texts = {path: data for path, data in shipped.items() if path.suffix in (".py", ".ipynb")}
    ours = re.compile(rb"(import|from) course\b")
    assert [path for path, text in texts.items() if ours.search(text)] == []


def test_no_file_that_goes_out_holds_the_text_of_a_solution(shipped):
    assert len(solutions()) > 2 * len(catalogue.EXERCISES)
    for path, data in shipped.items():
        text = data.decode("utf-8", "replace")
        text = "\n".join(cells(data)) if path.suffix == ".ipynb" else text
        assert b"BEGIN SOLUTION" not in data, path
        assert told(text) == [], path


def test_a_solution_that_went_out_would_be_found():
    (path,) = (pack.ROOT / "solutions").glob("ex06_*.ipynb")
    out = "\n".join(cells(path.read_bytes()))
    assert len(told(out)) >= 4


@pytest.mark.slow
def test_fingerprints_that_go_out_hold_numbers_and_hints_and_no_line_of_a_program(shipped):
    lines = {line for source in all_programs() for line in source.splitlines() if telling(line)}
    told = {"".join(tokens(line)) for line in lines}
    for path, data in shipped.items():
        if path.suffix != ".npz":
            continue
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:
            arrays = dict(stored)
        for key, array in arrays.items():
            assert array.dtype.kind in "fiU", (path, key)
            is_text = key.rpartition("/")[2] in ("digest", "names", "hints", "parts")
            assert is_text == (array.dtype.kind == "U"), (path, key)
            for text in array.ravel().tolist() if is_text else ():
                said = "".join(tokens(text))
                assert "BEGIN" not in text
                assert "def " not in text
                assert [line for line in told if line in said] == [], (path, text)


def test_its_package_runs_where_it_is_unpacked(packed, tmp_path):
    zipfile.ZipFile(packed).extractall(tmp_path)
    code = "import slamlab, slamlab.cli as c; print(slamlab.__file__); c.main(['check', '--help'])"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path / pack.TOP, capture_output=True, text=True
    )
    assert str(tmp_path) in done.stdout
    assert "usage: slamlab check" in done.stdout
