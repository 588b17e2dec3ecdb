"""Recorder of films: takes scenes, one a frame, and writes them to a file as they come."""

import gzip
import os
from contextlib import contextmanager, suppress
from pathlib import Path

from slamlab.files.errors import SourceError
from slamlab.files.text_files import reason
from slamlab.films.film_file import FrameEncoder, header_line
from slamlab.films.film_reader import FilmError, check_header

SIZE = 720, 480  # of the picture, as of a live view [pixels]


class FilmRecorder:
    """Recorder of a film, a context manager; the file is there when it is left.

    However it is left, what was recorded until then is a whole film. One without frames is not
    kept. Until then the film is beside, in ``FILE.part``.

    Parameters
    ----------
    path : str or Path, a new file, or a film, which is replaced
    title : str
    alt : str, what the film shows, for who cannot see it
    size : (width, height) of the picture [pixels]

    Raises
    ------
    FilmError : another file is there
    SourceError : it cannot be written, then or later
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
        # no name and no time in it: the same frames are the same bytes
        self._file = gzip.GzipFile("", "wb", compresslevel=9, fileobj=self._bytes, mtime=0)

    def add(self, scene):
        """Add a frame.

        Parameters
        ----------
        scene : Scene; the film's robot has the first one's radius
        """
        frame = self._encoder.encode(scene)
        if not self.frames:
            frame = header_line(*self._header, scene.radius) + frame
        with self._writing():
            self._file.write(frame)
        self.frames += 1

    def close(self):
        """End the film; may be called twice."""
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
        """Say which file it is that cannot be written; half a film is no use and takes room."""
        try:
            yield
        except OSError as error:
            if hasattr(self, "_bytes"):
                with suppress(OSError):  # it may hold bytes that find no room either
                    self._bytes.close()
                self._part.unlink(missing_ok=True)
            raise SourceError(f"{self.path} cannot be written: {reason(error)}") from None


def _require_film(path):
    if not path.is_file():
        raise FilmError(f"{path} is no file: name a new one")
    try:
        check_header(path)
    except FilmError:
        raise FilmError(f"{path} is there, and no film of this version: name a new file") from None
