"""Recorder of films: writes scenes to a file as frames."""

import gzip
import os
from contextlib import contextmanager, suppress
from pathlib import Path

from slamlab.files import SourceError, reason
from slamlab.live.films.film_file import FrameEncoder, header_line
from slamlab.live.films.film_reader import FilmError, check_header

SIZE = 720, 480  # of the picture, as of a live view [pixels]


class FilmRecorder:
    """Recorder of a film, a context manager. The file is complete even if the block fails.

    During the recording, the file is named ``FILE.part``. A film without frames is removed.

    Parameters
    ----------
    path : str or Path, a new file, or a film to replace
    title : str
    alt : str, description of the film
    size : (width, height) [pixels]

    Raises
    ------
    FilmError : the file exists and is not a film
    SourceError : the file cannot be written, now or later
    """

    def __init__(self, path, title, alt, size=SIZE):
        self.path, self.frames = Path(path), 0
        self._header = title, alt, size
        self._encoder = FrameEncoder()
        self._part = self.path.with_name(f"{self.path.name}.part")
        if self.path.exists():
            _require_film(self.path)
        with self._writing():
            self._bytes = open(self._part, "wb")  # noqa: SIM115  (closed by close)
        # without name and time, so that the same frames give the same bytes
        self._file = gzip.GzipFile("", "wb", compresslevel=9, fileobj=self._bytes, mtime=0)

    def add(self, scene):
        """Add a scene as a frame; the first scene determines the robot's radius."""
        frame = self._encoder.encode(scene)
        if not self.frames:
            frame = header_line(*self._header, scene.radius) + frame
        with self._writing():
            self._file.write(frame)
        self.frames += 1

    def close(self):
        if self._bytes.closed:
            return
        with self._writing():
            with self._bytes:
                self._file.close()
            if self.frames:
                os.replace(self._part, self.path)
            else:
                self._part.unlink()

    def __enter__(self):
        return self

    def __exit__(self, *exc):
        self.close()

    @contextmanager
    def _writing(self):
        """If the file cannot be written, remove its ``.part`` file and raise SourceError."""
        try:
            yield
        except OSError as error:
            if hasattr(self, "_bytes"):
                with suppress(OSError):  # writing its buffer may fail as well
                    self._bytes.close()
                self._part.unlink(missing_ok=True)
            raise SourceError(f"{self.path} cannot be written: {reason(error)}") from None


def _require_film(path):
    if not path.is_file():
        raise FilmError(f"{path} is not a file. Name a new file")
    try:
        check_header(path)
    except FilmError:
        raise FilmError(
            f"{path} exists and is not a film of this version. Name a new file"
        ) from None
