"""Base class of log file parsers: a text file of lines, plain or gzip, truncated or damaged too."""

from slamlab.files.text_files import lines, read_bytes
from slamlab.sources.base import Source


class LogFile(Source):
    """Log file as a source; subclasses parse its lines by ``_parse``.

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
        self._parse(list(lines(content)))

    def _parse(self, lines):
        """Parse the lines; each comes with whether its end was there."""
        raise NotImplementedError
