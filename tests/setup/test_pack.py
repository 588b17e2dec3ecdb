"""What students get holds the course and none of its solutions."""

import json
import subprocess
import sys
import zipfile

import pytest

from course import pack


@pytest.fixture(scope="module")
def packed(tmp_path_factory):
    target = tmp_path_factory.mktemp("pack") / "student.zip"
    pack.pack(target)
    return target


def test_the_same_project_gives_the_same_file(packed, tmp_path):
    pack.pack(tmp_path / "again.zip")
    assert (tmp_path / "again.zip").read_bytes() == packed.read_bytes()


def test_it_holds_every_lesson_and_exercise_and_no_solution(packed):
    names = zipfile.ZipFile(packed).namelist()
    for folder in ("notebooks", "exercises"):
        ours = {f"{pack.TOP}/{folder}/{p.name}" for p in (pack.ROOT / folder).glob("*.ipynb")}
        assert ours
        assert ours <= set(names)
    parts = {part for name in names for part in name.split("/")[1:2]}
    assert parts.isdisjoint({"solutions", "course", "tests", "benchmarks"})


def test_no_file_of_it_holds_the_text_of_a_solution(packed):
    solutions = []
    for path in (pack.ROOT / "solutions").glob("*.ipynb"):
        handed_out = (pack.ROOT / "exercises" / path.name).read_text("utf-8")
        for cell in json.loads(path.read_text("utf-8"))["cells"]:
            source = "".join(cell["source"])
            if cell["cell_type"] == "code" and json.dumps(source)[1:-1] not in handed_out:
                solutions.append(source)
    with zipfile.ZipFile(packed) as opened:
        texts = [opened.read(n) for n in opened.namelist() if n.endswith((".py", ".ipynb"))]
    assert solutions
    for source in solutions:
        assert not any(json.dumps(source)[1:-1].encode() in text for text in texts)
    assert not any(b"BEGIN SOLUTION" in text for text in texts)


def test_its_package_runs_where_it_is_unpacked(packed, tmp_path):
    zipfile.ZipFile(packed).extractall(tmp_path)
    code = "import slamlab, slamlab.cli as c; print(slamlab.__file__); c.main(['check', '--help'])"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path / pack.TOP, capture_output=True, text=True
    )
    assert str(tmp_path) in done.stdout
    assert "usage: slamlab check" in done.stdout
