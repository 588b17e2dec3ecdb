"""What all logs share: a file of lines, plain or gzip, of which damage may have left a part."""

from slamlab.sources.base import Source
from slamlab.sources.text import lines, read_bytes


class LogFile(Source):
    """A source that is a file of lines; subclasses take them in by ``_read``.

    Parameters
    ----------
    path : str or Path
    content : (bytes, bool) what ``read_bytes`` gave for the path, where that was done already

    Raises
    ------
    SourceError : the file cannot be read or holds no readable reading
    """

    def __init__(self, path, content=None):
        super().__init__()
        self.name = str(path)
        content, torn = read_bytes(path) if content is None else content
        if torn:
            self.damage["file torn"] += 1
        self._read(list(lines(content)))

    def _read(self, lines):
        """Take the lines in; each comes with whether its end was there."""
        raise NotImplementedError
