"""The recordings of a lesson are fetched by its number."""

import json

import pytest

from classroom import installed_course
from slamlab.cli import main
from slamlab.sources.public_datasets import RECORDINGS

BY_LESSON = json.loads(installed_course.file("recordings.json").read_text("utf-8"))


@pytest.mark.parametrize("lesson", BY_LESSON)
def test_a_lesson_gets_the_recordings_that_it_uses(lesson, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("SLAMLAB_DATA", str(tmp_path / "data"))
    assert main(["data", "get", "--lesson", lesson.zfill(2), "--from", str(tmp_path)]) == 2
    refused = [line.split(": ")[1] for line in capsys.readouterr().err.splitlines()]
    assert refused == BY_LESSON[lesson] and set(refused) <= set(RECORDINGS)


@pytest.mark.parametrize("lesson", ["4", "0", "x", "-1"])
def test_a_lesson_without_recordings_is_refused_in_one_line(lesson, capsys):
    with pytest.raises(SystemExit) as ended:
        main(["data", "get", "--lesson", lesson])
    err = capsys.readouterr().err
    assert ended.value.code == 2 and err.count("\n") == 1 and "--lesson" in err
