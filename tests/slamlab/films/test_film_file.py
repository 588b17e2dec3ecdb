"""A film read again is what was recorded, but for half a step; what is damaged is refused."""

import errno
import gzip
import json
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slamlab.layers import Points, Poses
from slamlab.live import films
from slamlab.live.films import FilmError, FilmRecorder, load
from slamlab.live.films.film_file import FrameEncoder, header_line
from slamlab.live.films.quantising import steps
from slamlab.live.frame_packing import Scene
from slamlab.sources import SourceError
from tests.slamlab.films.scenes import content, damaged, record, scenes


def assert_same(scene, shown, step=0.001):
    """Assert that the layers of a frame are a scene's."""
    assert [layer.name for layer in shown] == [layer.name for layer in scene.drawables]
    for layer, given_ in zip(shown, scene.drawables, strict=True):
        for name in ("kind", "colour", "panel"):
            assert getattr(layer, name) == getattr(given_, name)
        turned = np.exp(1j * layer.rows) - np.exp(1j * given_.rows)
        assert layer.rows.shape == given_.rows.shape
        assert np.all(np.abs(turned) <= step / 2 + 1e-6)


def test_every_kind_of_layer_can_be_read_again_and_the_bytes_are_the_same_each_time(tmp_path):
    made = scenes()
    paths = [record(tmp_path / name, made) for name in ("a", "b")]
    assert paths[0].read_bytes() == paths[1].read_bytes()
    film = load(paths[0])
    assert len(film) == len(made)
    for scene, (status, shown) in zip(made, film, strict=True):
        assert status == scene.status
        assert_same(scene, shown)
    assert film.header["title"] == "A run"
    assert film.header["size"] == [720, 480]


cuts = st.lists(st.integers(0, 60), min_size=1, max_size=8)


@given(cuts, st.sampled_from([1, 10, 1000]), st.integers(0, 2**32 - 1))
def test_incremental_frames_reproduce_any_tables(cuts, size, seed):
    rows = np.random.default_rng(seed).normal(size=(60, 2)).astype(np.float32) * size
    encoder = FrameEncoder()
    frames = [encoder.encode(Scene([Points("map", rows[:cut])])) for cut in cuts]
    film = read(header_line("", "", (1, 1), 0.1) + b"".join(frames))
    for frame, (_, (layer,)) in enumerate(film):
        allowed = np.array(steps("points", rows[: max(cuts[: frame + 1])])) / 2
        assert layer.rows.shape == (cuts[frame], 2)
        assert np.all(np.abs(layer.rows - rows[: cuts[frame]]) <= allowed * (1 + 1e-9))


def read(data):
    """A film of such a content."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "film")
        path.write_bytes(gzip.compress(data, 1))
        return load(path)


def test_unchanged_data_are_not_written_and_a_name_once():
    points = np.random.default_rng(0).normal(size=(1000, 2))
    encoder = FrameEncoder()
    first, then = (encoder.encode(Scene([Points("map", points)])) for _ in range(2))
    grown = encoder.encode(Scene([Points("map", np.vstack([points, [[1.0, 2]]]))]))
    assert len(first) > 4000 > 60 > len(then)
    assert len(grown) < 70
    assert b"map" in first and b"map" not in then + grown


def test_a_layer_that_needs_larger_steps_is_declared_again():
    near, far = np.array([[1.0, 2]]), np.array([[1.0, 2], [300, -4]])
    film = read(content([Scene([Points("map", rows)]) for rows in (near, far, far)]))
    first, *others = (shown for _, shown in film)
    assert_same(Scene([Points("map", near)]), first)
    for (layer,) in others:
        assert layer.rows == pytest.approx(far, abs=0.005)


def test_a_layer_that_returns_is_written_completely():
    rows = np.array([[1.0, 2], [3, 4]])
    made = [Scene([Points("map", rows)]), Scene([]), Scene([Points("map", rows)])]
    film = read(content(made))
    assert [len(shown) for _, shown in film] == [1, 0, 1]
    assert_same(made[2], list(film)[2][1])


def test_the_documented_header_and_frames_are_what_is_written():
    header, frame, *_ = content(scenes(1)).split(b"\n")
    assert set(json.loads(header)) == {"format", "version", "title", "alt", "size", "radius"}
    answer = json.loads(frame)
    assert set(answer) == {"status", "layers", "rows"}
    assert set(answer["layers"][0]) == {"kind", "name", "colour", "panel", "steps"}
    assert answer["rows"][0] == [0, 0, 5]


def test_an_incomplete_or_unreadable_film_is_refused_with_the_reason(tmp_path):
    path = tmp_path / "some.film"
    for data, message, _ in damaged(scenes()):
        path.write_bytes(data)
        with pytest.raises(FilmError, match=message):
            load(path)
    with pytest.raises(SourceError, match="does not exist"):
        load(tmp_path / "nothing")
    with pytest.raises(SourceError, match=r"is a folder\. Name a film"):
        load(tmp_path)


def test_a_film_is_complete_however_its_recording_ends(tmp_path):
    made = scenes(3)
    with pytest.raises(KeyboardInterrupt), FilmRecorder(tmp_path / "f", "", "") as film:
        for scene in made:
            film.add(scene)
        assert not film.path.exists()
        raise KeyboardInterrupt
    assert len(load(tmp_path / "f")) == 3
    assert [path.name for path in tmp_path.iterdir()] == ["f"]


def test_a_film_without_frames_is_not_kept(tmp_path):
    with FilmRecorder(tmp_path / "f", "", ""):
        pass
    assert list(tmp_path.iterdir()) == []


def test_a_film_replaces_only_a_film(tmp_path):
    path = record(tmp_path / "f", scenes(2))
    assert len(load(record(path, scenes(4)))) == 4
    path.write_text("a diary")
    with pytest.raises(FilmError, match="Name a new file"):
        FilmRecorder(path, "", "")
    assert path.read_text() == "a diary"
    with pytest.raises(FilmError, match="is not a file"):
        FilmRecorder(tmp_path, "", "")
    with pytest.raises(SourceError, match="cannot be written"):
        FilmRecorder(tmp_path / "nowhere" / "f", "", "")


def test_a_full_disk_is_reported_and_leaves_no_file(tmp_path, monkeypatch):
    def full(data):
        raise OSError(errno.ENOSPC, "No space left on device")

    with (
        pytest.raises(SourceError, match="f cannot be written: no space left on device"),
        FilmRecorder(tmp_path / "f", "", "") as film,
    ):
        film.add(scenes(1)[0])
        monkeypatch.setattr(film._file, "write", full)
        film.add(scenes(1)[0])
    assert list(tmp_path.iterdir()) == []


def test_a_page_contains_the_film_and_makes_no_requests(tmp_path):
    path = record(tmp_path / "f", scenes(2), title="A <b> & a film", alt='Says "so".')
    text = films.page(path)
    assert "<title>A &lt;b&gt; &amp; a film</title>" in text
    assert "Says &quot;so&quot;." in text
    assert "default-src 'none'" in text
    assert "http" not in text.replace("http-equiv", "")
    assert "jp-" not in text, "it knows nothing of JupyterLab"


def test_numbers_that_are_not_finite_are_shown_as_none():
    film = read(content([Scene([Poses("truth", [[0, np.inf, 0], [1, np.nan, 0], [1, 2, 3]])])]))
    ((_, (layer,)),) = film
    assert np.isnan(layer.rows).tolist() == [[False, True, False]] * 2 + [[False] * 3]
