"""The students' pack and a worker's files contain no solutions."""

import io
import json
import posixpath
import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hatchling.builders.sdist import SdistBuilder
from hatchling.builders.wheel import WheelBuilder

from classroom.coursework import originals
from classroom.exercises import catalogue
from classroom.grading import staging
from course import lecturer_cells, pack
from course.task_programs import programs
from tests.course.notebooks.test_derived import telling, tokens

PATH = re.compile(r"[\w./-]+\.(ipynb|md|png|svg|py)")  # in code, brackets may stand so
OURS = {"solutions", "tests", "benchmarks"}
COURSE = {"__init__.py", "recordings.json", "exercises", "originals.zip", "questions", "studies"}
"""All of the course's folder that goes out."""


@pytest.fixture(scope="module")
def packed(tmp_path_factory):
    target = tmp_path_factory.mktemp("pack") / "student.zip"
    pack.pack(target, pack.contents())
    return target


@pytest.fixture(scope="module", params=["pack", "wheel", "sdist", "library", "worker"])
def shipped(request, tmp_path_factory):
    """Name to content of every file that goes out: of the pack, the distributions, the workers."""
    folder = tmp_path_factory.mktemp(request.param)
    if request.param == "worker":
        for id in catalogue.EXERCISES:
            (folder / id).mkdir()
            staging.copy_modules(folder / id, catalogue.exercise(id))
        files = [path for path in folder.rglob("*") if path.is_file()]
        return {path.relative_to(folder): path.read_bytes() for path in files}
    if request.param == "sdist":
        (built,) = SdistBuilder(str(pack.ROOT)).build(directory=str(folder))
        with tarfile.open(built) as opened:
            held = {member.name: opened.extractfile(member) for member in opened if member.isfile()}
            return {Path(*Path(name).parts[1:]): file.read() for name, file in held.items()}
    if request.param == "pack":
        target = request.getfixturevalue("packed")
    else:
        root = pack.ROOT / "slamlab" if request.param == "library" else pack.ROOT
        (target,) = WheelBuilder(str(root)).build(directory=str(folder), versions=["standard"])
    with zipfile.ZipFile(target) as opened:
        return {Path(name): opened.read(name) for name in opened.namelist()}


@cache
def all_programs():
    """Every right way and every slip of every task, as source."""
    found = set()
    for one in (one for id in catalogue.EXERCISES for one in programs(id)):
        slips = [one.source(program) for slip in one.mistakes for program in slip.programs]
        found |= {source.strip() for source in [*one.ways.values(), *slips]}
    return found


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


def report(text):
    """Return what a text contains of them."""
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


def test_a_folder_keeps_no_file_of_an_earlier_edition(tmp_path, monkeypatch):
    monkeypatch.setattr(pack, "contents", lambda: {"notebooks/new.ipynb": b"{}"})
    (tmp_path / "notebooks").mkdir()
    for name in ("notebooks/old.ipynb", "settings.toml"):
        (tmp_path / name).touch()
    assert pack.main(["--folder", str(tmp_path)]) == 0
    left = {str(p.relative_to(tmp_path)) for p in tmp_path.rglob("*") if p.is_file()}
    assert left == {"notebooks/new.ipynb", "settings.toml"}
    (tmp_path / ".git").mkdir()
    with pytest.raises(SystemExit):
        pack.main(["--folder", str(tmp_path)])


def test_students_get_no_notes_and_lecturers_do(packed):
    note = "*For the lecturer:*"
    path = next((pack.ROOT / "notebooks").glob("04_*.ipynb"))
    lecturers = pack.lecturers_contents()
    assert note in lecturers[f"notebooks/{path.name}"].decode()
    assert any(name.startswith("solutions/") for name in lecturers)
    for name, data in opened(packed).items():
        assert note not in data.decode("utf-8", "replace"), name
        if name.endswith(".ipynb"):
            marks = set().union(*(lecturer_cells.marks(cell) for cell in json.loads(data)["cells"]))
            assert marks.isdisjoint(lecturer_cells.LECTURER), name


def opened(packed):
    """Name, from the course's folder on, to content of every file in a pack."""
    with zipfile.ZipFile(packed) as found:
        return {name.removeprefix(f"{pack.TOP}/"): found.read(name) for name in found.namelist()}


def test_students_get_every_lesson_and_exercise_and_no_link_leads_nowhere(packed):
    files = opened(packed)
    for folder in ("notebooks", "exercises"):
        ours = {f"{folder}/{path.name}" for path in (pack.ROOT / folder).glob("*.ipynb")}
        assert ours and ours <= files.keys()
    links = 0
    for name, data in files.items():
        if not name.endswith((".md", ".ipynb")):
            continue
        text = data.decode() if name.endswith(".md") else "\n".join(cells(data))
        # "benchmarks" alone is a term of lesson 16
        for word in ("benchmarks/", "-m benchmarks", "solutions/", "`git ", "make test",
                     "make student"):  # fmt: skip
            assert word not in text, (name, word, "is of files that they do not get")
        for link in re.findall(r"\]\(([^)#\s]+)[^)]*\)", text):
            if link.startswith(("http:", "https:", "attachment:")) or not PATH.fullmatch(link):
                continue
            target = posixpath.normpath(posixpath.join(posixpath.dirname(name), link))
            assert target in files, f"{name} links {link}"
            links += 1
    assert links > 60


