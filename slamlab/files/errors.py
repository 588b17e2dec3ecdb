"""The error of a file, log or device that cannot be read."""


class SourceError(ValueError):
    """A data source cannot be opened or holds nothing usable; the text says what to do."""
