"""``slamlab run --film`` and ``slamlab film`` as a user meets them."""

import webbrowser

import numpy as np
import pytest

from slamlab.cli import main
from slamlab.live.films import load
from tests.slamlab.films.scenes import record, scenes


@pytest.fixture(autouse=True)
def opened(monkeypatch):
    """The pages that the browser was asked to open."""
    pages = []
    monkeypatch.setattr(webbrowser, "open", lambda address: pages.append(address) or True)
    return pages


def test_a_run_is_filmed_a_frame_a_reading_with_truth_and_naive_track_beside(tmp_path, capsys):
    path = tmp_path / "run.film"
    words = ["run", "sim:polygon-wrong", "--estimator", "walls", "--film", str(path)]
    assert main(words) == 0
    assert f"slamlab film {path} plays it" in capsys.readouterr().out
    film = load(path)
    assert film.header["title"] == "walls on sim:polygon-wrong"
    assert len(film) == 4
    tracks = {layer.name: layer.rows for layer in list(film)[2][1] if layer.kind == "poses"}
    assert [len(tracks[name]) for name in ("truth", "naive", "corrected")] == [3] * 3
    assert list(film)[2][0].startswith("step 3 of 4 · t = ")
    assert np.allclose(tracks["truth"], tracks["corrected"], atol=0.1)
    assert not np.allclose(tracks["truth"], tracks["naive"], atol=0.1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "size", "kinds"),
    [("icp", 800_000, ["points", "poses"]), ("walls", 100_000, ["poses"])],
)
def test_a_film_of_a_whole_run_is_small(name, size, kinds, tmp_path):
    path = tmp_path / "run.film"
    assert main(["run", "sim:situation-1", "--estimator", name, "--film", str(path)]) == 0
    assert path.stat().st_size <= size
    naive = [layer.kind for layer in list(load(path))[-1][1] if layer.name == "naive"]
    assert sorted(naive) == kinds, "an estimator may have a naive map of its own"


def test_an_estimator_that_is_odometry_has_no_track_beside(tmp_path):
    path = tmp_path / "run.film"
    assert main(["run", "sim:polygon", "--estimator", "odometry", "--film", str(path)]) == 0
    names = [(layer.kind, layer.name) for layer in list(load(path))[-1][1]]
    assert len(names) == len(set(names))


def test_a_page_is_written_beside_the_film_and_opened(tmp_path, opened, monkeypatch, capsys):
    film = record(tmp_path / "run.film", scenes(3))
    assert main(["film", str(film)]) == 0
    page = tmp_path / "run.film.html"
    assert page.read_text("utf-8").startswith("<!doctype html>")
    assert opened == [page.as_uri()]
    assert "3 frames" in capsys.readouterr().out
    # made again it replaces itself, with or without a browser
    assert main(["film", str(film), "--no-open"]) == 0
    assert len(opened) == 1
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    assert main(["film", str(film)]) == 0
    assert "No browser was found" in capsys.readouterr().out


def test_out_determines_the_file_of_the_page_and_no_other_file_is_overwritten(
    tmp_path, opened, capsys
):
    film, other = record(tmp_path / "run.film", scenes(3)), tmp_path / "thesis.html"
    assert main(["film", str(film), "--out", str(tmp_path / "page.html")]) == 0
    assert opened == [(tmp_path / "page.html").as_uri()]
    other.write_text("<html>my thesis")
    assert main(["film", str(film), "--out", str(other)]) == 2
    assert other.read_text() == "<html>my thesis"
    assert "is not a film page" in capsys.readouterr().err
    assert main(["film", str(film), "--out", str(tmp_path / "nowhere" / "x")]) == 2
    assert "cannot be written" in capsys.readouterr().err


def test_a_file_that_is_not_a_film_is_refused_in_one_line(tmp_path, capsys, opened):
    path = tmp_path / "some"
    path.write_bytes(b"a text")
    assert main(["film", str(path)]) == 2
    output = capsys.readouterr().err
    assert output.startswith("slamlab film: ") and output.count("\n") == 1
    assert "is not a film" in output
    assert opened == [] and not (tmp_path / "some.html").exists()


def test_a_film_that_cannot_be_written_is_reported_before_the_run(tmp_path, capsys):
    assert main(["run", "sim:polygon", "--film", str(tmp_path / "no" / "f")]) == 2
    assert "cannot be written" in capsys.readouterr().err