def test_what_a_pack_can_reset_to_is_what_stands_in_it(packed):
    files = opened(packed)
    with zipfile.ZipFile(io.BytesIO(files[originals.ARCHIVE])) as archive:
        kept = {name: archive.read(name) for name in archive.namelist()}
    assert kept == {name: data for name, data in files.items() if name.endswith(".ipynb")}


def test_no_folder_of_ours_goes_out(shipped):
    assert len(shipped) > 20
    assert {part for path in shipped for part in path.parts[:2]}.isdisjoint(OURS)
    ours = {path.name for path in (pack.ROOT / "course").glob("*.py")} - {"__init__.py"}
    parts = [path.parts[path.parts.index("course") :] for path in shipped if "course" in path.parts]
    assert {path[1] for path in parts if len(path) > 1} <= COURSE
    stray = [path for path in shipped if path.name in ours and path.parts[-2:-1] == ("course",)]
    assert stray == []


def test_nothing_that_goes_out_imports_of_the_course_what_does_not(shipped):
    texts = {path: data for path, data in shipped.items() if path.suffix in (".py", ".ipynb")}
    inside = "|".join(name.removesuffix(".py") for name in COURSE)
    ours = re.compile(rf"(import|from) course(?!\.({inside})\b)[.\w]* ".encode())
    assert [path for path, text in texts.items() if ours.search(text)] == []


def test_the_two_distributions_hold_what_they_declare(tmp_path):
    declared = tomllib.loads((pack.ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["hatch"]
    targets = declared["build"]["targets"]
    assert targets["sdist"]["only-include"] == [*targets["wheel"]["only-include"], "labextension"]
    held = {}
    for root in (pack.ROOT, pack.ROOT / "slamlab"):
        (built,) = WheelBuilder(str(root)).build(directory=str(tmp_path), versions=["standard"])
        held[root] = set(zipfile.ZipFile(built).namelist())
    course, library = held.values()
    for name in ("slamlab/cli/run.py", "slamlab/live/player/drawing.js"):
        assert name in library and name not in course
    assert {name.split("/")[0] for name in library if ".dist-info" not in name} == {"slamlab"}
    for name in ("classroom/grading/feedback.html", "course/questions/06.json",
                 "course/exercises/ex06_ekf_slam/fingerprints.npz",
                 "course/studies/wall_slam_variants.json"):  # fmt: skip
        assert name in course and name not in library
    assert any(name.endswith("labextensions/slamlab/package.json") for name in course)


def test_no_file_that_goes_out_holds_the_text_of_a_solution(shipped):
    assert len(solutions()) > 2 * len(catalogue.EXERCISES)
    for path, data in shipped.items():
        text = data.decode("utf-8", "replace")
        text = "\n".join(cells(data)) if path.suffix == ".ipynb" else text
        assert b"BEGIN SOLUTION" not in data, path
        assert report(text) == [], path


def test_a_solution_that_went_out_would_be_found():
    (path,) = (pack.ROOT / "solutions").glob("ex06_*.ipynb")
    out = "\n".join(cells(path.read_bytes()))
    assert len(report(out)) >= 4


TEXTS = {"digest", "names", "hints", "parts", "quantities", "asks", "places", "questions"}


@pytest.mark.slow
def test_fingerprints_that_go_out_hold_numbers_and_hints_and_no_line_of_a_program(shipped):
    lines = {line for source in all_programs() for line in source.splitlines() if telling(line)}
    reported = {"".join(tokens(line)) for line in lines}
    for path, data in shipped.items():
        if path.suffix != ".npz":
            continue
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:
            arrays = dict(stored)
        for key, array in arrays.items():
            assert array.dtype.kind in "fiU", (path, key)
            is_text = key.rpartition("/")[2] in TEXTS
            assert is_text == (array.dtype.kind == "U"), (path, key)
            for text in array.ravel().tolist() if is_text else ():
                message = "".join(tokens(text))
                assert "BEGIN" not in text and "def " not in text
                assert [line for line in reported if line in message] == [], (path, text)


def test_its_package_runs_where_it_is_unpacked(packed, tmp_path):
    zipfile.ZipFile(packed).extractall(tmp_path)
    code = "import slamlab, slamlab.cli as c; print(slamlab.__file__); c.main(['check', '--help'])"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path / pack.TOP, capture_output=True, text=True
    )
    assert str(tmp_path) in done.stdout
    assert "usage: slamlab check" in done.stdout
